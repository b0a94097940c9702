// The direct solver, the smoothing step made of it, and the conjugate gradients; against theory and
// against a sparse factorisation.
#include <Eigen/SparseCholesky>
#include <numbers>

#include "kernels/fluid/conjugate_gradients.hpp"
#include "kernels/fluid/field_algebra.hpp"
#include "src/fluid/local_correction.hpp"
#include "src/fluid/pressure_solver.hpp"
#include "src/parallel/cell_reductions.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/flow_fields.hpp"
#include "tests/support/measured.hpp"

namespace barchan {
namespace {

using std::numbers::pi;
using test::HostField;
using test::HostGrid;

PoissonFft poisson(const Grid& grid, double mass = 0, double diffusion = 1) {
  return {grid, std::make_shared<const PlaneFft>(grid), mass, diffusion};
}

PressureReport solve(const Boundary& boundary, const Grid& grid, Preconditioner kind,
                     const FaceVector& c, Field& b, Field& p, double tolerance) {
  SolverConfig config;
  config.preconditioner = kind;
  config.max_iterations = 2000;
  config.pressure_tolerance = tolerance;
  const Workspace workspace(grid, false);
  const auto solver = make_pressure_solver({.grid = grid,
                                            .halo = boundary.halo(),
                                            .fft = std::make_shared<const PlaneFft>(grid),
                                            .config = config,
                                            .workspace = workspace});
  return solver->solve(c, Region(grid), b, p);
}

double volume_dot(const Grid& grid, const Field& a, const Field& b) {
  return grid.dx * grid.dz * sum_each_cell("test", grid, InnerProduct{grid, a, b});
}

/// Volume-weighted RMS error of -lap phi = f for a smooth phi with zero gradient on the walls.
double poisson_error(int n) {
  const Grid grid = test::stretched_grid({n, n / 2, 2 * n}, {1, 0.7, 1.3}, 0.7 / n);
  const HostGrid h(grid);
  const double kx = 2 * pi, ky = pi / 0.7, kz = 4 * pi / 1.3;
  const auto exact = [&](int i, int j, int k) {
    return std::cos(kx * h.x(i)) * std::cos(ky * h.y(j)) * std::sin(kz * h.z(k));
  };
  Field f("f", grid), phi("phi", grid);
  const double factor = kx * kx + ky * ky + kz * kz;
  test::set_field(f, grid, [&](int i, int j, int k) { return factor * exact(i, j, k); });
  poisson(grid).solve(f, phi);
  const auto got = test::to_host(phi);
  double sum = 0, volume = 0;
  test::for_owned_cells(grid, [&](int i, int j, int k) {
    sum += h.volume(j) * std::pow(got(i, j, k) - exact(i, j, k), 2);
    volume += h.volume(j);
  });
  return std::sqrt(sum / volume);
}

TEST(FluidPoisson, SecondOrder) {
  const double coarse = poisson_error(16), fine = poisson_error(32);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
}

FaceVector uniform_mobility(const Grid& grid) {
  const FaceVector c = make_faces("c", grid);
  for (const Field& face : {c.x, c.z}) Kokkos::deep_copy(face.storage, Real(1));
  test::set_field(c.y, grid, [](int, int j, int) { return j > 0 ? 1.0 : 0.0; });
  return c;
}

TEST(FluidPoisson, InvertsTheOperatorOnAwkwardSizes) {
  for (const std::array<int, 3> n :
       {std::array{8, 5, 12}, std::array{9, 4, 7}, std::array{6, 3, 1}, std::array{1, 6, 5}}) {
    const Grid grid = test::stretched_grid(n, {0.4, 0.3, 0.9}, 0.2 / n[1]);
    const Halo halo(grid);
    Field f("f", grid), phi("phi", grid);
    test::set_random(f, grid, 3);
    const double mean =
        sum_each_cell("test", grid, HeightSum{grid, f}) / (grid.ly * grid.nx * grid.nz);
    poisson(grid).solve(f, phi);
    halo.fill(phi);
    const FaceVector c = uniform_mobility(grid);
    // r = (f - mean) - A phi must vanish; its squares are what Residual adds up.
    for_each_cell("test", grid, Subtract{f, mean});
    EXPECT_LT(sum_each_cell("test", grid, Residual{grid, c, phi, f, f}), 1e-22);
    EXPECT_NEAR(sum_each_cell("test", grid, HeightSum{grid, phi}), 0, 1e-12);
  }
}

TEST(FluidSmoother, KeepsTheIntegralIsSelfAdjointAndMakesNoNewExtrema) {
  const Grid grid = test::stretched_grid({8, 5, 12}, {0.4, 0.3, 0.9}, 0.02);
  const PoissonFft smoother = poisson(grid, 1, 0.13 * 0.13);
  Field a("a", grid), b("b", grid), smooth_a("sa", grid), smooth_b("sb", grid);
  test::set_random(a, grid, 4);
  test::set_random(b, grid, 5);
  smoother.solve(a, smooth_a);
  smoother.solve(b, smooth_b);
  const double before = sum_each_cell("test", grid, HeightSum{grid, a});
  EXPECT_NEAR(sum_each_cell("test", grid, HeightSum{grid, smooth_a}), before, 1e-14);
  const double left = volume_dot(grid, smooth_a, b), right = volume_dot(grid, a, smooth_b);
  EXPECT_NEAR(left, right, 1e-14 * volume_dot(grid, a, a));

  test::set_field(a, grid, [](int i, int j, int k) { return i == 3 && j == 0 && k == 11; });
  smoother.solve(a, a);  // in place
  const auto spread = test::to_host(a);
  test::for_owned_cells(grid, [&](int i, int j, int k) {
    EXPECT_GE(spread(i, j, k), -1e-16);
    EXPECT_LE(spread(i, j, k), spread(3, 0, 11));
  });
}

/// Cosines with zero gradient at both ends are modes of the step of diffusion.
TEST(FluidSmoother, MirrorsDampCosinesByTheory) {
  const std::array<int, 3> n{9, 4, 7};
  const Grid grid = test::stretched_grid(n, {0.4, 0.3, 0.9}, 0.02);
  const double length = 0.13;
  for (const EvenExtension even :
       {EvenExtension{true, false}, EvenExtension{false, true}, EvenExtension{true, true}}) {
    const PoissonFft smoother(grid, std::make_shared<const PlaneFft>(grid, even), 1,
                              length * length);
    // Half waves between even, whole waves where the field is periodic.
    const double a = (even.x ? 3 : 4) * pi / n[0], b = (even.z ? 5 : 2) * pi / n[2];
    const auto mode = [&](int i, int, int k) {
      return std::cos(a * (i + 0.5)) * std::cos(b * (k + 0.5));
    };
    const double lambda =
        std::pow(2 * std::sin(a / 2) / grid.dx, 2) + std::pow(2 * std::sin(b / 2) / grid.dz, 2);
    Field f("f", grid);
    test::set_field(f, grid, mode);
    smoother.solve(f, f);
    const auto got = test::to_host(f);
    test::for_owned_cells(grid, [&](int i, int j, int k) {
      EXPECT_NEAR(got(i, j, k), mode(i, j, k) / (1 + length * length * lambda), 1e-15);
    });
  }
}

/// Fluid fraction and the c made of it.
struct Mixture {
  Grid grid;
  Boundary boundary{grid, WallFlow::no_slip, WallFlow::free_slip};
  Field alpha{"alpha", grid};
  FaceVector c = make_faces("c", grid);

  void update_mobility() {
    boundary.fill(alpha, FieldKind::scalar);
    sum_vector("test", DeviceReductions("test", 3), 0, owned_cells(grid),
               UpdateMobility{grid, alpha, c});
    boundary.fill_periodic(c);
  }
};

/// A heap with a sharp, noisy surface: alpha 0.35..0.5 inside.
Mixture heap(const Grid& grid) {
  Mixture m{grid};
  const HostGrid h(grid);
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(0.35, 0.5);
  test::set_field(m.alpha, grid, [&](int i, int j, int k) {
    const double r = std::hypot(h.x(i) - 0.3 * grid.lx, h.z(k) - 0.5 * grid.lz);
    const double noise = uniform(engine);
    return h.y(j) < 0.16 * grid.ly * (1 - r / 0.013) ? noise : 1.0;
  });
  m.update_mobility();
  return m;
}

/// Random fractions everywhere.
Mixture random_mixture(const Grid& grid, unsigned seed) {
  Mixture m{grid};
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  test::set_field(m.alpha, grid, [&](int, int, int) { return 0.4 + 0.6 * uniform(engine); });
  m.update_mobility();
  return m;
}

TEST(FluidPressure, IterationsForAHeap) {
  const Mixture m = heap(test::stretched_grid({63, 30, 32}, {0.1, 0.025, 0.05}, 2.625e-4));
  const auto iterations = [&](Preconditioner kind) {
    Field b("b", m.grid), p("p", m.grid);
    test::set_random(b, m.grid, 9);
    const PressureReport report = solve(m.boundary, m.grid, kind, m.c, b, p, 1e-6);
    EXPECT_LE(report.residual, 1e-6);
    return report.iterations;
  };
  EXPECT_LE(iterations(Preconditioner::of<PlainFft>()), 20);
  EXPECT_LE(iterations(Preconditioner::of<RelaxedFft>()), 6);
}

/// A hard solve, then one with hardly any grains, so that more is launched ahead than is needed.
TEST(FluidPressure, IterationsLaunchedAheadChangeNoBit) {
  const Mixture m = heap(test::stretched_grid({24, 12, 16}, {0.05, 0.025, 0.036}, 1e-3));
  const Region everywhere(m.grid);
  const Workspace workspace(m.grid, false);
  FaceVector dilute = uniform_mobility(m.grid);
  for_each_cell("test", m.grid, Axpby{0.02, m.c.x, 0.98, dilute.x});
  for_each_cell("test", m.grid, Axpby{0.02, m.c.y, 0.98, dilute.y});
  for_each_cell("test", m.grid, Axpby{0.02, m.c.z, 0.98, dilute.z});
  Halo(m.grid).fill(dilute.x, dilute.y, dilute.z);
  const auto solve_twice = [&](int ahead) {
    const SolverConfig config{.pressure_tolerance = 1e-9};
    const auto solver = make_pressure_solver({.grid = m.grid,
                                              .halo = m.boundary.halo(),
                                              .fft = std::make_shared<const PlaneFft>(m.grid),
                                              .config = config,
                                              .workspace = workspace,
                                              .ahead = ahead});
    Field b("b", m.grid), p("p", m.grid);
    std::vector<int> iterations;
    for (int n = 0; n < 2; ++n) {
      test::set_random(b, m.grid, 21);
      iterations.push_back(solver->solve(n == 0 ? m.c : dilute, everywhere, b, p).iterations);
    }
    return std::pair(iterations, test::to_host(p));
  };
  const auto [count, waiting] = solve_twice(0);
  EXPECT_GT(count[0], count[1]);
  for (const int ahead : {1, 4, 50}) {
    const auto [count_ahead, p] = solve_twice(ahead);
    EXPECT_EQ(count_ahead, count);
    test::for_owned_cells(
        m.grid, [&](int i, int j, int k) { ASSERT_EQ(p(i, j, k), waiting(i, j, k)) << ahead; });
  }
}

/// The inner product <a, M^-1 b> must not depend on the order, or conjugate gradients mislead.
TEST(FluidPressure, LocalPreconditionerIsSelfAdjointOnOddSizes) {
  const Grid grid = test::stretched_grid({13, 7, 9}, {0.05, 0.025, 0.036}, 1e-3);
  const Mixture m = heap(grid);
  LocalCorrection local(grid, m.boundary.halo());
  const Region everywhere(grid);
  Field room("room", grid), copy("copy", grid);
  local.update(m.c, everywhere, room);
  Field a("a", grid), b("b", grid), ma("ma", grid), mb("mb", grid);
  test::set_random(a, grid, 14);
  test::set_random(b, grid, 15);
  local.apply(poisson(grid), a, ma, copy);
  local.apply(poisson(grid), b, mb, copy);
  const double left = volume_dot(grid, a, mb), right = volume_dot(grid, ma, b);
  EXPECT_NEAR(left, right, 1e-13 * volume_dot(grid, a, ma));
  EXPECT_GT(volume_dot(grid, b, mb), 0);
}

TEST(FluidPressure, UniformMobilityTakesOneIteration) {
  const Grid grid = test::stretched_grid({8, 5, 12}, {0.4, 0.3, 0.9}, 0.02);
  Field b("b", grid), p("p", grid);
  test::set_random(b, grid, 10);
  const Boundary boundary(grid, WallFlow::no_slip, WallFlow::free_slip);
  const PressureReport report =
      solve(boundary, grid, Preconditioner::of<RelaxedFft>(), uniform_mobility(grid), b, p, 1e-10);
  EXPECT_EQ(report.iterations, 1);
  EXPECT_LE(report.residual, 1e-10);
}

/// -div(c grad p) = b with c = alpha on faces, put together from alpha here.
struct SparseProblem {
  Grid grid;
  HostField alpha, b;

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
    const auto at = [&](int i, int j, int k) {
      return alpha((i + grid.nx) % grid.nx, j, (k + grid.nz) % grid.nz);
    };
    double mean = 0;
    test::for_owned_cells(grid, [&](int i, int j, int k) {
      const double here = alpha(i, j, k);
      const int row = index(i, j, k);
      couple(row, index(i - 1, j, k),
             0.5 * (here + at(i - 1, j, k)) * h.dy(j) / (grid.dx * grid.dx));
      couple(row, index(i, j, k - 1),
             0.5 * (here + at(i, j, k - 1)) * h.dy(j) / (grid.dz * grid.dz));
      if (j > 0) {  // the mean over the face's volume
        const double mixed =
            (h.dy(j) * here + h.dy(j - 1) * at(i, j - 1, k)) / (h.dy(j) + h.dy(j - 1));
        couple(row, index(i, j - 1, k), mixed / (h.y(j) - h.y(j - 1)));
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
double disagreement(const Mixture& m, unsigned seed, Preconditioner kind) {
  const Grid& grid = m.grid;
  Field b("b", grid), p("p", grid);
  test::set_random(b, grid, seed);
  const SparseProblem problem{grid, test::to_host(m.alpha), test::to_host(b)};
  const Eigen::VectorXd exact = problem.solve();
  solve(m.boundary, grid, kind, m.c, b, p, 1e-13);
  const auto got = test::to_host(p);
  double shift = exact(0) - got(0, 0, 0), largest = 0, off = 0;
  test::for_owned_cells(grid, [&](int i, int j, int k) {
    largest = std::max(largest, std::abs(got(i, j, k)));
    off = std::max(off, std::abs(got(i, j, k) + shift - exact(problem.index(i, j, k))));
  });
  return off / largest;
}

TEST(FluidPressureDirect, RandomFractionsAgreeWithASparseFactorisation) {
  double worst = 0;
  unsigned seed = 1;
  for (const std::array<int, 3> n :
       {std::array{8, 6, 10}, std::array{9, 5, 7}, std::array{16, 4, 3}, std::array{5, 12, 8}}) {
    const Grid grid = test::stretched_grid(n, {0.05, 0.025, 0.036}, 0.5 * 0.025 / n[1]);
    for (const Preconditioner kind :
         {Preconditioner::of<RelaxedFft>(), Preconditioner::of<PlainFft>()}) {
      seed += 2;
      worst = std::max(worst, disagreement(random_mixture(grid, seed), seed + 1, kind));
    }
  }
  test::expect_below("pressure with random alpha against a sparse factorisation, over the largest",
                     worst, 1e-9);
}

TEST(FluidPressure, AgreesWithADirectSparseSolveOfAHeap) {
  const Mixture m = heap(test::stretched_grid({12, 7, 9}, {0.05, 0.025, 0.036}, 1e-3));
  for (const Preconditioner kind :
       {Preconditioner::of<RelaxedFft>(), Preconditioner::of<PlainFft>()}) {
    test::expect_below("pressure in a heap against a sparse factorisation, over the largest",
                       disagreement(m, 8, kind), 1e-9);
  }
}

}  // namespace
}  // namespace barchan
