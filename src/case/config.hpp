// Configuration as a typed tree: the sections of all rooms. Defaults live in their structs and
// nowhere else; SI units throughout.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "kernels/fluid/start_flows.hpp"
#include "src/bodies/bodies_case.hpp"
#include "src/coupling/coupling_case.hpp"
#include "src/restart/restart_case.hpp"
#include "src/results/output_case.hpp"

namespace barchan {

enum class HeapShape { cone, ridge, bed };

/// [initial] grains = { pour = {...} }, or one of several [[initial.heap]]: a jittered lattice that
/// settles.
struct HeapConfig {
  std::string name = {};              // in tables and pictures
  HeapShape shape = HeapShape::cone;  // or a ridge across the channel, or a bed over the floor
  std::array<double, 2> centre{};     // x, z [m]; by default Lx/5, Lz/2 of `pour`
  double radius = 0;                  // of a cone's foot, half the width of a ridge's [m]
  std::string kind = {};              // a name of [[grains.kind]]; empty: all of them
  std::vector<SizeClass> sizes = {};  // empty: grains.sizes, or of its kind
  double drop_height = 0;             // lowest grain above what lies there [m]
  double spacing = 1;                 // of the lattice, over the closest
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
  std::optional<HeapConfig> pour = {};
  std::vector<HeapConfig> heaps = {};
  std::vector<CraterConfig> craters = {};
  std::optional<std::array<double, 2>> window = {};  // corner of this box in theirs, [x, z] [m]
  std::uint64_t seed = 1;                            // of the perturbation of "turbulent"
  int realisation = 1;  // of an ensemble: its random numbers are those of seed + realisation - 1
  template <class Flow>
  bool starts_as() const {
    return fluid == Flow::named.word;
  }
  bool operator==(const InitialConfig&) const = default;
};

/// Largest number of heaps: as many as a byte of a grain can name, one value being none.
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

  // Parts that rooms compute with; solvers take them in place of the case. A run has them from its
  // SettledCase.
  // NOLINTBEGIN(google-explicit-constructor): a solver can be made from a case alone
  operator FluidCase() const;
  operator GrainsCase() const;
  operator CoupledCase() const;
  // NOLINTEND(google-explicit-constructor)
};

}  // namespace barchan
