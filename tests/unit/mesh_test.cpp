#include "src/fluid/mesh.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace barchan {
namespace {

TEST(Mesh, RatiosOfThePapersMeshes) {
  EXPECT_NEAR(stretching_ratio({0.025, 30, 2.625e-4}), 1.0705, 5e-5);
  EXPECT_NEAR(stretching_ratio({0.025, 45, 1.75e-4}), 1.0460, 5e-5);
  EXPECT_NEAR(stretching_ratio({0.025, 60, 1.25e-4}), 1.0355, 5e-5);
}

TEST(Mesh, RowsStartAtTheFirstHeightGrowByOneRatioAndFillTheHeight) {
  for (const double first : {1e-5, 2.625e-4, 8.3e-4}) {
    const auto faces = row_faces({0.025, 30, first});
    const double q = stretching_ratio({0.025, 30, first});
    ASSERT_EQ(faces.size(), 31u);
    EXPECT_EQ(faces.front(), 0.0);
    EXPECT_EQ(faces.back(), 0.025);
    EXPECT_NEAR(faces[1], first, 1e-12 * first);
    for (std::size_t j = 1; j + 1 < faces.size(); ++j) {
      EXPECT_NEAR((faces[j + 1] - faces[j]) / (faces[j] - faces[j - 1]), q, 1e-9) << "row " << j;
    }
  }
}

TEST(Mesh, UniformWhenTheFirstHeightIsNoneOrTheMean) {
  EXPECT_EQ(stretching_ratio({0.3, 12, 0}), 1.0);
  EXPECT_EQ(stretching_ratio({0.3, 12, 0.3 / 12}), 1.0);
  const auto faces = row_faces({0.3, 12, 0});
  for (int j = 0; j <= 12; ++j)
    EXPECT_NEAR(faces[static_cast<std::size_t>(j)], 0.3 * j / 12, 1e-15);
  EXPECT_EQ(row_faces({2.0, 1, 0}), (std::vector<double>{0, 2}));
}

TEST(Mesh, KeepsItsDigitsCloseToUniform) {
  // Expansion for q = 1 + s, small s: first = (ly / n) (1 - (n - 1) s / 2).
  const double s = 1e-8;
  EXPECT_NEAR(stretching_ratio({1.0, 10, 0.1 * (1 - 4.5 * s)}) - 1, s, 1e-12);
}

TEST(Mesh, RowsAreEqualUpToTheUniformHeightAndGrowByOneRatioAbove) {
  const RowSpacing spacing{0.025, 52, 1.3125e-4, 2e-3};
  ASSERT_EQ(uniform_rows(spacing), 16);  // the sixteenth begins at 1.97 mm
  const double q = stretching_ratio(spacing);
  const auto faces = row_faces(spacing);
  ASSERT_EQ(faces.size(), 53u);
  EXPECT_EQ(faces.front(), 0.0);
  EXPECT_EQ(faces.back(), 0.025);
  for (std::size_t j = 1; j < faces.size() - 1; ++j) {
    const double ratio = (faces[j + 1] - faces[j]) / (faces[j] - faces[j - 1]);
    EXPECT_NEAR(ratio, j < 16 ? 1 : q, 1e-9) << "row " << j;
  }
  // Sum by hand: q + ... + q^36 = (25 - 16 * 0.13125) / 0.13125.
  double sum = 0;
  for (int n = 1; n <= 36; ++n) sum += std::pow(q, n);
  EXPECT_NEAR(sum, (0.025 - 16 * 1.3125e-4) / 1.3125e-4, 1e-9);
}

TEST(Mesh, AUniformHeightThatMeetsAFaceTakesNoRowMore) {
  EXPECT_EQ(uniform_rows({1.0, 40, 0.01, 0.07}), 7);
  EXPECT_EQ(uniform_rows({1.0, 40, 0.01, 0.0701}), 8);
  EXPECT_EQ(uniform_rows({1.0, 40, 0.01, 0.0}), 1);
  EXPECT_EQ(row_faces({1.0, 40, 0.01, 0.01}), row_faces({1.0, 40, 0.01, 0.0}));
}

TEST(Mesh, EqualRowsMustLeaveRoomForThoseThatGrow) {
  EXPECT_TRUE(rows_fit({1.0, 40, 0.01, 0.3}));
  EXPECT_FALSE(rows_fit({1.0, 40, 0.01, 0.4}));    // no row is left
  EXPECT_FALSE(rows_fit({1.0, 40, 0.024, 0.99}));  // nor any height
  EXPECT_TRUE(rows_fit({1.0, 40, 0.025, 0.5}));    // all are equal
}

TEST(Mesh, RefusesWhatCannotBe) {
  EXPECT_THROW(stretching_ratio({0.025, 30, 1e-3}), std::invalid_argument);
  EXPECT_THROW(stretching_ratio({0.025, 1, 1e-3}), std::invalid_argument);
  EXPECT_THROW(stretching_ratio({0.025, 0, 0}), std::invalid_argument);
  EXPECT_THROW(stretching_ratio({0.0, 3, 0}), std::invalid_argument);
  EXPECT_THROW(stretching_ratio({1.0, 3, -0.1}), std::invalid_argument);
  EXPECT_THROW(row_faces({1.0, 3, std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace barchan
