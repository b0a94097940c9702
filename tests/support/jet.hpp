// Values that carry their derivatives along (forward differentiation), for manufactured solutions.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace barchan::test {

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

}  // namespace barchan::test
