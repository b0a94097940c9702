// The exchange between a dense bed and its pore fluid is stable: a bed at rest stays at rest.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>

#include "kernels/coupling/gather.hpp"
#include "kernels/grains/half_kick.hpp"
#include "tests/support/coupled_run.hpp"
#include "tests/support/packing.hpp"

namespace barchan {
namespace {

/// Dense bed and its pore fluid, per unit volume.
struct Mixture {
  double alpha, dt;
  double smoothing = 1;  // what smoothing and interpolation leave of a disturbance
  double period = 0;     // of the grains on a spring to the floor, as in a sheared bed; 0: none
  double share = 1;      // fluid that the grains carry over the fluid that there is
  bool squeezed = true;  // fluid leaves where grains go, alpha u + (1 - alpha) w = 0, which the
                         // pressure enforces; otherwise both slip freely
};

/// Largest growth per fluid step of small disturbances, with drag of Ergun's viscous term and the
/// grain steps of the program.
double growth(const Mixture& m) {
  const double rho_f = 1000, rho_p = 2500, mu_f = 1e-3, d = 2e-4, c = 1 - m.alpha, r = c / m.alpha;
  const double water = m.alpha * rho_f, per_share = 1 / (m.share * water);
  const double omega = m.period > 0 ? 2 * std::numbers::pi / m.period : 0;
  const double stiffness = omega * omega * c * rho_p;
  const int n = std::max(2, static_cast<int>(m.dt / 4e-5));
  Eigen::Matrix<double, 6, 6> step;
  for (int column = 0; column < 6; ++column) {
    Eigen::Matrix<double, 6, 1> s = Eigen::Matrix<double, 6, 1>::Unit(column);
    // Grains and fluid: velocities; change of the latter in the last step, impulse that it lost and
    // that of the pressure on the grains; displacement of the grains.
    double &w = s(0), &u = s(1), &change = s(2), &impulse = s(3), &push = s(4), &x = s(5);
    const MotionCoefficients coefficients{.mass = c * rho_p,
                                          .inertia_moment = 1,
                                          .inv_fluid_mass = per_share,
                                          .beta = 150 * c * c * mu_f / (m.alpha * d * d),
                                          .added_mass = kAddedMassCoefficient * c * rho_f};
    const double added_mass = coefficients.added_mass;
    const double inertial =
        change * inertial_fraction(per_share, added_mass, m.dt * coefficients.beta);
    const double of_added_mass = added_mass * (change - inertial);
    const double steady = (push + of_added_mass) / m.dt;
    const HalfKick kick(m.dt / n / 2, coefficients);
    GrainForces f;
    f.u_f = {u, 0, 0};
    f.acceleration = {(inertial + per_share * impulse) / m.dt, 0, 0};
    Vec3 velocity{w, 0, 0}, spin;
    impulse = 0;
    for (int k = 0; k < n; ++k) {
      f.force = {steady - stiffness * x, 0, 0};
      impulse += kick(f, velocity, spin).x;
      x += m.dt / n * velocity.x;
      f.force = {steady - stiffness * x, 0, 0};
      impulse += kick(f, velocity, spin).x;
    }
    w = velocity.x;
    const double given = m.smoothing * (impulse + of_added_mass);
    change = (m.squeezed ? -r * m.smoothing * w : u - given / water) - u;
    push = m.squeezed ? r * (given + water * change) : 0;
    u += change;
    step.col(column) = s;
  }
  double largest = 0;
  for (const std::complex<double>& value : step.eigenvalues()) {
    // Free grains: the momentum of both together, and their place.
    if (m.period == 0 && std::abs(value - 1.0) < 1e-7) continue;
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

TEST(DenseBed, SmallDisturbancesDieOutAtEveryFractionAndStep) {
  double worst = 0;
  for (const double alpha : {0.35, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9})
    for (const double dt : {1e-5, 1e-4, 2.5e-4, 5e-4, 1e-3})
      for (const double smoothing : {1.0, 0.5, 0.2})
        for (const double period : {0.0, 4e-3, 1e-2, 2e-2, 5e-2})
          for (const double share : {1.0, 0.5, 0.2})
            for (const bool squeezed : {true, false}) {
              if (period > 0 && period < 5 * dt) continue;  // no step resolves it
              worst = std::max(worst, growth({alpha, dt, smoothing, period, share, squeezed}));
            }
  test::expect_below("growth per step", worst, 1);
  // Grains that take more fluid along than there is drive it on.
  EXPECT_GT(growth({.alpha = 0.35, .dt = 1e-3, .share = 2, .squeezed = false}), 1.2);
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
  c.time.grain_step = 7.5e-6;  // stable, as in configs/paper/barchan-100k-overnight.toml
  return c;
}

/// Median speed of the grains [m/s]: a few that have no contact and drop do not count.
double median_speed(const test::CoupledRun& run) {
  std::vector<double> speed;
  const std::vector<test::GrainRow> rows = run.rows();
  for (std::size_t id = 1; id < rows.size(); ++id) speed.push_back(norm(rows[id].u));
  std::nth_element(speed.begin(), speed.begin() + 1000, speed.end());
  return speed[1000];
}

InitialGrains settled_bed(unsigned packing = 1) {
  const Config c = bed_config();
  return test::settled(c, test::lattice_packing(2000, c.size, 0.01, packing), 300);
}

TEST(DenseBed, ABedAtRestInStillWaterStaysAtRest) {
  std::vector<double> speeds;  // packings differ: 4e-5 to 2.5e-4, when one of them gives way
  for (unsigned packing = 1; packing <= 5; ++packing) {
    test::CoupledRun bed(bed_config(), settled_bed(packing));
    bed.advance(40);
    double sum = 0;  // over 0.01 s: a bed that shakes does so in bursts
    for (int n = 0; n < 20; ++n) {
      bed.advance(1);
      sum += median_speed(bed);
    }
    speeds.push_back(sum / 20);
  }
  std::sort(speeds.begin(), speeds.end());
  // A hundredth of the fall velocity; the points of the grains cross cells.
  test::expect_below("median speed, median of five packings [m/s]", speeds[2], 2e-4);
}

/// A bed elastic in shear under a flow. Pushed along the stream it swings; the exchange must not
/// feed that.
TEST(DenseBed, ASwingingBedComesToRest) {
  Config c = bed_config();
  c.fluid->pressure_gradient = 8;  // 0.04 Pa on the bed, a quarter of what moves it
  InitialGrains grains = settled_bed();
  for (std::size_t g = 0; g < grains.size(); ++g) grains.u[g].x += 2e-3 * (grains.x[g].y / 1.4e-3);
  test::CoupledRun bed(c, grains);
  const auto mean_speed = [&](int steps) {  // along the stream, root of the mean square [m/s]
    double sum = 0;
    for (int n = 0; n < steps; ++n) {
      bed.advance(1);
      double mean = 0;
      const std::vector<test::GrainRow> rows = bed.rows();
      for (std::size_t id = 1; id < rows.size(); ++id) mean += rows[id].u.x / 2000;
      sum += mean * mean;
    }
    return std::sqrt(sum / steps);
  };
  const double pushed = mean_speed(2);
  bed.advance(100);
  const double left = mean_speed(100);
  std::printf("[ measured ] mean velocity of the bed: pushed %.2e, after 0.05 s %.2e m/s\n", pushed,
              left);
  EXPECT_GT(pushed, 5e-4);
  test::expect_below("speed of the bed after 0.05 s over that at first", left / pushed, 0.02);
}

// A bed of one to two layers rises and sinks as one on its floor, and so do the points of its
// equal grains. The rows put a face at points of the grains that lie on the floor: at 1.3138,
// 1.4543, 1 and 0.6862 radii, less what they sink in.
TEST(DenseBed, ABedOnTheFloorDoesNotSwingWithTheFluidStep) {
  const double r = 1e-4;
  double worst = 0;
  for (const double row : {1.3128, 1.4533, 0.999, 0.6852}) {
    Config c = bed_config();
    const int rows = static_cast<int>(6e-3 / (row * r)), n = 330;
    c.size[1] = rows * row * r;
    c.fluid->cells[1] = rows;
    c.time.fluid_step = 2.5e-4;
    InitialGrains grains = test::lattice_packing(n, c.size, 0.01);
    grains.diameter.assign(n, 2 * r);
    test::CoupledRun bed(c, test::settled(c, grains, 300));
    bed.advance(40);
    double swing = 0, before = 0;  // mean of the change of the vertical velocity in a step [m/s]
    for (int step = 0; step <= 40; ++step) {
      bed.advance(1);
      double mean = 0;
      const std::vector<test::GrainRow> all = bed.rows();
      for (std::size_t id = 1; id < all.size(); ++id) mean += all[id].u.y / n;
      if (step > 0) swing += std::abs(mean - before) / 40;
      before = mean;
    }
    std::printf("[ measured ] rows of %.4f r: swing %.2e m/s\n", row, swing);
    worst = std::max(worst, swing);
  }
  test::expect_below("largest swing of the vertical velocity [m/s]", worst, 1e-5);
}

}  // namespace
}  // namespace barchan
