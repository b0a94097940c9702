// Grains that lie in two rows of cells couple the rows: how stiff, and each column solved.
#include "kernels/fluid/interlayer_drag.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "kernels/coupling/layered_exchange.hpp"
#include "tests/support/flow_fields.hpp"

namespace barchan {
namespace {

/// Nine rows that grow from 0.26 mm upwards.
test::HostGrid thick_rows() {
  return test::HostGrid{make_grid(7, 5, 0.0112, 0.008, row_faces({0.004, 9, 2.6e-4}))};
}

/// Rows of a grain of 0.2 mm at height y in rows 50 um high, and the coefficients of the interlayer
/// drag between them.
struct GrainInThinRows {
  test::HostGrid host{make_grid(7, 5, 0.0112, 0.008, row_faces({0.004, 80, 5e-5}))};
  GridRef grid = host.ref();

  GrainRows rows(Real y) const { return {grid, y, 1e-4}; }
};

// Rows exchange D u through a grain, D = diag(w) - w w^T. The chain of coefficients of the
// interlayer drag is at least as stiff: it takes less for no velocities. With two rows it is the
// same.
TEST(InterlayerDrag, NeighbouringRowsAreCoupledAtLeastAsStiffAsByTheGrain) {
  const GrainInThinRows thin;
  const int n = 80;
  double slackest = 0, stiffest = 0;
  for (Real y = 1.2e-4; y < 4e-4; y += 7e-6) {
    const GrainRows rows = thin.rows(y);
    ASSERT_GE(rows.n, 3);
    Eigen::VectorXd w = Eigen::VectorXd::Zero(n);
    for (int r = 0; r < rows.n; ++r) w(rows.row[r]) = rows.weight(r);
    Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(n, n);
    double sum = 0;
    for (int j = 1; j < n; ++j) {
      const double c = interlayer_drag_below(rows, j);
      chain(j, j) += c, chain(j - 1, j - 1) += c, chain(j, j - 1) -= c, chain(j - 1, j) -= c;
      sum += c;
    }
    const Eigen::MatrixXd direct = Eigen::MatrixXd(w.asDiagonal()) - w * w.transpose();
    const Eigen::VectorXd difference =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(chain - direct).eigenvalues();
    slackest = std::min(slackest, difference.minCoeff());
    stiffest = std::max(stiffest, difference.maxCoeff());
    EXPECT_LE(sum, kDividedOffsets * kDividedOffsets / 4);
  }
  EXPECT_GT(slackest, -1e-14);
  EXPECT_LT(stiffest, 4);
  const test::HostGrid host = thick_rows();
  const GridRef grid = host.ref();
  const GrainRows two(grid, grid.y_face(4), 1e-4);
  EXPECT_NEAR(interlayer_drag_below(two, 4), 0.25, 1e-15);
  EXPECT_EQ(interlayer_drag_below(two, 3) + interlayer_drag_below(two, 5), 0);
}

/// Random numbers on cells, the same for the same seed.
test::HostField noise(const GridRef& grid, double seed, double low, double high) {
  return test::host_field(grid, [=](int i, int j, int k) {
    const double x = std::sin(12.9898 * i + 78.233 * j + 37.719 * k + seed) * 43758.5453;
    return low + (high - low) * (x - std::floor(x));
  });
}

// Each column is solved on its own: (m + C)(u' - u) = m (u* - u), C the matrix of the interlayer
// drag.
TEST(InterlayerDrag, SolvesEachColumnOfFaces) {
  const test::HostGrid host = thick_rows();
  const GridRef grid = host.ref();
  const int n = 9;
  for (const bool along_x : {true, false}) {
    const auto alpha = noise(grid, 1, 0.3, 1), drag = noise(grid, 2, 0, 4e3);
    const auto u = noise(grid, 3, -1, 1), predicted = noise(grid, 4, -1, 1);
    const auto star = noise(grid, 4, -1, 1), pivot = noise(grid, 5, 0, 0);
    // No grain above row 6, and none that lies in rows 2 and 3.
    const auto c = test::host_field(
        grid, [&](int i, int j, int k) { return j > 6 || j == 3 ? 0 : drag.ref()(i, j, k); });
    const InterlayerDrag solve{.grid = grid,
                               .rows = grid.ny,
                               .interlayer_drag = c.ref(),
                               .alpha = alpha.ref(),
                               .u = u.ref(),
                               .density = 1000,
                               .along_x = along_x,
                               .u_star = star.ref(),
                               .pivot = pivot.ref()};
    const int i = 2, k = 3, i0 = along_x ? i - 1 : i, k0 = along_x ? k : k - 1;
    const auto on_face = [&](const test::HostField& f, int j) {
      return (f.ref()(i0, j, k0) + f.ref()(i, j, k)) / 2;
    };
    solve(i, 0, k);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd given(n);
    for (int j = 0; j < n; ++j) {
      const double mass = 1000 * on_face(alpha, j) * grid.dy(j);
      matrix(j, j) += mass;
      given(j) = mass * (predicted.ref()(i, j, k) - u.ref()(i, j, k));
      if (j == 0) continue;
      const double of_pair = c.ref()(i, j, k) * grid.dy(j);
      matrix(j, j) += of_pair, matrix(j - 1, j - 1) += of_pair;
      matrix(j, j - 1) -= of_pair, matrix(j - 1, j) -= of_pair;
    }
    const Eigen::VectorXd change = matrix.ldlt().solve(given);
    for (int j = 0; j < n; ++j)
      EXPECT_NEAR(star.ref()(i, j, k), u.ref()(i, j, k) + change(j), 1e-13) << j;
    EXPECT_GT(std::abs(star.ref()(i, 1, k) - predicted.ref()(i, 1, k)), 1e-3);
    EXPECT_EQ(star.ref()(i + 1, 1, k), predicted.ref()(i + 1, 1, k));
  }
}

}  // namespace
}  // namespace barchan
