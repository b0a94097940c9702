// The pressure equation with random fluid fractions against a direct sparse solve.
#include <Eigen/SparseCholesky>
#include <array>

#include "src/fluid/boundary.hpp"
#include "src/fluid/pressure_solver.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/flow_fields.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using test::HostField;
using test::HostGrid;

/// -div(c grad p) = b with c = alpha^2 / (alpha + m) on faces, put together from alpha and m here.
struct SparseProblem {
  Grid grid;
  HostField alpha, mx, my, mz, b;
  double rho;

  int index(int i, int j, int k) const {
    return (i + grid.nx) % grid.nx + grid.nx * (j + grid.ny * ((k + grid.nz) % grid.nz));
  }
  Eigen::VectorXd solve() const {
    const HostGrid h(grid);
    std::vector<Eigen::Triplet<double>> entries;
    const int n = grid.nx * grid.ny * grid.nz;
    Eigen::VectorXd rhs(n);
    const auto couple = [&](int row, int column, double value) {
      entries.emplace_back(row, row, value);
      entries.emplace_back(column, column, value);
      entries.emplace_back(row, column, -value);
      entries.emplace_back(column, row, -value);
    };
    const auto c = [&](double a, double m) { return a * a / (a + m / rho); };
    const auto at = [&](int i, int j, int k) {
      return alpha((i + grid.nx) % grid.nx, j, (k + grid.nz) % grid.nz);
    };
    double mean = 0;
    test::for_owned_cells(grid, [&](int i, int j, int k) {
      const double here = alpha(i, j, k);
      const int row = index(i, j, k);
      couple(row, index(i - 1, j, k),
             c(0.5 * (here + at(i - 1, j, k)), mx(i, j, k)) * h.dy(j) / (grid.dx * grid.dx));
      couple(row, index(i, j, k - 1),
             c(0.5 * (here + at(i, j, k - 1)), mz(i, j, k)) * h.dy(j) / (grid.dz * grid.dz));
      if (j > 0) {  // the mean over the face's volume
        const double mixed =
            (h.dy(j) * here + h.dy(j - 1) * at(i, j - 1, k)) / (h.dy(j) + h.dy(j - 1));
        couple(row, index(i, j - 1, k), c(mixed, my(i, j, k)) / (h.y(j) - h.y(j - 1)));
      }
      rhs(row) = b(i, j, k) * h.dy(j);
      mean += rhs(row) / (grid.ly * grid.nx * grid.nz);
    });
    for (int row = 0; row < n; ++row) rhs(row) -= mean * h.dy((row / grid.nx) % grid.ny);
    entries.emplace_back(0, 0, 1.0);  // pins the constant; nothing else moves
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(rhs);
  }
};

/// Largest difference of the two solutions over the largest pressure.
double disagreement(std::array<int, 3> n, unsigned seed, bool drag, Preconditioner kind) {
  const double rho = 1000;
  const Grid grid = test::stretched_grid(n, {0.05, 0.025, 0.036}, 0.5 * 0.025 / n[1]);
  const Boundary boundary(grid, WallFlow::no_slip, WallFlow::free_slip);
  Field alpha("alpha", grid), b("b", grid), p("p", grid);
  FaceVector implicit = test::make_faces(grid), c = test::make_faces(grid);
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto random = [&](const Field& f, double low, double high) {
    test::set_field(f, grid, [&](int, int, int) { return low + (high - low) * uniform(engine); });
  };
  random(alpha, 0.4, 1);
  random(b, -1, 1);
  if (drag) {  // up to the mass of the fluid, as in a dense bed
    for (const Field& m : {implicit.x, implicit.y, implicit.z}) random(m, 0, rho);
  }
  boundary.fill(alpha, FieldKind::scalar);
  const SparseProblem problem{grid,
                              test::to_host(alpha),
                              test::to_host(implicit.x),
                              test::to_host(implicit.y),
                              test::to_host(implicit.z),
                              test::to_host(b),
                              rho};
  const Eigen::VectorXd exact = problem.solve();

  sum_each_cell("test", grid, UpdateMobility{grid, alpha, implicit, 1 / rho, c});
  boundary.fill_periodic(c);
  SolverConfig config;
  config.preconditioner = kind;
  config.max_iterations = 2000;
  PressureSolver solver(grid, boundary.halo(), std::make_shared<const PlaneFft>(grid), config);
  solver.solve(c, b, p, 1e-13);
  const auto got = test::to_host(p);
  double shift = exact(0) - got(0, 0, 0), largest = 0, off = 0;
  test::for_owned_cells(grid, [&](int i, int j, int k) {
    largest = std::max(largest, std::abs(got(i, j, k)));
    off = std::max(off, std::abs(got(i, j, k) + shift - exact(problem.index(i, j, k))));
  });
  return off / largest;
}

TEST(FluidPressureDirect, RandomFractionsAgreeWithASparseFactorisation) {
  const std::array<std::array<int, 3>, 4> sizes{{{8, 6, 10}, {9, 5, 7}, {16, 4, 3}, {5, 12, 8}}};
  double worst = 0;
  unsigned seed = 1;
  for (const auto& n : sizes) {
    for (const bool drag : {false, true}) {
      for (const Preconditioner kind : {Preconditioner::local_fft, Preconditioner::fft}) {
        worst = std::max(worst, disagreement(n, seed++, drag, kind));
      }
    }
  }
  testing::expect_below(
      "pressure with random alpha against a sparse factorisation, over the largest", worst, 1e-9);
}

}  // namespace
}  // namespace barchan
