// Means and second moments of the flow in every cell over a window of time (flow_average.h5).
#pragma once

#include <array>
#include <vector>

#include "kernels/diagnostics/flow_statistics.hpp"
#include "src/fluid/fluid_state.hpp"
#include "src/restart/checkpoint.hpp"
#include "src/results/output_files.hpp"

namespace barchan {

/// The arrays of flow_average.h5, in the order of FlowMoment.
std::vector<Output> flow_moment_outputs();

class FlowAverage {
 public:
  explicit FlowAverage(const Grid& grid);

  /// Adds the flow at t to the sums. Its ghosts must be valid.
  void sample(const FluidState& fluid, double t);

  /// Means u, v, w, p, alpha_f, nu_t and moments uu, vv, ww, uv, uw, vw, in this order; empty
  /// without samples.
  std::vector<NamedField> means();
  /// Replaces flow_average.h5; does nothing without samples.
  void write(const OutputFiles& output, double t, std::int64_t step);

  void save(CheckpointWriter& file) const;
  /// Reads the sums of a restart file. If it has none, the averages start anew.
  void load(const CheckpointReader& file);

 private:
  template <class F>
  void for_each_saved(const F& f) const;
  static FlowSums refs(std::array<Field, n_flow_moments>& fields);

  Grid grid_;
  std::array<Field, n_flow_moments> sum_;
  std::array<Field, 3> first_;                // velocity at the first sample [m/s]
  std::array<Field, n_flow_moments> result_;  // made when first asked for
  std::int64_t n_samples_ = 0;
  double start_ = 0;  // time of the first sample [s]
};

}  // namespace barchan
