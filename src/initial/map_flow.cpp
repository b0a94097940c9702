#include "src/initial/map_flow.hpp"

#include <cmath>

#include "kernels/fluid/flow_between_meshes.hpp"
#include "src/fluid/fluid_solver.hpp"

namespace barchan {

namespace {

/// Sets `to` between the nodes of `from`, free of divergence.
void interpolate_flow(const FluidCase& flow, const FluidConfig& theirs, const Vec3& corner,
                      FluidState& from, FluidState& to) {
  fill_ghosts(Boundary(from.grid, theirs.bottom, theirs.top, theirs.top_velocity), from);
  for_each_cell("fluid: from another mesh", to.grid,
                FlowFromMesh{.from = from.grid,
                             .to = to.grid,
                             .corner = corner,
                             .u_from = from.u,
                             .du_dt_from = from.du_dt,
                             .p_from = from.p,
                             .nu_t_from = from.nu_t,
                             .alpha_from = from.alpha_f,
                             .u = to.u,
                             .du_dt = to.du_dt,
                             .p = to.p,
                             .nu_t = to.nu_t,
                             .alpha = to.alpha_f});
  if (!flow.with_grains) Kokkos::deep_copy(to.alpha_f.storage, Real(1));
  Kokkos::deep_copy(to.alpha_f_previous.storage, to.alpha_f.storage);
  to.drive = from.drive;
  FluidSolver(flow, to.grid).remove_divergence(to);
}

}  // namespace

void map_flow(const FluidCase& flow, FluidState& from, FluidState& to) {
  interpolate_flow(flow, flow.fluid, {}, from, to);
  const Real along = bulk_velocity(to), across = bulk_velocity_across(to);
  const bool more_across = std::abs(across) > std::abs(along);
  const Real bulk = more_across ? across : along;
  if (bulk == 0) return;
  const Real wanted = more_across ? bulk_velocity_across(from) : bulk_velocity(from);
  for_each_cell("fluid: bulk velocity", to.grid, ScaleFaces{.factor = wanted / bulk, .v = to.u});
}

void map_window(const FluidCase& flow, const FluidConfig& theirs,
                const std::array<double, 2>& corner, FluidState& from, FluidState& to) {
  interpolate_flow(flow, theirs, {corner[0], 0, corner[1]}, from, to);
}

}  // namespace barchan
