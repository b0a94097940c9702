// Free rotation of a rigid body against what mechanics says of tops without torque.
#include "kernels/grains/rigid_rotation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace barchan {
namespace {

constexpr Vec3 kInertia{1, 1.7, 2.3};

struct Top {
  Vec3 inertia, j;
  Quaternion q = {};

  Vec3 body_spin() const { return rotate_back(q, angular_velocity(q, inertia, j)); }
  Real energy() const { return dot(j, angular_velocity(q, inertia, j)) / 2; }
};
/// Top at its start: its frame is that of space, so J is I omega.
Top top(const Vec3& inertia, const Vec3& omega) {
  return {inertia, angular_momentum({}, inertia, omega)};
}
void turn(Top& top, Real h, int steps) {
  for (int n = 0; n < steps; ++n) top.q = rotate_freely(top.q, top.inertia, top.j, h);
}
/// Angle between two orientations [rad].
Real angle(const Quaternion& a, const Quaternion& b) {
  return 2 * std::asin(std::min(norm((conjugate(a) * b).vec()), Real(1)));
}
Real order(Real coarse, Real fine) { return std::log2(coarse / fine); }

TEST(RigidRotation, QuaternionsTurnVectorsAsMatricesDo) {
  const Quaternion quarter = rotation_about({0, 0, 1}, std::numbers::pi_v<Real> / 2);
  EXPECT_LT(norm(rotate(quarter, {1, 0, 0}) - Vec3{0, 1, 0}), 1e-15);
  const Quaternion a = rotation_about({0.36, 0.48, 0.8}, 0.9),
                   b = rotation_about({0, 0.6, 0.8}, -2);
  const Vec3 v{0.3, -1.2, 2.5};
  EXPECT_LT(norm(rotate(a * b, v) - rotate(a, rotate(b, v))), 1e-15 * 10);
  EXPECT_LT(norm(rotate_back(a, rotate(a, v)) - v), 1e-15 * 10);
  EXPECT_NEAR(norm(rotate(a, v)), norm(v), 1e-15 * 10);
  const Vec3 omega{1, 2, 3}, j = angular_momentum(a, kInertia, omega);
  EXPECT_LT(norm(angular_velocity(a, kInertia, j) - omega), 1e-14);
}

// A turn about an axis of the body is a product with a rotation, and leaves J in space.
TEST(RigidRotation, TurnsAboutAxesOfTheBodyLeaveAngularMomentumInSpace) {
  const Quaternion q = rotation_about({0.36, 0.48, 0.8}, 0.9);
  const Vec3 j{1, 2, 3};
  const auto check = [&](auto by, const Vec3& axis) {
    FreeBody body{q, rotate_back(q, j)};
    by(body);
    EXPECT_LT(angle(body.q, q * rotation_about(axis, 0.7)), 1e-15 * 10);
    EXPECT_LT(norm(rotate(body.q, body.l) - j), 1e-14);
  };
  check([](FreeBody& body) { body.turn_x(0.7); }, {1, 0, 0});
  check([](FreeBody& body) { body.turn_y(0.7); }, {0, 1, 0});
}

// J is kept in space. In the frame of the body it has the same length after 1e5 steps, as its
// orientation stays of unit length. The energy does not drift.
TEST(RigidRotation, LosesNothingIn1e5Steps) {
  Top body = top(kInertia, {0.9, 0.5, -0.7});
  const Real energy = body.energy();
  Real early = 0, late = 0;
  for (int n = 0; n < 100; ++n) {
    turn(body, 0.05, 1000);
    Real& error = n < 50 ? early : late;
    error = std::max(error, std::abs(body.energy() / energy - 1));
  }
  EXPECT_NEAR(norm(rotate_back(body.q, body.j)) / norm(body.j), 1, 1e-14);
  EXPECT_NEAR(norm(body.q.vec()) * norm(body.q.vec()) + body.q.w * body.q.w, 1, 1e-14);
  EXPECT_LT(late, 1.2 * early);
  EXPECT_LT(late, 1e-3);
}

TEST(RigidRotation, ErrorsFallWithTheSquareOfTheStep) {
  const auto error_of_energy = [&](Real h) {
    Top body = top(kInertia, {0.9, 0.5, -0.7});
    const Real energy = body.energy();
    Real error = 0;
    for (Real t = 0; t < 20; t += h) {
      turn(body, h, 1);
      error = std::max(error, std::abs(body.energy() / energy - 1));
    }
    return error;
  };
  const Real of_energy = order(error_of_energy(0.1), error_of_energy(0.05));
  EXPECT_NEAR(of_energy, 2, 0.1);
  const auto end = [&](int steps) {
    Top body = top(kInertia, {0.9, 0.5, -0.7});
    turn(body, 10. / steps, steps);
    return body.q;
  };
  const Quaternion exact = end(1 << 16);
  const Real of_angle = order(angle(end(100), exact), angle(end(200), exact));
  EXPECT_NEAR(of_angle, 2, 0.1);
}

// Back with the opposite step is where it came from.
TEST(RigidRotation, IsReversible) {
  Top body = top(kInertia, {0.9, 0.5, -0.7});
  turn(body, 0.1, 1000);
  turn(body, -0.1, 1000);
  EXPECT_LT(angle(body.q, {}), 1e-11);
}

// The axis of a symmetric top goes round J at |J|/I_x, while the top turns about its axis at
// L_z (1/I_z - 1/I_x). That is exact for any step where I_z is one of two equal moments.
TEST(RigidRotation, SymmetricTopPrecessesAtItsRate) {
  for (const Vec3& inertia : {Vec3{2, 2, 0.7}, Vec3{1, 1, 1.9}}) {
    const Top start = top(inertia, {0.8, -0.3, 1.1});
    const Real size = norm(start.j), t = 8;
    const Quaternion exact =
        rotation_about((1 / size) * start.j, t * size / inertia.x) *
        rotation_about({0, 0, 1}, t * start.j.z * (1 / inertia.z - 1 / inertia.x));
    const auto error = [&](int steps) {
      Top body = start;
      turn(body, t / steps, steps);
      return angle(body.q, exact);
    };
    EXPECT_NEAR(order(error(200), error(400)), 2, 0.05);
    EXPECT_LT(error(400), 2e-3);
  }
  const Vec3 along_x{0.7, 2, 2};  // I_y = I_z, as of a dimer
  const Top start = top(along_x, {1.1, 0.8, -0.3});
  const Real size = norm(start.j), t = 8;
  const Quaternion exact =
      rotation_about((1 / size) * start.j, t * size / along_x.y) *
      rotation_about({1, 0, 0}, t * start.j.x * (1 / along_x.x - 1 / along_x.y));
  for (const int steps : {1, 3, 100}) {
    Top body = start;
    turn(body, t / steps, steps);
    EXPECT_LT(angle(body.q, exact), 1e-12) << steps;
  }
}

// A sphere turns about J at the same rate for ever.
TEST(RigidRotation, SphereTurnsEvenly) {
  Top body = top({2, 2, 2}, {0.9, 0.5, -0.7});
  const Quaternion exact = rotation_about((1 / norm(body.j)) * body.j, norm(body.j) / 2 * 12);
  turn(body, 3, 4);
  EXPECT_LT(angle(body.q, exact), 1e-14 * 10);
}

struct Jacobi {
  Real sn, cn, dn;
};
/// Jacobi's elliptic functions by descending Landen transformations, Abramowitz & Stegun 16.4.
Jacobi jacobi(Real u, Real m) {
  std::vector<Real> a{1}, c{std::sqrt(m)};
  for (Real b = std::sqrt(1 - m); std::abs(c.back()) > 1e-16;) {
    const Real mean = (a.back() + b) / 2;
    c.push_back((a.back() - b) / 2);
    b = std::sqrt(a.back() * b);
    a.push_back(mean);
  }
  std::size_t n = a.size() - 1;
  Real phi = std::ldexp(a[n] * u, static_cast<int>(n));
  for (; n > 0; --n) phi = (phi + std::asin(c[n] / a[n] * std::sin(phi))) / 2;
  return {std::sin(phi), std::cos(phi), std::sqrt(1 - m * std::pow(std::sin(phi), 2))};
}

// Landau & Lifshitz, Mechanics, section 37: the spin of an asymmetric top in its own frame for
// J^2 > 2 E I_y; at t = 0 that about y is zero.
TEST(RigidRotation, AsymmetricTopIsJacobis) {
  const Vec3 i = kInertia;
  const Top start = top(i, {0.6, 0, 0.8});
  const Real twice = 2 * start.energy(), square = dot(start.j, start.j);
  ASSERT_GT(square, twice * i.y);
  const Real rate = std::sqrt((i.z - i.y) * (square - twice * i.x) / (i.x * i.y * i.z));
  const Real m = (i.y - i.x) * (twice * i.z - square) / ((i.z - i.y) * (square - twice * i.x));
  const Vec3 most{std::sqrt((twice * i.z - square) / (i.x * (i.z - i.x))),
                  std::sqrt((twice * i.z - square) / (i.y * (i.z - i.y))),
                  std::sqrt((square - twice * i.x) / (i.z * (i.z - i.x)))};
  const auto error = [&](Real h) {
    Top body = start;
    Real largest = 0;
    for (int n = 1; n * h < 40; ++n) {
      turn(body, h, 1);
      const Jacobi at = jacobi(rate * n * h, m);
      const Vec3 exact{most.x * at.cn, most.y * at.sn, most.z * at.dn};
      largest = std::max(largest, norm(body.body_spin() - exact));
    }
    return largest;
  };
  EXPECT_NEAR(order(error(0.02), error(0.01)), 2, 0.05);
  EXPECT_LT(error(0.01), 1e-4);
  // Richardson's extrapolation of the states at one time leaves what is of fourth order.
  const auto spin = [&](int steps) {
    Top body = start;
    turn(body, 20. / steps, steps);
    return body.body_spin();
  };
  const Jacobi at = jacobi(rate * 20, m);
  const Vec3 exact{most.x * at.cn, most.y * at.sn, most.z * at.dn};
  EXPECT_LT(norm(fma(Real(1) / 3, spin(4000) - spin(2000), spin(4000)) - exact), 1e-8);
}

}  // namespace
}  // namespace barchan
