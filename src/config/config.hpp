// The configuration as a typed tree. Defaults live here and nowhere else; SI units throughout.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/config/choices.hpp"
#include "src/config/coupling_config.hpp"

namespace barchan {

/// A velocity in the plane of the bed [m/s]. In a case it is a number, along x, or [x, z].
struct PlaneVelocity {
  double x = 0, z = 0;
  // NOLINTNEXTLINE(google-explicit-constructor): as in a case
  constexpr PlaneVelocity(double along_x = 0, double along_z = 0) : x(along_x), z(along_z) {}
  bool operator==(const PlaneVelocity&) const = default;
};

/// [time]
struct TimeConfig {
  double end = 0;               // [s], required
  double fluid_step = 2.5e-4;   // [s]; in a case both steps are chosen by default (steps.hpp)
  double grain_step = 2.5e-6;   // [s]; fluid_step is cut into ceil(fluid_step / grain_step)
  double wall_clock_limit = 0;  // [s] of wall time, 0: none; then a restart and exit code 3
  bool operator==(const TimeConfig&) const = default;
};

/// [[fluid.schedule]]: the bulk velocity from a time on.
struct FlowTarget {
  double time = 0;            // [s], required
  PlaneVelocity velocity{};   // [m/s], required
  double ramp = 0;            // [s] over which it is reached from the one before
  PlaneVelocity amplitude{};  // [m/s] of an oscillation about it, a sine from its time on
  double period = 0;          // [s] of the oscillation
  bool operator==(const FlowTarget&) const = default;
};

/// [fluid]
struct FluidConfig {
  std::array<int, 3> cells{};                    // nx, ny, nz, required
  double first_cell_height = 0;                  // [m]; 0: uniform in y
  double uniform_height = 0;                     // [m] up to which rows are as high as the first
  double density = 1000;                         // [kg/m^3]
  double kinematic_viscosity = 1e-6;             // [m^2/s]
  PlaneVelocity mean_velocity{};                 // [m/s], held by a body force
  std::optional<double> pressure_gradient = {};  // [Pa/m], instead of mean_velocity
  double ramp_time = 0;  // [s] over which mean_velocity is brought up from its start
  std::vector<FlowTarget> schedule = {};  // in order of time, instead of mean_velocity
  Turbulence turbulence = Turbulence::wale;
  double wale_constant = 0.325;
  WallFlow bottom = WallFlow::no_slip;
  WallFlow top = WallFlow::free_slip;
  double top_velocity = 0;  // [m/s] along x, of a no-slip top: a lid that drags the flow
  bool operator==(const FluidConfig&) const = default;
};

/// [grains] material; [grains.wall] overrides what it names.
struct Material {
  double youngs_modulus = 5e6;  // [Pa]
  double poisson_ratio = 0.45;
  double restitution = 0.1;
  double sliding_friction = 0.6;
  double rolling_friction = 0.0;
  bool operator==(const Material&) const = default;
};

struct SizeClass {
  double diameter = 0;  // [m]
  std::int64_t count = 0;
  int kind = 0;  // entry of [[grains.kind]] that they are of
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
  double x = 0;                           // [m] where they come in
  std::array<double, 2> across{};         // z from, z to [m]; both 0: over the whole width
  double height = 0;                      // [m] of the lowest of them above the floor
  std::uint64_t seed = 1;
  bool operator==(const FeedConfig&) const = default;
};

/// [grains]
struct GrainConfig {
  double density = 2500;  // [kg/m^3]
  Material material;      // keys directly in [grains]
  Material wall;          // [grains.wall], defaults to `material`
  CoulombLimit coulomb_limit = CoulombLimit::total;
  RollingModel rolling_model = RollingModel::of<Epsd2>();
  double rolling_theta_m = 0.1;  // [rad], angle of incipient rolling of the theta_m model (A13)
  ContactModel contact_model = ContactModel::of<HertzMindlin>();
  double linear_stiffness = 0;   // [N/m], contact_model = "linear" only, then required
  std::vector<SizeClass> sizes;  // for `pour`; otherwise the initial file decides
  bool frozen = false;
  GrainBoundaryX boundary_x = GrainBoundaryX::exit;
  GrainBoundaryZ boundary_z = GrainBoundaryZ::periodic;
  GrainFloor floor = GrainFloor::smooth;
  double floor_diameter = 0;  // [m] of the spheres of a glued floor, which needs it
  std::array<double, 3> gravity{0, -9.81, 0};  // [m/s^2]
  double skin = 4e-5;                          // [m], Verlet skin; in a case 0.2 d by default
  double max_overlap = 0.1;  // over a pair's mean diameter, a grain's in a wall; more stops the run
  std::optional<AmbientConfig> ambient = {};
  std::vector<KindConfig> kinds = {};  // none: all grains are of one kind
  std::vector<PairConfig> pairs = {};
  std::optional<FeedConfig> feed = {};
  bool operator==(const GrainConfig&) const = default;
};

/// [initial] grains = { pour = {...} }: a jittered lattice above the floor that settles.
struct PourConfig {
  PourShape shape = PourShape::cone;         // or a bed over the whole floor
  std::array<double, 2> centre{0.04, 0.05};  // x, z [m]; in a case Lx/5, Lz/2 by default
  double radius = 0;                         // of the unrelaxed cone's foot [m]
  double drop_height = 0;                    // lowest grain above the floor [m]
  std::uint64_t seed = 1;
  bool operator==(const PourConfig&) const = default;
};

/// [[initial.heap]]: one of several heaps that are poured, instead of `pour`.
struct HeapConfig {
  std::string name;                   // in tables and pictures
  HeapShape shape = HeapShape::cone;  // or a ridge across the channel, or a bed over the floor
  std::array<double, 2> centre{};     // x, z [m]; of a ridge x alone counts
  double radius = 0;                  // of a cone's foot, half the width of a ridge's [m]
  std::string kind;                   // a name of [[grains.kind]]; empty: all of them
  std::vector<SizeClass> sizes;       // empty: grains.sizes, or those of its kind
  double drop_height = 0;             // lowest grain above what lies there [m]
  std::uint64_t seed = 1;
  bool operator==(const HeapConfig&) const = default;
};

/// [[initial.crater]]: a hollow, a paraboloid without grains.
struct CraterConfig {
  std::array<double, 2> centre{};  // x, z [m], required
  double radius = 0;               // of its rim [m], required
  double depth = 0;                // [m], required
  bool operator==(const CraterConfig&) const = default;
};

/// [initial]
struct InitialConfig {
  std::filesystem::path fluid = StillFlow::named.word;  // or of another start flow, or a path
  std::filesystem::path grains = {};                    // an absolute path; empty with `pour`
  std::optional<PourConfig> pour = {};
  std::vector<HeapConfig> heaps = {};
  std::vector<CraterConfig> craters = {};
  std::uint64_t seed = 1;  // of the perturbation of "turbulent"
  int realisation = 1;     // of an ensemble: its random numbers are those of seed + realisation - 1
  template <class Flow>
  bool starts_as() const {
    return fluid == Flow::named.word;
  }
  bool operator==(const InitialConfig&) const = default;
};

/// [[body]]: a solid at rest in the flow and among the grains. Which keys a shape takes it says
/// itself. Lengths of 0 are not given.
struct BodyConfig {
  std::string name;                // in tables and pictures, required
  BodyShape shape;                 // required
  std::array<double, 2> centre{};  // x, z of its middle; of a dune of its crest [m]
  double base = 0;                 // of its underside above the floor [m]
  Axis axis = Axis::y;             // of a cylinder
  double radius = 0;               // of a cylinder, a sphere, a fence's posts [m]
  double height = 0;               // [m]; of a wave from trough to crest
  double length = 0;               // of a lying cylinder; of a fence between end posts [m]
  std::array<double, 2> size{};    // of a box, a dune: along x, along z [m]
  double lee = 0;                  // length of a dune's lee side, of all its length [m]
  double spacing = 0;              // of a fence's posts, between their axes [m]
  double wavelength = 0;           // [m]
  double angle = 0;                // by which box and fence are turned from x to z [rad]
  bool operator==(const BodyConfig&) const = default;
};

/// [[output.probe]]: a point, or points at equal distances on a line, at which the flow is written.
struct ProbeConfig {
  std::string name;  // in tables and pictures, required
  std::optional<std::array<double, 3>> at = {}, from = {}, to = {};  // or a line's ends [m]
  int points = 0;                                                    // of a line, with its ends
  double interval = 0.01;                                            // [s]
  bool operator==(const ProbeConfig&) const = default;
};

/// [[output.slice]]: the layer of cells at a place, with all fields of the flow.
struct SliceConfig {
  std::string name;  // of its file, required
  Axis normal = Axis::y;
  double at = 0;          // place along the normal [m], required
  double interval = 0.1;  // [s]
  bool operator==(const SliceConfig&) const = default;
};

/// [output], intervals in simulated seconds; 0 turns a file off.
struct OutputConfig {
  double history_interval = 0.01;
  double dune_interval = 0.05;
  double grains_interval = 0.1;
  double fields_interval = 0.5;
  double tracks_interval = 0;  // ids and positions alone, in tracks.h5
  bool grain_forces = false;   // each force separately in grains.h5
  std::vector<ProbeConfig> probes = {};
  std::vector<SliceConfig> slices = {};
  bool operator==(const OutputConfig&) const = default;
};

/// [restart]
struct RestartConfig {
  double interval = 0;         // simulated seconds, 0: off
  double wall_interval = 600;  // wall seconds, 0: off
  int keep = 2;
  bool operator==(const RestartConfig&) const = default;
};

/// [statistics]: averages over time; those over planes always. Off without the section.
struct StatisticsConfig {
  double start = 0;           // [s], required
  double interval = 0.01;     // between samples [s]
  bool fields = false;        // means and second moments of the flow in every cell
  bool grain_forces = false;  // resultant force on the grains in polar bins around the main dune
  bool operator==(const StatisticsConfig&) const = default;
};

/// [solver]
struct SolverConfig {
  double pressure_tolerance = 1e-6;  // residual over right-hand side, 2-norm
  int max_iterations = 200;
  Preconditioner preconditioner = Preconditioner::of<RelaxedFft>();
  bool operator==(const SolverConfig&) const = default;
};

/// The most that a byte of a grain can name, one value being none.
inline constexpr int kMostHeaps = 255;

struct Config {
  std::filesystem::path file;  // where it came from
  std::string title;           // [case] title
  std::string notes;           // [case] notes, free text
  TimeConfig time;
  std::array<double, 3> size{};  // [domain] size = [Lx, Ly, Lz] [m]
  std::optional<FluidConfig> fluid;
  std::optional<GrainConfig> grains;
  std::vector<BodyConfig> bodies = {};
  CouplingConfig coupling;
  InitialConfig initial;
  OutputConfig output;
  RestartConfig restart;
  SolverConfig solver;
  std::optional<StatisticsConfig> statistics = {};
  bool operator==(const Config&) const = default;
};

}  // namespace barchan
