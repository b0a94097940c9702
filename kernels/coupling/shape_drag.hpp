// Effect of the shape of a grain on its drag. A law here gives beta [kg/s] of a grain alone in the
// flow, as in kernels/coupling/drag.hpp: F_drag = beta (u_f - u_p). Diameters are those of the
// sphere of equal volume, and so are Reynolds numbers and the areas of drag coefficients.
#pragma once

#include "kernels/coupling/drag.hpp"
#include "kernels/grains/clump.hpp"

namespace barchan {

/// Form of a grain, as the flow meets it.
struct GrainForm {
  Real sphericity = 1;  // surface of the sphere of its volume over its own [-]
  Real crosswise = 1;   // section of that sphere over the area of its shadow along the flow [-]
};

/// Shadow of a body in a direction of its own frame, of any length but 0, from the shadows along
/// its axes: A^2 = sum of (n_k A_k)^2. Exact for an ellipsoid. [unit of A]
KOKKOS_FORCEINLINE_FUNCTION Real shadow_of_ellipsoid(const Vec3& areas, const Vec3& direction) {
  const Vec3 a{areas.x * direction.x, areas.y * direction.y, areas.z * direction.z};
  return Kokkos::sqrt(dot(a, a) / dot(direction, direction));
}
/// Crosswise sphericity of a shape of unit volume-equivalent diameter.
KOKKOS_FORCEINLINE_FUNCTION Real crosswise_sphericity(const Vec3& areas, const Vec3& direction) {
  return std::numbers::pi_v<Real> / 4 / shadow_of_ellipsoid(areas, direction);
}
/// Form of a clump in a flow along `slip` [any unit, not 0].
KOKKOS_FORCEINLINE_FUNCTION GrainForm form_in_flow(const PartOfClump& of, const Vec3& slip) {
  return {of.sphericity, crosswise_sphericity(of.shadows, rotate_back(of.q, slip))};
}

/// -log10 of a sphericity, at least 0.
KOKKOS_FORCEINLINE_FUNCTION Real decades_below_one(Real sphericity) {
  return sphericity < 1 ? -Kokkos::log10(sphericity) : Real(0);
}

/// Drag in slow flow over that of the sphere of equal volume: friction on the surface and pressure
/// on the shadow, (1/sqrt(crosswise) + 2/sqrt(sphericity))/3. Leith, Aerosol Sci. Technol. 6, 153
/// (1987). Limit: 1 for a sphere.
KOKKOS_FORCEINLINE_FUNCTION Real slow_drag_ratio(const GrainForm& form) {
  return (1 / Kokkos::sqrt(form.crosswise) + 2 / Kokkos::sqrt(form.sphericity)) / 3;
}

/// Hoelzer & Sommerfeld, Powder Technol. 184, 361 (2008), equation 10, with the crosswise
/// sphericity c in the place of the lengthwise one:
///   C_d = 8/Re 1/sqrt(c) + 16/Re 1/sqrt(s) + 3/sqrt(Re) 1/s^(3/4) + 0.42 10^(0.4 (-log10
///   s)^0.2)/c.
/// Limit for a sphere: 24/Re + 3/sqrt(Re) + 0.42.
struct HoelzerSommerfeld {
  static constexpr Named named{"hoelzer_sommerfeld", "Hoelzer & Sommerfeld (2008)"};
  KOKKOS_INLINE_FUNCTION Real operator()(const LocalFlow& f, const GrainForm& form) const {
    const Real reynolds = reynolds_number(f, 1, f.d_p);
    const Real root = Kokkos::sqrt(form.sphericity);
    const Real fast =
        Real(0.42) / form.crosswise *
        Kokkos::pow(Real(10),
                    Real(0.4) * Kokkos::pow(decades_below_one(form.sphericity), Real(0.2)));
    const Real laminar = 3 * Kokkos::sqrt(reynolds) / (root * Kokkos::sqrt(root));
    return stokes_coefficient(f, f.d_p) *
           (slow_drag_ratio(form) + (laminar + fast * reynolds) / 24);
  }
};

/// Ganser, Powder Technol. 77, 143 (1993), without walls: with X = Re K1 K2,
///   C_d/K2 = 24/X (1 + 0.1118 X^0.6567) + 0.4305/(1 + 3305/X),
///   1/K1 = (1/sqrt(c) + 2/sqrt(s))/3,  K2 = 10^(1.8148 (-log10 s)^0.5743).
/// For a body as long in all directions he takes c = 1. Limit for a sphere: K1 = K2 = 1.
struct Ganser {
  static constexpr Named named{"ganser", "Ganser (1993)"};
  KOKKOS_INLINE_FUNCTION Real operator()(const LocalFlow& f, const GrainForm& form) const {
    const Real slow = slow_drag_ratio(form);
    const Real fast = Kokkos::pow(
        Real(10), Real(1.8148) * Kokkos::pow(decades_below_one(form.sphericity), Real(0.5743)));
    const Real reynolds = reynolds_number(f, 1, f.d_p), x = reynolds * fast / slow;
    return stokes_coefficient(f, f.d_p) *
           (slow * (1 + Real(0.1118) * Kokkos::pow(x, Real(0.6567))) +
            Real(0.4305) / 24 * fast * reynolds * x / (x + 3305));
  }
};

/// Drag of the sphere of equal volume: for comparison.
struct DragOfSphere {
  static constexpr Named named{"sphere", "that of the sphere of equal volume"};
  KOKKOS_INLINE_FUNCTION Real operator()(const LocalFlow&, const GrainForm&) const { return 1; }
};

using ShapeDragLaws = Alternatives<HoelzerSommerfeld, Ganser, DragOfSphere>;

/// Factor of the shape on the drag of the sphere of equal volume: that of a law in clear water. It
/// is 1 for a sphere, whatever the law of the case, and rises steeply beside it where the flow is
/// fast: Hoelzer & Sommerfeld give 1.1 at a sphericity of 0.999 and Re = 100.
struct ShapeFactor {
  Choice<ShapeDragLaws> law;

  KOKKOS_INLINE_FUNCTION Real operator()(const LocalFlow& f, const GrainForm& form) const {
    constexpr std::size_t ganser = ShapeDragLaws::place_of<Ganser>();
    constexpr std::size_t sphere = ShapeDragLaws::place_of<DragOfSphere>();
    if (law.place == sphere) return 1;
    return law.place == ganser ? ratio(Ganser{}, f, form) : ratio(HoelzerSommerfeld{}, f, form);
  }
  /// Factor on the drag of a clump; in fluid that rests with it that of slow flow upwards.
  KOKKOS_INLINE_FUNCTION Real operator()(const LocalFlow& f, const PartOfClump& of,
                                         const Vec3& slip) const {
    return (*this)(f, form_in_flow(of, dot(slip, slip) > 0 ? slip : Vec3{0, 1, 0}));
  }

 private:
  template <class Law>
  KOKKOS_FORCEINLINE_FUNCTION static Real ratio(const Law& of, const LocalFlow& f,
                                                const GrainForm& form) {
    return of(f, form) / of(f, GrainForm{});
  }
};

}  // namespace barchan
