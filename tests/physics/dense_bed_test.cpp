// The exchange between a dense bed and its pore water is stable: what rests, rests.
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "tests/support/coupled_run.hpp"
#include "tests/support/packing.hpp"

namespace barchan {
namespace {

/// Largest growth per fluid step of small disturbances of grains and pore water, per unit volume:
/// one grain step as long as the fluid step, no contacts, drag of Ergun's viscous term. Squeezed
/// (`tied`), water leaves where grains go, alpha u + (1 - alpha) w = 0, which the pressure
/// enforces; otherwise both slip freely. `smoothing` is what the smoothing leaves of the
/// disturbance.
double growth(double alpha, double dt, double smoothing, bool tied, bool relaxed) {
  const double rho_f = 1000, rho_p = 2500, mu_f = 1e-3, d = 2e-4, c = 1 - alpha;
  const double drag = 150 * c * c * mu_f / (alpha * d * d) * dt;  // impulse per slip
  const double added = kAddedMassCoefficient * c * rho_f, inertia = c * rho_p + added;
  const double share = relaxed ? exchange_relaxation(inertia, c * rho_f, drag / dt, alpha, dt) : 1;
  Eigen::Matrix<double, 5, 5> step;
  for (int column = 0; column < 5; ++column) {
    Eigen::Matrix<double, 5, 1> s = Eigen::Matrix<double, 5, 1>::Unit(column);
    // grains w, water u; what the grains see: pressure impulse, water velocity; impulse owed
    double &w = s(0), &u = s(1), &pressure = s(2), &seen = s(3), &owed = s(4);
    const double paid = share * owed, forcing = pressure + paid;
    const double equilibrium = seen + forcing / drag;
    const double w_new = equilibrium + (w - equilibrium) * std::exp(-drag / inertia);
    const double impulse = inertia * (w_new - w) - forcing - added * (w_new - w);
    const double implicit = drag + added;
    double u_new = -(c / alpha) * smoothing * w_new, push = 0;
    if (!tied) u_new = u - smoothing * impulse / (alpha * rho_f + implicit);
    if (tied) {
      push = (c / alpha) * (smoothing * impulse + (alpha * rho_f + implicit) * (u_new - u));
    }
    owed += smoothing * implicit * (u_new - u) - paid;
    pressure += share * (push - pressure);
    seen += share * (u_new - seen);
    u = u_new;
    w = w_new;
    step.col(column) = s;
  }
  double largest = 0;
  for (const std::complex<double>& value : step.eigenvalues()) {
    if (!tied && std::abs(value - 1.0) < 1e-9) continue;  // the momentum of both together
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

TEST(DenseBed, SmallDisturbancesDieOutAtEveryFractionAndStep) {
  double worst = 0;
  for (const double alpha : {0.35, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}) {
    for (const double dt : {1e-5, 1e-4, 2.5e-4, 5e-4, 1e-3}) {
      for (const double smoothing : {1.0, 0.5, 0.2}) {
        for (const bool tied : {true, false}) {
          worst = std::max(worst, growth(alpha, dt, smoothing, tied, true));
        }
      }
    }
  }
  testing::expect_below("growth per step, relaxed", worst, 1);
  // Without it squeezing grows in the bed: 3.2-fold per step of the paper at alpha = 0.4.
  EXPECT_GT(growth(0.4, 2.5e-4, 1, true, false), 3);
}

/// 2,000 grains, 1.4 mm deep, in a periodic box: settled without a flow solver, then coupled.
Config bed_config() {
  Config c = test::water_box({4, 23, 4}, {0.0032, 0.006, 0.0032});
  c.fluid->bottom = WallFlow::no_slip;
  c.coupling.smoothing_length = 2e-4;
  Material& m = c.grains->material;
  m.youngs_modulus = 3.125e5;
  m.rolling_friction = 0.1;
  c.grains->wall = m;
  c.grains->gravity = {0, -9.81, 0};
  c.time.fluid_step = 5e-4;
  c.time.grain_step = 1e-5;
  return c;
}

/// Median speed of the grains [m/s]: a few that have no contact and drop do not count.
double median_speed(const test::CoupledRun& run) {
  std::vector<double> speed;
  const std::vector<testing::GrainRow> rows = run.rows();
  for (std::size_t id = 1; id < rows.size(); ++id) speed.push_back(norm(rows[id].u));
  std::nth_element(speed.begin(), speed.begin() + 1000, speed.end());
  return speed[1000];
}

/// Its mean over 0.01 s, after 0.02 s of pore water that answers: a bed that shakes does so in
/// bursts.
double coupled_speed(const InitialGrains& grains, bool relaxation) {
  Config c = bed_config();
  c.coupling.relaxation = relaxation;
  test::CoupledRun bed(c, grains);
  bed.advance(40);
  double sum = 0;
  for (int n = 0; n < 20; ++n) {
    bed.advance(1);
    sum += median_speed(bed);
  }
  return sum / 20;
}

TEST(DenseBed, ABedAtRestInStillWaterStaysAtRest) {
  const Config c = bed_config();
  const InitialGrains grains = test::settled(c, testing::lattice_packing(2000, c.size, 0.01), 300);
  // A hundredth of the fall velocity; the points of the grains cross cells.
  testing::expect_below("median speed [m/s]", coupled_speed(grains, true), 2e-4);
  EXPECT_GT(coupled_speed(grains, false), 2e-3) << "without relaxation";
}

}  // namespace
}  // namespace barchan
