// Dunes followed in time: labels, celerity, lost grains.
#include "tests/support/built_dunes.hpp"

#include <map>

#include "src/diagnostics/gathered_grains.hpp"
#include "src/diagnostics/heap_shares.hpp"

namespace barchan {
namespace {

using namespace test;

TEST(DuneTracker, TranslationGivesCelerityAndLabelsStay) {
  const Grains small = heap(0.02, 0.025, 4.0 * mm, 1.5 * mm);
  const Grains large = heap(0.05, 0.025, 8.0 * mm, 2.5 * mm);
  DuneTracker tracker(channel);
  std::vector<DuneRecord> rows;
  for (int step = 0; step <= 30; ++step) {
    const double t = 0.1 * step;  // the small one is faster and crosses the edge in z
    rows = tracker.update(
        t, moved(small, 6.0 * mm * t, 10.0 * mm * t) + moved(large, 2.0 * mm * t, 0.0));
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(std::isnan(rows[0].celerity), step == 0);
  }
  EXPECT_DOUBLE_EQ(rows[0].t, 3.0);
  EXPECT_NEAR(rows[0].cx, 0.056, 0.1 * d);
  EXPECT_NEAR(rows[0].celerity, 2.0 * mm, 0.02 * mm);
  EXPECT_NEAR(rows[1].celerity, 6.0 * mm, 0.06 * mm);
  EXPECT_EQ(rows[0].n_lost, 0);
}

TEST(DuneTracker, CelerityIsThatOfItsWindowOfOneSecond) {
  const Grains grains = heap(0.02, 0.025, 4.0 * mm, 1.5 * mm);
  DuneTracker tracker(channel);
  for (int step = 0; step <= 30; ++step) {
    const double t = 0.1 * step;  // 2 mm/s until 2 s, then 6 mm/s
    const double x = 2.0 * mm * t + std::max(0.0, 4.0 * mm * (t - 2.0));
    const double celerity = tracker.update(t, moved(grains, x, 0.0)).at(0).celerity;
    if (step == 20 || step == 30) {
      EXPECT_NEAR(celerity, (step == 20 ? 2.0 : 6.0) * mm, 0.01 * mm);
    }
  }
}

TEST(DuneTracker, CelerityGoesOnAcrossAPeriodicOutlet) {
  const DuneDomain loop{.length_x = 0.1, .length_z = 0.05, .periodic_x = true};
  Grains grains = heap(0.09, 0.025, 8.0 * mm, 2.5 * mm);
  DuneTracker tracker(loop);
  for (int step = 0; step <= 20; ++step) {
    const auto rows = tracker.update(0.1 * step, moved(grains, step * mm, 0.0, loop));
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].dune, 0);
    if (step > 0) {
      EXPECT_NEAR(rows[0].celerity, 10.0 * mm, 0.1 * mm);
    }
  }
}

TEST(DuneTracker, LabelSurvivesAGapAndANewDuneGetsANewOne) {
  const Grains first = heap(0.02, 0.025, 4.0 * mm, 1.5 * mm), none;
  const Grains second = heap(0.07, 0.025, 6.0 * mm, 2.0 * mm);
  DuneTracker tracker(channel);
  EXPECT_EQ(tracker.update(0.0, first).at(0).dune, 0);
  EXPECT_TRUE(tracker.update(0.1, none).empty());
  EXPECT_EQ(tracker.update(0.2, first).at(0).dune, 0);
  EXPECT_EQ(tracker.update(0.3, second).at(0).dune, 1);
  EXPECT_EQ(tracker.update(0.4, second).at(0).dune, 1);
}

TEST(DuneTracker, GrainsBearTheLabelOfTheirDune) {
  const Grains first = heap(0.02, 0.025, 4.0 * mm, 1.5 * mm);
  const Grains alone{{{0.045, 0.5 * d, 0.01}, d}};
  const Grains both = first + heap(0.07, 0.025, 6.0 * mm, 2.0 * mm) + alone;
  DuneTracker tracker(channel);
  tracker.update(0.0, first);
  const std::vector<int> labels = tracker.labels(both);  // the second is new, and larger
  const std::vector<DuneRecord> rows = tracker.update(0.1, both);
  EXPECT_EQ(tracker.labels(both), labels);
  ASSERT_EQ(labels.size(), both.size());
  EXPECT_EQ(labels.back(), -1);
  const auto second = labels.begin() + static_cast<std::ptrdiff_t>(first.size());
  EXPECT_EQ(std::count(labels.begin(), second, 0), rows.at(0).n_grains);
  EXPECT_EQ(std::count(second, labels.end(), 1), rows.at(1).n_grains);
}

TEST(DuneTracker, TellsWhichHeapTheGrainsOfADuneCameFrom) {
  Grains first = heap(0.02, 0.025, 4.0 * mm, 1.5 * mm);
  Grains second = heap(0.07, 0.025, 6.0 * mm, 2.0 * mm);
  Grains loose{{{0.045, 0.5 * d, 0.01}, d}};
  for (GrainSample& grain : first) grain.heap = 0;
  for (GrainSample& grain : second) grain.heap = 1;
  loose[0].heap = 1;
  first[0].heap = 1;                             // one that was carried over
  loose.push_back({{0.047, 0.5 * d, 0.01}, d});  // came from no heap
  const Grains all = first + second + loose;
  DuneTracker tracker(channel);
  tracker.update(0.5, all);
  const std::vector<int> labels = tracker.labels(all);
  const std::vector<HeapShare> shares = heap_shares(0.5, all, labels);
  std::map<std::pair<int, int>, std::int64_t> expected;  // (dune, heap), in their order
  for (std::size_t p = 0; p < all.size(); ++p)
    ++expected[{labels[p], static_cast<int>(all[p].heap)}];
  EXPECT_EQ((expected[{1, 1}]), 1) << "the carried grain, in the smaller dune";
  ASSERT_EQ(shares.size(), expected.size());
  auto share = shares.begin();
  for (const auto& [place, n] : expected) {
    EXPECT_EQ(share->dune, place.first);
    EXPECT_EQ(share->heap, place.second);
    EXPECT_EQ(share->n_grains, n);
    const double volume = static_cast<double>(n) * std::numbers::pi / 6 * d * d * d;
    EXPECT_NEAR(share->volume, volume, 1e-12 * volume);
    EXPECT_EQ(share->t, 0.5);
    ++share;
  }
  EXPECT_TRUE(are_of_heaps(all));
  EXPECT_FALSE(are_of_heaps(heap(0.02, 0.025, 4.0 * mm, 1.5 * mm)));
}

TEST(DuneTracker, GrainsOfARunBearTheirHeapIfThereAreSeveral) {
  InitialGrains initial;
  for (const int id : {7, 9}) initial.add(id, d, {id * mm, mm, mm});
  GrainState grains = make_grain_state(initial, 2500);
  for (const GrainSample& grain : gathered_grains(grains)) EXPECT_EQ(grain.heap, -1);
  grains.heap = Kokkos::View<std::uint8_t*>("heap", 2);
  const auto heap = mirror(grains.heap);
  heap(0) = 0, heap(1) = 3;
  Kokkos::deep_copy(grains.heap, heap);
  const std::vector<GrainSample> all = gathered_grains(grains);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].heap, 0);
  EXPECT_EQ(all[1].heap, 3);
}

TEST(DuneTracker, CountsLostGrains) {
  Grains grains = heap(0.03, 0.02, 8.0 * mm, 2.5 * mm);
  DuneTracker tracker(channel);
  tracker.update(0.0, grains);
  grains.resize(grains.size() - 17);
  EXPECT_EQ(tracker.update(0.1, grains).at(0).n_lost, 17);
  grains.resize(grains.size() - 2);  // five more have left, and three have come in
  EXPECT_EQ(tracker.update(0.15, grains, 3).at(0).n_lost, 22);
  EXPECT_TRUE(tracker.update(0.2, {}).empty());
}

TEST(DuneTracker, RestoredStateContinuesTheSame) {
  Grains grains = heap(0.03, 0.02, 8.0 * mm, 2.5 * mm);
  DuneTracker straight(channel), resumed(channel);
  for (int step = 0; step < 5; ++step)
    straight.update(0.3 * step, moved(grains, 0.3 * mm * step * step, 0.0));
  resumed.set_state(straight.state());
  const Grains later = moved(grains, 9.0 * mm, 0.0);
  const DuneRecord a = straight.update(1.5, later).at(0);
  const DuneRecord b = resumed.update(1.5, later).at(0);
  EXPECT_EQ(a.celerity, b.celerity);
  EXPECT_EQ(a.dune, b.dune);
  EXPECT_EQ(straight.state(), resumed.state());

  std::vector<double> broken = straight.state();
  broken.pop_back();
  EXPECT_THROW(resumed.set_state(broken), std::runtime_error);
  // Counts as a damaged file may have them, and a dune that was never seen.
  for (const double bad : {-1.0, 1e300, std::nan("")}) {
    for (const std::size_t at : {0, 1, 2, 3, 4, 9}) {
      broken = straight.state();
      broken[at] = bad;
      EXPECT_THROW(resumed.set_state(broken), std::runtime_error) << at;
    }
  }
  EXPECT_THROW(resumed.set_state(std::vector<double>{9, 0, 1, 1, 0, 0, 1, 1, 1, 0}),
               std::runtime_error);
  EXPECT_EQ(straight.state(), resumed.state());
}

}  // namespace
}  // namespace barchan
