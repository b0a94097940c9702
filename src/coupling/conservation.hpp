// The ledger of mass and momentum over a run.
#pragma once

#include <map>
#include <string>

#include "src/coupling/coupling.hpp"
#include "src/grains/grain_state.hpp"

namespace barchan {

/// Adds up what changed sides and keeps the largest mismatch of any step.
class Ledger {
 public:
  /// After each coupled step. Throws std::runtime_error if a grain is unaccounted for.
  void close_step(const ExchangeLedger& step, const GrainState& grains);
  /// Names and values for run.json; momentum along x, y, z [N s], mismatches relative.
  std::map<std::string, double> entries() const;
  double volume_mismatch() const { return volume_; }
  double exchange_mismatch() const { return exchange_; }
  double carried_mismatch() const { return carried_; }

 private:
  Vec3 given_, taken_, implicit_, carried_sum_;
  double volume_ = 0, exchange_ = 0, carried_ = 0;
};

}  // namespace barchan
