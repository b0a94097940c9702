// Grains in a flow, both cut among ranks in ways of their own, against one rank.
#include <gtest/gtest.h>

#include <cmath>

#include "src/coupling/coupled_step.hpp"
#include "src/coupling/deposit.hpp"
#include "src/coupling/deposit_stencil.hpp"
#include "src/coupling/fluid_side_grains.hpp"
#include "src/fluid/domain.hpp"
#include "src/grains/grain_arrays.hpp"
#include "src/initial/initial_state.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/coupled_case.hpp"
#include "tests/support/coupling_schemes.hpp"
#include "tests/support/shared_grains.hpp"
#include "tests/support/shared_grid.hpp"

namespace barchan {
namespace {

using test::by_id;
using test::differences;
using test::from_all_ranks;
using test::numbers_of;

bool is_first() { return rank_of(MPI_COMM_WORLD) == 0; }

struct Coupled {
  explicit Coupled(const Config& c, MPI_Comm ranks = MPI_COMM_SELF, const InitialFiles& files = {},
                   int along_x = 0)
      : pencils(make_pencils(c, ranks, along_x)),
        state(make_initial_state(c, files, ranks, pencils.get())),
        step(c, state) {
    step.start(state);
  }
  static std::unique_ptr<const Decomposition> make_pencils(const Config& c, MPI_Comm ranks,
                                                           int along_x) {
    if (rank_count(ranks) == 1) return {};
    return std::make_unique<const Decomposition>(ranks, c.fluid->cells[0], c.fluid->cells[2],
                                                 along_x);
  }
  std::unique_ptr<const Decomposition> pencils;
  SystemState state;
  CoupledStep step;
};

std::vector<int> shapes(const Config& c) { return test::shapes(c.fluid->cells); }

double difference(const Field& whole, const Field& mine, const Grid& grid) {
  return test::difference_over_ranks(whole, mine, grid).largest;
}

/// An impulse of its own for every grain.
void give_each_its_own(const GrainState& grains) {
  const auto impulse = grains.fluid.impulse;
  const auto id = grains.id;
  Kokkos::parallel_for(
      "test: what grains give", grains.n,
      KOKKOS_LAMBDA(int g) { impulse(g).x = 1 + Kokkos::sin(static_cast<Real>(id(g))); });
}

/// A field times what was deposited of the impulse along x.
struct InCells {
  GridRef grid;
  ConstFieldRef values;
  Deposits deposits;
  KOKKOS_FUNCTION Real operator()(int i, int j, int k) const {
    return values(i, j, k) *
           deposits.impulse.decode(deposits.sum(CellIndex{i, j, k}.linear(grid), 3));
  }
};

/// Sum over the grains of their impulse along x times what they find.
struct AtGrains {
  Kokkos::View<const Vec3*> impulse, found;
  KOKKOS_FUNCTION void operator()(int g, Real& sum) const { sum += impulse(g).x * found(g).x; }
};

Config heap_at_the_seam(const test::Scheme& scheme, GrainBoundaryX x) {
  Config c = test::coupled_config();
  scheme.choose(c.coupling);
  c.grains->boundary_x = x;
  c.initial.fluid = "still";
  c.initial.pour->centre = {0.0062, 0.0031};  // across the middle, where pencils meet
  return c;
}

/// The fluid fraction of a case cut in all shapes is that of one rank to the tolerance; each is
/// then looked at: look(grid, fraction).
template <class Look>
void expect_fraction_of_one_rank(const Config& c, double tolerance, const Look& look) {
  const Coupled whole(c);
  for (const int along_x : shapes(c)) {
    SCOPED_TRACE(along_x);
    const Coupled shared(c, MPI_COMM_WORLD, {}, along_x);
    const Grid& grid = shared.state.fluid->grid;
    const Field& alpha = shared.state.fluid->alpha_f;
    EXPECT_LE(difference(whole.state.fluid->alpha_f, alpha, grid), tolerance);
    look(grid, test::to_host(alpha));
  }
}

TEST(CoupledOverRanks, FluidFractionHasTheBitsOfOneRank) {
  for (const test::Scheme& scheme : test::kSchemes) {
    for (const GrainBoundaryX x : {GrainBoundaryX::exit, GrainBoundaryX::periodic}) {
      expect_fraction_of_one_rank(heap_at_the_seam(scheme, x), 0, [](const Grid& grid, auto here) {
        double least = 1;
        for (int k = 0; k < grid.nz; ++k)
          for (int i = 0; i < grid.nx; ++i) least = std::min(least, here(i, 0, k));
        EXPECT_LT(-max_over(MPI_COMM_WORLD, -least), 0.95) << "there is no heap";
      });
    }
  }
}

/// A heap in the corner of walls that the flow passes: nothing of it is smoothed through them.
TEST(CoupledOverRanks, WallsOfTheGrainsKeepTheSolidFractionInside) {
  Config c = heap_at_the_seam(test::kSchemes[0], GrainBoundaryX::wall);
  c.grains->boundary_z = GrainBoundaryZ::wall;
  c.coupling.smoothing_length = 3e-4;
  c.size = {0.036, 0.006, 0.036};
  c.fluid->cells = {30, 14, 36};
  c.initial.pour->centre = {0.0021, 0.0021};
  expect_fraction_of_one_rank(c, 1e-15, [](const Grid& grid, auto here) {
    double densest = 0, beyond = 0;
    test::for_owned_cells(grid, [&](int i, int j, int k) {
      const double solid = 1 - here(i, j, k);
      densest = std::max(densest, solid);
      if (i + grid.i_begin >= 25 || k + grid.k_begin >= 31) {
        beyond = std::max(beyond, std::abs(solid));
      }
    });
    EXPECT_GT(max_over(MPI_COMM_WORLD, densest), 0.2) << "there is no heap";
    EXPECT_LT(max_over(MPI_COMM_WORLD, beyond), 1e-12);
  });
}

/// Grains near all edges of the pencils and of the domain.
InitialGrains scattered_grains(const Config& c, int n) {
  InitialGrains grains = test::random_grains(n, c.size, 8);
  for (std::size_t g = 0; g < grains.size(); g += 3) {
    grains.x[g].x = std::round(grains.x[g].x / 0.0012) * 0.0012 + 3e-5 * (grains.x[g].y / 0.006);
    grains.x[g].z = std::round(grains.x[g].z / 0.001) * 0.001 - 3e-5 * (grains.x[g].y / 0.006);
  }
  return grains;
}

/// sum over cells of f times what the grains deposit = sum over grains of what they give times the
/// f they find: scattering is the adjoint of gathering, over any cuts.
TEST(CoupledOverRanks, ScatterIsTheAdjointOfGather) {
  const Config c = test::coupled_config();
  for (const int along_x : shapes(c)) {
    SCOPED_TRACE(along_x);
    const auto pencils = Coupled::make_pencils(c, MPI_COMM_WORLD, along_x);
    const Grid grid = make_grid(c, pencils.get());
    GrainState grains = make_grain_state(scattered_grains(c, 900), 2500, MPI_COMM_WORLD);
    add_fluid(grains);
    add_exchange(grains);
    give_each_its_own(grains);
    FluidSideGrains fluid_side(grid, false, grains);
    GrainState& there = fluid_side.to_fluid_ranks(grains, kDepositReads);
    EXPECT_EQ(sum_over(MPI_COMM_WORLD, there.n), 900);
    const ExchangeOfGrain of_grain{
        .dt = 1, .grains = there.kin, .on_grains = there.fluid, .exchange = there.exchange};
    const DepositStencil stencil = make_deposit_stencil(c, grid, there.r_max, PointModel::divided);
    Deposits deposits;
    deposits.sum = decltype(deposits.sum)("test: deposits", CellIndex::count(grid));
    deposits.impulse = fixed_point_for(1e4);
    using Launch = DepositGrains<7, CellExchange>;
    Kokkos::parallel_for(
        "test: scatter", Launch::items_for(there.n),
        Launch{.of_grain = of_grain, .exchange = {stencil}, .deposits = deposits, .n = there.n});
    Halo(grid, Deposits::kQuantities).scatter_add(deposits.sum);
    Field f("f", grid);
    test::set_field(f, grid, [&](int i, int j, int k) {
      return test::noise(i + grid.i_begin, j, k + grid.k_begin);
    });
    Halo(grid).fill(f);
    const Real in_cells = sum_each_cell("test: cells", grid, InCells{grid, f, deposits});
    const auto n = static_cast<std::size_t>(there.n);
    const FlowAtGrains found{.u = {},
                             .du_dt = {},
                             .u_grad_u = {},
                             .pressure = {"test: found", n},
                             .stress = {},
                             .alpha_l = {"test: mean", n},
                             .alpha_o = {"test: left by others", n},
                             .slip = {},
                             .factor = {},
                             .solid_per_fluid = {"test: largest", n}};
    Kokkos::parallel_for("test: gather", there.n,
                         FlowOverCells{.stencil = stencil,
                                       .alpha_f = f,
                                       .alpha_raw = f,
                                       .with_pressure = true,
                                       .pressure = {f, f, f},
                                       .stress = {f, f, f},
                                       .grains = there.kin,
                                       .flow = found});
    Real at_grains = 0;
    Kokkos::parallel_reduce("test: at grains", there.n,
                            AtGrains{there.fluid.impulse, found.pressure}, at_grains);
    at_grains = sum_over(MPI_COMM_WORLD, at_grains);
    EXPECT_GT(std::abs(at_grains), 1e-3);
    EXPECT_NEAR(in_cells / at_grains, 1, 1e-11);
  }
}

void twenty_steps(const Config& c) {
  Coupled whole(c);
  for (int s = 0; s < 20; ++s) whole.step.advance(whole.state);
  for (const int along_x : shapes(c)) {
    SCOPED_TRACE(along_x);
    Coupled shared(c, MPI_COMM_WORLD, {}, along_x);
    for (int s = 0; s < 20; ++s) shared.step.advance(shared.state);
    const auto off = differences(by_id(numbers_of(*whole.state.grains)),
                                 by_id(from_all_ranks(numbers_of(*shared.state.grains))));
    const Grid& grid = shared.state.fluid->grid;
    const double u = difference(whole.state.fluid->u.x, shared.state.fluid->u.x, grid);
    const double alpha = difference(whole.state.fluid->alpha_f, shared.state.fluid->alpha_f, grid);
    EXPECT_LT(off[0], 1e-12);
    EXPECT_LT(off[1], 1e-10);
    EXPECT_LT(u, 1e-11);
    EXPECT_LT(alpha, 1e-10);
    EXPECT_LT(shared.step.ledger().entries().at("largest_volume_mismatch"), 1e-12);
    EXPECT_LT(shared.step.ledger().entries().at("largest_exchange_mismatch"), 1e-10);
    if (is_first())
      std::printf(
          "[ measured ] %d ranks, %d along x: x %.1e, u %.1e of grains; u %.1e m/s, alpha "
          "%.1e\n",
          rank_count(MPI_COMM_WORLD), along_x, off[0], off[1], u, alpha);
  }
}

TEST(CoupledOverRanks, TwentyStepsAsOnOneRank) { twenty_steps(test::coupled_config()); }

TEST(CoupledOverRanks, TwentyStepsWithForcesOfShearAsOnOneRank) {
  Config c = test::coupled_config();
  c.coupling.forces.lift = c.coupling.forces.torque = c.coupling.forces.wall_drag = true;
  c.coupling.forces.mixture_viscosity = true;
  twenty_steps(c);
}

/// A heap of cubes and of sand.
TEST(CoupledOverRanks, TwentyStepsOfClumpsAsOnOneRank) {
  Config c = test::coupled_config();
  c.coupling.forces.lift = c.coupling.forces.torque = true;
  for (const NamedClump name : {NamedClump::cube, NamedClump::sand}) {
    c.grains->shape = {.shape = GrainShape::clump, .clump = name};
    twenty_steps(c);
  }
}

TEST(CoupledOverRanks, TwentyStepsInCellsOfTwoDiametersAsOnOneRank) {
  Config c = test::coupled_config();
  c.fluid->cells[0] = 30, c.fluid->cells[2] = 15;
  c.time.fluid_step /= 4;
  twenty_steps(c);
}

/// Round-off grows in a heap of grains as any other disturbance does. Until it has grown, ranks
/// agree to 1e-9; from then on they differ no more than one rank does from itself after a grain
/// has been moved by the last bit of its position.
TEST(CoupledOverRanks, TwoHundredStepsAsOnOneRankUntilChaos) {
  const Config c = test::coupled_config();
  Coupled whole(c), moved(c), shared(c, MPI_COMM_WORLD);
  test::move_by_the_last_bit(*moved.state.grains, 100, 101);
  double worst_share = 0;
  for (int s = 1; s <= 200; ++s) {
    for (Coupled* one : {&whole, &moved, &shared}) one->step.advance(one->state);
    if (s % 20 != 0) continue;
    const auto exact = by_id(numbers_of(*whole.state.grains));
    const double chaos = differences(exact, by_id(numbers_of(*moved.state.grains)))[0];
    const double off =
        differences(exact, by_id(from_all_ranks(numbers_of(*shared.state.grains))))[0];
    EXPECT_LT(off, std::max(1e-9, 300 * chaos)) << "step " << s;
    worst_share = std::max(worst_share, off / std::max(1e-9, chaos));
    if (is_first())
      std::printf("[ measured ] %d ranks, step %d: x %.1e; one grain moved by a bit: %.1e\n",
                  rank_count(MPI_COMM_WORLD), s, off, chaos);
  }
}

/// All arrays that a grain can have, and all walls: 200 grains in a box of 6 x 3 x 4 mm.
Config fullest_case() {
  Config c = test::coupled_config();
  c.size = {0.006, 0.003, 0.004};
  c.fluid->cells = {10, 9, 6};
  c.grains->floor = GrainFloor::glued;
  c.grains->floor_diameter = 2e-4;
  c.grains->boundary_x = GrainBoundaryX::wall;
  c.grains->boundary_z = GrainBoundaryZ::wall;
  c.coupling.forces.lift = c.coupling.forces.torque = c.coupling.forces.wall_drag = true;
  c.coupling.forces.mixture_viscosity = true;
  c.initial.pour->centre = {0.003, 0.002};
  return c;
}

TEST(CoupledOverRanks, TwentyStepsWithAllArraysOfAGrainAsOnOneRank) {
  const Config c = fullest_case();
  const Coupled shared(c, MPI_COMM_WORLD);
  EXPECT_EQ(layout_of(*shared.state.grains).n, 22) << "not all of for_each_grain_array";
  EXPECT_EQ(shared.step.grain_solver()->walls().n, kMaxWalls);
  const auto migrated = sum_over(MPI_COMM_WORLD, shared.step.neighbor_list()->n_migrated());
  EXPECT_TRUE(rank_count(MPI_COMM_WORLD) == 1 || migrated > 0);
  twenty_steps(c);
}

/// Six grains in a resolved flow, in a box that they do not fill, which cross the middle and both
/// ends of it.
Config immersed_case() {
  Config c = test::coupled_config();
  c.size = {0.004, 0.005, 0.004};
  c.coupling.scheme = CouplingScheme::resolved;
  c.coupling.smoothing_length = 0;
  c.fluid->cells = {24, 30, 24};
  c.fluid->first_cell_height = 0;
  c.fluid->turbulence = Turbulence::none;
  c.fluid->kinematic_viscosity = 1e-5;
  c.grains->boundary_x = GrainBoundaryX::periodic;
  c.grains->sizes = {{.diameter = 1e-3, .count = 6}};
  c.initial.fluid = "still";
  c.initial.pour->centre = {0.0027, 0.0014};
  c.initial.pour->radius = 0.0013;
  c.time = {.end = 1, .fluid_step = 1e-4, .grain_step = 5e-6};
  return c;
}

void push(const GrainState& grains) {
  const auto kin = grains.kin;
  Kokkos::parallel_for(
      "test: push", grains.n, KOKKOS_LAMBDA(int g) {
        kin(g).u = {0.5, 0, -0.5};
        kin(g).omega = {100, 50, 0};
      });
}

TEST(CoupledOverRanks, ImmersedGrainsMoveAsOnOneRank) {
  const Config c = immersed_case();
  Coupled whole(c);
  push(*whole.state.grains);
  for (int s = 0; s < 20; ++s) whole.step.advance(whole.state);
  for (const int along_x : shapes(c)) {
    SCOPED_TRACE(along_x);
    Coupled shared(c, MPI_COMM_WORLD, {}, along_x);
    push(*shared.state.grains);
    for (int s = 0; s < 20; ++s) shared.step.advance(shared.state);
    const auto off = differences(by_id(numbers_of(*whole.state.grains)),
                                 by_id(from_all_ranks(numbers_of(*shared.state.grains))));
    const Grid& grid = shared.state.fluid->grid;
    EXPECT_LT(off[0], 1e-12);
    EXPECT_LT(off[1], 1e-11);
    EXPECT_LT(off[2], 1e-11);
    EXPECT_LT(difference(whole.state.fluid->u.x, shared.state.fluid->u.x, grid), 1e-12);
    EXPECT_LT(difference(whole.state.fluid->u.z, shared.state.fluid->u.z, grid), 1e-12);
    const Vec3 force = shared.step.impulse_on_grains() - whole.step.impulse_on_grains();
    EXPECT_LT(norm(force), 1e-11 * norm(whole.step.impulse_on_grains()));
  }
}

}  // namespace
}  // namespace barchan
