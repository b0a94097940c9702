// Bodies at rest across the cuts between ranks.
#include <gtest/gtest.h>

#include "src/parallel/reduce.hpp"
#include "tests/support/shared_grains.hpp"

namespace barchan {
namespace {

using test::SharedGrains;

/// Two cylinders that lie along x through the whole domain, so across every cut, and a sphere.
Config across_all() {
  Config c = test::grain_config();
  c.size = {0.008, 0.006, 0.006};
  c.grains->boundary_x = GrainBoundaryX::periodic;
  c.grains->boundary_z = GrainBoundaryZ::periodic;
  c.grains->material.rolling_friction = c.grains->wall.rolling_friction = 0.1;
  c.grains->rolling_model = RollingModel::of<Epsd2>();
  const BodyConfig pipe{.name = "pipe",
                        .shape = BodyShape::of<shapes::Cylinder>(),
                        .centre = {0.004, 0.002},
                        .base = 1e-3,
                        .axis = Axis::x,
                        .radius = 1e-3};
  BodyConfig other = pipe;
  other.name = "other", other.centre = {0.004, 0.0045};
  c.bodies = {pipe,
              other,
              {.name = "ball",
               .shape = BodyShape::of<shapes::Sphere>(),
               .centre = {0.004, 0.00325},
               .base = 4e-4,
               .radius = 3e-4}};
  return c;
}

/// Rows of grains above both, too far apart to meet.
InitialGrains rows() {
  InitialGrains grains;
  for (int row = 0; row < 4; ++row) {
    for (int n = 0; n < 20; ++n) {
      const Real across = row < 2 ? 0.002 : 0.0045, side = row % 2 == 0 ? -3e-4 : 3e-4;
      test::add_grain(grains, 2e-4, {4e-4 * n + 1e-4, 3.07e-3 + 1e-6 * n, across + side},
                      {0, -0.05, 0}, {10.0 * n, 0, 0});
    }
  }
  return grains;
}

void expect_same(const std::vector<GrainsOnBody>& a, const std::vector<GrainsOnBody>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) {
    EXPECT_EQ(norm(a[n].load.force - b[n].load.force), 0) << n;
    EXPECT_EQ(norm(a[n].load.torque - b[n].load.torque), 0) << n;
    EXPECT_EQ(a[n].contacts, b[n].contacts) << n;
  }
}

TEST(BodiesOverRanks, GrainsAndLoadsHaveTheBitsOfOneRank) {
  SharedGrains s(across_all(), rows());
  for (test::GrainBench* bench : {&s.whole, &s.shared})
    test::set_weight(bench->state, {0, -9.81, 0});
  std::int64_t contacts = 0;
  Real force = 0;
  for (int round = 0; round < 30; ++round) {
    s.advance(50, 2e-6);
    const auto loads = s.whole.solver.body_loads();
    expect_same(loads, s.shared.solver.body_loads());
    contacts = std::max(contacts, loads[0].contacts + loads[1].contacts);
    force = std::max(force, norm(loads[0].load.force));
  }
  for (const double off : s.off()) EXPECT_EQ(off, 0);
  EXPECT_GT(contacts, 20);
  EXPECT_GT(force, 0);
}

/// Marks in the place of histories go with their grains.
TEST(BodiesOverRanks, HistoriesMigrate) {
  Config c = across_all();
  InitialGrains grains = test::random_grains(1000, c.size, 6);
  for (Vec3& u : grains.u) u.y = 0;
  test::GrainBench bench(c, grains, MPI_COMM_WORLD);
  const auto xi = bench.state.body_xi_t;
  ASSERT_EQ(xi.extent(1), 3u);
  const auto count_wrong = [&](bool write) {
    const auto history = bench.state.body_xi_t, torque = bench.state.body_torque;
    const auto touching = bench.state.body_touching;
    const auto id = bench.state.id;
    int count = 0;
    Kokkos::parallel_reduce(
        "test: body histories", bench.state.n,
        KOKKOS_LAMBDA(int g, int& sum) {
          const auto bits = static_cast<std::uint8_t>(id(g) % 8);
          if (write) touching(g) = bits;
          bool differs = touching(g) != bits;
          for (int b = 0; b < 3; ++b) {
            const Vec3 mark{static_cast<Real>(id(g)), Real(b), 1};
            if (write) history(g, b) = mark, torque(g, b) = -mark;
            differs = differs || norm(history(g, b) - mark) > 0 || norm(torque(g, b) + mark) > 0;
          }
          sum += differs;
        },
        count);
    return sum_over(MPI_COMM_WORLD, count);
  };
  ASSERT_GT(count_wrong(false), 0) << "the marks are not there yet";
  count_wrong(true);
  for (int round = 0; round < 10; ++round) {
    test::drift(bench.state, 6e-5);
    bench.solver.list().rebuild(bench.state, false);
    ASSERT_EQ(count_wrong(false), 0) << "round " << round;
  }
  EXPECT_TRUE(rank_count(MPI_COMM_WORLD) == 1 ||
              sum_over(MPI_COMM_WORLD, bench.solver.list().n_migrated()) > 100);
}

}  // namespace
}  // namespace barchan
