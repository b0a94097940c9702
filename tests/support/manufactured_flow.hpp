// A manufactured solution of the volume-averaged equations between walls.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "src/case/config.hpp"

namespace barchan::test {

// --- Values that carry their derivatives along (forward differentiation).

/// A function of (x, y, z, t) at a point: its value, first derivatives along x, y, z, t and second
/// derivatives in space in the order xx, yy, zz, xy, xz, yz.
struct Jet {
  double v = 0;
  std::array<double, 4> d{};
  std::array<double, 6> dd{};

  Jet() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): formulas mix both
  Jet(double constant) : v(constant) {}
  /// The coordinate itself: axis 0, 1, 2, 3 is x, y, z, t.
  static Jet variable(double value, std::size_t axis) {
    Jet j(value);
    j.d[axis] = 1;
    return j;
  }
  /// d2/(da db) of two space axes.
  double second(std::size_t a, std::size_t b) const { return a == b ? dd[a] : dd[a + b + 2]; }
};

inline constexpr std::array<std::array<std::size_t, 2>, 6> kSecond{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

inline Jet operator+(Jet a, const Jet& b) {
  a.v += b.v;
  for (std::size_t n = 0; n < 4; ++n) a.d[n] += b.d[n];
  for (std::size_t n = 0; n < 6; ++n) a.dd[n] += b.dd[n];
  return a;
}
inline Jet operator*(const Jet& a, const Jet& b) {
  Jet r(a.v * b.v);
  for (std::size_t n = 0; n < 4; ++n) r.d[n] = a.d[n] * b.v + a.v * b.d[n];
  for (std::size_t n = 0; n < 6; ++n) {
    const auto [p, q] = kSecond[n];
    r.dd[n] = a.dd[n] * b.v + a.d[p] * b.d[q] + a.d[q] * b.d[p] + a.v * b.dd[n];
  }
  return r;
}
inline Jet operator-(const Jet& a, const Jet& b) { return a + Jet(-1) * b; }

/// f(a) from f, f', f'' at a.
inline Jet chain(const Jet& a, double f, double f1, double f2) {
  Jet r(f);
  for (std::size_t n = 0; n < 4; ++n) r.d[n] = f1 * a.d[n];
  for (std::size_t n = 0; n < 6; ++n) {
    r.dd[n] = f1 * a.dd[n] + f2 * a.d[kSecond[n][0]] * a.d[kSecond[n][1]];
  }
  return r;
}
inline Jet sin(const Jet& a) {
  const double s = std::sin(a.v), c = std::cos(a.v);
  return chain(a, s, c, -s);
}
inline Jet cos(const Jet& a) {
  const double s = std::sin(a.v), c = std::cos(a.v);
  return chain(a, c, -s, -c);
}
inline Jet operator/(const Jet& a, const Jet& b) {
  const double r = 1 / b.v;
  return a * chain(b, r, -r * r, 2 * r * r * r);
}

// --- The flow.

/// Fluid fraction alpha in (0.4, 1), interstitial velocity u and pressure p in a box that is
/// periodic in x and z, with alpha u = curl A + G, div G = -d(alpha)/dt: mass is conserved
/// identically. The residual of the momentum equation (docs/theory-fluid.md, nu_t = 0, f = 0) is
/// the body force that makes them a solution. u vanishes on walls without slip and has no slope on
/// those with free slip; alpha and p are free to have slopes.
struct ManufacturedFlow {
  std::array<double, 3> size{1.5, 1, 1.2};  // [m]
  WallFlow bottom = WallFlow::no_slip, top = WallFlow::free_slip;
  double rho = 1000, nu = 0.01;
  double wave_speed = 0;  // of alpha along x [m/s]; 0 keeps the fraction fixed
  bool steady = true;     // velocity and pressure do not depend on time

  template <class T>
  struct Values {
    T alpha;
    std::array<T, 3> momentum;  // alpha u [m/s]
    T p;                        // [Pa]
  };

  template <class T>
  Values<T> values(const T& x, const T& y, const T& z, const T& t) const {
    using std::cos, std::sin;
    const double kx = 2 * std::numbers::pi / size[0], kz = 2 * std::numbers::pi / size[2];
    const double ky = std::numbers::pi / size[1];
    const T time = steady ? T(0) : t;
    const T s = sin(ky * y), wave = sin(kx * (x - wave_speed * t)) * s * s;
    const auto [h, slope, profile] = wall_functions(y);
    const T a = kx * x - time, b = kz * z, c = kz * z + time;
    Values<T> r;
    // The part that stands may have any slope at a wall without slip.
    const T tilt = both(WallFlow::no_slip) ? sin(ky * y + T(0.4)) : cos(ky * y);
    r.alpha = T(0.7) + T(0.14) * wave + T(0.12) * cos(b) * tilt;
    r.momentum[0] = T(0.6) * profile + slope * (T(0.5) + T(0.4) * sin(a) * cos(b)) +
                    T(0.14 * wave_speed) * wave;  // the last is G
    r.momentum[1] = h * (T(0.4 * kz) * cos(kx * x) * cos(c) - T(0.4 * kx) * cos(a) * cos(b));
    r.momentum[2] = T(-0.4) * slope * cos(kx * x) * sin(c);
    r.p = T(0.3 * rho) * cos(kx * x + T(1) - time) * sin(b) * cos(T(2) * y + T(0.3)) +
          T(0.2 * rho) * sin(T(3) * y);
    return r;
  }

  double alpha(double x, double y, double z, double t) const { return values(x, y, z, t).alpha; }
  double u(std::size_t axis, double x, double y, double z, double t) const {
    const auto at = values(x, y, z, t);
    return at.momentum[axis] / at.alpha;
  }
  double p(double x, double y, double z, double t) const { return values(x, y, z, t).p; }

  Values<Jet> jets(double x, double y, double z, double t) const {
    return values(Jet::variable(x, 0), Jet::variable(y, 1), Jet::variable(z, 2),
                  Jet::variable(t, 3));
  }
  /// d(alpha)/dt + div(alpha u) [1/s]: zero.
  double mass_residual(double x, double y, double z, double t) const {
    const auto at = jets(x, y, z, t);
    return at.alpha.d[3] + at.momentum[0].d[0] + at.momentum[1].d[1] + at.momentum[2].d[2];
  }
  /// Body force per mass of pure fluid along `axis`:
  ///   d(alpha u)/dt + div(alpha u u) + (alpha/rho) grad p - alpha nu (lap u + grad div u).
  double force(std::size_t axis, double x, double y, double z, double t) const {
    const auto at = jets(x, y, z, t);
    const Jet one_over = Jet(1) / at.alpha;
    const Jet own = at.momentum[axis] * one_over;
    double f = at.momentum[axis].d[3] + at.alpha.v / rho * at.p.d[axis];
    for (std::size_t b = 0; b < 3; ++b) {
      const Jet u_b = b == axis ? own : at.momentum[b] * one_over;
      f += at.momentum[b].d[b] * own.v + at.momentum[b].v * own.d[b];
      f -= at.alpha.v * nu * (own.second(b, b) + u_b.second(axis, b));
    }
    return f;
  }

 private:
  bool both(WallFlow wall) const { return bottom == wall && top == wall; }

  /// h of the vector potential, h' and a profile of mean flow: h vanishes on both walls, h' and the
  /// profile vanish on a wall without slip and have no slope on one with free slip.
  template <class T>
  std::array<T, 3> wall_functions(const T& y) const {
    using std::cos, std::sin;
    const double pi = std::numbers::pi, l = size[1];
    const T angle = T(pi / l) * y;
    if (both(WallFlow::no_slip)) {
      return {T(l / pi) * sin(angle) * sin(angle), sin(T(2) * angle), sin(angle) * sin(angle)};
    }
    if (both(WallFlow::free_slip)) return {T(l / pi) * sin(angle), cos(angle), T(1)};
    // Bottom without, top with slip: s^2 (1 - s)(3/2 - s) has no curvature at s = 1.
    const T s = T(1 / l) * y, half = sin(T(0.5) * angle);
    return {T(2 * l) * s * s * (T(1) - s) * (T(1.5) - s),
            T(2) * s * (T(4) * s * s - T(7.5) * s + T(3)), half * half};
  }
};

}  // namespace barchan::test
