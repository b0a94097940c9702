// A case that begins as a part of another one.
#include "src/initial/window.hpp"

#include <gtest/gtest.h>

#include <map>

#include "src/base/errors.hpp"
#include "src/case/validate.hpp"

namespace barchan {
namespace {

constexpr double kD = 1e-3;

Config window_at(double x, double z) {
  Config config;
  config.size = {0.010, 0.004, 0.006};
  config.initial.window = {x, z};
  return config;
}

/// A layer of grains that touch, on squares, with the number 100 i + k.
InitialGrains layer() {
  InitialGrains grains;
  for (int i = 0; i < 30; ++i)
    for (int k = 0; k < 20; ++k)
      grains.add(100 * i + k, kD, {(i + 0.5) * kD, kD / 2, (k + 0.5) * kD}, {0.1 * i, 0, 0.1 * k});
  return grains;
}

TEST(Window, HoldsTheGrainsOfItsPlaceWithTheirNumbersAndVelocities) {
  InitialGrains grains = layer();
  const Config config = window_at(5 * kD, 3 * kD);
  cut_to_window(config, {0.010, 0.006}, grains);
  ASSERT_EQ(grains.size(), 60U);
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const int i = static_cast<int>(grains.id[g] / 100), k = static_cast<int>(grains.id[g] % 100);
    EXPECT_NEAR(grains.x[g].x, (i - 5 + 0.5) * kD, 1e-15);
    EXPECT_EQ(grains.x[g].y, kD / 2);
    EXPECT_NEAR(grains.x[g].z, (k - 3 + 0.5) * kD, 1e-15);
    EXPECT_EQ(grains.u[g].x, 0.1 * i);
    EXPECT_EQ(grains.u[g].z, 0.1 * k);
  }
}

TEST(Window, OfGrainsThatOverlapWhereSidesMeetOneGoes) {
  // A column of grains lies on a side: the one at the other side would lie in it by 0.4 d.
  Config config = window_at(5.2 * kD, 3 * kD);
  config.size[0] = 9.6 * kD;
  InitialGrains periodic = layer(), open = layer();
  cut_to_window(config, {9.6 * kD, 0.006}, periodic);
  cut_to_window(config, {0, 0.006}, open);
  EXPECT_EQ(open.size(), 60U);
  EXPECT_EQ(periodic.size(), 54U);
  std::map<std::int64_t, int> columns;
  for (const std::int64_t id : periodic.id) ++columns[id / 100];
  EXPECT_EQ(columns.size(), 9U);
  for (const auto& [column, count] : columns) EXPECT_EQ(count, 6) << "column " << column;
}

TEST(Window, WithoutGrainsIsRefused) {
  InitialGrains grains = layer();
  grains.keep(std::vector<bool>(grains.size(), false));
  EXPECT_THROW(cut_to_window(window_at(0, 0), {}, grains), InputError);
}

TEST(Window, LiesInTheOtherBox) {
  Config other;
  other.size = {0.030, 0.004, 0.020};
  other.grains.emplace();
  const auto problems = [&](double x, double z) {
    return check_start(window_at(x, z), other, false).size();
  };
  EXPECT_EQ(problems(0.020, 0.014), 0U);
  EXPECT_EQ(problems(0.021, 0.014), 1U);
  EXPECT_EQ(problems(0.020, 0.015), 1U);
  EXPECT_EQ(problems(-0.001, 0), 1U);
  other.size[1] = 0.003;
  EXPECT_EQ(problems(0, 0), 1U);
}

}  // namespace
}  // namespace barchan
