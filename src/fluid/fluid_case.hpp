// Flow of a case: its keys, and what is settled.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "kernels/bodies/body.hpp"
#include "kernels/fluid/preconditioners.hpp"

namespace barchan {

enum class Turbulence { none, wale };
enum class WallFlow { no_slip, free_slip };
using Preconditioner = Choice<Preconditioners>;

/// A velocity in the plane of the bed [m/s]. In a case it is a number, along x, or [x, z].
struct PlaneVelocity {
  double x = 0, z = 0;
  // NOLINTNEXTLINE(google-explicit-constructor): as in a case
  constexpr PlaneVelocity(double along_x = 0, double along_z = 0) : x(along_x), z(along_z) {}
  bool operator==(const PlaneVelocity&) const = default;
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

/// [solver]
struct SolverConfig {
  double pressure_tolerance = 1e-6;  // residual over right-hand side, 2-norm
  int max_iterations = 200;
  Preconditioner preconditioner = Preconditioner::of<RelaxedFft>();
  bool operator==(const SolverConfig&) const = default;
};

/// Settled values that a flow is computed from.
struct FluidCase {
  std::filesystem::path file;  // of the case, for messages
  FluidConfig fluid;
  SolverConfig solver;
  std::array<double, 3> size{};      // of the domain [m]
  std::vector<double> row_faces;     // heights, from the floor up [m]
  std::vector<FlowTarget> schedule;  // flow_schedule of `fluid`
  Bodies bodies;
  bool with_grains = false;
};

}  // namespace barchan
