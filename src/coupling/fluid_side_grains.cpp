#include "src/coupling/fluid_side_grains.hpp"

#include <utility>

#include "src/parallel/communicator.hpp"
#include "src/parallel/decomposition.hpp"

namespace barchan {

FluidSideGrains::FluidSideGrains(const Grid& grid, bool periodic_x, const GrainState& grains,
                                 const ForceSwitches& forces) {
  if (!grid.ranks) return;
  is_cut_ = true;
  const Decomposition& pencils = *grid.ranks;
  ranks_ = pencils.all();
  owners_ = {.x = {pencils.x().n, pencils.x().parts},
             .z = {pencils.z().n, pencils.z().parts},
             .dx = grid.dx,
             .dz = grid.dz,
             .box = grid.box(periodic_x)};
  copies_ = make_grain_entries(0, ranks_);
  add_fluid(copies_);
  add_exchange(copies_, forces);
  if (grains.clump.size() > 0) add_parts(copies_);
}

/// Finds the owners of the grains: fills entry_, in their order, and counts_.
void FluidSideGrains::find_owners(const GrainState& grains) {
  const Kokkos::View<int*> owner("fluid-side grains: owners", grains.kin.extent(0));
  const auto kin = grains.kin;
  const PencilOwners owner_of = owners_;
  Kokkos::parallel_for(
      "fluid-side grains: owners", items(grains.n),
      KOKKOS_LAMBDA(int g) { owner(g) = owner_of(kin(g).x); });
  SendList entries = sort_by_rank(owner, grains.n, rank_count(ranks_));
  entry_ = entries.entry;
  counts_ = exchange_counts(ranks_, std::move(entries.to));
}

void FluidSideGrains::wrap_copies() const {
  const auto kin = copies_.kin;
  const PeriodicBox box = owners_.box;
  Kokkos::parallel_for(
      "fluid-side grains: wrap", items(copies_.n),
      KOKKOS_LAMBDA(int g) { kin(g).x = box.wrap(kin(g).x); });
}

void FluidSideGrains::copy_to_fluid_ranks(const GrainState& grains, unsigned uses) {
  if (!is_cut_) return;
  find_owners(grains);
  exchange_.exchange(counts_, layout_of(grains, uses), entry_);
  for (std::size_t e = copies_.extra.size(); e < grains.extra.size(); ++e)
    add_extra(copies_, grains.extra[e].name, grains.extra[e].unit, grains.extra[e].uses);
  copies_.n = counts_.n_from();
  reserve_entries(copies_, copies_.n, kFluidSide);
  exchange_.unpack(layout_of(copies_, uses), {});
  wrap_copies();
}

GrainState& FluidSideGrains::to_fluid_ranks(GrainState& grains, unsigned uses) {
  copy_to_fluid_ranks(grains, uses);
  return is_cut_ ? copies_ : grains;
}

const GrainState& FluidSideGrains::to_fluid_ranks(const GrainState& grains, unsigned uses) {
  copy_to_fluid_ranks(grains, uses);
  return is_cut_ ? copies_ : grains;
}

void FluidSideGrains::to_grain_ranks(GrainState& grains, unsigned uses) {
  if (!is_cut_) return;
  exchange_.exchange(counts_.back(), layout_of(copies_, uses));
  exchange_.unpack(layout_of(grains, uses), entry_);
}

}  // namespace barchan
