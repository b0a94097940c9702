// Words that users of other programs write for a key of ours.
#pragma once

#include <string>
#include <string_view>

namespace barchan {

struct Synonym {
  std::string_view word;      // word as typed
  std::string_view sections;  // where, "grains grains.wall"; empty: anywhere
  std::string_view keys;      // keys that it may stand for, dotted: "a.b" or "a.b, a.c"
};

// Words of LIGGGHTS, CFDEM, OpenFOAM and textbooks. The first that fits counts.
constexpr Synonym kSynonyms[] = {
    {"mu", "grains grains.wall", "grains.sliding_friction"},
    {"mu", "", "fluid.kinematic_viscosity"},
    {"mu_s", "", "grains.sliding_friction"},
    {"friction", "", "grains.sliding_friction"},
    {"coefficientFriction", "", "grains.sliding_friction"},
    {"mu_r", "", "grains.rolling_friction"},
    {"coefficientRollingFriction", "", "grains.rolling_friction"},
    {"e", "", "grains.restitution"},
    {"coefficientRestitution", "", "grains.restitution"},
    {"E", "", "grains.youngs_modulus"},
    {"youngsModulus", "", "grains.youngs_modulus"},
    {"young", "", "grains.youngs_modulus"},
    {"nu", "grains grains.wall", "grains.poisson_ratio"},
    {"poissonsRatio", "", "grains.poisson_ratio"},
    {"kn", "", "grains.linear_stiffness"},
    {"diameter", "", "grains.sizes"},
    {"diameters", "", "grains.sizes"},
    {"d", "", "grains.sizes"},
    {"radius", "grains", "grains.sizes"},
    {"count", "grains", "grains.sizes"},
    {"number", "grains", "grains.sizes"},
    {"g", "", "grains.gravity"},
    {"neighbor", "", "grains.skin"},
    {"viscosity", "", "fluid.kinematic_viscosity"},
    {"nu", "", "fluid.kinematic_viscosity"},
    {"dynamic_viscosity", "", "fluid.kinematic_viscosity"},
    {"rho", "grains", "grains.density"},
    {"rho", "", "fluid.density"},
    {"Ubar", "", "fluid.mean_velocity"},
    {"U", "", "fluid.mean_velocity"},
    {"velocity", "", "fluid.mean_velocity"},
    {"bulk_velocity", "", "fluid.mean_velocity"},
    {"LESModel", "", "fluid.turbulence"},
    {"Cw", "", "fluid.wale_constant"},
    {"mesh", "", "fluid.cells"},
    {"dt", "grains", "time.grain_step"},
    {"dt", "fluid", "time.fluid_step"},
    {"dt", "", "time.fluid_step, time.grain_step"},
    {"timestep", "", "time.grain_step"},
    {"deltaT", "", "time.fluid_step"},
    {"couplingInterval", "", "time.fluid_step"},
    {"endTime", "", "time.end"},
    {"duration", "", "time.end"},
    {"writeInterval", "", "output.fields_interval, output.grains_interval"},
    {"interval", "output",
     "output.grains_interval, output.fields_interval, output.history_interval"},
    {"dump", "", "output.grains_interval"},
    {"thermo", "", "output.history_interval"},
    {"smoothingLength", "", "coupling.smoothing_length"},
    {"voidFractionModel", "", "coupling.scheme"},
};

}  // namespace barchan
