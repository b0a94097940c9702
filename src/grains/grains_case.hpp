// Keys of a case about its grains.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernels/bodies/body.hpp"
#include "kernels/grains/law_table.hpp"
#include "src/grains/clump_shape.hpp"

namespace barchan {

using ContactModel = Choice<ContactModels>;
using RollingModel = Choice<RollingModels>;
enum class CoulombLimit { total, elastic };  // normal force that limits friction
enum class GrainBoundaryX { exit, periodic, wall, follow };
enum class GrainBoundaryZ { periodic, wall };
enum class GrainFloor { smooth, glued };
enum class FeedAmount { given, as_lost };
enum class GrainShape { sphere, clump };
enum class NamedClump { dimer, tetrahedron, cube, sand };

/// [grains] material; [grains.wall] overrides what it names.
struct Material {
  double youngs_modulus = 5e6;  // [Pa]
  double poisson_ratio = 0.45;
  double restitution = 0.1;
  double sliding_friction = 0.6;
  double rolling_friction = 0.0;
  bool operator==(const Material&) const = default;
};

/// Shape of the grains of a kind: spheres, or rigid clumps of spheres.
struct ShapeConfig {
  GrainShape shape = GrainShape::sphere;
  std::vector<ClumpSphere> spheres = {};  // of a clump, in any unit of length,
  std::optional<NamedClump> clump = {};   // or its name
  bool operator==(const ShapeConfig&) const = default;
};

struct SizeClass {
  double diameter = 0;  // [m]
  std::int64_t count = 0;
  int kind = 0;     // its entry of [[grains.kind]]
  double wide = 1;  // diameter of the sphere around a grain, over `diameter`
  bool operator==(const SizeClass&) const = default;
};

/// [grains.ambient]: still fluid around the grains of a run without [fluid]
/// (buoyancy, Schiller-Naumann drag, added mass).
struct AmbientConfig {
  double density = 1000;              // [kg/m^3]
  double kinematic_viscosity = 1e-6;  // [m^2/s]
  bool operator==(const AmbientConfig&) const = default;
};

/// [[grains.kind]]: grains of a material of their own.
struct KindConfig {
  std::string name;              // required
  double density = 2500;         // [kg/m^3]; this and what follows default to that of [grains]
  Material material;             // keys directly in [[grains.kind]]
  ShapeConfig shape = {};        // likewise; not as in [grains]
  std::vector<SizeClass> sizes;  // for `pour`
  bool operator==(const KindConfig&) const = default;
};

/// [[grains.pair]]: contacts of two kinds with each other, instead of the mixing rules.
struct PairConfig {
  std::array<std::string, 2> kinds{};  // names, required
  std::optional<double> restitution = {}, sliding_friction = {}, rolling_friction = {};
  bool operator==(const PairConfig&) const = default;
};

/// [grains.feed]: grains that come in at the inlet.
struct FeedConfig {
  FeedAmount amount = FeedAmount::given;  // or as many as have left
  double rate = 0;                        // [1/s], of amount = "given", then required
  double start = 0;                       // [s]
  double x = 0;                           // place where they come in [m]
  std::array<double, 2> across{};         // z from, z to [m]; both 0: over the whole width
  double height = 0;                      // height of the lowest of them above the floor [m]
  std::uint64_t seed = 1;
  bool operator==(const FeedConfig&) const = default;
};

/// [grains]
struct GrainConfig {
  double density = 2500;   // [kg/m^3]
  Material material;       // keys directly in [grains]
  ShapeConfig shape = {};  // likewise
  Material wall;           // [grains.wall], defaults to `material`
  CoulombLimit coulomb_limit = CoulombLimit::total;
  RollingModel rolling_model = RollingModel::of<Epsd2>();
  double rolling_theta_m = 0.1;  // [rad], angle of incipient rolling of the theta_m model (A13)
  ContactModel contact_model = ContactModel::of<HertzMindlin>();
  double tangential_damping = 1;  // factor on the dashpots along contacts
  double thinnest_film = 3e-3;    // over the radius; contact_model = "hertz_lubricated" only
  double linear_stiffness = 0;    // [N/m], contact_model = "linear" only, then required
  std::vector<SizeClass> sizes;   // for `pour`; otherwise the initial file decides
  bool frozen = false;
  GrainBoundaryX boundary_x = GrainBoundaryX::exit;
  GrainBoundaryZ boundary_z = GrainBoundaryZ::periodic;
  GrainFloor floor = GrainFloor::smooth;
  double floor_diameter = 0;  // [m] of the spheres of a glued floor, which needs it
  std::array<double, 3> gravity{0, -9.81, 0};  // [m/s^2]
  double skin = 4e-5;                          // [m], Verlet skin; in a case 0.2 d by default
  // overlap over a pair's mean diameter, or over a grain's in a wall; more stops the run
  double max_overlap = 0.1;
  std::optional<AmbientConfig> ambient = {};
  std::vector<KindConfig> kinds = {};  // empty: all grains are of one kind
  std::vector<PairConfig> pairs = {};
  std::optional<FeedConfig> feed = {};
  bool operator==(const GrainConfig&) const = default;
};

/// Switches of coupling.forces; by default those of the paper.
struct ForceSwitches {
  bool drag = true, pressure_gradient = true, stress = true, added_mass = true, buoyancy = true;
  bool lift = false, torque = false, wall_drag = false, mixture_viscosity = false;
  bool operator==(const ForceSwitches&) const = default;
};

/// The water between surfaces that approach, for a contact model that knows it.
struct Film {
  double viscosity = 0;  // [Pa s]
  double reach = 0;      // gap from which it acts [m]
};

/// Input of the grain solver, settled once.
struct GrainsCase {
  GrainConfig grains;
  Film film{};
  std::array<double, 3> size{};  // size of the domain [m]
  // half the width of the strip around the edge of a window that follows its dune [m]
  double half_edge_strip = 0;
  double fluid_step = 0;      // [s]
  bool keeps_forces = false;  // keeps the force of each pair, for output
  Bodies bodies;
  std::vector<std::string> body_names;
};

/// Tells if grains leave along x: at the ends, or at the edge of a window that follows its dune.
bool grains_leave(const GrainConfig& grains);
/// Tells if grains that go beyond one end in x come in at the other.
bool is_periodic_x(const GrainConfig& grains);

}  // namespace barchan
