// A body among grains that are held, in a steady flow: grains, floor and body take the whole drive.
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "tests/support/coupled_run.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

constexpr double kDiameter = 2e-4, kWidth = 3.2e-3, kHeight = 2e-3, kBed = 8e-4;  // [m]

/// A channel with a floor, a flow oblique to the rows of cells, and a post that stands out of a bed
/// of four layers.
Config channel_with_post(CouplingScheme scheme, double smoothing) {
  Config c = test::water_box({8, 8, 8}, {kWidth, kHeight, kWidth});
  c.fluid->bottom = WallFlow::no_slip;
  c.fluid->schedule = {{.time = 0, .velocity = {0.02, 0.01}}};
  c.grains->frozen = true;
  c.coupling.scheme = scheme;
  c.coupling.smoothing_length = smoothing;
  c.solver.pressure_tolerance = 1e-10;
  c.time.fluid_step = 2e-3;
  c.bodies = {{.name = "post",
               .shape = BodyShape::of<shapes::Cylinder>(),
               .centre = {1.5e-3, 1.7e-3},
               .radius = 7e-4,
               .height = 1.1e-3}};
  return c;
}

/// Grains anywhere around the post and up to its surface, in a bed; they may overlap.
InitialGrains bed_around(const BodyConfig& post) {
  std::mt19937_64 generator(1);
  const auto uniform = [&generator] { return static_cast<double>(generator() >> 11) * 0x1.0p-53; };
  InitialGrains grains;
  while (grains.size() < 600) {
    const Vec3 at{kWidth * uniform(), kDiameter / 2 + (kBed - kDiameter) * uniform(),
                  kWidth * uniform()};
    if (std::hypot(at.x - post.centre[0], at.z - post.centre[1]) > post.radius + kDiameter / 2)
      test::add_grain(grains, kDiameter, at);
  }
  return grains;
}

/// Force of the flow on all grains, from their arrays.
Vec3 on_grains(const test::CoupledRun& run) {
  Vec3 sum;
  for (const test::NamedForce& force : run.forces()) {
    if (force.name == "force_total" || force.name.starts_with("force_contact")) continue;
    const auto values = host_copy(force.values);
    for (std::size_t g = 0; g < values.extent(0); ++g) sum += values(g);
  }
  return sum;
}

Vec3 on_floor(const test::CoupledRun& run) {
  const Grid& grid = run.state.fluid->grid;
  const auto u = test::to_host(run.state.fluid->u.x), w = test::to_host(run.state.fluid->u.z);
  const double per_speed = 1e-3 * grid.dx * grid.dz / (kHeight / grid.ny / 2);
  Vec3 sum;
  for (int k = 0; k < grid.nz; ++k)
    for (int i = 0; i < grid.nx; ++i) sum += per_speed * Vec3{u(i, 0, k), 0, w(i, 0, k)};
  return sum;
}

/// Compares a force with the drive along x and along z.
void expect_all(const std::string& what, const Vec3& force, const Vec3& drive) {
  test::expect_relative(what + " over the drive along x", force.x / drive.x, 1, 1e-6);
  test::expect_relative(what + " over the drive along z", force.z / drive.z, 1, 1e-6);
}

// Grains around the post take a force that comes from the post. With layers, grains get what the
// fluid loses; the other schemes give them the flow at their centres.
TEST(BodiesAmongGrains, ForceOnGrainsFloorAndPostIsTheDrive) {
  for (const CouplingScheme scheme :
       {CouplingScheme::layered, CouplingScheme::smoothed, CouplingScheme::centred}) {
    for (const double smoothing : {0.0, 6e-4}) {
      const Config c = channel_with_post(scheme, smoothing);
      test::CoupledRun run(c, bed_around(c.bodies[0]));
      run.advance(2600);
      const FluidState& fluid = *run.state.fluid;
      const Vec3 drive = 1000 * kWidth * kHeight * kWidth * Vec3{fluid.drive.x, 0, fluid.drive.z};
      const Vec3 post = run.step.fluid_solver()->body_loads()[0].force;
      const ExchangeLedger& exchanged = run.step.exchange();
      const Vec3 taken =
          (1 / run.step.dt()) * (exchanged.taken_from_fluid + exchanged.flow_on_solid);
      const std::string which = fmt::format(
          "scheme {}, smoothed over {:.1f} d: ", static_cast<int>(scheme), smoothing / kDiameter);
      expect_all(which + "what water loses", taken + on_floor(run) + post, drive);
      if (scheme == CouplingScheme::layered)
        expect_all(which + "what all get", on_grains(run) + on_floor(run) + post, drive);
      test::expect_below(which + "volume of the grains in the water, error",
                         run.step.ledger().entries().at("largest_volume_mismatch"), 1e-12);
      EXPECT_GT(post.x / drive.x, 0.05);
      EXPECT_GT(taken.x / drive.x, 0.1);
    }
  }
}

}  // namespace
}  // namespace barchan
