#include "src/config/mesh.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace barchan {
namespace {

TEST(Mesh, RatiosOfThePapersMeshes) {
  EXPECT_NEAR(stretching_ratio(0.025, 30, 2.625e-4), 1.0705, 5e-5);
  EXPECT_NEAR(stretching_ratio(0.025, 45, 1.75e-4), 1.0460, 5e-5);
  EXPECT_NEAR(stretching_ratio(0.025, 60, 1.25e-4), 1.0355, 5e-5);
}

TEST(Mesh, RowsStartAtTheFirstHeightGrowByOneRatioAndFillTheHeight) {
  for (const double first : {1e-5, 2.625e-4, 8.3e-4}) {
    const auto faces = stretched_faces(0.025, 30, first);
    const double q = stretching_ratio(0.025, 30, first);
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
  EXPECT_EQ(stretching_ratio(0.3, 12, 0), 1.0);
  EXPECT_EQ(stretching_ratio(0.3, 12, 0.3 / 12), 1.0);
  const auto faces = stretched_faces(0.3, 12, 0);
  for (int j = 0; j <= 12; ++j)
    EXPECT_NEAR(faces[static_cast<std::size_t>(j)], 0.3 * j / 12, 1e-15);
  EXPECT_EQ(stretched_faces(2.0, 1, 0), (std::vector<double>{0, 2}));
}

TEST(Mesh, KeepsItsDigitsCloseToUniform) {
  // For q = 1 + s, small s: first = (ly / n) (1 - (n - 1) s / 2).
  const double s = 1e-8;
  EXPECT_NEAR(stretching_ratio(1.0, 10, 0.1 * (1 - 4.5 * s)) - 1, s, 1e-12);
}

TEST(Mesh, RefusesWhatCannotBe) {
  EXPECT_THROW(stretching_ratio(0.025, 30, 1e-3), std::invalid_argument);
  EXPECT_THROW(stretching_ratio(0.025, 1, 1e-3), std::invalid_argument);
  EXPECT_THROW(stretching_ratio(0.025, 0, 0), std::invalid_argument);
  EXPECT_THROW(stretching_ratio(0.0, 3, 0), std::invalid_argument);
  EXPECT_THROW(stretching_ratio(1.0, 3, -0.1), std::invalid_argument);
  EXPECT_THROW(stretched_faces(1.0, 3, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace barchan
