#include "src/coupling/immersed_boundary.hpp"

#include <algorithm>
#include <cmath>

#include "src/parallel/decomposition.hpp"
#include "src/parallel/launch.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

namespace {

constexpr int kLoops = 3;  // of forcing in a step

/// Policy of so many teams. On the host a team is one thread, so that sums do not depend on the
/// number of threads.
Kokkos::TeamPolicy<> teams(int n) {
  if (kOnHost) return {n, 1};
  return {n, Kokkos::AUTO};
}

/// The markers' directions are those of the largest grain: smaller ones have them closer together.
Markers make_markers(Real h, Real r_max) {
  const Real retraction = kRetraction * h;
  const int n = markers_on_sphere((r_max - retraction) / h);
  const Kokkos::View<Vec3*> direction("immersed: markers", static_cast<std::size_t>(n));
  const auto on_host = mirror(direction);
  for (int m = 0; m < n; ++m) on_host(m) = marker_direction(m, n);
  Kokkos::deep_copy(direction, on_host);
  return {.direction = direction, .grains = {}, .retraction = retraction, .n = n};
}

Real width_of_cells(const Grid& grid) { return std::cbrt(grid.dx * (grid.ly / grid.ny) * grid.dz); }

/// Faces that markers reach; those along y have no place on the floor.
GrainPatch patch_of_markers(const Grid& grid, Real reach) {
  GrainPatch patch = GrainPatch::of(grid, reach, kReachOfDelta, grid.ly / grid.ny);
  patch.first_y_face = 1;
  return patch;
}

}  // namespace

ImmersedBoundary::ImmersedBoundary(const Grid& grid, Real density, Real r_max)
    : grid_(grid),
      density_(density),
      h_(width_of_cells(grid)),
      markers_(make_markers(h_, r_max)),
      patch_(patch_of_markers(grid, r_max - markers_.retraction)),
      inside_(GrainPatch::of(grid, r_max + h_ / 2, 0, grid.ly / grid.ny)),
      grains_(grid, patch_) {}

void ImmersedBoundary::place(const GrainState& grains) {
  grains_.place(grains);
  markers_.grains = grains_.kin();
  n_own_ = grains.n, own_ = grains.kin, exchange_ = grains.exchange;
  if (impulse_.extent_int(0) >= grains_.n()) return;
  const auto n = static_cast<std::size_t>(grains_.n() + grains_.n() / 8),
             n_markers = n * static_cast<std::size_t>(markers_.n);
  impulse_ = Kokkos::View<ImpulseOnWater*>("immersed: impulse", n);
  water_ = Kokkos::View<WaterOfGrain*>("immersed: water", n);
  values_ = {.patch = Kokkos::View<Real*>("immersed: patches",
                                          n * static_cast<std::size_t>(patch_.size())),
             .read = Kokkos::View<Vec3*>("immersed: read", n_markers),
             .given = Kokkos::View<Vec3*>("immersed: given", n_markers)};
}

/// With dt = 0 sets the momentum inside alone.
void ImmersedBoundary::set_loads(const FaceVector& u, Real dt) {
  Kokkos::parallel_for(
      "immersed: momentum inside", teams(grains_.n()),
      SumOfInside{
          .inner = {inside_, u}, .grains = markers_.grains, .given = impulse_, .water = water_});
  Kokkos::parallel_for("immersed: loads", items(n_own_),
                       LoadsOnGrains{.grains = own_,
                                     .water = grains_.of_own(water_),
                                     .density = density_,
                                     .dt = dt,
                                     .exchange = exchange_});
}

/// Forcing in loops: what markers give to faces that they share is corrected in the next one.
void ImmersedBoundary::force(const FlowStep& step) {
  const VelocityAhead ahead{.grid = grid_,
                            .u_star = step.u_star,
                            .p = step.fluid.p,
                            .drive = step.fluid.drive,
                            .dt = step.dt,
                            .inv_density = 1 / density_};
  Kokkos::deep_copy(values_.given, Vec3{});
  for (int loop = 0; loop < kLoops; ++loop) {
    Kokkos::parallel_for("immersed: read", teams(grains_.n()),
                         ReadAtMarkers{patch_, markers_, ahead, values_});
    grains_.combine_read(values_.read, markers_.n);
    Kokkos::parallel_for("immersed: spread", teams(grains_.n()),
                         SpreadSlip{patch_, markers_, h_, values_});
    Kokkos::parallel_for("immersed: add to flow", teams(grid_.nz),
                         AddToFlow{.patch = patch_,
                                   .grains = markers_.grains,
                                   .n_grains = grains_.n(),
                                   .patches = values_.patch,
                                   .u_star = step.u_star});
  }
}

void ImmersedBoundary::after_predict(const FlowStep& step) {
  if (step.dt == 0 || !grains_.are_there()) return;
  force(step);
  const Real dy = grid_.ly / grid_.ny, cell_volume = grid_.dx * dy * grid_.dz;
  Kokkos::parallel_for("immersed: impulse", teams(grains_.n()),
                       SumOfMarkers{.markers = markers_,
                                    .h = h_,
                                    .cell_volume = cell_volume,
                                    .density = density_,
                                    .given = values_.given,
                                    .impulse = impulse_});
  Kokkos::parallel_reduce("immersed: flow rate", items(grains_.n_led()),
                          RateTaken{impulse_, dy / (density_ * cell_volume)},
                          step.numbers.into<Vec3>(kTaken));
}

void ImmersedBoundary::after_correct(const FlowStep& step) {
  set_loads(step.fluid.u, step.dt);
  Kokkos::parallel_reduce("immersed: sum of loads", items(n_own_),
                          SumOfLoads{exchange_.resolved_force}, step.numbers.into<Vec3>(kOfTerms));
  step.numbers.combine(ranks_of(grid_), kOfTerms, 3, MPI_SUM);
}

void ImmersedBoundary::report(const DeviceReductions& numbers) {
  force_on_grains_ = numbers.get<Vec3>(kOfTerms);
}

}  // namespace barchan
