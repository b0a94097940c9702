// Bodies at rest in the flow.
#pragma once

#include <vector>

#include "kernels/fluid/body_faces.hpp"
#include "src/bodies/body_load.hpp"
#include "src/fluid/flow_term.hpp"
#include "src/fluid/fluid_case.hpp"
#include "src/fluid/solids.hpp"
#include "src/parallel/halo.hpp"

namespace barchan {

/// Bodies and frozen grains. Direct forcing within the fluid step: faces inside a body are closed,
/// and the friction of its wall acts on the faces next to these, where the wall is
/// (docs/theory-fluid.md, "Bodies"). Nothing changes over a run.
class BodiesInFlow : public FlowTerm {
 public:
  /// `pressure_reach`: cells around closed faces that the pressure solver needs.
  BodiesInFlow(const Solids& solids, const Grid& grid, const Halo& halo, const FluidConfig& config,
               int pressure_reach);

  int count() const { return static_cast<int>(feet_.size()); }
  /// Columns of cells that know of bodies, the same on all ranks.
  const ColumnMap& columns() const { return near_; }
  /// Sets closed faces to zero.
  void close(FaceVector& f) const;
  /// Sets closed cells to zero.
  void close(Field& f) const;
  /// Volume of solid that alpha leaves for closed cells [m^3].
  void add_solid_inside(const Field& alpha, const DeviceReductions& reductions, int slot) const;

  const FlowRegions* regions() const override { return &regions_; }
  /// Makes the old fraction the new one in closed cells, which are not in the flow.
  void correct_fraction(FluidState& fluid) override;
  /// Sets nu_t to zero in bodies.
  void limit_eddies(Field& nu_t) override;
  /// Direct forcing of u* and the mobility. Walls do not slow down in a dt of zero.
  void after_predict(const FlowStep& step) override;
  void after_drive_across(const FlowStep& step) override;
  /// Takes the mean over the fluid away, and sets closed cells to zero. When grains leave, the sum
  /// of the source is not zero, and a periodic box has no pressure for that.
  void constrain_pressure(Field& f, const DeviceReductions& numbers) override;
  void after_correct(const FlowStep& step) override;
  void report(const DeviceReductions& numbers) override;
  bool stop(FaceVector& u) override;

  /// Count of numbers, from kOfTerms on.
  std::size_t numbers() const { return kNumbersOfLoad * feet_.size(); }
  /// Loads of the last step on each, as the host has fetched them.
  const std::vector<BodyLoad>& loads() const { return loads_; }

 private:
  static constexpr int kNumbersOfLoad = 6;
  static constexpr int number_of(int body) { return kOfTerms + kNumbersOfLoad * body; }
  void find_columns(const std::vector<BodyFace>& faces, int pressure_reach);
  int n_faces() const { return faces_.extent_int(0); }
  int n_cells() const { return cells_.extent_int(0); }

  std::vector<Vec3> feet_;  // points of the solids that torques are about [m]
  Grid grid_;
  Real density_;
  Kokkos::View<BodyFace*> faces_;
  std::vector<int> first_face_;  // of each body
  int n_bodies_ = 0;             // bodies of the case; behind them come frozen grains
  Kokkos::View<int*> first_face_of_grain_;
  Kokkos::View<Vec3*> foot_of_grain_;  // [m]
  Kokkos::View<BodyCell*> cells_;
  Real height_of_fluid_ = 0;      // sum of the heights of open cells, over all columns [m]
  Kokkos::View<Real*> unforced_;  // u* at the faces before the direct forcing [m/s]
  ColumnMap near_;
  FlowRegions regions_;
  std::vector<BodyLoad> loads_;
};

}  // namespace barchan
