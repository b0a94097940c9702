// One grain on the paper's mesh: the cells hardly matter to it, and its momentum is the fluid's
// loss.
#include "kernels/fluid/flow_sums.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/coupled_run.hpp"
#include "tests/support/drag_reference.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using test::CoupledRun;

constexpr double kDiameter = 2e-4, kDx = 1.6e-3, kDz = 0.05 / 31.5;  // Table I, mesh 1 [m]
constexpr int kColumns = 8;

/// A piece of the paper's first mesh: 30 rows from 0.2625 mm on, smoothing over three diameters.
Config paper_mesh() {
  Config c = test::water_box({kColumns, 30, kColumns}, {kColumns * kDx, 0.025, kColumns * kDz});
  c.fluid->first_cell_height = 2.625e-4;
  c.coupling.smoothing_length = 6e-4;
  return c;
}

/// A step of a grain held at x in a flow of u(i, y) [m/s] on the x-faces before cells i.
template <class Velocity>
CoupledRun held_grain(Config c, const Vec3& x, const Velocity& u) {
  c.grains->frozen = true;
  InitialGrains grain;
  test::add_grain(grain, kDiameter, x);
  CoupledRun run(c, grain);
  const test::HostGrid h(run.state.fluid->grid);
  test::set_field(run.state.fluid->u.x, run.state.fluid->grid,
                  [&](int i, int j, int) { return u(i, h.y(j)); });
  run.fill_ghosts();
  run.advance();
  return run;
}

/// Drag along x on it [N], in the flow u = bulk + shear y.
double drag_at(const Vec3& x, double bulk, double shear) {
  Config c = paper_mesh();
  if (shear > 0) c.fluid->bottom = WallFlow::no_slip;
  CoupledRun run = held_grain(c, x, [&](int, double y) { return bulk + shear * y; });
  return test::force_on_first(run, "force_drag").x;
}

struct Range {
  double low = 1e300, high = -1e300;
  void add(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
  double variation() const { return (high - low) / std::abs((high + low) / 2); }
};

/// Steps of a fraction of the path from one point to another.
template <class Value>
Range along(const Vec3& from, const Vec3& to, const Value& value) {
  Range range;
  constexpr int kSteps = 64;
  for (int n = 0; n <= kSteps; ++n) range.add(value(from + (double(n) / kSteps) * (to - from)));
  return range;
}

void check(const char* what, const Range& r) {
  test::expect_below(std::string("variation of the drag, ") + what, r.variation(), 0.05);
}

TEST(GrainOnMesh, DragIsSteadyAcrossCellsInUniformFlow) {
  const auto drag = [](const Vec3& x) { return drag_at(x, 0.02, 0); };
  const Vec3 low{2.5 * kDx, 1.1e-4, 2.5 * kDz}, high{2.5 * kDx, 2e-3, 2.5 * kDz};
  check("along x at the floor", along(low, low + Vec3{2 * kDx, 0, 0}, drag));
  check("along z at the floor", along(low, low + Vec3{0, 0, 2 * kDz}, drag));
  check("along y from the floor up", along(low, high, drag));
  check("along a diagonal", along(low, high + Vec3{2 * kDx, 0, kDz}, drag));
}

TEST(GrainOnMesh, DragIsSteadyAcrossCellsInShear) {
  // Wall shear of the paper, u*^2/nu = 256 1/s: 0.028 m/s at the centre of a resting grain.
  const double shear = 256;
  const auto drag = [&](const Vec3& x) { return drag_at(x, 0, shear); };
  const Vec3 low{2.5 * kDx, 1.1e-4, 2.5 * kDz}, high{2.5 * kDx, 1.5e-3, 2.5 * kDz};
  check("along x in shear, first row", along(low, low + Vec3{2 * kDx, 0, 0}, drag));
  const Vec3 second = low + Vec3{0, 2.7e-4, 0};
  check("along x in shear, second row", along(second, second + Vec3{2 * kDx, 0, 0}, drag));
  // Upwards the drag must follow the law at the velocity that is there.
  check("along y in shear, over Schiller-Naumann", along(low, high, [&](const Vec3& x) {
          return drag(x) / test::schiller_naumann_force(shear * x.y, kDiameter);
        }));
}

/// CFDEM reads velocities at the centres of cells, where +u and -u on opposite faces are nothing.
TEST(GrainOnMesh, AsCfdemReadsTheFlowItIsThatOfTheCentres) {
  const double u = 0.02, shear = 256;
  const Vec3 on_a_face{2 * kDx, 1.1e-3, 2.5 * kDz};
  const auto zigzag = [&](int i, double) { return i % 2 == 0 ? u : -u; };
  Config c = paper_mesh();
  c.coupling.scheme = CouplingScheme::centred;
  const auto read = [&](const auto& flow) {
    const CoupledRun run = held_grain(c, on_a_face, flow);
    return host_copy(run.state.grains->fluid.u_f)(0).x;
  };
  EXPECT_NEAR(read(zigzag), u, 1e-14);
  c.coupling.scheme = CouplingScheme::cfdem;
  EXPECT_NEAR(read(zigzag), 0, 1e-14);
  c.fluid->bottom = WallFlow::no_slip;
  const double in_shear = shear * on_a_face.y;
  EXPECT_NEAR(read([&](int, double y) { return shear * y; }), in_shear, 0.02 * in_shear);
}

/// A grain driven along x by its weight through cells that it stirs itself.
TEST(GrainOnMesh, DragIsSteadyOnAFreeGrain) {
  for (const double height : {1.5e-4, 5e-3}) {
    Config c = paper_mesh();
    c.grains->gravity = {9.81, 0, 0};
    InitialGrains grain;
    test::add_grain(grain, kDiameter, {0.5 * kDx, height, 2.3 * kDz});
    CoupledRun run(c, grain);
    Range drag;
    for (int n = 1; n <= 700; ++n) {
      run.advance();
      if (n <= 300) continue;  // 75 ms, more than ten response times; then 1.4 cells
      drag.add(test::force_on_first(run, "force_drag").x);
    }
    check(height < 1e-3 ? "free at the floor" : "free in the middle", drag);
  }
}

/// x-momentum of the channel's parts, and what changed it.
struct Momentum {
  double fluid, grain;  // [N s]
  double total() const { return fluid + grain; }
};

Momentum momentum(const CoupledRun& run) {
  const FluidState& f = *run.state.fluid;
  const Grid grid = f.grid;
  const GrainKinematics grain = host_copy(run.state.grains->kin)(0);
  return {1000 * grid.dx * grid.dz *
              sum_each_cell("test: momentum", grid, FlowRate{grid, f.u.x, f.alpha_f}),
          grain.m * grain.u.x};
}

/// Sums over the x-faces of the last step: alpha dp/dx, and the explicit rate (stress and, summing
/// to nothing, convection), both times volume.
struct FaceSums {
  double pressure, rate;
};
FaceSums face_sums(const FluidState& f) {
  const Grid grid = f.grid;
  const ConstFieldRef p = f.p, alpha = f.alpha_f, rate = f.rate_previous.x;
  const double area = grid.dx * grid.dz;
  return {area * sum_each_cell(
                     "test: pressure", grid,
                     KOKKOS_LAMBDA(int i, int j, int k) {
                       return cell_to_xface(alpha, i, j, k) * ddx_at_xface(grid, p, i, j, k) *
                              grid.dy(j);
                     }),
          area * sum_each_cell(
                     "test: rate", grid,
                     KOKKOS_LAMBDA(int i, int j, int k) { return rate(i, j, k) * grid.dy(j); })};
}

/// Only the weight brings momentum into a channel with one grain. The exchanged parts balance
/// exactly. Pressure gradient and stress are shared, not exchanged (docs/theory-fluid.md), and the
/// two shares, of the smoothed fraction and of the grain's centre, differ by a small part of the
/// weight.
TEST(GrainOnMesh, MomentumIsConserved) {
  Config c = paper_mesh();
  c.grains->gravity = {9.81, 0, 0};
  InitialGrains grain;
  test::add_grain(grain, kDiameter, {0.7 * kDx, 6e-4, 2.3 * kDz}, {0.05, -0.002, 0.01});
  CoupledRun run(c, grain);
  const double weight = 1500 * test::volume_of(kDiameter) * 9.81, dt = c.time.fluid_step;
  const Momentum start = momentum(run);
  Momentum last = start;
  double previous_rate = 0, unexplained = 0;
  const int steps = 400;
  for (int n = 1; n <= steps; ++n) {
    run.advance();
    const Momentum now = momentum(run);
    const ExchangeLedger& ledger = run.step.exchange();
    const FaceSums sums = face_sums(*run.state.fluid);
    const double rate = n == 1 ? sums.rate : 1.5 * sums.rate - 0.5 * previous_rate;
    const double shared = dt * (1000 * rate - sums.pressure);
    const double exchanged = -ledger.given_to_grains.x;
    unexplained = std::max(unexplained, std::abs(now.fluid - last.fluid - exchanged - shared));
    previous_rate = sums.rate;
    last = now;
  }
  const double given = weight * steps * dt;
  test::expect_below("momentum that neither exchange nor shared forces explain, over the weight's",
                     unexplained / (weight * dt), 1e-9);
  test::expect_relative("momentum of all parts, impulse of the weight [N s]",
                        last.total() - start.total(), given, 1e-3);
}

// --- The forces in the output against Newton's second law: without contacts the resultant is what
// changed the grain's momentum over the step, and the parts add up to it.

void expect_newtons_law(const char* what, Config c, double displaced_density) {
  c.grains->gravity = {2, -9.81, 0.5};
  c.grains->boundary_z = GrainBoundaryZ::periodic;
  InitialGrains grain;
  test::add_grain(grain, kDiameter, {1.3e-3, 3e-3, 2e-3}, {0.04, -0.01, 0.02});
  CoupledRun run(c, grain);
  const double volume = test::volume_of(kDiameter), m = 2500 * volume;
  const double weight = (2500 - displaced_density) * volume * -9.81;
  double worst = 0, worst_parts = 0;
  for (int n = 0; n < 20; ++n) {
    const Vec3 before = run.velocity_of(1);
    run.advance();
    const Vec3 rate = (m / c.time.fluid_step) * (run.velocity_of(1) - before);
    const Vec3 total = test::force_on_first(run, "force_total");
    worst = std::max(worst, norm(total - rate) / norm(rate));
    if (displaced_density == 0) continue;
    const Vec3 mean = host_copy(mean_resultant_force(*run.state.grains, run.step.dt()))(0);
    EXPECT_LT(norm(mean - rate), 1e-12 * norm(rate)) << what;
    const double parts = weight + test::force_on_first(run, "force_drag").y +
                         test::force_on_first(run, "force_added_mass").y;
    if (!c.fluid) worst_parts = std::max(worst_parts, std::abs(parts - total.y) / norm(rate));
  }
  test::expect_below(std::string("resultant force, m du/dt, ") + what, worst, 1e-10);
  test::expect_below(std::string("its parts, ") + what, worst_parts, 1e-10);
}

TEST(ResultantForce, IsWhatMovesTheGrain) {
  const std::array<double, 3> size{6e-3, 6e-3, 6e-3};
  Config nothing = test::still_water(size);
  nothing.grains->ambient.reset();
  expect_newtons_law("without a fluid", nothing, 0);
  expect_newtons_law("in still water", test::still_water(size), 1000);
  expect_newtons_law("in a computed flow", test::water_box({6, 6, 6}, size), 1000);
}

}  // namespace
}  // namespace barchan
