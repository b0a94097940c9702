// Ledger of mass and momentum that pass between flow and grains.
#pragma once

#include <map>
#include <string>

#include "kernels/coupling/deposit.hpp"
#include "src/grains/grain_state.hpp"
#include "src/parallel/device_reductions.hpp"

namespace barchan {

/// Momentum and volume that passed between flow and grains in one fluid step.
struct ExchangeLedger {
  Real grain_volume = 0, deposited_volume = 0;  // [m^3], before and after the smoothing
  Vec3 given_to_grains;                         // drag and added mass over the grain steps [N s]
  Vec3 taken_from_fluid;                        // deposit on the faces [N s]
  Real largest_exchange = 0;  // bound of the sizes of given and taken momentum, added up [N s]
  bool keeps_volume = true;   // the void fraction model drops none
  Vec3 flow_on_solid;         // pressure gradient and stress on the solid fraction [N s]
  Vec3 flow_on_grains;        // pressure gradient and stress on the grains [N s]
};

/// Sums of a step over cells and grains, on the device until the step needs them.
struct ExchangeSums : DeviceReductions {
  enum Sum : int {
    kTotals,           // GrainTotals
    kFastest = 6,      // fastest flow along x or z [m/s]
    kPressureOnSolid,  // Vec3 [N]
    kStressOnSolid = 10,
    kForceOnGrains = 13,
    kTakenFromFluid = 16,   // [N s]
    kDepositedVolume = 19,  // [m^3]
    kVolumeInBodies,        // part of the deposited volume that lies in bodies
    kSums
  };
  ExchangeSums() : DeviceReductions("ledger: sums", kSums) {}

  /// Combines over all ranks what grains give, and the fastest flow.
  void combine_totals(MPI_Comm ranks) const;
  /// Bound of the impulse that all cells together get, each component by its size [N s]. In layers
  /// grains exchange no more than by twice the fastest velocity along x and z.
  Real largest_exchange() const;
  /// Ledger of a step of dt [s], over all ranks.
  ExchangeLedger ledger(MPI_Comm ranks, Real dt) const;
};

/// Sums of the exchange over a run, and the largest mismatch of any step.
class Ledger {
 public:
  Ledger() { add({}); }
  /// Books a coupled step. Throws std::runtime_error if a grain is unaccounted for, or more volume
  /// or momentum than rounding leaves.
  void close_step(const ExchangeLedger& step, const GrainState& grains);
  /// Names and values for run.json; momentum along x, y, z [N s], mismatches relative.
  const std::map<std::string, double>& entries() const { return entries_; }

 private:
  static void expect_closed(const ExchangeLedger& step);
  void add(const ExchangeLedger& step);

  std::map<std::string, double> entries_;
};

}  // namespace barchan
