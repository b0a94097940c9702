// Numbers that follow from a configuration: `check` prints them, and the cross-checks use them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/case/config.hpp"

namespace barchan {

/// Tells if grains that go beyond one end in x come in at the other; false without [grains].
bool is_periodic_x(const Config& config);
/// Half the width of the strip along x in which grains leave a window that follows its dune, one
/// cell [m]; 0 without such a window. Needs [grains].
double half_edge_strip(const Config& config);

/// Mean diameter [m] by number of grains; there must be some.
double mean_diameter(const std::vector<SizeClass>& sizes);

/// Rayleigh time [s] of a sphere: pi r sqrt(rho/G) / (0.1631 s + 0.8766), G = E / (2 (1 + s)),
/// the time a surface wave takes over it. Li, Xu & Thornton (2005).
double rayleigh_time(double diameter, double density, const Material& material);

/// Overlap of the lowest pair of a chain of grains over their diameter, under the `weight` [N/m^3]
/// of so many layers, without friction and dashpot: Hertz, (pi/2 n (1 - s^2) weight d / E)^(2/3).
double overlap_at_rest(int layers, double diameter, double weight, const Material& material);
/// Largest overlap of two equal grains that meet at a `speed` [m/s] over their diameter, without
/// dashpot: Hertz, (5 pi/16 (1 - s^2) density v^2 / E)^(2/5) (from Johnson 1985, eq. 11.23).
double overlap_of_impact(double density, double speed, const Material& material);

/// Duration [s] of a contact of two spheres of a `mass` [kg] with a linear spring [N/m],
/// pi sqrt(m / (2 k)), without damping.
double linear_contact_time(double mass, double stiffness);

/// Friction velocity [m/s] of channel flow at bulk velocity U: u* = U sqrt(Cf / 2) with Dean's
/// (1978) Cf = 0.073 (2 delta U / nu)^(-1/4), or the laminar 12 / (2 delta U / nu) where larger.
/// `delta` [m] from the wall to the free surface or the middle. 0 for U = 0 or nu = 0.
double friction_velocity(double bulk_velocity, double delta, double viscosity);
/// Bulk velocity [m/s] of a given friction velocity: the inverse of friction_velocity().
double bulk_velocity_of(double u_star, double delta, double viscosity);

/// Fall velocity [m/s] of a lone sphere under Schiller & Naumann's drag.
double settling_velocity(double diameter, double density_ratio, double viscosity, double gravity);

/// Estimated speed of the fastest grains over the largest bulk velocity.
inline constexpr double kFastestGrains = 0.4;
/// Layers of the heap for which `check` gives the overlap at rest: those of the paper's dune.
inline constexpr int kLayersAtRest = 15;

struct FluidNumbers {
  std::int64_t cells = 0;
  double dx = 0, dz = 0, dy_first = 0, dy_last = 0;  // [m]
  double stretching = 1;                             // ratio of neighbouring rows
  double bulk_velocity = 0;  // [m/s], the largest; with a pressure gradient the expected one
  bool varies = false;       // has a schedule
  double delta = 0;          // [m], from a wall to the free surface or the middle; 0: no wall
  double reynolds = 0;       // 2 delta U / nu
  double u_star = 0;         // [m/s] expected
  double reynolds_tau = 0;   // u* delta / nu
  double y1_plus = 0;        // height of the first cell centre in nu / u*
  double dx_plus = 0, dz_plus = 0;
  double pressure_gradient = 0;  // [Pa/m], rho u*^2 / delta or the one given
  double cfl = 0;                // 1.15 dt (|U|/dx + |W|/dz), the mean flow at the centreline
  double viscous_number = 0;     // 4 nu dt (1/dx^2 + 1/dy^2 + 1/dz^2), first row
};

/// Numbers of the grains of one kind.
struct KindNumbers {
  std::string name;                            // empty: there is one
  int spheres = 1;                             // of a grain
  double density = 0;                          // [kg/m^3]
  double youngs_modulus = 0;                   // [Pa]
  double d_min = 0, d_mean = 0;                // smallest and mean diameter [m]; mean by number
  double r_least = 0;                          // [m], of a sphere of the smallest grain
  double rayleigh_min = 0, rayleigh_mean = 0;  // [s], of the smallest and the mean grain
  double at_rest = 0;                          // overlap over d under kLayersAtRest, mean grain
  double impact_speed = 0;                     // [m/s] of the fastest grains; 0: not known
  double at_impact = 0;                        // overlap over d at that speed, mean grain
  double fall_velocity = 0;                    // [m/s] of the mean grain; 0 without a liquid
  double shields = 0;                          // u*^2 / ((s - 1) g d), mean grain; 0 without a flow
  double shields_threshold = 0;                // Soulsby & Whitehouse
};

struct GrainNumbers {
  std::int64_t count = 0, spheres = 0;         // more spheres than grains where there are clumps
  double d_min = 0, d_mean = 0, d_max = 0;     // [m]; mean by number
  double solid_volume = 0;                     // [m^3]
  std::vector<KindNumbers> kinds;              // kinds that there are grains of
  KindNumbers fastest_contacts;                // the kind of the shortest Rayleigh time
  double fraction_min = 0, fraction_mean = 0;  // grain step over its Rayleigh times
  KindNumbers easiest;                         // the kind farthest above its threshold of motion
  double cell_ratio = 0;    // smallest cell length over the mean diameter; 0 without cells
  double floor_ratio = 0;   // height of the lowest row over the mean diameter
  double column_ratio = 0;  // length of a cell along x over the mean diameter
  double width_ratio = 0;   // the smaller of a cell's lengths along x and z over the mean diameter
  double top = 0;           // [m] highest point of the grains; 0: not known
  double top_ratio = 0;     // height of the row there over the mean diameter
  bool as_poured = false;   // the grains are still to settle
};

struct Derived {
  std::int64_t fluid_steps = 0;
  double fluid_step = 0;  // [s]
  int grain_substeps = 1;
  double grain_step = 0;  // [s], the one really taken
  std::optional<FluidNumbers> fluid;
  std::optional<GrainNumbers> grains;  // absent too when no sizes are known
  CouplingScheme scheme = CouplingScheme::layered;
};

/// Derives the numbers of a `config` that has passed validate. `sizes` as of the Case; may be
/// empty. `top`: highest point of the grains [m], 0: not known.
Derived derive(const Config& config, const std::vector<SizeClass>& sizes, double top = 0);

/// Summary in one line: "31680 cells, 3000 grains of 0.15 to 0.25 mm, 2400 steps of 50 grain
/// steps".
std::string summary(const Derived& derived);
/// Numbers in lines for a terminal, each ending in a newline.
std::string to_text(const Derived& derived);

}  // namespace barchan
