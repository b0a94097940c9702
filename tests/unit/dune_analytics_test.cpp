// In-line dune analytics against shapes whose width, length, height and horns are known.

#include "src/diagnostics/dune_analytics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace barchan {
namespace {

constexpr double d = 2e-4;       // grain diameter [m]
constexpr double bin = 2.5 * d;  // the resolution that is promised [m]
constexpr double mm = 1e-3;      // [m]
const DuneDomain channel{.length_x = 0.1, .length_z = 0.05};

using Grains = std::vector<CloudGrain>;

Grains moved(Grains grains, double dx, double dz, const DuneDomain& domain = channel) {
  for (auto& [x, diameter, u_x] : grains) {
    x += Vec3{dx, 0, dz};
    if (domain.periodic_x) x.x -= std::floor(x.x / domain.length_x) * domain.length_x;
    if (domain.periodic_z) x.z -= std::floor(x.z / domain.length_z) * domain.length_z;
  }
  return grains;
}

using Height = std::function<double(double x, double z)>;  // [m]; zero or less: no sand

/// Columns of touching grains on a square lattice that just cover the height; `x`, `z` are the
/// middle of a square of half width `half`.
Grains pile(double x, double z, double half, const Height& height) {
  const int n = static_cast<int>(std::ceil(half / d));
  Grains grains;
  for (int i = -n; i <= n; ++i) {
    for (int k = -n; k <= n; ++k) {
      const double h = height(i * d, k * d);
      for (int j = 0; j * d < h; ++j) grains.push_back({{x + i * d, (j + 0.5) * d, z + k * d}, d});
    }
  }
  return grains;
}

Grains heap(double x, double z, double radius, double top) {
  return pile(x, z, radius,
              [=](double a, double b) { return top * (1.0 - std::hypot(a, b) / radius); });
}

Grains operator+(Grains a, const Grains& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A disc of 10 mm radius less one of the same radius `offset` downstream, rising inwards from the
/// outline at slope 0.3 and from the lee foot at slope 0.6.
Height crescent(double offset) {
  return [=](double x, double z) {
    const double from_outline = 10.0 * mm - std::hypot(x, z);
    const double from_lee = std::hypot(x - offset, z) - 10.0 * mm;
    return std::min(0.3 * from_outline, 0.6 * from_lee);
  };
}

/// A slab of 5 x 20 mm with two arms of 4 mm width downstream: a crescent with blunt horns.
Grains slab_with_arms(double left, double right) {
  return pile(0.04, 0.025, 20.0 * mm, [=](double x, double z) {
    const bool body = std::abs(x) < 2.5 * mm && std::abs(z) < 10.0 * mm;
    const double arm = z < 0.0 ? left : right;
    const bool in_arm =
        std::abs(z) > 6.0 * mm && std::abs(z) < 10.0 * mm && x > 0.0 && x < 2.5 * mm + arm;
    return body || in_arm ? 1.0 * mm : 0.0;
  });
}

std::vector<DuneRow> measure_dunes(const Grains& grains, const DuneDomain& domain = channel) {
  return find_dunes(grains, domain).rows;
}
DuneRow only_dune(const Grains& grains, const DuneDomain& domain = channel) {
  const std::vector<DuneRow> rows = measure_dunes(grains, domain);
  EXPECT_EQ(rows.size(), 1u);
  return rows.empty() ? DuneRow{} : rows.front();
}

void expect_same_shape(const DuneRow& a, const DuneRow& b, double tolerance) {
  EXPECT_EQ(a.n_grains, b.n_grains);
  EXPECT_NEAR(a.w, b.w, tolerance);
  EXPECT_NEAR(a.l, b.l, tolerance);
  EXPECT_NEAR(a.h, b.h, tolerance);
  EXPECT_NEAR(a.cy, b.cy, 1e-9);
  EXPECT_NEAR(a.horn_left, b.horn_left, tolerance);
  EXPECT_NEAR(a.horn_right, b.horn_right, tolerance);
}

TEST(DuneAnalytics, ConeIsItsDiameterAndHasNoHorns) {
  Grains grains = heap(0.03, 0.02, 13.0 * mm, 3.0 * mm);
  const DuneRow dune = only_dune(grains);
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
  for (CloudGrain& grain : grains) {
    if (grain.x.x > 0.03) grain.d *= 0.5;
  }
  EXPECT_LT(only_dune(grains).cx, before - 1.0 * mm);
}

TEST(DuneAnalytics, CrescentHornsReachTheTips) {
  const double offset = 8.0 * mm;
  const DuneRow dune = only_dune(pile(0.04, 0.025, 10.0 * mm, crescent(offset)));
  // The circles meet at x = offset / 2; the lee foot on the centreline is at offset - 10 mm.
  const double horn = 0.5 * offset - (offset - 10.0 * mm);
  EXPECT_NEAR(dune.horn_left, horn, bin);
  EXPECT_NEAR(dune.horn_right, horn, bin);
  EXPECT_NEAR(dune.w, 20.0 * mm, bin);
  EXPECT_NEAR(dune.l, offset, bin);
  // On the centreline the slopes meet at 0.3 (10 mm + x) = 0.6 (-2 mm - x).
  EXPECT_NEAR(dune.crest_x, 0.04 - 14.0 / 3.0 * mm, bin);
}

TEST(DuneAnalytics, LeftHornIsAtSmallerZ) {
  Grains grains = slab_with_arms(3.0 * mm, 9.0 * mm);
  const DuneRow dune = only_dune(grains);
  // On this lattice all of them are whole numbers of grains, from edge to edge.
  EXPECT_NEAR(dune.horn_left, 15 * d, 1e-9);
  EXPECT_NEAR(dune.horn_right, 45 * d, 1e-9);
  EXPECT_NEAR(dune.l, 25 * d, 1e-9);
  EXPECT_NEAR(dune.w, 99 * d, 1e-9);
  EXPECT_NEAR(dune.h, 5 * d, 1e-9);
  EXPECT_GT(dune.cz, 0.025);
}

TEST(DuneAnalytics, SandBetweenTheHornsIsNotLength) {
  const Grains dune = slab_with_arms(9.0 * mm, 9.0 * mm);
  const DuneRow clean = only_dune(dune);
  const Grains bar_between_the_tips = pile(0.04, 0.025, 20.0 * mm, [](double x, double z) {
    return x > 9.5 * mm && x < 11.5 * mm && std::abs(z) < 6.0 * mm ? 1.0 * mm : 0.0;
  });
  const DuneRow joined = only_dune(dune + bar_between_the_tips);
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
  const std::vector<DuneRow> rows =
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
  const std::vector<DuneRow> clean = measure_dunes(grains);
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
  const std::vector<DuneRow> rows = measure_dunes(grains);
  ASSERT_EQ(rows.size(), 2u);
  for (const DuneRow& row : rows) {
    EXPECT_NEAR(row.w, 16.0 * mm, 2.0 * bin);
    EXPECT_NEAR(row.l, 16.0 * mm, 2.0 * bin);
    EXPECT_NEAR(row.h, clean[0].h, 1e-9);
  }
}

TEST(DuneAnalytics, FlyingGrainsDoNotRaiseTheCrest) {
  Grains grains = heap(0.03, 0.02, 13.0 * mm, 3.0 * mm);
  const DuneRow before = only_dune(grains);
  const DuneRow after =
      only_dune(grains + Grains{{{0.03, 6.0 * mm, 0.02}, d}, {{0.035, 5.0 * mm, 0.02}, d}});
  EXPECT_NEAR(after.h, before.h, d);
  EXPECT_NEAR(after.crest_x, before.crest_x, bin);
}

TEST(DuneAnalytics, DuneAcrossThePeriodicBoundaryIsOneDune) {
  Grains grains = slab_with_arms(3.0 * mm, 9.0 * mm);
  const DuneRow inside = only_dune(grains);
  const DuneDomain both{.length_x = 0.1, .length_z = 0.05, .periodic_x = true};
  // Whole bins, so that the same grains share a bin before and after.
  const double half_x = 100 * 0.1 / 200, half_z = 50 * 0.05 / 100;
  const DuneRow across_z = only_dune(moved(grains, 0.0, half_z));
  expect_same_shape(across_z, inside, 1e-9);
  EXPECT_NEAR(across_z.cz, std::fmod(inside.cz + half_z, channel.length_z), 1e-9);
  EXPECT_NEAR(across_z.crest_x, inside.crest_x, 1e-9);
  const DuneRow across_x = only_dune(moved(grains, half_x + 0.01, half_z, both), both);
  expect_same_shape(across_x, inside, 1e-9);
  EXPECT_NEAR(across_x.cx, std::fmod(inside.cx + half_x + 0.01, 0.1), 1e-9);
}

TEST(DuneAnalytics, RidgeAcrossThePeriodIsAsWideAsTheDomain) {
  Grains grains = pile(0.05, 0.025, 25.0 * mm,
                       [](double x, double) { return std::abs(x) < 5.0 * mm ? 1.0 * mm : 0.0; });
  const DuneRow ridge = only_dune(grains);
  EXPECT_NEAR(ridge.w, channel.length_z, bin);
  EXPECT_LE(ridge.w, channel.length_z);
  EXPECT_NEAR(ridge.l, 10.0 * mm, bin);
}

TEST(DuneAnalytics, ErrorStaysBelowABinAtAnyPositionOnTheBins) {
  Grains grains = slab_with_arms(3.0 * mm, 9.0 * mm);
  for (int i = 0; i < 10; ++i) {
    const DuneRow dune = only_dune(moved(grains, 0.1 * i * bin, 0.13 * i * bin));
    EXPECT_NEAR(dune.l, 5.0 * mm, bin);
    EXPECT_NEAR(dune.w, 20.0 * mm, bin);
    EXPECT_NEAR(dune.horn_left, 3.0 * mm, bin);
    EXPECT_NEAR(dune.horn_right, 9.0 * mm, bin);
  }
}

TEST(DuneTracker, TranslationGivesCelerityAndLabelsStay) {
  const Grains small = heap(0.02, 0.025, 4.0 * mm, 1.5 * mm);
  const Grains large = heap(0.05, 0.025, 8.0 * mm, 2.5 * mm);
  DuneTracker tracker(channel);
  std::vector<DuneRow> rows;
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
  const std::vector<DuneRow> rows = tracker.update(0.1, both);
  EXPECT_EQ(tracker.labels(both), labels);
  ASSERT_EQ(labels.size(), both.size());
  EXPECT_EQ(labels.back(), -1);
  const auto second = labels.begin() + static_cast<std::ptrdiff_t>(first.size());
  EXPECT_EQ(std::count(labels.begin(), second, 0), rows.at(0).n_grains);
  EXPECT_EQ(std::count(second, labels.end(), 1), rows.at(1).n_grains);
}

TEST(DuneTracker, CountsLostGrains) {
  Grains grains = heap(0.03, 0.02, 8.0 * mm, 2.5 * mm);
  DuneTracker tracker(channel);
  tracker.update(0.0, grains);
  grains.resize(grains.size() - 17);
  EXPECT_EQ(tracker.update(0.1, grains).at(0).n_lost, 17);
  EXPECT_TRUE(tracker.update(0.2, {}).empty());
}

TEST(DuneTracker, RestoredStateContinuesTheSame) {
  Grains grains = heap(0.03, 0.02, 8.0 * mm, 2.5 * mm);
  DuneTracker straight(channel), resumed(channel);
  for (int step = 0; step < 5; ++step)
    straight.update(0.3 * step, moved(grains, 0.3 * mm * step * step, 0.0));
  resumed.set_state(straight.state());
  const Grains later = moved(grains, 9.0 * mm, 0.0);
  const DuneRow a = straight.update(1.5, later).at(0);
  const DuneRow b = resumed.update(1.5, later).at(0);
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

TEST(DuneAnalytics, FluxIsVolumeTimesVelocityOverFootprint) {
  Grains grains = heap(30.0 * mm, 25.0 * mm, 10.0 * mm, 3.0 * mm);
  EXPECT_EQ(only_dune(grains).flux, 0.0);
  // One half moves downstream, the other half as fast upstream; stray grains are not the dune's.
  for (CloudGrain& grain : grains) {
    const double side = grain.x.z - 25.0 * mm;
    grain.u_x = side > 0.5 * d ? 0.04 : side < -0.5 * d ? -0.02 : 0.0;
  }
  for (int i = 0; i < 30; ++i) {
    for (int k = 0; k < 20; ++k)
      grains.push_back({{(60.0 + i) * mm, 0.5 * d, (15.0 + k) * mm}, d, 9.0});
  }
  const DuneRow dune = only_dune(grains);
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
  const DuneRow clean = only_dune(grains);
  const Grains odd{{{std::nan(""), d, d}, d}, {{1e30, d, d}, d}};
  expect_same_shape(only_dune(grains + odd), clean, 1e-12);
  EXPECT_THROW(measure_dunes({{{d, d, d}, 0.0}}), std::invalid_argument);
  EXPECT_THROW(measure_dunes({}, DuneDomain{}), std::invalid_argument);
}

}  // namespace
}  // namespace barchan
