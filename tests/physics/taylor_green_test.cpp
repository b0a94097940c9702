// The two-dimensional Taylor-Green vortex, at rest and carried along: errors of u and p.
#include <numbers>

#include "tests/support/flow_errors.hpp"
#include "tests/support/flow_run.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/saved_results.hpp"

namespace barchan {
namespace {

using namespace testing;
using std::numbers::pi;
using test::FlowErrors;

/// u_a = U_a + sin(a - U_a t) cos(b - U_b t) D, u_b = U_b - cos(a - U_a t) sin(b - U_b t) D,
/// p = rho/4 (cos 2(a - U_a t) + cos 2(b - U_b t)) D^2, D = exp(-2 nu t): exact in a plane a-b.
struct Vortex {
  std::size_t a = 0, b = 1;
  double mean_a = 0, mean_b = 0;  // [m/s]
  double nu = 0.05, rho = 1000;

  struct At {
    const Vortex& vortex;
    double t;
    double u(std::size_t axis, double x, double y, double z) const {
      const auto [s, q] = place(x, y, z);
      const double decay = std::exp(-2 * vortex.nu * t);
      if (axis == vortex.a) return vortex.mean_a + std::sin(s) * std::cos(q) * decay;
      if (axis == vortex.b) return vortex.mean_b - std::cos(s) * std::sin(q) * decay;
      return 0;
    }
    double p(double x, double y, double z) const {
      const auto [s, q] = place(x, y, z);
      return 0.25 * vortex.rho * (std::cos(2 * s) + std::cos(2 * q)) * std::exp(-4 * vortex.nu * t);
    }
    std::array<double, 2> place(double x, double y, double z) const {
      const std::array<double, 3> at{x, y, z};
      return {at[vortex.a] - vortex.mean_a * t, at[vortex.b] - vortex.mean_b * t};
    }
  };
  At at(double t) const { return {*this, t}; }
};

/// `cells` per 2 pi along a and a half more along b; free-slip walls in y are planes of symmetry.
/// Rows in y are stretched when the vortex lies in them.
FlowErrors vortex_errors(const Vortex& vortex, int cells) {
  std::array<int, 3> n{3, 3, 3};
  n[vortex.a] = cells;
  n[vortex.b] = 3 * cells / 2;
  const bool in_y = vortex.a == 1 || vortex.b == 1;
  if (in_y) n[1] /= 2;
  Config config = test::smooth_flow_config(n, {2 * pi, pi, 2 * pi},
                                           in_y ? test::first_row(pi, n[1], 2) : 0, vortex.nu);
  config.fluid->density = vortex.rho;
  test::FlowRun run(config);
  test::set_velocity(run.fluid, vortex.at(0));
  run.solver.fill_ghosts(run.fluid);
  const double end = 0.8;
  const int steps = 4 * cells;
  run.advance_over(end, steps);
  // The pressure of a step is that of its middle, to second order.
  const FlowErrors e =
      test::flow_errors(run.fluid, vortex.at(end), vortex.at(end - 0.5 * end / steps));
  test::save_result("taylor_green_2d", {{"a", vortex.a},
                                        {"b", vortex.b},
                                        {"mean_a", vortex.mean_a},
                                        {"mean_b", vortex.mean_b},
                                        {"cells", cells},
                                        {"u", e.u},
                                        {"u_max", e.u_max},
                                        {"p", e.p / vortex.rho},
                                        {"p_max", e.p_max / vortex.rho}});
  return e;
}

void expect_second_order(const Vortex& vortex) {
  const FlowErrors coarse = vortex_errors(vortex, 32), fine = vortex_errors(vortex, 64);
  const std::string what = "vortex in axes " + std::to_string(vortex.a) + std::to_string(vortex.b);
  expect_order(what + ", u", coarse.u, fine.u, 2, 0.1);
  expect_order(what + ", p", coarse.p, fine.p, 2, 0.1);
  expect_order(what + ", largest error of u", coarse.u_max, fine.u_max, 2, 0.15);
  expect_order(what + ", largest error of p", coarse.p_max, fine.p_max, 2, 0.15);
  expect_below(what + ", u, 64 cells", fine.u, 2e-3);
  expect_below(what + ", p over rho U^2, 64 cells", fine.p / vortex.rho, 5e-3);
}

TEST(FluidVortex, DecayIsSecondOrderInVelocityAndPressureInEveryPlane) {
  expect_second_order({.a = 0, .b = 1});
  expect_second_order({.a = 1, .b = 2});
  expect_second_order({.a = 2, .b = 0});
}

TEST(FluidVortex, ConvectionIsSecondOrderInThePeriodicPlane) {
  expect_second_order({.a = 0, .b = 2, .mean_a = 1, .mean_b = 0.6});
  expect_second_order({.a = 2, .b = 0, .mean_a = -0.8, .mean_b = 1.2});
}

}  // namespace
}  // namespace barchan
