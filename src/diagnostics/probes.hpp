// Probes: points of a case at which the flow is read (probes.csv).
#pragma once

#include <span>
#include <vector>

#include "kernels/diagnostics/flow_at_points.hpp"
#include "src/case/settled.hpp"
#include "src/diagnostics/probe_table.hpp"
#include "src/fluid/fluid_state.hpp"

namespace barchan {

/// Points of a probe in their order [m].
std::vector<Vec3> points_of(const ProbeConfig& probe);

/// Throws InputError if a point lies in a body of the case.
void check_probes(const SettledCase& the_case);

/// All probes of a case. Its memory is allocated once.
class Probes {
 public:
  explicit Probes(const Config& config);

  std::size_t count() const { return probes_.size(); }
  /// Flow at the points of probe n at t [s], on all ranks, which call this together. Valid until
  /// the next call.
  std::span<const ProbeRecord> sample(std::size_t n, const FluidState& fluid, double t);

 private:
  struct Probe {
    Kokkos::View<Vec3*> points;
    Kokkos::View<FlowAtPoint*> values;
    Kokkos::View<FlowAtPoint*>::host_mirror_type on_host;
    std::vector<ProbeRecord> rows;
  };
  Real wall_viscosity_ = 0;  // [Pa s]
  std::vector<Probe> probes_;
};

}  // namespace barchan
