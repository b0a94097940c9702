// Dune analytics against shapes whose width, length, height and horns are known.
#include "tests/support/built_dunes.hpp"

namespace barchan {
namespace {

using namespace test;

TEST(DuneAnalytics, ConeIsItsDiameterAndHasNoHorns) {
  Grains grains = heap(0.03, 0.02, 13.0 * mm, 3.0 * mm);
  const DuneRecord dune = only_dune(grains);
  EXPECT_NEAR(dune.w, 26.0 * mm, bin);
  EXPECT_NEAR(dune.l, 26.0 * mm, bin);
  EXPECT_NEAR(dune.h, 3.0 * mm, bin);
  EXPECT_NEAR(dune.cx, 0.03, 0.1 * d);
  EXPECT_NEAR(dune.cz, 0.02, 0.1 * d);
  EXPECT_NEAR(dune.crest_x, 0.03, bin);
  EXPECT_EQ(dune.horn_left, 0.0);
  EXPECT_EQ(dune.horn_right, 0.0);
  // Single grains may stick out of the outline.
  const auto n = static_cast<double>(dune.n_grains);
  EXPECT_NEAR(n, static_cast<double>(grains.size()), 0.005 * n);
  EXPECT_NEAR(dune.volume, n * std::numbers::pi / 6.0 * d * d * d, 1e-9 * dune.volume);
}

TEST(DuneAnalytics, CentroidIsWeightedByVolume) {
  Grains grains = pile(0.03, 0.02, 5.0 * mm, [](double, double) { return 1.0 * mm; });
  const double before = only_dune(grains).cx;
  for (GrainSample& grain : grains) {
    if (grain.x.x > 0.03) grain.d *= 0.5;
  }
  EXPECT_LT(only_dune(grains).cx, before - 1.0 * mm);
}

TEST(DuneAnalytics, CrescentHornsReachTheTips) {
  const double offset = 8.0 * mm;
  const DuneRecord dune = only_dune(pile(0.04, 0.025, 10.0 * mm, crescent(offset)));
  // The circles meet at x = offset / 2; the lee foot on the centreline is at offset - 10 mm.
  const double horn = 0.5 * offset - (offset - 10.0 * mm);
  EXPECT_NEAR(dune.horn_left, horn, bin);
  EXPECT_NEAR(dune.horn_right, horn, bin);
  EXPECT_NEAR(dune.w, 20.0 * mm, bin);
  EXPECT_NEAR(dune.l, offset, bin);
  // The slopes meet on the centreline at 0.3 (10 mm + x) = 0.6 (-2 mm - x).
  EXPECT_NEAR(dune.crest_x, 0.04 - 14.0 / 3.0 * mm, bin);
}

/// Horns by height reach as far, to the bin that the median takes from a tip.
TEST(DuneAnalytics, HornsByHeightReachTheTipsToo) {
  const DuneRecord dune = only_dune(slab_with_arms(3.0 * mm, 9.0 * mm));
  EXPECT_NEAR(dune.horn_left_2d, 3.0 * mm, bin);
  EXPECT_NEAR(dune.horn_right_2d, 9.0 * mm, bin);
  // A slope of 0.3 is two diameters high 1.3 mm behind its outline, on the lee (0.6) half of that.
  const DuneRecord pointed = only_dune(pile(0.04, 0.025, 10.0 * mm, crescent(8.0 * mm)));
  EXPECT_LT(pointed.horn_left_2d, pointed.horn_left - bin);
  EXPECT_GT(pointed.horn_left_2d, pointed.horn_left - 3.0 * mm);
  EXPECT_EQ(only_dune(heap(0.03, 0.02, 13.0 * mm, 3.0 * mm)).horn_left_2d, 0.0);
}

/// Grains that trail behind one another from the tips, dense enough to belong to the dune.
TEST(DuneAnalytics, StreaksOfSingleGrainsAreNoHornsByHeight) {
  const Grains dune = slab_with_arms(3.0 * mm, 9.0 * mm);
  const Grains streaks = pile(0.04, 0.025, 20.0 * mm, [](double x, double z) {
    const double tip = z < 0.0 ? 5.5 * mm : 11.5 * mm;
    return std::abs(z) > 7.0 * mm && std::abs(z) < 8.5 * mm && x > tip && x < tip + 2.5 * mm ? d / 2
                                                                                             : 0.0;
  });
  const DuneRecord clean = only_dune(dune), streaky = only_dune(dune + streaks);
  EXPECT_GT(streaky.n_grains, clean.n_grains + 100);
  EXPECT_NEAR(streaky.horn_left, clean.horn_left + 2.4 * mm, bin);
  EXPECT_NEAR(streaky.horn_right, clean.horn_right + 2.4 * mm, bin);
  EXPECT_NEAR(streaky.horn_left_2d, clean.horn_left_2d, bin / 2);
  EXPECT_NEAR(streaky.horn_right_2d, clean.horn_right_2d, bin / 2);
}

/// A carpet of single grains at the lee foot: it is sand that the horns are not longer than, but
/// not the foot of what is two grains high.
TEST(DuneAnalytics, ACarpetAtTheFootDoesNotShortenHornsByHeight) {
  const Grains dune = slab_with_arms(6.0 * mm, 6.0 * mm);
  const Grains carpet = pile(0.04, 0.025, 20.0 * mm, [](double x, double z) {
    return std::abs(z) < 4.0 * mm && x > 2.5 * mm && x < 5.5 * mm ? d / 2 : 0.0;
  });
  const DuneRecord clean = only_dune(dune), carpeted = only_dune(dune + carpet);
  EXPECT_LT(carpeted.horn_left, clean.horn_left - 2.0 * mm);
  EXPECT_NEAR(carpeted.horn_left_2d, clean.horn_left_2d, bin / 2);
  EXPECT_NEAR(carpeted.horn_right_2d, clean.horn_right_2d, bin / 2);
}

TEST(DuneAnalytics, LeftHornIsAtSmallerZ) {
  Grains grains = slab_with_arms(3.0 * mm, 9.0 * mm);
  const DuneRecord dune = only_dune(grains);
  // All of these lengths are whole numbers of grains on this lattice, from edge to edge.
  EXPECT_NEAR(dune.horn_left, 15 * d, 1e-9);
  EXPECT_NEAR(dune.horn_right, 45 * d, 1e-9);
  EXPECT_NEAR(dune.l, 25 * d, 1e-9);
  EXPECT_NEAR(dune.w, 99 * d, 1e-9);
  EXPECT_NEAR(dune.h, 5 * d, 1e-9);
  EXPECT_GT(dune.cz, 0.025);
}

TEST(DuneAnalytics, SandBetweenTheHornsIsNotLength) {
  const Grains dune = slab_with_arms(9.0 * mm, 9.0 * mm);
  const DuneRecord clean = only_dune(dune);
  const Grains bar_between_the_tips = pile(0.04, 0.025, 20.0 * mm, [](double x, double z) {
    return x > 9.5 * mm && x < 11.5 * mm && std::abs(z) < 6.0 * mm ? 1.0 * mm : 0.0;
  });
  const DuneRecord joined = only_dune(dune + bar_between_the_tips);
  EXPECT_NEAR(joined.l, clean.l, 1e-9);
  EXPECT_NEAR(joined.horn_left, 9.0 * mm, bin);
}

TEST(DuneAnalytics, ADenseLayerOfOneGrainIsNoDune) {
  Grains layer;
  const double row = std::sqrt(0.75) * d;
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 60; ++k)
      layer.push_back({{0.03 + (i + 0.5 * (k % 2)) * d, 0.5 * d, 0.02 + k * row}, d});
  }
  EXPECT_TRUE(measure_dunes(layer).empty());
}

TEST(DuneAnalytics, TwoDunesAreOrderedBySize) {
  const std::vector<DuneRecord> rows =
      measure_dunes(heap(0.03, 0.025, 4.0 * mm, 1.5 * mm) + heap(0.06, 0.025, 8.0 * mm, 2.5 * mm));
  ASSERT_EQ(rows.size(), 2u);
  for (const std::size_t i : {0, 1}) {
    EXPECT_EQ(rows[i].dune, static_cast<int>(i));
    EXPECT_NEAR(rows[i].cx, i == 0 ? 0.06 : 0.03, 0.1 * d);
    EXPECT_NEAR(rows[i].w, (i == 0 ? 16.0 : 8.0) * mm, bin);
  }
}

TEST(DuneAnalytics, StrayGrainsNeitherEnlargeNorBridge) {
  Grains grains = heap(0.02, 0.025, 8.0 * mm, 2.5 * mm) + heap(0.04, 0.025, 8.0 * mm, 2.5 * mm);
  const std::vector<DuneRecord> clean = measure_dunes(grains);
  ASSERT_EQ(clean.size(), 2u);
  // A sparse carpet: a tenth of the wall covered outside the dunes, a few grains in flight.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int p = 0; p < 15000; ++p) {
    const double x = channel.length_x * uniform(random), z = channel.length_z * uniform(random);
    const bool on_dune =
        std::hypot(x - 0.02, z - 0.025) < 8.0 * mm || std::hypot(x - 0.04, z - 0.025) < 8.0 * mm;
    if (!on_dune) grains.push_back({{x, p % 20 == 0 ? 5.0 * mm * uniform(random) : 0.5 * d, z}, d});
  }
  const std::vector<DuneRecord> rows = measure_dunes(grains);
  ASSERT_EQ(rows.size(), 2u);
  for (const DuneRecord& row : rows) {
    EXPECT_NEAR(row.w, 16.0 * mm, 2.0 * bin);
    EXPECT_NEAR(row.l, 16.0 * mm, 2.0 * bin);
    EXPECT_NEAR(row.h, clean[0].h, 1e-9);
  }
}

TEST(DuneAnalytics, FlyingGrainsDoNotRaiseTheCrest) {
  Grains grains = heap(0.03, 0.02, 13.0 * mm, 3.0 * mm);
  const DuneRecord before = only_dune(grains);
  const DuneRecord after =
      only_dune(grains + Grains{{{0.03, 6.0 * mm, 0.02}, d}, {{0.035, 5.0 * mm, 0.02}, d}});
  EXPECT_NEAR(after.h, before.h, d);
  EXPECT_NEAR(after.crest_x, before.crest_x, bin);
}

TEST(DuneAnalytics, DuneAcrossThePeriodicBoundaryIsOneDune) {
  Grains grains = slab_with_arms(3.0 * mm, 9.0 * mm);
  const DuneRecord inside = only_dune(grains);
  const DuneDomain both{.length_x = 0.1, .length_z = 0.05, .periodic_x = true};
  // Whole bins, so that the same grains share a bin before and after.
  const double half_x = 100 * 0.1 / 200, half_z = 50 * 0.05 / 100;
  const DuneRecord across_z = only_dune(moved(grains, 0.0, half_z));
  expect_same_shape(across_z, inside, 1e-9);
  EXPECT_NEAR(across_z.cz, std::fmod(inside.cz + half_z, channel.length_z), 1e-9);
  EXPECT_NEAR(across_z.crest_x, inside.crest_x, 1e-9);
  const DuneRecord across_x = only_dune(moved(grains, half_x + 0.01, half_z, both), both);
  expect_same_shape(across_x, inside, 1e-9);
  EXPECT_NEAR(across_x.cx, std::fmod(inside.cx + half_x + 0.01, 0.1), 1e-9);
}

TEST(DuneAnalytics, RidgeAcrossThePeriodIsAsWideAsTheDomain) {
  Grains grains = pile(0.05, 0.025, 25.0 * mm,
                       [](double x, double) { return std::abs(x) < 5.0 * mm ? 1.0 * mm : 0.0; });
  const DuneRecord ridge = only_dune(grains);
  EXPECT_NEAR(ridge.w, channel.length_z, bin);
  EXPECT_LE(ridge.w, channel.length_z);
  EXPECT_NEAR(ridge.l, 10.0 * mm, bin);
}

TEST(DuneAnalytics, ErrorStaysBelowABinAtAnyPositionOnTheBins) {
  Grains grains = slab_with_arms(3.0 * mm, 9.0 * mm);
  for (int i = 0; i < 10; ++i) {
    const DuneRecord dune = only_dune(moved(grains, 0.1 * i * bin, 0.13 * i * bin));
    EXPECT_NEAR(dune.l, 5.0 * mm, bin);
    EXPECT_NEAR(dune.w, 20.0 * mm, bin);
    EXPECT_NEAR(dune.horn_left, 3.0 * mm, bin);
    EXPECT_NEAR(dune.horn_right, 9.0 * mm, bin);
  }
}

TEST(DuneAnalytics, FluxIsVolumeTimesVelocityOverFootprint) {
  Grains grains = heap(30.0 * mm, 25.0 * mm, 10.0 * mm, 3.0 * mm);
  EXPECT_EQ(only_dune(grains).flux, 0.0);
  // One half moves downstream, the other half as fast upstream; stray grains are not the dune's.
  for (GrainSample& grain : grains) {
    const double side = grain.x.z - 25.0 * mm;
    grain.u_x = side > 0.5 * d ? 0.04 : side < -0.5 * d ? -0.02 : 0.0;
  }
  for (int i = 0; i < 30; ++i) {
    for (int k = 0; k < 20; ++k)
      grains.push_back({{(60.0 + i) * mm, 0.5 * d, (15.0 + k) * mm}, d, 9.0});
  }
  const DuneRecord dune = only_dune(grains);
  const double area = std::numbers::pi * 10.0 * mm * 10.0 * mm;
  // Half of the grains less the centre line; the footprint is known to within the rim of bins.
  EXPECT_NEAR(dune.flux, dune.volume * 0.01 / area, 0.1 * dune.volume * 0.01 / area);
}

TEST(DuneAnalytics, NothingGivesNothing) {
  EXPECT_TRUE(measure_dunes({}).empty());
  DuneTracker tracker(channel);
  DuneTracker resumed = tracker;
  EXPECT_NO_THROW(resumed.set_state(tracker.state()));  // of a flow without grains
  EXPECT_EQ(resumed.state(), tracker.state());
  EXPECT_TRUE(tracker.update(0.0, {}).empty());
}

TEST(DuneAnalytics, OddInputIsHandled) {
  Grains grains = heap(0.03, 0.02, 4.0 * mm, 1.5 * mm);
  const DuneRecord clean = only_dune(grains);
  const Grains odd{{{std::nan(""), d, d}, d}, {{1e30, d, d}, d}};
  expect_same_shape(only_dune(grains + odd), clean, 1e-12);
  EXPECT_THROW(measure_dunes({{{d, d, d}, 0.0}}), std::invalid_argument);
  EXPECT_THROW(measure_dunes({}, DuneDomain{}), std::invalid_argument);
}

}  // namespace
}  // namespace barchan
