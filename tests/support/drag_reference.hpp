// Drag and settling of a sphere from the literature, written down independently of
// kernels/coupling/drag.hpp.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

namespace barchan::test {

struct Water {
  double rho = 1000, mu = 1e-3;
};

inline double volume_of(double d) { return std::numbers::pi / 6 * d * d * d; }

/// Force C_d (pi/8) rho d^2 v^2 of Schiller & Naumann (1935), C_d = 24/Re (1 + 0.15 Re^0.687) [N].
inline double schiller_naumann_force(double v, double d, const Water& w = {}) {
  if (v == 0) return 0;
  const double re = w.rho * std::abs(v) * d / w.mu;
  const double c_d = 24 / re * (1 + 0.15 * std::pow(re, 0.687));
  return c_d * std::numbers::pi / 8 * w.rho * d * d * v * std::abs(v);
}

/// Wen & Yu (1966) on one grain at interstitial slip v in a suspension, force of model A:
/// (pi/8) C_d rho d^2 v^2 alpha^(1 - 2.65), C_d of Schiller & Naumann at Re = alpha d v/nu [N].
inline double wen_yu_force(double v, double alpha, double d, const Water& w = {}) {
  const double re = alpha * w.rho * v * d / w.mu;
  const double c_d = 24 / re * (1 + 0.15 * std::pow(re, 0.687));
  return c_d * std::numbers::pi / 8 * w.rho * d * d * v * v * std::pow(alpha, -1.65);
}

/// Di Felice (1994) with C_d = (0.63 + 4.8/sqrt(Re))^2, Re = alpha d v/nu [N].
inline double di_felice_force(double v, double alpha, double d, const Water& w = {}) {
  const double re = alpha * w.rho * v * d / w.mu;
  const double c_d = std::pow(0.63 + 4.8 / std::sqrt(re), 2);
  const double chi = 3.7 - 0.65 * std::exp(-0.5 * std::pow(1.5 - std::log10(re), 2));
  return c_d * std::numbers::pi / 8 * w.rho * d * d * std::pow(alpha * v, 2) *
         std::pow(alpha, -chi);
}

/// Pressure drop per length of a bed of spheres at superficial velocity U (Ergun 1952) [Pa/m].
inline double ergun_gradient(double alpha, double superficial, double d, const Water& w = {}) {
  const double s = 1 - alpha, a3 = alpha * alpha * alpha;
  return 150 * s * s / a3 * w.mu * superficial / (d * d) +
         1.75 * s / a3 * w.rho * superficial * superficial / d;
}

/// Ergun's drop as the drag on one grain at interstitial slip v, force of model A: alpha dp/L of
/// the number of grains per volume [N].
inline double ergun_force(double v, double alpha, double d, const Water& w = {}) {
  return alpha * ergun_gradient(alpha, alpha * v, d, w) * volume_of(d) / (1 - alpha);
}

/// Root of a function that grows from below to above zero in [low, high], by bisection.
inline double root(const std::function<double(double)>& f, double low, double high) {
  for (int n = 0; n < 200; ++n) {
    const double middle = (low + high) / 2;
    (f(middle) < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// A sphere released at rest in still fluid: (rho_p + C_a rho_f) V dv/dt = (rho_p - rho_f) V g -
/// F_d(v), C_a = 1/2, by classical Runge-Kutta steps.
class SettlingSphere {
 public:
  SettlingSphere(double d, double rho_p, const Water& water, double g = 9.81)
      : d_(d), rho_p_(rho_p), water_(water), g_(g) {}

  double submerged_weight() const { return (rho_p_ - water_.rho) * volume_of(d_) * g_; }
  double terminal_velocity() const {
    return root(
        [&](double v) { return schiller_naumann_force(v, d_, water_) - submerged_weight(); }, 0,
        stokes_velocity());
  }
  double stokes_velocity() const { return (rho_p_ - water_.rho) * g_ * d_ * d_ / (18 * water_.mu); }
  /// (rho_p + rho_f/2) d^2/(18 mu), the slowest response there can be [s].
  double response_time() const { return (rho_p_ + water_.rho / 2) * d_ * d_ / (18 * water_.mu); }

  double velocity() const { return v_; }
  void advance(double dt, int steps = 20) {
    const double h = dt / steps;
    for (int s = 0; s < steps; ++s) {
      const double a = rate(v_), b = rate(v_ + h / 2 * a), c = rate(v_ + h / 2 * b),
                   e = rate(v_ + h * c);
      v_ += h / 6 * (a + 2 * b + 2 * c + e);
    }
  }

 private:
  double rate(double v) const {
    return (submerged_weight() - schiller_naumann_force(v, d_, water_)) /
           ((rho_p_ + water_.rho / 2) * volume_of(d_));
  }
  double d_, rho_p_;
  Water water_;
  double g_, v_ = 0;
};

}  // namespace barchan::test
