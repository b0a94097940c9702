// Convection does no net work on divergence-free velocities, whatever the cells and walls.
#include "src/parallel/reduce.hpp"
#include "tests/support/flow_run.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

/// u . N V of the faces of a cell [m^2/s^3 per dx dz], or the sum of the magnitudes of its parts.
struct WorkOfConvection {
  Convection convection;
  bool magnitude;
  KOKKOS_FUNCTION Real operator()(int i, int j, int k) const {
    const GridRef& grid = convection.grid;
    const ConstFaceRef& u = convection.u;
    const Real x = u.x(i, j, k) * convection.x(i, j, k) * grid.dy(j);
    const Real y = j > 0 ? u.y(i, j, k) * convection.y(i, j, k) * grid.dy_centre(j) : 0;
    const Real z = u.z(i, j, k) * convection.z(i, j, k) * grid.dy(j);
    return magnitude ? Kokkos::abs(x) + Kokkos::abs(y) + Kokkos::abs(z) : x + y + z;
  }
};

/// Net work over the work without its signs, for a random velocity made divergence-free by a step.
double net_work(std::array<int, 3> n, double first, WallFlow bottom, WallFlow top, unsigned seed) {
  Config config = test::flow_config(n, {0.4, 0.3, 0.9}, first);
  config.fluid->kinematic_viscosity = 1e-9;
  config.fluid->turbulence = Turbulence::none;
  config.fluid->bottom = bottom;
  config.fluid->top = top;
  test::FlowRun run(config);
  test::set_random(run.fluid.u.x, run.grid, seed);
  test::set_random(run.fluid.u.y, run.grid, seed + 1);
  test::set_random(run.fluid.u.z, run.grid, seed + 2);
  run.solver.fill_ghosts(run.fluid);
  EXPECT_LT(run.advance(1e-3).continuity_residual, 1e-13);
  const Convection convection{run.grid, run.fluid.u, run.fluid.u};
  return std::abs(sum_each_cell("test", run.grid, WorkOfConvection{convection, false})) /
         sum_each_cell("test", run.grid, WorkOfConvection{convection, true});
}

TEST(FluidConvection, DoesNoNetWorkOnAnyMeshBetweenAnyWalls) {
  const std::array<std::array<int, 3>, 5> sizes{
      {{8, 5, 12}, {9, 4, 7}, {16, 24, 10}, {5, 30, 1}, {32, 16, 32}}};
  double worst = 0;
  unsigned seed = 21;
  for (const auto& n : sizes) {
    for (const double share : {0.0, 0.6, 0.15}) {  // of the first row in a uniform one; 0: uniform
      for (const WallFlow bottom : {WallFlow::no_slip, WallFlow::free_slip}) {
        for (const WallFlow top : {WallFlow::no_slip, WallFlow::free_slip}) {
          worst = std::max(worst, net_work(n, share * 0.3 / n[1], bottom, top, seed += 3));
        }
      }
    }
  }
  test::expect_below("net work of convection over its magnitude, 60 meshes and walls", worst,
                     1e-12);
}

}  // namespace
}  // namespace barchan
