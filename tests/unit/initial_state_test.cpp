// Grains of a file in the domain of a case.
#include "src/run/initial_state.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

/// Where a grain of a file ends up in a domain of 0.1 x 0.02 x 0.05 m; throws as
/// make_initial_state.
Vec3 placed(const Vec3& x, GrainBoundaryX sides) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "grains.csv";
  std::ofstream(path) << "id,diameter,x,y,z\n1,2e-4," << x.x << ',' << x.y << ',' << x.z << '\n';
  Config config;
  config.size = {0.1, 0.02, 0.05};
  config.grains.emplace().boundary_x = sides;
  const SystemState state = make_initial_state(config, {.fluid = {}, .grains = path});
  const auto kin = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, state.grains->kin);
  return kin(0).x;
}

// A run wraps positions at its list rebuilds only, so its restart may hold grains just outside.
TEST(InitialState, GrainsThatLeftThroughAPeriodicSideComeBackOnTheOther) {
  EXPECT_DOUBLE_EQ(placed({-0.01, 0.01, 0.02}, GrainBoundaryX::periodic).x, 0.09);
  EXPECT_DOUBLE_EQ(placed({0.125, 0.01, 0.02}, GrainBoundaryX::periodic).x, 0.025);
  EXPECT_DOUBLE_EQ(placed({0.05, 0.01, -0.01}, GrainBoundaryX::exit).z, 0.04);
  EXPECT_DOUBLE_EQ(placed({0.05, 0.01, 0.02}, GrainBoundaryX::exit).x, 0.05);
}

TEST(InitialState, GrainsOutsideAreRefused) {
  EXPECT_THROW(placed({-0.01, 0.01, 0.02}, GrainBoundaryX::exit), std::runtime_error);
  EXPECT_THROW(placed({0.125, 0.01, 0.02}, GrainBoundaryX::wall), std::runtime_error);
  EXPECT_THROW(placed({0.35, 0.01, 0.02}, GrainBoundaryX::periodic), std::runtime_error);
  EXPECT_THROW(placed({0.05, 0.03, 0.02}, GrainBoundaryX::periodic), std::runtime_error);
}

}  // namespace
}  // namespace barchan
