// What a rank sends: a message to each side, and few numbers for each grain (docs/dev/scaling.md).
#include <gtest/gtest.h>

#include "src/parallel/exchange.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/packing.hpp"
#include "tests/support/shared_grains.hpp"
#include "tests/support/shared_grid.hpp"

namespace barchan {
namespace {

/// Sent since `before`, and in it.
MessageCounts since(const MessageCounts& before) {
  const MessageCounts& now = message_counts();
  return {now.messages - before.messages, now.bytes - before.bytes,
          now.reductions - before.reductions, now.all_to_alls - before.all_to_alls};
}

void expect_equal(const MessageCounts& counted, const MessageCounts& expected) {
  EXPECT_EQ(counted.messages, expected.messages);
  EXPECT_EQ(counted.bytes, expected.bytes);
  EXPECT_EQ(counted.reductions, expected.reductions);
  EXPECT_EQ(counted.all_to_alls, expected.all_to_alls);
}

TEST(HaloOverRanks, OneMessageToEachSide) {
  constexpr std::array<int, 3> cells{21, 7, 15};  // unequal pencils
  for (const int along_x : test::shapes(cells)) {
    SCOPED_TRACE(along_x);
    const test::SharedGrid shared(cells, {0.0105, 0.004, 0.0075}, 3e-4, along_x);
    const Grid& grid = shared.mine;
    const Halo halo(grid);
    Field f("f", grid);
    const MessageCounts before = message_counts();
    halo.fill(f);
    // A plane to each side of every cut, z with the corners.
    const int x = grid.ranks->along_x().count > 1, z = grid.ranks->along_z().count > 1;
    const int numbers = (grid.ny + 2) * (2 * x * grid.nz + 2 * z * (grid.nx + 2));
    expect_equal(since(before), {.messages = 2 * x + 2 * z, .bytes = 8 * numbers});
  }
}

/// Grains in a box, on all ranks; the ranks cut them in pieces.
struct Box {
  Box() : bench(config(), test::lattice_packing(2500, config().size, 0), MPI_COMM_WORLD) {}

  static Config config() {
    Config c = test::grain_config();
    c.size = {0.0108, 0.004, 0.0081};
    c.grains->boundary_x = GrainBoundaryX::periodic;
    return c;
  }
  NeighborList& list() { return bench.solver.list(); }
  /// A message to each rank that has ghosts of this one, with so many numbers for each of them.
  MessageCounts to_ghosts(int width) {
    MessageCounts sum;
    for (const int n : list().ghosts()->counts().to) {
      sum.messages += n > 0;
      sum.bytes += 8 * width * n;
    }
    return sum;
  }

  test::GrainBench bench;
  bool is_alone = rank_count(MPI_COMM_WORLD) == 1;
};

/// Position, velocity and spin of the ghosts, and the largest excess over a skin.
TEST(MessageCounts, NineNumbersForAGhostInAGrainStep) {
  Box box;
  const std::int64_t rebuilds = box.list().rebuilds();
  const MessageCounts before = message_counts();
  box.bench.advance(1, 1e-7);
  ASSERT_EQ(box.list().rebuilds(), rebuilds);
  if (box.is_alone) return expect_equal(since(before), {});
  MessageCounts expected = box.to_ghosts(9);
  expected.reductions = 1;
  expect_equal(since(before), expected);
}

/// Ghosts whole; the balance; the largest and the mean speed; numbers of grains, contacts, ghosts.
MessageCounts rebuild(Box& box) {
  MessageCounts sum = box.to_ghosts(13);
  sum.reductions = 4;
  sum.all_to_alls = 3;
  return sum;
}

TEST(MessageCounts, AListRebuild) {
  Box box;
  const MessageCounts before = message_counts();
  box.list().rebuild(box.bench.state, false);
  expect_equal(since(before), box.is_alone ? MessageCounts{} : rebuild(box));
}

void move_along_x(const GrainState& grains, Real distance) {
  const auto kin = grains.kin;
  Kokkos::parallel_for(
      "test: move", grains.n, KOKKOS_LAMBDA(int g) { kin(g).x.x += distance; });
}

/// Every grain goes on by one column, some to another rank: 30 numbers each, and no contacts.
TEST(MessageCounts, AMigration) {
  Box box;
  if (box.is_alone) return;
  move_along_x(box.bench.state, 3e-4);
  const std::int64_t before_it = box.list().n_migrated();
  const MessageCounts before = message_counts();
  box.list().rebuild(box.bench.state, false);
  const MessageCounts counted = since(before), still = rebuild(box);
  const std::int64_t migrated = box.list().n_migrated() - before_it;
  EXPECT_GT(sum_over(MPI_COMM_WORLD, migrated), 0);
  EXPECT_EQ(counted.bytes - still.bytes, 8 * 30 * migrated);
  EXPECT_EQ(counted.messages > still.messages, migrated > 0);
}

}  // namespace
}  // namespace barchan
