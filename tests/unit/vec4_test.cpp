// Vectors of four numbers: what the processor does with all of them at once.
#include "kernels/math/vec4.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace barchan {
namespace {

// Numbers that round in every operation: a product and a sum that is rounded once shows.
TEST(Vec4, EachComponentGetsTheBitsThatItGetsOnItsOwn) {
  int n_rounded_once = 0;
  for (int n = 1; n < 200; ++n) {
    const Real s = std::sin(n), a[] = {std::cos(n), 1e-9 * n, -std::sqrt(n), 1.0 / n};
    const Real b[] = {std::tan(n), 3e-9, std::sqrt(n) / 3, -0.3 / n};
    Real sum[4], difference[4], both[4];
    (Vec4(a) + Vec4(b)).store(sum);
    (Vec4(a) - Vec4(b)).store(difference);
    fma(s, Vec4(a), Vec4(b)).store(both);
    for (int q = 0; q < 4; ++q) {
      EXPECT_EQ(sum[q], a[q] + b[q]);
      EXPECT_EQ(difference[q], a[q] - b[q]);
      EXPECT_EQ(both[q], fma(s, a[q], b[q]));
      n_rounded_once += both[q] != s * a[q] + b[q] ? 1 : 0;
    }
  }
  const bool rounds_once = fma(1 + 0x1p-30, 1 - 0x1p-30, -1.0) != 0;
  EXPECT_EQ(n_rounded_once > 50, rounds_once);
}

TEST(Vec4, CarriesAVectorAndANumber) {
  const Vec3 a{1, -2, 3};
  const Vec4 with_number(a.x, a.y, a.z, 4);
  EXPECT_EQ(with_number.w(), 4);
  EXPECT_EQ(vec4(a).w(), 0);
  for (const Vec3& b : {with_number.vec(), vec4(a).vec()}) EXPECT_EQ(norm(b - a), 0);
  EXPECT_EQ(alignof(Vec4), sizeof(Vec4));
  EXPECT_EQ(sizeof(Vec4), 4 * sizeof(Real));
}

}  // namespace
}  // namespace barchan
