// Messages of a rank in a step, counted and as the scaling model has them (perf/scaling_counts.py,
// docs/dev/scaling.md).
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <utility>

#include "src/coupling/coupled_step.hpp"
#include "src/parallel/exchange.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/packing.hpp"
#include "tests/support/shared_grains.hpp"
#include "tests/support/shared_grid.hpp"

namespace barchan {
namespace {

using test::SharedGrid;

MessageCounts operator+(const MessageCounts& a, const MessageCounts& b) {
  return {a.messages + b.messages, a.bytes + b.bytes, a.reductions + b.reductions,
          a.all_to_alls + b.all_to_alls};
}
MessageCounts operator*(std::int64_t n, const MessageCounts& a) {
  return {n * a.messages, n * a.bytes, n * a.reductions, n * a.all_to_alls};
}
MessageCounts since(const MessageCounts& before) { return message_counts() + (-1) * before; }

void expect_equal(const MessageCounts& counted, const MessageCounts& expected) {
  EXPECT_EQ(counted.messages, expected.messages);
  EXPECT_EQ(counted.bytes, expected.bytes);
  EXPECT_EQ(counted.reductions, expected.reductions);
  EXPECT_EQ(counted.all_to_alls, expected.all_to_alls);
}

int n_ranks() { return rank_count(MPI_COMM_WORLD); }
MessageCounts numbers_sent(std::int64_t messages, std::int64_t numbers) {
  return {.messages = messages, .bytes = 8 * numbers};
}
MessageCounts reductions(std::int64_t n) { return {.reductions = n_ranks() > 1 ? n : 0}; }
MessageCounts all_to_alls(std::int64_t n) { return {.all_to_alls = n_ranks() > 1 ? n : 0}; }

// --- the flow ----------------------------------------------------------------------------------

/// A plane to each side of every cut, z with the corners.
MessageCounts fill(const Grid& grid, int ny) {
  const int cut_x = grid.ranks->along_x().count > 1, cut_z = grid.ranks->along_z().count > 1;
  return numbers_sent(2 * cut_x + 2 * cut_z,
                      2 * cut_x * (ny + 2) * grid.nz + 2 * cut_z * (ny + 2) * (grid.nx + 2));
}
MessageCounts fill(const Grid& grid) { return fill(grid, grid.ny); }

/// Messages to the other ranks of a line: their part of `split` of all `n_here` and `others` here.
MessageCounts shares(int place, int n_here, const BlockPartition& split, int others, int width) {
  MessageCounts sum;
  for (int p = 0; p < split.parts; ++p) {
    const std::int64_t numbers = std::int64_t{n_here} * split.count(p) * others * width;
    if (p != place && numbers > 0) sum = sum + numbers_sent(1, numbers);
  }
  return sum;
}

/// The axis `shared` made whole at the cost of `split`, and cut again.
MessageCounts there_and_back(const RankAxis& line, const BlockPartition& shared,
                             const BlockPartition& split, int others, int width) {
  return shares(line.position, shared.count(line.position), split, others, width) +
         shares(line.position, split.count(line.position), shared, others, width);
}

/// Lines of x, lines of z, rows.
MessageCounts fft_solve(const Grid& grid) {
  const RankAxis &x = grid.ranks->along_x(), &z = grid.ranks->along_z();
  const BlockPartition cells_x{grid.nx_all, x.count}, cells_z{grid.nz_all, z.count};
  const BlockPartition rows{grid.ny, x.count}, planes{grid.nz_all, x.count};
  const BlockPartition modes{grid.nx_all / 2 + 1, z.count};
  return there_and_back(x, cells_x, rows, grid.nz, 1) +
         there_and_back(z, cells_z, modes, rows.count(x.position), 2) +
         there_and_back(x, rows, planes, modes.count(z.position), 2);
}

/// nu_t, u*_x, u*_z, p twice, u; flow rate before and after, Courant number with continuity.
MessageCounts flow_step(const Grid& grid) {
  return 8 * fill(grid) + fft_solve(grid) + reductions(3);
}

/// A fill for each colour in five sweeps there and back.
MessageCounts relaxation(const Grid& grid) {
  const int colours = grid.nx_all % 2 == 0 && grid.nz_all % 2 == 0 ? 2 : 3;
  return (2 * 5 * colours) * fill(grid);
}
/// An iteration: the direction, the local part before the FFT solve; three inner products, one of
/// them with a mean.
MessageCounts pressure_iteration(const Grid& grid) {
  return 2 * fill(grid) + relaxation(grid) + fft_solve(grid) + reductions(3);
}
/// The first one: p as guessed, relaxed, solved, relaxed; heights of columns twice; norm of b, then
/// that of what is left with the mean before and after. At the end p.
MessageCounts pressure_solve(const Grid& grid, int iterations) {
  return 5 * fill(grid) + relaxation(grid) + fft_solve(grid) + 2 * fill(grid, 1) + reductions(2) +
         (iterations - 1) * pressure_iteration(grid);
}
/// alpha_f twice, nu_t, alpha u, mobility, u*_x, u*_z, p, u, du/dt; flow rate with mobility, flow
/// rate, Courant number with continuity.
MessageCounts flow_step_around_grains(const Grid& grid, int iterations) {
  return 18 * fill(grid) + pressure_solve(grid, iterations) + reductions(3);
}

// --- the exchange ------------------------------------------------------------------------------

/// Sums of six quantities in the ghosts, those in x with the corners.
MessageCounts scatter_add(const Grid& grid) {
  const int cut_x = grid.ranks->along_x().count > 1, cut_z = grid.ranks->along_z().count > 1;
  return numbers_sent(2 * cut_x + 2 * cut_z,
                      6 * grid.ny * (2 * cut_x * (grid.nz + 2) + 2 * cut_z * grid.nx));
}

/// Messages of the exchange. Columns that have grains, or less fluid: a map and a height.
/// Raw fraction; pressure, it and a component of its force smoothed, the force in cells;
/// stress on faces, in cells; what the flow gets of each; convective acceleration. Columns again,
/// the fraction of those that are new; fraction, smoothed; totals, fastest velocity; what the
/// ledger books.
MessageCounts exchange(const Grid& grid) {
  return reductions(4) + (1 + (1 + 3) + (3 + 3) + 3) * fill(grid) + 2 * fft_solve(grid) +
         reductions(2) + fill(grid) + scatter_add(grid) + fill(grid) + fft_solve(grid) +
         reductions(1 + 1 + 1);
}

/// Messages of cells narrower than 2.4 d: the solid that belongs to the momentum cells, along x and
/// z.
MessageCounts solid_of_momentum_cells(const Grid& grid) {
  return scatter_add(grid) + 2 * fill(grid);
}

/// Grains of this rank in the pencil of each rank.
std::vector<int> grains_in_pencils(const SharedGrid& grid, const GrainState& grains) {
  std::vector<int> n(static_cast<std::size_t>(n_ranks()));
  const auto kin = host_copy(grains.kin);
  const auto part = [](const BlockPartition& split, Real at, Real spacing) {
    int p = 0;
    while (p + 1 < split.parts && at >= split.begin(p + 1) * spacing) ++p;
    return p;
  };
  for (int g = 0; g < grains.n; ++g) {
    const int x = part(grid.ranks->x(), kin(g).x.x, grid.whole.dx);
    const int z = part(grid.ranks->z(), kin(g).x.z, grid.whole.dz);
    ++n[static_cast<std::size_t>(x + grid.ranks->x().parts * z)];
  }
  return n;
}
/// Messages with so many numbers to every other rank for each of its grains.
MessageCounts rows(const std::vector<int>& n, int width) {
  MessageCounts sum;
  for (int r = 0; r < n_ranks(); ++r) {
    const int count = n[static_cast<std::size_t>(r)];
    if (r != rank_of(MPI_COMM_WORLD) && count > 0) sum = sum + numbers_sent(1, count * width);
  }
  return sum;
}
/// Grains go to the fluid ranks with `reads` numbers,
MessageCounts to_fluid(const std::vector<int>& n, int reads) {
  return rows(n, reads) + all_to_alls(1);
}
/// and come back with `writes`.
MessageCounts back_from_fluid(const std::vector<int>& n, int writes) {
  std::vector<int> copies(n.size());
  MPI_Alltoall(n.data(), 1, MPI_INT, copies.data(), 1, MPI_INT, MPI_COMM_WORLD);
  return rows(copies, writes);
}

// --- the grains --------------------------------------------------------------------------------

/// Position, velocity and spin of the ghosts, and the largest excess over a skin.
MessageCounts grain_step(const ExchangeCounts& ghosts) {
  return rows(ghosts.to, 9) + reductions(1);
}
/// Ghosts whole; the balance; the largest and the mean speed; numbers of grains, contacts and
/// ghosts.
MessageCounts rebuild(const ExchangeCounts& ghosts) {
  return rows(ghosts.to, 13) + reductions(4) + all_to_alls(3);
}

/// Grains on the floor of a shallow channel, cut in one of all shapes.
struct SmallCase {
  static constexpr std::array<int, 3> cells{21, 7, 15};  // unequal pencils, three colours
  static constexpr std::array<double, 3> size{0.0105, 0.004, 0.0075};

  explicit SmallCase(int along_x, bool with_grains) : grid(cells, size, 3e-4, along_x) {
    config.fluid->mean_velocity = 0.02;
    config.time.fluid_step = 2.5e-4;
    config.time.grain_step = 2.5e-5;
    config.solver.pressure_tolerance = 1e-12;
    config.solver.max_iterations = 3;  // too few for it: all are taken
    if (with_grains) {
      config.grains.emplace();
      config.grains->material.youngs_modulus = config.grains->wall.youngs_modulus = 5e4;
    }
    state.fluid = make_fluid_state(grid.mine);
    grid.set(Field("whole", grid.whole), state.fluid->u.x,
             [](int i, int j, int k) { return 0.02 + 0.005 * test::noise(i, j, k); });
    for (const Field& f : {state.fluid->alpha_f, state.fluid->alpha_f_previous})
      Kokkos::deep_copy(f.storage, Real(1));
    if (with_grains) {
      const InitialGrains grains = test::lattice_packing(2500, size, 0);
      state.grains = make_grain_state(grains, config.grains->density, MPI_COMM_WORLD);
    }
    step = std::make_unique<CoupledStep>(config, state);
    step->start(state);
    step->advance(state);  // the first one also measures the flow it starts from
  }

  SharedGrid grid;
  Config config = test::flow_config(cells, size, 3e-4);
  SystemState state;
  std::unique_ptr<CoupledStep> step;
};

TEST(HaloOverRanks, OneMessageToEachSide) {
  for (const int along_x : test::shapes(SmallCase::cells)) {
    SCOPED_TRACE(along_x);
    const SharedGrid grid(SmallCase::cells, SmallCase::size, 3e-4, along_x);
    const Halo halo(grid.mine);
    Field f("f", grid.mine);
    const MessageCounts before = message_counts();
    halo.fill(f);
    expect_equal(since(before), fill(grid.mine));
  }
}

TEST(MessageCounts, AFlowStep) {
  for (const int along_x : test::shapes(SmallCase::cells)) {
    SCOPED_TRACE(along_x);
    SmallCase c(along_x, false);
    const MessageCounts before = message_counts();
    c.step->advance(c.state);
    expect_equal(since(before), flow_step(c.grid.mine));
  }
}

TEST(MessageCounts, ACoupledStep) {
  constexpr int grain_steps = 10, iterations = 3;
  for (const int along_x : test::shapes(SmallCase::cells)) {
    SCOPED_TRACE(along_x);
    SmallCase c(along_x, true);
    const NeighborList& list = *std::as_const(*c.step).neighbor_list();
    const std::int64_t rebuilds = list.rebuilds();
    const std::vector<int> grains_before = grains_in_pencils(c.grid, *c.state.grains);
    const ExchangeCounts ghosts = list.ghosts() ? list.ghosts()->counts() : ExchangeCounts{};
    const MessageCounts before = message_counts();
    c.step->advance(c.state);
    const MessageCounts counted = since(before);
    ASSERT_EQ(list.rebuilds(), rebuilds);
    ASSERT_EQ(c.step->fluid_report().pressure_iterations, iterations);
    ASSERT_EQ(c.step->substeps(), grain_steps);

    MessageCounts expected =
        flow_step_around_grains(c.grid.mine, iterations) + exchange(c.grid.mine) +
        solid_of_momentum_cells(c.grid.mine) + to_fluid(grains_before, 15) +
        back_from_fluid(grains_before, 21) +
        to_fluid(grains_in_pencils(c.grid, *c.state.grains), 20) +
        reductions(2);  // the ledger's number of grains; whether one has passed the outlet
    if (n_ranks() > 1) expected = expected + grain_steps * grain_step(ghosts);
    expect_equal(counted, expected);
  }
}

Config periodic_box() {
  Config c = test::grain_config();
  c.size = {0.0108, 0.004, 0.0081};
  c.grains->boundary_x = GrainBoundaryX::periodic;
  return c;
}

TEST(MessageCounts, AListRebuild) {
  const Config c = periodic_box();
  test::GrainBench s(c, test::lattice_packing(2500, c.size, 0), MPI_COMM_WORLD);
  const MessageCounts before = message_counts();
  s.solver.list().rebuild(s.state, false);
  if (n_ranks() == 1) return expect_equal(since(before), {});
  expect_equal(since(before), rebuild(s.solver.list().ghosts()->counts()));
}

void move_along_x(const GrainState& grains, Real distance) {
  const auto kin = grains.kin;
  Kokkos::parallel_for(
      "test: move", grains.n, KOKKOS_LAMBDA(int g) { kin(g).x.x += distance; });
}

/// Every grain goes on by one column, some to another rank: 30 numbers each, and no contacts.
TEST(MessageCounts, AMigration) {
  const Config c = periodic_box();
  test::GrainBench s(c, test::lattice_packing(2500, c.size, 0), MPI_COMM_WORLD);
  if (n_ranks() == 1) return;
  const NeighborList& list = s.solver.list();
  move_along_x(s.state, 3e-4);
  const std::int64_t migrated = list.n_migrated();
  const MessageCounts before = message_counts();
  s.solver.list().rebuild(s.state, false);
  const MessageCounts counted = since(before), still = rebuild(list.ghosts()->counts());
  EXPECT_GT(sum_over(MPI_COMM_WORLD, list.n_migrated() - migrated), 0);
  EXPECT_EQ(counted.bytes - still.bytes, 8 * 30 * (list.n_migrated() - migrated));
  EXPECT_EQ(counted.messages > still.messages, list.n_migrated() > migrated);
}

}  // namespace
}  // namespace barchan
