// Workloads: configurations, settled heaps, and the case that is being run.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "src/case/config.hpp"
#include "src/coupling/coupled_step.hpp"

namespace barchan {

/// Workload, before it is set up.
struct CaseSpec {
  std::string name;  // also the key under which the running case is kept
  Config config;
  std::string heap = {};            // "heap_100k", "heap_10k", "lattice" (nothing touches) or none
  std::filesystem::path dune = {};  // restart file to go on from, in place of a heap
  int heaps_in_a_row = 1;           // copies along x, each in a box of the size of `config`
  bool rebuild_each_step = false;
  int untimed_steps = 2;  // CoupledStep::advance before the first timed one
};

/// Grains alone as the peers run them: no fluid, gravity 5.886 m/s^2, skin 2e-5 m, 100 grain steps
/// of 2.5e-6 s in one advance.
CaseSpec grains_alone(const std::string& name, const std::string& heap, double rolling_friction);
/// Ten heaps of 100,000 grains in a row, to measure the cost of a grain among ten times as many.
CaseSpec ten_heaps();
/// Mesh 1, 2 or 3 of the paper (250 x 30, 45 or 60 x 63 cells), WALE, bulk velocity 0.28 m/s,
/// perturbed log law.
CaseSpec channel_flow(const std::string& name, int mesh);
/// Heap on one of these meshes, 100 grain steps in a fluid step of 2.5e-4 s.
CaseSpec heap_in_channel(const std::string& name, const std::string& heap, int mesh);
/// Case configs/barchan-10k.toml, from a perturbed flow over a heap at rest.
CaseSpec shipped_10k(const std::string& name);
/// Moving dune: the run of a restart file goes on.
CaseSpec moving_dune(const std::string& name, const std::filesystem::path& restart);
/// Grains of a moving dune alone, from the same places and velocities, with the weight that they
/// have in the fluid.
CaseSpec moving_grains(const std::string& name, const std::filesystem::path& restart);

/// Case that is set up and warm.
class RunningCase {
 public:
  explicit RunningCase(const CaseSpec& spec);
  void advance();

  int grains() const { return state.grains ? state.grains->n : 0; }
  double cells() const;
  std::int64_t bytes() const { return bytes_; }  // memory of its arrays, once it is warm
  double per_grain(std::int64_t count) const { return static_cast<double>(count) / grains(); }

  CaseSpec spec;
  std::string grains_source;  // file, or "settled here"
  SystemState state;
  std::unique_ptr<CoupledStep> step;

 private:
  void put_grains();

  std::int64_t bytes_ = 0;
};

/// Case of this name, set up unless it is the one that ran last: benchmarks that share it and the
/// repetitions of one go on where the last stopped.
RunningCase& running_case(const CaseSpec& spec);
/// Drops the running case; to be called before Kokkos ends.
void drop_running_case();

}  // namespace barchan
