// Bodies at rest in the flow.
#pragma once

#include <vector>

#include "kernels/fluid/body_faces.hpp"
#include "src/bodies/body_load.hpp"
#include "src/fluid/exchange_on_faces.hpp"
#include "src/fluid/fluid_case.hpp"
#include "src/fluid/fluid_state.hpp"
#include "src/fluid/solids.hpp"
#include "src/parallel/device_reductions.hpp"
#include "src/parallel/halo.hpp"

namespace barchan {

/// Bodies and frozen grains. Direct forcing within the fluid step: faces inside a body are closed,
/// and the friction of its wall acts on the faces next to these, where the wall is
/// (docs/theory-fluid.md, "Bodies"). Nothing changes over a run.
class BodiesInFlow {
 public:
  BodiesInFlow(const Solids& solids, const Grid& grid, const Halo& halo, const FluidConfig& config);

  int count() const { return static_cast<int>(feet_.size()); }
  /// The columns of cells that know of bodies, the same on all ranks.
  const ColumnMap& columns() const { return near_; }
  /// Of a flow without grains.
  const FlowRegions& regions() const { return regions_; }

  /// Stops the water that runs in bodies. Whether there was any: the same on all ranks.
  bool stop(FaceVector& u) const;
  /// Zero on closed faces.
  void close(FaceVector& f) const;
  /// Zero in closed cells.
  void close(Field& f) const;
  /// alpha_before becomes alpha in closed cells: what stands there is not in the flow.
  void forget_change(const Field& alpha, Field& alpha_before) const;
  /// The volume of solid that alpha leaves for closed cells [m^3].
  void add_solid_inside(const Field& alpha, const DeviceReductions& reductions, int slot) const;
  /// No eddies in bodies.
  void clear(Field& nu_t) const;
  /// Predicted velocity and mobility of a step of dt; what flow rate and response they lose goes to
  /// three numbers from `lost` on. Of a dt of zero walls do not slow down what they do not stop.
  void hold_back(FaceVector& u_star, FaceVector& c, const Field& alpha, Real dt,
                 const DeviceReductions& reductions, int lost);
  /// After a drive f_z dt has acted on all faces.
  void hold_back_across(Field& u_z, Real drive_dt, Real dt) const;
  /// Takes the mean over the water from a cell field, and sets it to zero in closed cells;
  /// `number`: room for one. For the pressure, and for its source: when grains leave, the sum of
  /// the source is not zero, and a periodic box has no pressure for that.
  void take_mean_away(Field& f, const DeviceReductions& reductions, int number) const;

  static constexpr int kNumbersOfLoad = 6;
  /// Of a step: kNumbersOfLoad for each body, from `first` on.
  void add_loads(const FluidState& fluid, Real dt, const DeviceReductions& reductions,
                 int first) const;
  /// As they were fetched.
  std::vector<BodyLoad> loads(const DeviceReductions& reductions, int first) const;

 private:
  void find_columns(const std::vector<BodyFace>& faces);
  int n_faces() const { return faces_.extent_int(0); }
  int n_cells() const { return cells_.extent_int(0); }

  std::vector<Vec3> feet_;  // of the solids: what torques are about [m]
  Grid grid_;
  Real density_;
  Kokkos::View<BodyFace*> faces_;
  std::vector<int> first_face_;  // of each body
  int n_bodies_ = 0;             // those of the case; behind them come frozen grains
  Kokkos::View<int*> first_face_of_grain_;
  Kokkos::View<Vec3*> foot_of_grain_;  // [m]
  Kokkos::View<BodyCell*> cells_;
  Real height_of_water_ = 0;  // of the cells that are not closed, over all columns [m]
  Kokkos::View<Real*> free_;  // u* at the faces before it was held back [m/s]
  ColumnMap near_;
  FlowRegions regions_;
};

}  // namespace barchan
