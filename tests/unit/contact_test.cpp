// Contact laws against closed forms and integrated references.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kernels/grains/contact_geometry.hpp"
#include "kernels/grains/contact_law.hpp"
#include "kernels/grains/grain.hpp"
#include "kernels/grains/sphere.hpp"
#include "kernels/grains/wall_shapes.hpp"

namespace barchan {
namespace {

constexpr Elastic kGrain{.youngs_modulus = 5e6, .poisson_ratio = 0.45};
constexpr Real kRadius = 1e-4, kDensity = 2500;

HertzMindlin law(Real restitution) {
  return HertzMindlin::from({.a = kGrain, .b = kGrain, .restitution = restitution});
}

/// contact_force with the stiffness that the law has for this pair.
template <class Rolling>
ContactResult force_by(const HertzMindlin& hertz, const Rolling& rolling, const Friction& friction,
                       const ContactPair& pair, const ContactResult& history, Real dt) {
  const ContactStiffness k = hertz(pair.r_eff, pair.m_eff, pair.delta_n);
  return contact_force(k, rolling, friction, pair, history, dt);
}

/// A head-on impact of a grain with reduced mass m_eff at speed v [m/s].
struct Impact {
  Real restitution = 0, max_overlap = 0, max_force = 0, duration = 0;
};

Impact head_on(const HertzMindlin& hertz, Real v, Real dt) {
  const Real m_eff = sphere_volume(kRadius) * kDensity / 2, r_eff = kRadius / 2;
  Impact impact;
  Real delta = 0, approach = v;
  ContactResult history;
  // Symplectic Euler is enough at the fine steps used here.
  while (true) {
    ContactPair pair{.normal = {1, 0, 0},
                     .delta_n = std::max(delta, 1e-300),
                     .slip = {-approach, 0, 0},
                     .omega_difference = {},
                     .r_eff = r_eff,
                     .m_eff = m_eff};
    history = force_by(hertz, NoRolling{}, Friction{}, pair, history, dt);
    const Real force = history.force.x;
    approach -= dt * force / m_eff;
    delta += dt * approach;
    impact.duration += dt;
    impact.max_overlap = std::max(impact.max_overlap, delta);
    impact.max_force = std::max(impact.max_force, force);
    if (delta <= 0) break;
  }
  impact.restitution = -approach / v;
  return impact;
}

TEST(ContactGeometry, EffectiveRadiusAndMassAreHarmonic) {
  const EffectivePair equal = effective_pair(1e-4, 1e-4, 3e-9, 3e-9);
  EXPECT_DOUBLE_EQ(equal.r, 5e-5);
  EXPECT_DOUBLE_EQ(equal.m, 1.5e-9);
  const EffectivePair pair = effective_pair(1e-4, 3e-4, 2e-9, 8e-9);
  EXPECT_NEAR(1 / pair.r, 1 / 1e-4 + 1 / 3e-4, 1e-10);
  EXPECT_NEAR(1 / pair.m, 1 / 2e-9 + 1 / 8e-9, 1e-5);
  const EffectivePair beside_a_boulder = effective_pair(1e-4, 1e8, 2e-9, 1e20);
  EXPECT_NEAR(beside_a_boulder.r / 1e-4, 1, 1e-11);
  EXPECT_NEAR(beside_a_boulder.m / 2e-9, 1, 1e-11);
}

TEST(ContactGeometry, OverlapsAcrossTheSeamAndWithAWall) {
  const PeriodicBox box{.lx = 0.01, .lz = 0};
  GrainKinematics a, b;
  a.r = 1e-4, b.r = 3e-4;
  a.x = {0.0001, 0.002, 0.003}, b.x = {0.0098, 0.002, 0.003};  // 0.3 mm apart through the seam
  EXPECT_NEAR(relative_overlap(box, a, b), 0.25, 1e-12);
  EXPECT_NEAR(relative_overlap(PeriodicBox{}, a, b), 1 - 9.7e-3 / 4e-4, 1e-10);
  const Plane top{.normal = {0, -1, 0}, .offset = -0.00205};
  EXPECT_NEAR(top.distance(a.x), 5e-5, 1e-15);
  EXPECT_NEAR(top.overlap(a), 5e-5, 1e-15);
  EXPECT_LT(top.distance({0, 0.0021, 0}), 0);  // beyond it
}

TEST(PeriodicBox, WrapsPositionsAlongPeriodicDirectionsOnly) {
  const PeriodicBox box{.lx = 2, .lz = 0};
  for (const Real x : {-3.5, 0.5, 2.5, 20.5}) {
    const Vec3 wrapped = box.wrap({x, -7, 9});
    EXPECT_EQ(wrapped.x, 0.5);
    EXPECT_EQ(wrapped.y, -7);
    EXPECT_EQ(wrapped.z, 9);
  }
  EXPECT_EQ(box.nearest_image({1.5, 0, 5}).x, -0.5);
  EXPECT_EQ(box.nearest_image({-1.5, 0, 5}).x, 0.5);
  EXPECT_EQ(box.nearest_image({-1.5, 0, 5}).z, 5);
}

TEST(ContactLaw, EffectiveModuliOfEqualMaterials) {
  EXPECT_NEAR(effective_youngs_modulus(kGrain, kGrain), 5e6 / (2 * (1 - 0.45 * 0.45)), 1e-3);
  EXPECT_NEAR(effective_shear_modulus(kGrain, kGrain), 5e6 / (4 * 1.55 * 1.45), 1e-3);
  const Elastic rigid{.youngs_modulus = 1e30, .poisson_ratio = 0.2};
  EXPECT_NEAR(effective_youngs_modulus(kGrain, rigid), 5e6 / (1 - 0.45 * 0.45), 1e-3);
}

TEST(ContactLaw, ElasticImpactFollowsHertz) {
  // delta_max = (15 m v^2 / (16 E sqrt R))^(2/5), t_c = 2.94327 delta_max / v (Johnson 1985).
  const Real v = 0.05, m = sphere_volume(kRadius) * kDensity / 2, r = kRadius / 2;
  const Real e = law(1).e_eff;
  const Real expected = std::pow(15 * m * v * v / (16 * e * std::sqrt(r)), 0.4);
  const Impact impact = head_on(law(1), v, 1e-9);
  EXPECT_NEAR(impact.max_overlap / expected, 1, 1e-3);
  EXPECT_NEAR(impact.duration / (2.94327 * expected / v), 1, 1e-3);
  EXPECT_NEAR(impact.max_force / (4.0 / 3 * e * std::sqrt(r) * std::pow(expected, 1.5)), 1, 1e-3);
  EXPECT_NEAR(impact.restitution, 1, 1e-3);
}

TEST(ContactLaw, DampingDeliversTheRestitution) {
  for (const Real e : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    EXPECT_NEAR(head_on(law(e), 0.05, 2e-9).restitution, e, 1e-3) << "input " << e;
    EXPECT_NEAR(head_on(law(e), 0.2, 2e-9).restitution, e, 1e-3) << "at another speed, input " << e;
  }
}

// A9, A10: gamma = 2 sqrt(5/6) damping sqrt(S m) with the stiffness S that a small motion meets,
// dF_n/d(delta) = 3/2 k_n along the normal and k_t across.
TEST(ContactLaw, DashpotsBelongToTheirSprings) {
  const Real m = 1e-8, damping = damping_ratio(0.3);
  const ContactStiffness k = law(0.3)(kRadius / 2, m, 1e-6);
  const Real per_spring = 10.0 / 3 * damping * damping * m;
  const Real k_n = k.elastic / 1e-6;
  EXPECT_NEAR(k.gamma_n * k.gamma_n / (per_spring * 1.5 * k_n), 1, 1e-12);
  EXPECT_NEAR(k.gamma_t * k.gamma_t / (per_spring * k.k_t), 1, 1e-12);
  EXPECT_NEAR(k.k_t / k_n, 6 * law(0.3).g_eff / law(0.3).e_eff, 1e-12);  // Mindlin over Hertz
}

TEST(ContactLaw, TangentialDampingIsAFactorOnItsDashpotAlone) {
  ContactMaterial m{.a = {5e6, 0.45}, .b = {5e6, 0.45}, .restitution = 0.3, .linear_stiffness = 9};
  const auto compare = [&]<class Law>(Law) {
    m.tangential_damping = 1;
    const ContactStiffness whole = Law::from(m)(kRadius / 2, 1e-8, 1e-6);
    m.tangential_damping = 0.25;
    const ContactStiffness quarter = Law::from(m)(kRadius / 2, 1e-8, 1e-6);
    EXPECT_GT(whole.gamma_t, 0);
    EXPECT_DOUBLE_EQ(quarter.gamma_t, whole.gamma_t / 4);
    EXPECT_EQ(quarter.gamma_n, whole.gamma_n);
    EXPECT_EQ(quarter.k_t, whole.k_t);
    EXPECT_EQ(quarter.elastic, whole.elastic);
  };
  compare(HertzMindlin{});
  compare(LinearSpring{});
}

ContactPair sliding_pair(Real slip) {
  return {.normal = {0, 1, 0},
          .delta_n = 1e-6,
          .slip = {slip, 0, 0},
          .omega_difference = {},
          .r_eff = kRadius / 2,
          .m_eff = 1e-8};
}

TEST(ContactForce, SlidesAtTheCoulombLimitAndSticksAgain) {
  const Friction friction{.sliding = 0.6, .rolling = 0};
  const ContactPair slides = sliding_pair(1);
  ContactResult c;
  for (int n = 0; n < 200; ++n) c = force_by(law(1), NoRolling{}, friction, slides, c, 1e-7);
  EXPECT_NEAR(-c.force.x, 0.6 * c.force.y, 1e-12 * c.force.y);
  EXPECT_NEAR(norm(c.xi_t), 0.6 * c.force.y / law(1)(kRadius / 2, 1e-8, 1e-6).k_t, 1e-15);
  // Back by half the stored displacement: the spring pulls with half the limit.
  const ContactPair back = sliding_pair(-norm(c.xi_t) / 2 / 1e-7);
  c = force_by(law(1), NoRolling{}, friction, back, c, 1e-7);
  EXPECT_NEAR(-c.force.x, 0.3 * c.force.y, 1e-9 * c.force.y);
}

TEST(ContactForce, NeverLeavesTheCoulombConeWhenElastic) {
  const Friction friction{.sliding = 0.4, .rolling = 0};
  ContactResult c;
  for (int n = 0; n < 1000; ++n) {
    ContactPair pair = sliding_pair(std::sin(0.1 * n));
    pair.slip.z = std::cos(0.037 * n);
    pair.delta_n = 1e-6 * (1.2 + std::sin(0.01 * n));
    c = force_by(law(1), NoRolling{}, friction, pair, c, 1e-7);
    const Vec3 tangential = c.force - c.force.y * Vec3{0, 1, 0};
    EXPECT_LE(norm(tangential), 0.4 * c.force.y * (1 + 1e-12));
    EXPECT_NEAR(dot(c.xi_t, pair.normal), 0, 1e-20);
    EXPECT_NEAR(norm(c.n_cross_f_t), norm(tangential), 1e-12 * c.force.y);
  }
}

// The normal of a pair turns; its spring turns with it.
TEST(ContactForce, TangentialDisplacementLiesInTheTangentPlane) {
  ContactResult history;
  history.xi_t = {1e-9, 2e-9, 3e-9};  // of a contact whose normal was another
  const ContactResult c =
      force_by(law(1), NoRolling{}, Friction{.sliding = 0.6}, sliding_pair(0), history, 1e-7);
  EXPECT_EQ(c.xi_t.y, 0);
  EXPECT_EQ(c.xi_t.x, 1e-9);
  EXPECT_NEAR(c.force.z / c.force.x, 3, 1e-14);
}

// The contact also slides another way than its spring points, and its dashpot is not along it.
TEST(ContactForce, SlidingFrictionIsAlongTheSpring) {
  ContactResult history;
  history.xi_t = {1e-6, 0, 0};
  ContactPair pair = sliding_pair(0);
  pair.slip.z = 0.1;
  const Friction friction{.sliding = 0.6};
  const ContactResult c = force_by(law(0.1), NoRolling{}, friction, pair, history, 1e-7);
  EXPECT_NEAR(std::hypot(c.force.x, c.force.z), 0.6 * c.force.y, 1e-12 * c.force.y);
  EXPECT_NEAR(c.force.z / c.force.x, 0.1 * 1e-7 / 1e-6, 1e-12);
  EXPECT_LT(c.force.x, 0);
}

TEST(ContactForce, OppositeRolesGiveOppositeForces) {
  const Friction friction{.sliding = 0.6, .rolling = 0};
  const Vec3 normal = (1 / std::sqrt(14.0)) * Vec3{1, 2, 3};
  const ContactPair a{.normal = normal,
                      .delta_n = 1e-6,
                      .slip = {0.1, -0.2, 0.05},
                      .omega_difference = {1, 2, 3},
                      .r_eff = 5e-5,
                      .m_eff = 1e-8};
  ContactPair b = a;
  b.normal = -a.normal, b.slip = -a.slip, b.omega_difference = -a.omega_difference;
  const ContactResult ra = force_by(law(0.5), Epsd2{}, friction, a, {}, 1e-7);
  const ContactResult rb = force_by(law(0.5), Epsd2{}, friction, b, {}, 1e-7);
  EXPECT_NEAR(norm(ra.force + rb.force), 0, 1e-12 * norm(ra.force));
  EXPECT_NEAR(norm(ra.n_cross_f_t - rb.n_cross_f_t), 0, 1e-12 * norm(ra.n_cross_f_t));
}

/// Rolls a contact about z by `angle` in n steps; returns the torque.
template <class Law>
Real rolled(const Law& rolling, Real mu_r, Real angle, int n) {
  const Real dt = 1e-6;
  ContactResult c;
  for (int s = 0; s < n; ++s) {
    ContactPair pair = sliding_pair(0);
    pair.omega_difference = {0, 100, angle / n / dt};  // the part along the normal is torsion
    c = force_by(law(1), rolling, Friction{.sliding = 0.6, .rolling = mu_r}, pair, c, dt);
    EXPECT_EQ(c.rolling.y, 0);
  }
  return c.rolling.z;
}

TEST(Rolling, Epsd2IsASpringUpToItsLimit) {
  const Real r = kRadius / 2;
  const ContactStiffness k = law(1)(r, 1e-8, 1e-6);
  const Real limit = 0.1 * r * k.elastic, k_r = k.k_t * r * r;
  EXPECT_NEAR(rolled(Epsd2{}, 0.1, 0.5 * limit / k_r, 10), -0.5 * limit, 1e-9 * limit);
  EXPECT_NEAR(rolled(Epsd2{}, 0.1, 5 * limit / k_r, 10), -limit, 1e-9 * limit);
}

TEST(Rolling, ThetaMReachesItsLimitAtThetaM) {
  const Real r = kRadius / 2;
  const Real limit = 0.2 * r * law(1)(r, 1e-8, 1e-6).elastic;
  const ThetaM model{.theta_m = 0.05};
  EXPECT_NEAR(rolled(model, 0.2, 0.025, 20), -0.5 * limit, 1e-9 * limit);
  EXPECT_NEAR(rolled(model, 0.2, 0.05, 20), -limit, 1e-9 * limit);
  EXPECT_NEAR(rolled(model, 0.2, 0.2, 20), -limit, 1e-9 * limit);
}

TEST(Rolling, ConstantTorqueOpposesAndAllVanishWithoutFriction) {
  const Real r = kRadius / 2;
  const Real limit = 0.2 * r * law(1)(r, 1e-8, 1e-6).elastic;
  EXPECT_NEAR(rolled(ConstantTorque{}, 0.2, 1e-4, 1), -limit, 1e-9 * limit);
  EXPECT_EQ(rolled(ConstantTorque{}, 0.2, 0, 1), 0);
  EXPECT_EQ(rolled(Epsd2{}, 0, 0.1, 5), 0);
  EXPECT_EQ(rolled(ThetaM{}, 0, 0.1, 5), 0);
}

TEST(LinearSpring, DeliversTheRestitution) {
  const auto spring =
      LinearSpring::from({.a = {}, .b = {}, .restitution = 0.5, .linear_stiffness = 100});
  const Real m = 1e-8, dt = 1e-10;
  Real x = 0, v = 0.1;
  do {
    const ContactStiffness k = spring(0, m, x);
    v -= dt / m * (k.elastic + k.gamma_n * v);
    x += dt * v;
  } while (x > 0);
  EXPECT_NEAR(-v / 0.1, 0.5, 1e-3);
}

// Schaefer, Dippel & Wolf 1996: 2/7 of the mass answers at the contact point of a solid sphere, so
// that springs with k_t = 2/7 k_n swing with one period. Both dashpots have the same damping ratio.
TEST(LinearSpring, SwingsAcrossAsItSwingsAlong) {
  const Real damping = damping_ratio(0.5), m = 1e-8;
  const auto spring =
      LinearSpring::from({.a = {}, .b = {}, .restitution = 0.5, .linear_stiffness = 100});
  const ContactStiffness k = spring(0, m, 1);  // at 1 m
  EXPECT_NEAR(k.k_t / (Real(2) / 7 * m) / (k.elastic / m), 1, 1e-14);
  EXPECT_NEAR(k.gamma_n / (2 * std::sqrt(m * k.elastic)), damping, 1e-14);
  EXPECT_NEAR(k.gamma_t / (2 * std::sqrt(m * k.k_t)), damping, 1e-14);
}

}  // namespace
}  // namespace barchan
