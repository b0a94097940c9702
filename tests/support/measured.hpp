// Measurements of a test, printed beside reference and tolerance (docs/validation*.md), and
// checked.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "kernels/math/vec3.hpp"

namespace barchan::test {

inline void print_measured(const std::string& claim, Real value, Real reference, Real tolerance) {
  std::printf("[ measured ] %s: %.7g (reference %.7g, tolerance %.2g)\n", claim.c_str(), value,
              reference, tolerance);
}

/// Tolerance relative to the reference.
inline void expect_relative(const std::string& claim, Real value, Real reference, Real tolerance) {
  print_measured(claim, value, reference, tolerance);
  EXPECT_NEAR(value / reference, 1, tolerance) << claim << ": " << value;
}

inline void expect_absolute(const std::string& claim, Real value, Real reference, Real tolerance) {
  print_measured(claim, value, reference, tolerance);
  EXPECT_NEAR(value, reference, tolerance) << claim;
}

/// An error that must vanish.
inline void expect_below(const std::string& claim, Real error, Real tolerance) {
  print_measured(claim, error, 0, tolerance);
  EXPECT_LT(error, tolerance) << claim;
}

/// Order of an error on a mesh, or with a step, and on one half as large.
inline void expect_order(const std::string& claim, Real coarse, Real fine, Real order,
                         Real tolerance) {
  expect_absolute("order, " + claim, std::log2(coarse / fine), order, tolerance);
}

}  // namespace barchan::test
