#include "src/coupling/coupling_grid.hpp"

#include "kernels/coupling/beside_bodies.hpp"
#include "kernels/coupling/deposit.hpp"
#include "src/coupling/deposit_stencil.hpp"
#include "src/parallel/decomposition.hpp"

namespace barchan {

namespace {

/// Transforms for the smoothing: those of the flow, or others with walls. Walls of the grains stop
/// the smoothing though the flow passes them.
std::shared_ptr<const PlaneFft> smoothing_fft(const CoupledCase& config, const FluidSolver& solver,
                                              const Grid& grid, const EvenExtension& walls) {
  if (walls == EvenExtension{} || config.coupling.smoothing_length == 0) return solver.fft();
  return std::make_shared<const PlaneFft>(grid, walls);
}

// Least share that is kept: deeper in a body there are no grains.
constexpr Real kLeastWeight = 1e-3;

WallFaces ends_of(const RankAxis& line, int n) {
  WallFaces faces;
  if (line.position == 0) faces.first = 0;
  if (line.position + 1 == line.count) faces.last = n;
  return faces;
}

}  // namespace

CouplingGrid::CouplingGrid(const CoupledCase& config, const FluidSolver& solver,
                           const Grid& of_flow, Real r_max, PointModel points)
    : grid(of_flow),
      boundary(solver.boundary()),
      box(grid.box(is_periodic_x(config.grains->grains))),
      stencil(make_deposit_stencil(config, grid, r_max, points)),
      smoothing_length(config.coupling.smoothing_length),
      reach_of_grain(r_max),
      walls{.x = config.grains->grains.boundary_x == GrainBoundaryX::wall,
            .z = config.grains->grains.boundary_z == GrainBoundaryZ::wall},
      smoother(grid, smoothing_fft(config, solver, grid, walls), walls, smoothing_length),
      bodies(solver.bodies()),
      pressure_reach(solver.pressure_reach()),
      marks("coupling: columns", grid, kMarks) {
  if (bodies == nullptr || smoothing_length == 0) return;
  smoothing_weight = Field("coupling: smoothing weight", grid);
  Kokkos::deep_copy(smoothing_weight.storage, Real(1));
  bodies->close(smoothing_weight);
  const Region everywhere(grid);
  smoother.solve(smoothing_weight, everywhere);
  for_each_cell("coupling: least smoothing weight", grid,
                KeepAbove{smoothing_weight, kLeastWeight});
  boundary.fill_scalars(smoothing_weight);
}

void CouplingGrid::renormalise(Field& f, const Region& region) const {
  if (smoothing_weight.storage.size() > 0)
    for_each_cell("coupling: renormalise", region, DivideBy{smoothing_weight, f});
}

void CouplingGrid::mark_columns_of(const GrainState& grains) const {
  marks.set_zero();
  Kokkos::parallel_for("coupling: columns of grains", items(grains.n),
                       MarkColumns{grid, box, grains.kin, reach_of_grain, marks.row(kOfGrains)});
}

ColumnMap CouplingGrid::columns_of_grains() const {
  // one column more: the other face of a momentum cell
  return ColumnMap::marked(grid, marks, kOfGrains).dilated(1);
}

void CouplingGrid::fill_ghosts(FaceVector& f, const Region& region) const {
  boundary.fill_scalars(region, f.x, f.y, f.z);
}

void CouplingGrid::fill_ghosts(CellVector& f, const Region& region) const {
  boundary.fill_scalars(region, f.x, f.y, f.z);
}

WallFaces CouplingGrid::wall_faces_x() const {
  if (!walls.x) return {};
  return ends_of(grid.ranks ? grid.ranks->along_x() : RankAxis{}, grid.nx);
}

WallFaces CouplingGrid::wall_faces_z() const {
  if (!walls.z) return {};
  return ends_of(grid.ranks ? grid.ranks->along_z() : RankAxis{}, grid.nz);
}

}  // namespace barchan
