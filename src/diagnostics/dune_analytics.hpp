#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "src/diagnostics/dune_shape.hpp"

namespace barchan {

/// Measures the dunes time after time and keeps what needs memory: labels, celerity, losses.
///
/// A dune keeps its label by being the nearest to the last centroid (pairs are taken in order of
/// distance, none farther than the larger of W and L), so the heavier part of a dune that splits
/// keeps the name, and so does the heavier of two that merge; others get a new label, never one
/// used before. A label missing twice running and for longer than the celerity window is given up.
/// Celerity is the least-squares slope of Cx over the window, at least the last two times.
class DuneTracker {
 public:
  explicit DuneTracker(const DuneDomain& domain, const DuneCriteria& criteria = {})
      : domain_(domain), criteria_(criteria) {}

  /// Measures the dunes at time t; returns one record per dune, in order of label. Times must not
  /// go back further than a restart does: samples at or after t are forgotten. The first call fixes
  /// the initial number of grains; n_fed have come in since the run began.
  std::vector<DuneRecord> update(double t, GrainCloud grains, std::int64_t n_fed = 0);

  /// Label of the dune of each grain, as an update now would give it and the last one did; -1: in
  /// no dune.
  [[nodiscard]] std::vector<int> labels(GrainCloud grains) const;

  /// Memory of the tracker as plain numbers for restart files; set_state() restores it exactly and
  /// throws std::runtime_error if the numbers are not from state().
  [[nodiscard]] std::vector<double> state() const;
  void set_state(std::span<const double> numbers);

 private:
  struct Sample {
    double t, x;  // x without the jumps of a periodic direction
  };
  struct Track {
    int label = 0;
    bool missed = false;                   // dune not seen at the last time
    double x = 0.0, z = 0.0, reach = 0.0;  // last centroid; largest distance of the next
    std::deque<Sample> samples{};
  };

  void forget(double t);
  [[nodiscard]] std::vector<int> match(const std::vector<DuneRecord>& records) const;
  void extend(Track& track, double t, const DuneRecord& record) const;

  DuneDomain domain_;
  DuneCriteria criteria_;
  std::vector<Track> tracks_;
  int next_label_ = 0;
  std::int64_t n_initial_ = -1, n_lost_ = 0;  // n_initial_ -1: no call yet
};

}  // namespace barchan
