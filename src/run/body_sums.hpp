// Loads on the bodies, for bodies.csv.
#pragma once

#include <cstdint>
#include <vector>

#include "src/coupling/coupled_step.hpp"
#include "src/diagnostics/body_table.hpp"
#include "src/restart/checkpoint.hpp"

namespace barchan {

/// Sums over fluid steps since the last lines of bodies.csv. All ranks call every member together.
class BodySums {
 public:
  explicit BodySums(std::size_t n_bodies) : water_(n_bodies), grains_(n_bodies) {}

  bool any() const { return !water_.empty(); }
  /// Adds the loads of the last step.
  void add(const CoupledStep& step);
  /// Records of each body, with the means since the last call; `contacts` are the present ones.
  std::vector<BodyRecord> take(double t, const CoupledStep& step);

  void save(CheckpointWriter& file) const;
  void load(const CheckpointReader& file);

 private:
  std::vector<BodyLoad> water_, grains_;  // sums [N], [N m]
  std::int64_t steps_ = 0;
};

}  // namespace barchan
