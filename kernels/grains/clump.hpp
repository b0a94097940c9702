// Rigid clumps of spheres among the grains: how their spheres are numbered and where they are.
#pragma once

#include <cstdint>

#include "kernels/grains/grain.hpp"
#include "kernels/grains/law_table.hpp"
#include "kernels/grains/rigid_rotation.hpp"
#include "kernels/grains/step_limit.hpp"

namespace barchan {

/// Motion of a clump, kept with its first sphere; its other spheres have the centre alone.
struct alignas(32) ClumpMotion {
  Vec3 x;         // centre of mass [m]
  Real d = 0;     // diameter of the sphere of its volume [m]
  Quaternion q;   // orientation of its principal axes
  Vec3 u;         // velocity of the centre [m/s]
  Real m = 0;     // mass [kg]
  Vec3 j;         // angular momentum about the centre, in space [kg m^2/s]
  Real rest = 0;  // not used
};

/// Bits of an entry's id that are the number of its grain; those above count the spheres of a
/// clump. So contacts know their spheres, and the first sphere has the number of the clump.
inline constexpr int kNumberBits = 40;
inline constexpr std::int64_t kLargestNumber = (std::int64_t{1} << kNumberBits) - 1;
/// Largest number of spheres of a clump: the quadrature of 64 that all overlap takes seconds.
inline constexpr int kMostSpheres = 64;

KOKKOS_FORCEINLINE_FUNCTION constexpr std::int64_t clump_of_id(std::int64_t id) {
  return id & kLargestNumber;
}
KOKKOS_FORCEINLINE_FUNCTION constexpr int member_of_id(std::int64_t id) {
  return static_cast<int>(id >> kNumberBits);
}
KOKKOS_FORCEINLINE_FUNCTION constexpr std::int64_t id_of_member(std::int64_t clump, int member) {
  return clump | (std::int64_t{member} << kNumberBits);
}

/// Shapes of the kinds of grains, of diameter and mass 1; a sphere is a clump of one.
struct ClumpShapes {
  int first[kMaxKinds + 1] = {};          // first sphere of each kind in `sphere`
  Vec3 inertia[kMaxKinds] = {};           // principal moments
  Vec3 shadows[kMaxKinds] = {};           // areas seen along the principal axes
  Real sphericity[kMaxKinds] = {};        // surface of the sphere of its volume over its own
  Real over_largest_sphere = 1;           // d over the diameter of its largest sphere, at most
  Kokkos::View<const Vec4*> sphere = {};  // centre and radius
  Kokkos::View<const Real*> share = {};   // of each sphere in the volume
  Kokkos::View<const InertiaInContacts*> in_contacts = {};  // of the clump, in those of each sphere

  KOKKOS_FORCEINLINE_FUNCTION int count(int kind) const { return first[kind + 1] - first[kind]; }
  /// Largest number of spheres of a grain; 0 without shapes.
  KOKKOS_FORCEINLINE_FUNCTION int largest_count() const {
    int largest = 0;
    for (int kind = 0; kind < kMaxKinds; ++kind)
      largest = largest < count(kind) ? count(kind) : largest;
    return largest;
  }
  /// Inertia in contacts of an entry; `kind` of all of them, empty: one kind. Without shapes, that
  /// of a sphere.
  KOKKOS_FORCEINLINE_FUNCTION InertiaInContacts
  in_contacts_of(const Kokkos::View<const std::uint8_t*>& kind,
                 const Kokkos::View<const std::int64_t*>& id, int g) const {
    if (in_contacts.extent(0) == 0) return {};
    return in_contacts(first[kind.extent(0) > 0 ? kind(g) : 0] + member_of_id(id(g)));
  }
  /// Centre of a sphere in the principal frame.
  KOKKOS_FORCEINLINE_FUNCTION Vec3 centre(int kind, int member) const {
    return sphere(first[kind] + member).vec();
  }
};

/// Sphere of a clump as the flow meets it: a part of the clump's volume.
struct alignas(32) PartOfClump {
  Quaternion q;         // orientation of the clump
  Vec3 shadows;         // areas that the clump has along its principal axes, for d = 1
  Real sphericity = 1;  // of the clump
  Real d = 0;           // diameter of the sphere of the clump's volume [m]
  Real radius = 0;      // of the sphere [m]
  Real share = 1;       // of the part in that volume
  Real rest = 0;        // not used
};

/// Entries of the spheres of each clump, the clumps in the order of their first spheres.
struct ClumpMembers {
  int n = 0;                 // clumps of this rank
  Kokkos::View<int*> first;  // (n) where the spheres of a clump begin in `entry`
  Kokkos::View<int*> entry;  // both may be longer: memory is kept
};

/// Place that says which rank has an entry, and when it leaves: that of its clump.
struct PlaceOfGrain {
  Kokkos::View<const GrainKinematics*> grains;
  Kokkos::View<const ClumpMotion*> clump;  // empty: all grains are spheres
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(int g) const {
    return clump.extent(0) > 0 ? clump(g).x : grains(g).x;
  }
};

}  // namespace barchan
