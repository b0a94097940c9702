#include "src/fluid/bodies_in_flow.hpp"

#include <algorithm>

#include "kernels/fluid/conjugate_gradients.hpp"
#include "kernels/fluid/flow_sums.hpp"
#include "src/fluid/body_faces.hpp"
#include "src/fluid/pressure_solver.hpp"
#include "src/parallel/cell_reductions.hpp"
#include "src/parallel/mirror.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

/// A sum over the cells of the water becomes the mean over them.
struct FindMeanOfWater {
  Real* number;
  Real height;
  KOKKOS_FUNCTION void operator()(int) const { *number /= height; }
};

}  // namespace

BodiesInFlow::BodiesInFlow(const Solids& solids, const Grid& grid, const Halo& halo,
                           const FluidConfig& config)
    : grid_(grid), density_(config.density), regions_(grid) {
  const BodyFaces found = find_body_faces(solids, grid, halo, config.kinematic_viscosity);
  faces_ = to_device("bodies: faces", found.faces);
  cells_ = to_device("bodies: cells", found.cells);
  free_ = Kokkos::View<Real*>("bodies: free velocity", found.faces.size());
  for (int body = 0; body <= solids.count(); ++body) {
    if (body < solids.count()) feet_.push_back(solids.foot(body));
    const auto first =
        std::partition_point(found.faces.begin(), found.faces.end(),
                             [body](const BodyFace& face) { return face.body < body; });
    first_face_.push_back(static_cast<int>(first - found.faces.begin()));
  }
  Real closed = 0;
  const HostGrid rows = grid.on_host();
  for (const BodyCell& cell : found.cells)
    if (cell.closed) closed += rows.dy(cell.j);
  height_of_water_ = grid.height_of_all_columns() - sum_over(ranks_of(grid), closed);
  find_columns(found.faces);
  n_bodies_ = solids.count() - solids.grains();
  first_face_of_grain_ = to_device("bodies: faces of grains",
                                   std::vector(first_face_.begin() + n_bodies_, first_face_.end()));
  foot_of_grain_ = to_device("bodies: grains", std::vector(feet_.begin() + n_bodies_, feet_.end()));
}

/// Those whose cells have such faces, and as many around as the pressure equation looks at.
void BodiesInFlow::find_columns(const std::vector<BodyFace>& faces) {
  const ColumnMarks marks("bodies: columns", grid_, 1);
  const int last = grid_.nx_all * grid_.nz_all;
  for (const BodyFace& face : faces) {
    marks.on_host(0, grid_.i_begin + face.i + grid_.nx_all * (grid_.k_begin + face.k)) = 1;
    marks.on_host(0, last) = std::max(marks.on_host(0, last), face.j + 1);
  }
  near_ = ColumnMap::marked(grid_, marks, 0);
  near_ = near_.dilated(1 + kCellsAroundObstructed).padded_to_blocks();
  regions_.fraction.set(near_);
  regions_.exchange.set({});
}

bool BodiesInFlow::stop(FaceVector& u) const {
  Real ran = 0;
  Kokkos::parallel_reduce("bodies: stop", items(n_faces()), StopInBodies{faces_.data(), u}, ran);
  return sum_over(ranks_of(grid_), ran) > 0;
}

void BodiesInFlow::close(FaceVector& f) const {
  Kokkos::parallel_for("bodies: close faces", items(n_faces()), CloseBodyFaces{faces_.data(), f});
}

void BodiesInFlow::close(Field& f) const {
  Kokkos::parallel_for("bodies: close cells", items(n_cells()),
                       ClearInBodies{cells_.data(), f, true});
}

void BodiesInFlow::forget_change(const Field& alpha, Field& alpha_before) const {
  Kokkos::parallel_for("bodies: no change", items(n_cells()),
                       CopyInBodies{cells_.data(), alpha, alpha_before});
}

void BodiesInFlow::add_solid_inside(const Field& alpha, const DeviceReductions& reductions,
                                    int slot) const {
  Kokkos::parallel_reduce("bodies: solid inside", items(n_cells()),
                          SolidInBodies{grid_, cells_.data(), alpha}, reductions.into(slot));
}

void BodiesInFlow::clear(Field& nu_t) const {
  Kokkos::parallel_for("bodies: no eddies", items(n_cells()),
                       ClearInBodies{cells_.data(), nu_t, false});
}

void BodiesInFlow::hold_back(FaceVector& u_star, FaceVector& c, const Field& alpha, Real dt,
                             const DeviceReductions& reductions, int lost) {
  Kokkos::parallel_reduce("bodies: hold back", items(n_faces()),
                          HoldBack{.grid = grid_,
                                   .faces = faces_.data(),
                                   .alpha = alpha,
                                   .u_star = u_star,
                                   .c = c,
                                   .free = free_.data(),
                                   .dt = dt},
                          reductions.into<Vec3>(lost));
}

void BodiesInFlow::hold_back_across(Field& u_z, Real drive_dt, Real dt) const {
  Kokkos::parallel_for("bodies: hold back across", items(n_faces()),
                       HoldBackAcross{faces_.data(), u_z, drive_dt, dt});
}

void BodiesInFlow::take_mean_away(Field& f, const DeviceReductions& reductions, int number) const {
  close(f);
  sum_each_cell("bodies: mean of the water", reductions, number, owned_cells(grid_),
                HeightSum{grid_, f});
  reductions.combine(ranks_of(grid_), number, 1, MPI_SUM);
  Kokkos::parallel_for("bodies: mean of the water", items(1),
                       FindMeanOfWater{reductions.data() + number, height_of_water_});
  for_each_cell("bodies: mean of the water", grid_, Subtract{f, reductions.scalar(number)});
  close(f);
}

void BodiesInFlow::add_loads(const FluidState& fluid, Real dt, const DeviceReductions& reductions,
                             int first) const {
  const LoadOnBody all{.grid = grid_,
                       .faces = faces_.data(),
                       .free = free_.data(),
                       .u = fluid.u,
                       .p = fluid.p,
                       .alpha = fluid.alpha_f,
                       .foot = {},
                       .drive = {fluid.drive.x, 0, fluid.drive.z},
                       .density = density_,
                       .dt = dt};
  for (int body = 0; body < n_bodies_; ++body) {
    const int begin = first_face_[static_cast<std::size_t>(body)];
    const int end = first_face_[static_cast<std::size_t>(body) + 1];
    LoadOnBody load = all;
    load.faces += begin, load.free += begin;
    load.foot = feet_[static_cast<std::size_t>(body)];
    Kokkos::parallel_reduce("bodies: load", items(end - begin), load,
                            reductions.into<ForceAndTorque>(first + kNumbersOfLoad * body));
  }
  const LoadsOnMany of_grains{
      .load = all,
      .first = first_face_of_grain_.data(),
      .foot = foot_of_grain_.data(),
      .result = reductions.into<ForceAndTorque>(first + kNumbersOfLoad * n_bodies_).data()};
  if (count() > n_bodies_)
    Kokkos::parallel_for("bodies: loads on grains", items(count() - n_bodies_), of_grains);
  reductions.combine(ranks_of(grid_), first, kNumbersOfLoad * count(), MPI_SUM);
}

std::vector<BodyLoad> BodiesInFlow::loads(const DeviceReductions& reductions, int first) const {
  std::vector<BodyLoad> all;
  for (int body = 0; body < count(); ++body) {
    const auto load = reductions.get<ForceAndTorque>(first + kNumbersOfLoad * body);
    all.push_back({load.force, load.torque});
  }
  return all;
}

}  // namespace barchan
