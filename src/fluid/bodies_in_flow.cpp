#include "src/fluid/bodies_in_flow.hpp"

#include <algorithm>

#include "kernels/fluid/field_algebra.hpp"
#include "kernels/fluid/flow_sums.hpp"
#include "src/fluid/body_faces.hpp"
#include "src/parallel/cell_reductions.hpp"
#include "src/parallel/mirror.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

/// Turns a sum over the cells of the fluid into the mean over them.
struct FindMeanOfFluid {
  Real* number;
  Real height;
  KOKKOS_FUNCTION void operator()(int) const { *number /= height; }
};

}  // namespace

BodiesInFlow::BodiesInFlow(const Solids& solids, const Grid& grid, const Halo& halo,
                           const FluidConfig& config, int pressure_reach)
    : grid_(grid), density_(config.density), regions_(grid) {
  const BodyFaces found = find_body_faces(solids, grid, halo, config.kinematic_viscosity);
  faces_ = to_device("bodies: faces", found.faces);
  cells_ = to_device("bodies: cells", found.cells);
  unforced_ = Kokkos::View<Real*>("bodies: unforced velocity", found.faces.size());
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
  height_of_fluid_ = grid.height_of_all_columns() - sum_over(ranks_of(grid), closed);
  find_columns(found.faces, pressure_reach);
  loads_.resize(feet_.size());
  n_bodies_ = solids.count() - solids.grains();
  first_face_of_grain_ = to_device("bodies: faces of grains",
                                   std::vector(first_face_.begin() + n_bodies_, first_face_.end()));
  foot_of_grain_ = to_device("bodies: grains", std::vector(feet_.begin() + n_bodies_, feet_.end()));
}

/// Marks columns with faces of bodies, and those around that the pressure solver needs.
void BodiesInFlow::find_columns(const std::vector<BodyFace>& faces, int pressure_reach) {
  const ColumnMarks marks("bodies: columns", grid_, 1);
  const int last = grid_.nx_all * grid_.nz_all;
  for (const BodyFace& face : faces) {
    marks.on_host(0, grid_.i_begin + face.i + grid_.nx_all * (grid_.k_begin + face.k)) = 1;
    marks.on_host(0, last) = std::max(marks.on_host(0, last), face.j + 1);
  }
  near_ = ColumnMap::marked(grid_, marks, 0);
  near_ = near_.dilated(1 + pressure_reach).padded_to_blocks();
  regions_.fraction.set(near_);
  regions_.exchange.set({});
}

bool BodiesInFlow::stop(FaceVector& u) {
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

void BodiesInFlow::correct_fraction(FluidState& fluid) {
  Kokkos::parallel_for("bodies: no change", items(n_cells()),
                       CopyInBodies{cells_.data(), fluid.alpha_f, fluid.alpha_f_previous});
}

void BodiesInFlow::add_solid_inside(const Field& alpha, const DeviceReductions& reductions,
                                    int slot) const {
  Kokkos::parallel_reduce("bodies: solid inside", items(n_cells()),
                          SolidInBodies{grid_, cells_.data(), alpha}, reductions.into(slot));
}

void BodiesInFlow::limit_eddies(Field& nu_t) {
  Kokkos::parallel_for("bodies: no eddies", items(n_cells()),
                       ClearInBodies{cells_.data(), nu_t, false});
}

void BodiesInFlow::after_predict(const FlowStep& step) {
  Kokkos::parallel_reduce("bodies: direct forcing", items(n_faces()),
                          DirectForcing{.grid = grid_,
                                        .faces = faces_.data(),
                                        .alpha = step.fluid.alpha_f,
                                        .u_star = step.u_star,
                                        .c = step.mobility,
                                        .unforced = unforced_.data(),
                                        .dt = step.dt},
                          step.numbers.into<Vec3>(kTaken));
}

void BodiesInFlow::after_drive_across(const FlowStep& step) {
  Kokkos::parallel_for(
      "bodies: direct forcing across", items(n_faces()),
      ForcingAcross{faces_.data(), step.u_star.z, step.fluid.drive.z * step.dt, step.dt});
}

void BodiesInFlow::constrain_pressure(Field& f, const DeviceReductions& numbers) {
  close(f);
  sum_each_cell("bodies: mean of the fluid", numbers, kMeanOfFluid, owned_cells(grid_),
                HeightSum{grid_, f});
  numbers.combine(ranks_of(grid_), kMeanOfFluid, 1, MPI_SUM);
  Kokkos::parallel_for("bodies: mean of the fluid", items(1),
                       FindMeanOfFluid{numbers.data() + kMeanOfFluid, height_of_fluid_});
  for_each_cell("bodies: mean of the fluid", grid_, Subtract{f, numbers.scalar(kMeanOfFluid)});
  close(f);
}

void BodiesInFlow::after_correct(const FlowStep& step) {
  const FluidState& fluid = step.fluid;
  const LoadOnBody all{.grid = grid_,
                       .faces = faces_.data(),
                       .unforced = unforced_.data(),
                       .u = fluid.u,
                       .p = fluid.p,
                       .alpha = fluid.alpha_f,
                       .foot = {},
                       .drive = {fluid.drive.x, 0, fluid.drive.z},
                       .density = density_,
                       .dt = step.dt};
  for (int body = 0; body < n_bodies_; ++body) {
    const int begin = first_face_[static_cast<std::size_t>(body)];
    const int end = first_face_[static_cast<std::size_t>(body) + 1];
    LoadOnBody load = all;
    load.faces += begin, load.unforced += begin;
    load.foot = feet_[static_cast<std::size_t>(body)];
    Kokkos::parallel_reduce("bodies: load", items(end - begin), load,
                            step.numbers.into<ForceAndTorque>(number_of(body)));
  }
  const LoadsOnMany of_grains{
      .load = all,
      .first = first_face_of_grain_.data(),
      .foot = foot_of_grain_.data(),
      .result = step.numbers.into<ForceAndTorque>(number_of(n_bodies_)).data()};
  if (count() > n_bodies_)
    Kokkos::parallel_for("bodies: loads on grains", items(count() - n_bodies_), of_grains);
  step.numbers.combine(ranks_of(grid_), kOfTerms, static_cast<int>(numbers()), MPI_SUM);
}

void BodiesInFlow::report(const DeviceReductions& numbers) {
  for (int body = 0; body < count(); ++body) {
    const auto load = numbers.get<ForceAndTorque>(number_of(body));
    loads_[static_cast<std::size_t>(body)] = {load.force, load.torque};
  }
}

}  // namespace barchan
