// Forces of a fluid on a sphere whether it flows or not: weight less buoyancy, added mass.
#pragma once

#include "kernels/grains/grain.hpp"
#include "kernels/grains/sphere.hpp"

namespace barchan {

inline constexpr Real kAddedMassCoefficient = 0.5;  // C_m of a sphere

/// Added mass of a sphere, C_m rho_f V_p [kg].
KOKKOS_FORCEINLINE_FUNCTION constexpr Real sphere_added_mass(Real rho_f, Real volume) {
  return kAddedMassCoefficient * rho_f * volume;
}

/// Weight less buoyancy [N].
struct SubmergedWeight {
  Vec3 gravity;        // [m/s^2]
  Real displaced = 0;  // density of the displaced fluid [kg/m^3]; 0: no buoyancy
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(const GrainKinematics& grain) const {
    return (grain.m - displaced * sphere_volume(grain.r)) * gravity;
  }
};

}  // namespace barchan
