// Division of the cells among the ranks, and the flow on pencils against the same flow on one rank,
// in all shapes that the ranks can be put in.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "src/fluid/fluid_solver.hpp"
#include "src/fluid/fluid_state.hpp"
#include "src/fluid/local_correction.hpp"
#include "src/fluid/pressure_solver.hpp"
#include "src/initial/initial_flow.hpp"
#include "src/initial/map_flow.hpp"
#include "tests/support/shared_grid.hpp"

namespace barchan {
namespace {

using test::noise;
using test::SharedGrid;

// Odd numbers, no common divisors: pencils of unequal size.
const std::array<int, 3> kCells{21, 7, 15};
const std::array<double, 3> kSize{0.05, 0.025, 0.036};
SharedGrid awkward(int along_x) { return {kCells, kSize, 1e-3, along_x}; }

TEST(Decomposition, SplitsAreEvenAndComplete) {
  for (const int n : {1, 2, 7, 63, 250}) {
    for (int parts = 1; parts <= 9; ++parts) {
      const BlockPartition split{.n = n, .parts = parts};
      EXPECT_EQ(split.begin(0), 0);
      EXPECT_EQ(split.begin(parts), n);
      for (int p = 0; p < parts; ++p) {
        EXPECT_LE(split.count(p), split.count(0));
        EXPECT_GE(split.count(p), split.count(0) - 1);
      }
    }
  }
}

TEST(Decomposition, EveryColumnHasOneOwner) {
  const SharedGrid grid({11, 3, 13}, {0.11, 0.03, 0.13}, 0);
  int n = grid.mine.nx * grid.mine.nz, all = 0;
  MPI_Allreduce(&n, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(all, 11 * 13);
  EXPECT_GE(grid.mine.nx, 2);
  EXPECT_GE(grid.mine.nz, 2);
  // The rank behind along x begins where this one ends.
  const RankAxis& line = grid.ranks->along_x();
  int next = 0, end = (grid.mine.i_begin + grid.mine.nx) % 11;
  MPI_Sendrecv(&grid.mine.i_begin, 1, MPI_INT, line.lower(), 0, &next, 1, MPI_INT, line.upper(), 0,
               line.communicator, MPI_STATUS_IGNORE);
  EXPECT_EQ(next, end);
}

TEST(Decomposition, TooThinPencilsAreRefused) {
  const int count = rank_count(MPI_COMM_WORLD);
  if (count == 1) GTEST_SKIP() << "one rank fits everywhere";
  try {
    const Decomposition thin(MPI_COMM_WORLD, 3, 3);
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(count) + " ranks cannot share 3 x 3"),
              std::string::npos)
        << error.what();
  }
}

TEST(HaloOverRanks, GhostsAreTheCellsAcross) {
  for (const int along_x : test::shapes(kCells)) {
    SCOPED_TRACE(along_x);
    const SharedGrid grid = awkward(along_x);
    Field f("f", grid.mine), whole("f", grid.whole);
    grid.set(whole, f, [](int i, int j, int k) { return noise(i, j, k); });
    Halo(grid.mine).fill(f);
    const auto got = test::to_host(f);
    const int nx = kCells[0], nz = kCells[2];
    for (int k = -1; k <= grid.mine.nz; ++k)
      for (int j = 0; j < grid.mine.ny; ++j)
        for (int i = -1; i <= grid.mine.nx; ++i) {
          ASSERT_EQ(got(i, j, k),
                    noise((i + grid.mine.i_begin + nx) % nx, j, (k + grid.mine.k_begin + nz) % nz));
        }
  }
}

/// Ghosts that hold cells of other ranks within bounds are filled, and no others.
TEST(HaloOverRanks, BetweenRanksWithinBounds) {
  const CellRange bounds{3, 12, 0, 5, 1, 8};
  for (const int along_x : test::shapes(kCells)) {
    SCOPED_TRACE(along_x);
    const SharedGrid grid = awkward(along_x);
    const Grid& mine = grid.mine;
    Field f("f", mine), whole("f", grid.whole);
    grid.set(whole, f, [](int i, int j, int k) { return noise(i, j, k); });
    Halo(mine).fill_between_ranks(f, bounds);
    const auto got = test::to_host(f);
    const bool cut_x = mine.ranks && mine.ranks->along_x().count > 1;
    const bool cut_z = mine.ranks && mine.ranks->along_z().count > 1;
    const int nx = kCells[0], nz = kCells[2];
    for (int k = -1; k <= mine.nz; ++k)
      for (int j = 0; j < mine.ny; ++j)
        for (int i = -1; i <= mine.nx; ++i) {
          const bool beside_x = i < 0 || i == mine.nx, beside_z = k < 0 || k == mine.nz;
          if (!beside_x && !beside_z) continue;
          const int x = i + mine.i_begin, z = k + mine.k_begin;
          const bool in_x = x >= bounds.i0 && x < bounds.i1, in_z = z >= bounds.k0 && z < bounds.k1;
          const bool filled =
              j < bounds.j1 && beside_x != beside_z && (beside_x ? cut_x && in_z : cut_z && in_x);
          ASSERT_EQ(got(i, j, k), filled ? noise((x + nx) % nx, j, (z + nz) % nz) : 0)
              << i << " " << j << " " << k;
        }
  }
}

TEST(PoissonOverRanks, AsOnOneRank) {
  for (const int along_x : test::shapes(kCells)) {
    SCOPED_TRACE(along_x);
    const SharedGrid grid = awkward(along_x);
    for (const double mass : {0.0, 1.0}) {
      Field f("f", grid.mine), f_whole("f", grid.whole);
      Field phi("phi", grid.mine), phi_whole("phi", grid.whole);
      grid.set(f_whole, f, [](int i, int j, int k) { return noise(i, j, k, 2); });
      PoissonFft(grid.whole, std::make_shared<const PlaneFft>(grid.whole), mass, 1e-5)
          .solve(f_whole, phi_whole);
      PoissonFft(grid.mine, std::make_shared<const PlaneFft>(grid.mine), mass, 1e-5).solve(f, phi);
      EXPECT_LT(grid.difference(phi_whole, phi), 1e-14 * 10);
    }
    for (const EvenExtension even :
         {EvenExtension{true, false}, EvenExtension{false, true}, EvenExtension{true, true}}) {
      Field f("f", grid.mine), f_whole("f", grid.whole);
      grid.set(f_whole, f, [](int i, int j, int k) { return noise(i, j, k, 2); });
      for (const auto& [cells, field] : {std::pair{&grid.whole, &f_whole}, {&grid.mine, &f}}) {
        PoissonFft(*cells, std::make_shared<const PlaneFft>(*cells, even), 1, 1e-5)
            .solve(*field, *field);
      }
      EXPECT_LT(grid.difference(f_whole, f), 1e-14 * 10);
    }
  }
}

/// Water hindered in a heap, as grains would.
template <class Set>
void set_heap(const SharedGrid& grid, const Set& set) {
  const double dx = kSize[0] / kCells[0], dz = kSize[2] / kCells[2];
  const test::HostGrid h(grid.whole);
  set([=](int i, int j, int k) {
    const double r = std::hypot((i + 0.5) * dx - 0.02, (k + 0.5) * dz - 0.018);
    return h.y(j) < 0.012 - r ? 0.45 : 1.0;
  });
}

TEST(LocalCorrectionOverRanks, AsOnOneRank) {
  for (const int along_x : test::shapes(kCells)) {
    SCOPED_TRACE(along_x);
    const SharedGrid grid = awkward(along_x);
    const Boundary here(grid.mine, WallFlow::no_slip, WallFlow::free_slip);
    const Boundary there(grid.whole, WallFlow::no_slip, WallFlow::free_slip);
    FaceVector c = make_faces("test", grid.mine), c_whole = make_faces("test", grid.whole);
    set_heap(grid, [&](auto share) {
      grid.set(c_whole.x, c.x, share);
      grid.set(c_whole.z, c.z, share);
      grid.set(c_whole.y, c.y, [&](int i, int j, int k) { return j > 0 ? share(i, j, k) : 0; });
    });
    here.fill_periodic(c);
    there.fill_periodic(c_whole);
    Field r("r", grid.mine), z("z", grid.mine), r_whole("r", grid.whole), z_whole("z", grid.whole);
    grid.set(r_whole, r, [](int i, int j, int k) { return noise(i, j, k, 3); });
    LocalCorrection local(grid.mine, here.halo()), local_whole(grid.whole, there.halo());
    const PoissonFft poisson(grid.mine, std::make_shared<const PlaneFft>(grid.mine), 0, 1);
    const PoissonFft poisson_whole(grid.whole, std::make_shared<const PlaneFft>(grid.whole), 0, 1);
    const Region everywhere(grid.mine), everywhere_whole(grid.whole);
    const Field room("room", grid.mine), room_whole("room", grid.whole);
    Field copy("copy", grid.mine), copy_whole("copy", grid.whole);
    for (int twice = 0; twice < 2; ++twice) {  // the second time with what the first left behind
      local.update(c, everywhere, room);
      local.apply(poisson, r, z, copy);
      local_whole.update(c_whole, everywhere_whole, room_whole);
      local_whole.apply(poisson_whole, r_whole, z_whole, copy_whole);
      EXPECT_LT(grid.difference(z_whole, z), 1e-13);
    }
  }
}

/// Flow on one rank and flow on pencils: a sheared start with noise, walls, WALE.
struct TwoFlows {
  SharedGrid grid;
  Config config = test::flow_config(kCells, kSize, 1e-3);
  FluidState here, there;
  explicit TwoFlows(int along_x)
      : grid(awkward(along_x)),
        here(make_fluid_state(grid.mine)),
        there(make_fluid_state(grid.whole)) {
    config.fluid->mean_velocity = 0.25;
    const test::HostGrid h(grid.whole);
    const auto start = [&](double mean, unsigned seed) {
      return [=, &h](int i, int j, int k) {
        return mean * h.y(j) / kSize[1] + 0.02 * noise(i, j, k, seed);
      };
    };
    grid.set(there.u.x, here.u.x, start(0.5, 4));
    grid.set(there.u.y, here.u.y,
             [](int i, int j, int k) { return j > 0 ? 0.02 * noise(i, j, k, 5) : 0; });
    grid.set(there.u.z, here.u.z, start(0, 6));
    for (FluidState* flow : {&here, &there}) {
      Kokkos::deep_copy(flow->alpha_f.storage, Real(1));
      Kokkos::deep_copy(flow->alpha_f_previous.storage, Real(1));
    }
  }
  void expect_same(double tolerance) const {
    EXPECT_LT(grid.difference(there.u.x, here.u.x), tolerance);
    EXPECT_LT(grid.difference(there.u.y, here.u.y), tolerance);
    EXPECT_LT(grid.difference(there.u.z, here.u.z), tolerance);
    EXPECT_LT(grid.difference(there.p, here.p), tolerance);
    EXPECT_LT(grid.difference(there.nu_t, here.nu_t), tolerance);
  }
};

TEST(FluidOverRanks, ChannelAsOnOneRank) {
  for (const int along_x : test::shapes(kCells)) {
    SCOPED_TRACE(along_x);
    TwoFlows flows(along_x);
    FluidSolver here(flows.config, flows.grid.mine), there(flows.config, flows.grid.whole);
    here.fill_ghosts(flows.here);
    there.fill_ghosts(flows.there);
    FluidStepReport report, report_there;
    for (int step = 0; step < 20; ++step) {
      report = here.advance(flows.here, nullptr, 1e-3);
      report_there = there.advance(flows.there, nullptr, 1e-3);
    }
    flows.expect_same(1e-12);
    EXPECT_NEAR(report.courant, report_there.courant, 1e-11);
    EXPECT_NEAR(report.drive.x, report_there.drive.x,
                1e-13 * 0.25 / 1e-3);  // what is left of U / dt
    EXPECT_NEAR(here.friction_velocity(flows.here), there.friction_velocity(flows.there), 1e-12);
    EXPECT_LT(report.continuity_residual, 1e-12);
  }
}

TEST(FluidOverRanks, FlowFromAnotherMeshAsOnOneRank) {
  Config other = test::flow_config({16, 9, 10}, kSize, 8e-4);
  other.fluid->mean_velocity = 0.25;
  FluidState from = make_fluid_state(make_grid(other));
  set_flow(TurbulentFlow{}, other, from);
  test::set_random(from.p, from.grid, 7);
  test::set_random(from.nu_t, from.grid, 8);
  for (const int along_x : test::shapes(kCells)) {
    SCOPED_TRACE(along_x);
    TwoFlows flows(along_x);
    map_flow(flows.config, from, flows.here);
    map_flow(flows.config, from, flows.there);
    flows.expect_same(1e-13);
    EXPECT_NEAR(bulk_velocity(flows.here), 0.25, 1e-14);
  }
}

TEST(FluidOverRanks, FlowThroughAHeapAsOnOneRank) {
  for (const int along_x : test::shapes(kCells)) {
    SCOPED_TRACE(along_x);
    TwoFlows flows(along_x);
    flows.config.grains.emplace();
    flows.config.solver.pressure_tolerance = 1e-12;
    FluidSolver here(flows.config, flows.grid.mine), there(flows.config, flows.grid.whole);
    const Field c("c", flows.grid.mine), c_whole("c", flows.grid.whole);
    ExchangeOnFaces on_here{make_faces("test", flows.grid.mine), c, c};
    ExchangeOnFaces on_there{make_faces("test", flows.grid.whole), c_whole, c_whole};
    set_heap(flows.grid, [&](auto share) {
      flows.grid.set(flows.there.alpha_f, flows.here.alpha_f, share);
      flows.grid.set(flows.there.alpha_f_previous, flows.here.alpha_f_previous, share);
      const auto drag = [&](int i, int j, int k) { return 2e4 * (1 - share(i, j, k)); };
      const auto brake = [&](int i, int j, int k) { return -5 * (1 - share(i, j, k)); };
      flows.grid.set(on_there.interlayer_drag_x, on_here.interlayer_drag_x, drag);
      flows.grid.set(on_there.impulse.x, on_here.impulse.x, brake);
    });
    here.fill_ghosts(flows.here);
    there.fill_ghosts(flows.there);
    for (int step = 0; step < 5; ++step) {
      const FluidStepReport report = here.advance(flows.here, &on_here, 1e-3);
      const FluidStepReport report_there = there.advance(flows.there, &on_there, 1e-3);
      EXPECT_EQ(report.pressure_iterations, report_there.pressure_iterations);
    }
    flows.expect_same(1e-11);
  }
}

/// A box that ends where cells do, and a sphere that ranks cut.
std::vector<BodyConfig> two_bodies() {
  BodyConfig box, sphere;
  box.name = "box", box.shape = BodyShape::of<shapes::Box>();
  box.centre = {kSize[0] * 10 / 21, kSize[2] * 8 / 15};
  box.size = {kSize[0] * 4 / 21, kSize[2] * 4 / 15};
  box.height = 0.0071;
  sphere.name = "sphere", sphere.shape = BodyShape::of<shapes::Sphere>();
  sphere.centre = {0.041, 0.0061};
  sphere.radius = 0.0055, sphere.base = 0.009;
  return {box, sphere};
}

TEST(FluidOverRanks, FlowAroundBodiesAsOnOneRank) {
  for (const int along_x : test::shapes(kCells)) {
    SCOPED_TRACE(along_x);
    TwoFlows flows(along_x);
    flows.config.bodies = two_bodies();
    flows.config.solver.pressure_tolerance = 1e-12;
    FluidSolver here(flows.config, flows.grid.mine), there(flows.config, flows.grid.whole);
    here.fill_ghosts(flows.here);
    there.fill_ghosts(flows.there);
    here.flow_around_bodies(flows.here);
    there.flow_around_bodies(flows.there);
    // Tolerance for a pressure that is solved for to 1e-12.
    EXPECT_LT(flows.grid.difference(flows.there.u.x, flows.here.u.x), 1e-9);
    for (int step = 0; step < 5; ++step) {
      const FluidStepReport report = here.advance(flows.here, nullptr, 1e-3);
      const FluidStepReport report_there = there.advance(flows.there, nullptr, 1e-3);
      EXPECT_EQ(report.pressure_iterations, report_there.pressure_iterations);
      EXPECT_LT(report.continuity_residual, 1e-9);
    }
    flows.expect_same(1e-9);
    for (std::size_t body = 0; body < 2; ++body) {
      const BodyLoad &a = here.body_loads()[body], &b = there.body_loads()[body];
      EXPECT_LT(norm(a.force - b.force), 1e-9 * norm(b.force));
      EXPECT_LT(norm(a.torque - b.torque), 1e-9 * norm(b.torque));
    }
  }
}

}  // namespace
}  // namespace barchan
