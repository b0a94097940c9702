// Contacts of grains with bodies: the contact law with one side at rest (m_eff = m), flat or a
// sphere, as at walls. Only pairs of a grain and a body near it are looked at; their list lives as
// long as the neighbour list.
#pragma once

#include <cstdint>

#include "kernels/bodies/body.hpp"
#include "kernels/grains/grain.hpp"
#include "kernels/grains/law_table.hpp"
#include "kernels/grains/list_validity.hpp"

namespace barchan {

/// Effective radius of a grain of radius r on a body: r R/(r + R) on a sphere, elsewhere r [m].
KOKKOS_FORCEINLINE_FUNCTION Real effective_radius(const Body& body, Real r) {
  const Real curvature = body.curvature();
  return curvature > 0 ? r * curvature / (r + curvature) : r;
}

/// Largest overlap of a grain with a body [m]; 0 without bodies, infinite if not a number.
KOKKOS_INLINE_FUNCTION Real deepest_in(const Bodies& bodies, const Vec3& x, Real r) {
  Real deepest = 0;
  for (int b = 0; b < bodies.n; ++b) {
    const Real depth = r - bodies.body[b].distance(x);
    if (!(depth <= deepest)) deepest = depth;
  }
  return deepest == deepest ? deepest : Kokkos::Experimental::infinity_v<Real>;
}

/// Pairs of a grain and a body near it. The pairs of a grain follow one another.
struct NearBodies {
  /// Number of components of a load on a body: force, then torque about Body::foot.
  static constexpr int kParts = 6;
  int n = 0;
  Kokkos::View<int*> grain;
  Kokkos::View<std::uint8_t*> body, touches;
  Kokkos::View<Real* [kParts]> load;  // summed over grain steps [N], [N m]
};

/// Marks the bodies that a grain can touch before it has used up its skin, a bit each. A grain that
/// is near none touches none.
struct MarkNearBodies {
  Bodies bodies;
  Real law_reach = 0;  // [m]
  Kokkos::View<const GrainKinematics*> grains;
  Kokkos::View<const Vec3*> x_reference;  // position of a grain when its skin was new
  Kokkos::View<std::uint8_t*> touching, near;

  KOKKOS_FUNCTION void operator()(int g) const {
    const GrainKinematics& grain = grains(g);
    unsigned bits = 0;
    for (int b = 0; b < bodies.n; ++b) {
      // Twice the skin: the distance to a hill may fall somewhat faster than a grain goes.
      const Real reach = grain.r + 2 * grain.skin + law_reach;
      if (bodies.body[b].distance(x_reference(g)) < reach) bits |= 1u << b;
    }
    near(g) = static_cast<std::uint8_t>(bits);
    touching(g) = static_cast<std::uint8_t>(touching(g) & bits);
  }
};

/// Lists the marked pairs, as a scan over grains.
struct ListNearBodies {
  int n_bodies;
  Kokkos::View<const std::uint8_t*> near;
  NearBodies list;

  KOKKOS_FUNCTION void operator()(int g, int& count, bool final) const {
    for (int b = 0; b < n_bodies; ++b) {
      if ((near(g) >> b & 1) == 0) continue;
      if (final && count < list.grain.extent_int(0)) write(count, g, b);
      ++count;
    }
  }
  KOKKOS_FUNCTION void write(int p, int g, int b) const {
    list.grain(p) = g;
    list.body(p) = static_cast<std::uint8_t>(b);
    list.touches(p) = 0;
    for (int part = 0; part < NearBodies::kParts; ++part) list.load(p, part) = 0;
  }
};

/// Computes the contacts of grains with bodies in a grain step. The first pair of a grain works for
/// all pairs of that grain.
template <class Law>
struct BodyContacts {
  Bodies bodies;
  Law law;
  ListValidity validity;
  NearBodies near;
  Kokkos::View<const GrainKinematics*> grains;
  Kokkos::View<const std::uint8_t*> kind;                  // kinds of the grains; empty: one kind
  Kokkos::View<Vec3**, Kokkos::LayoutLeft> xi_t, rolling;  // (grain, body): [m], [N m]
  Kokkos::View<std::uint8_t*> touching;                    // bit b: grain touches body b
  Kokkos::View<ContactSum*> sums;                          // contact sums of the grains

  KOKKOS_FUNCTION void operator()(int first) const {
    if (!validity.holds()) return;
    const int g = near.grain(first);
    if (first > 0 && near.grain(first - 1) == g) return;
    const unsigned before = touching(g);
    unsigned now = 0;
    ContactSum sum{};
    for (int p = first; p < near.n && near.grain(p) == g; ++p) {
      const int b = near.body(p);
      const ToSurface at = bodies.body[b].to_surface(grains(g).x);
      const Real r = grains(g).r, r_eff = effective_radius(bodies.body[b], r);
      const bool touches = in_contact(law.table.of(law_at(g)), r_eff, r - at.distance);
      near.touches(p) = touches ? 1 : 0;
      if (!touches) continue;
      now |= 1u << b;
      add(p, at, (before >> b & 1) != 0, sum);
    }
    sums(g) = sum;
    touching(g) = static_cast<std::uint8_t>(now);
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION std::uint8_t law_at(int g) const {
    return Law::kMany ? law_entry(kind(g), 0) : std::uint8_t{0};
  }
  KOKKOS_FUNCTION void add(int p, const ToSurface& at, bool touched, ContactSum& sum) const {
    const int g = near.grain(p), b = near.body(p);
    const GrainKinematics& grain = grains(g);
    const Vec3& normal = at.normal;
    const Real delta_n = grain.r - at.distance, arm = grain.r - delta_n / 2;
    const ContactPair pair{.normal = normal,
                           .delta_n = delta_n,
                           .slip = contact_slip(grain.u, arm * grain.omega, normal),
                           .omega_difference = grain.omega,
                           .r_eff = effective_radius(bodies.body[b], grain.r),
                           .m_eff = grain.m};
    ContactResult history;
    if (touched) history.xi_t = xi_t(g, b);
    if constexpr (Law::Rolling::has_history)
      if (touched) history.rolling = rolling(g, b);
    const ContactResult result =
        contact_force(law.table.of(law_at(g))(pair.r_eff, pair.m_eff, delta_n), law.rolling,
                      law.table.friction[law.table.at(law_at(g))], pair, history, law.dt);
    xi_t(g, b) = result.xi_t;
    if constexpr (Law::Rolling::has_history) rolling(g, b) = result.rolling;
    sum.force = sum.force + vec4(result.force);
    sum.torque = fma(-arm, vec4(result.n_cross_f_t), sum.torque);
    if constexpr (Law::kRolls) sum.torque = sum.torque + vec4(result.rolling);
    push_back(p, bodies.body[b].from_foot(grain.x) - arm * normal, result);
  }
  /// Adds the reaction on the body, at a place seen from its foot.
  KOKKOS_FUNCTION void push_back(int p, const Vec3& place, const ContactResult& result) const {
    const Vec3 force = -result.force, torque = cross(place, force) - result.rolling;
    const Real parts[NearBodies::kParts]{force.x, force.y, force.z, torque.x, torque.y, torque.z};
    for (int part = 0; part < NearBodies::kParts; ++part) near.load(p, part) += parts[part];
  }
};

/// Adds the loads of the pairs since the last call to sums of whole numbers, which do not depend on
/// the order, and counts the contacts.
struct SumBodyLoads {
  NearBodies near;
  Real per_force, per_torque;                              // units in 1 N, in 1 N m
  Real most;                                               // largest load of a pair, in units
  Kokkos::View<std::int64_t * [NearBodies::kParts]> sums;  // sums over the pairs of each body
  Kokkos::View<std::int64_t*> contacts;

  KOKKOS_FUNCTION void operator()(int p) const {
    const int b = near.body(p);
    for (int part = 0; part < NearBodies::kParts; ++part) {
      const Real number = near.load(p, part) * (part < 3 ? per_force : per_torque);
      const Real held = Kokkos::min(Kokkos::max(number, -most), most);
      const auto units = static_cast<std::int64_t>(held + (held < 0 ? Real(-0.5) : Real(0.5)));
      if (units != 0) Kokkos::atomic_add(&sums(b, part), units);
      near.load(p, part) = 0;
    }
    if (near.touches(p)) Kokkos::atomic_add(&contacts(b), std::int64_t{1});
  }
};

}  // namespace barchan
