#include "src/coupling/fluid_side_grains.hpp"

#include <utility>
#include <vector>

#include "src/parallel/communicator.hpp"
#include "src/parallel/decomposition.hpp"

namespace barchan {

FluidSideGrains::FluidSideGrains(const Grid& grid, bool periodic_x) {
  if (!grid.ranks) return;
  is_cut_ = true;
  const Decomposition& pencils = *grid.ranks;
  ranks_ = pencils.all();
  owners_ = {.x = {pencils.x().n, pencils.x().parts},
             .z = {pencils.z().n, pencils.z().parts},
             .dx = grid.dx,
             .dz = grid.dz,
             .box = grid.box(periodic_x)};
  visitors_ = make_grain_rows(0, ranks_);
  add_fluid(visitors_);
  add_exchange(visitors_);
  count_ =
      Kokkos::View<int*>("fluid-side grains: count", static_cast<std::size_t>(rank_count(ranks_)));
}

/// Fills row_, in the order of the owners, and counts_.
void FluidSideGrains::find_owners(const GrainState& home) {
  const int n = home.n;
  reserve_rows(owner_, n);
  reserve_rows(row_, n);
  Kokkos::deep_copy(count_, 0);
  const auto kin = home.kin;
  const auto owner = owner_, row = row_, count = count_;
  const PencilOwners owner_of = owners_;
  Kokkos::parallel_for(
      "fluid-side grains: owners", items(n), KOKKOS_LAMBDA(int g) {
        owner(g) = owner_of(kin(g).x);
        Kokkos::atomic_inc(&count(owner(g)));
      });
  const auto counts = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, count_);
  std::vector<int> to(counts.data(), counts.data() + counts.extent(0));
  int begin = 0;
  for (std::size_t rank = 0; rank < to.size(); begin += to[rank++]) {
    if (to[rank] == 0) continue;
    const int wanted = static_cast<int>(rank), first = begin;
    Kokkos::parallel_scan(
        "fluid-side grains: rows of an owner", items(n),
        KOKKOS_LAMBDA(int g, int& sum, bool final) {
          if (owner(g) != wanted) return;
          if (final) row(first + sum) = g;
          ++sum;
        });
  }
  counts_ = announce(ranks_, std::move(to));
}

void FluidSideGrains::wrap_visitors() const {
  const auto kin = visitors_.kin;
  const PeriodicBox box = owners_.box;
  Kokkos::parallel_for(
      "fluid-side grains: wrap", items(visitors_.n),
      KOKKOS_LAMBDA(int g) { kin(g).x = box.wrap(kin(g).x); });
}

void FluidSideGrains::send(const RecordLayout& layout, const RecordCounts& counts,
                           const Kokkos::View<const int*>& row) {
  const int n = counts.n_to();
  send_.reserve(static_cast<std::size_t>(n) * static_cast<std::size_t>(layout.width));
  Kokkos::parallel_for("fluid-side grains: pack", items(n),
                       PackRecords{layout, row, send_.data(), layout.width});
  exchange(counts, layout.width, send_, receive_);
}

void FluidSideGrains::take(const RecordLayout& layout, const RecordCounts& counts,
                           const Kokkos::View<const int*>& row) const {
  Kokkos::parallel_for("fluid-side grains: unpack", items(counts.n_from()),
                       UnpackRecords{layout, row, 0, receive_.data(), layout.width});
}

void FluidSideGrains::to_grain_ranks(const Kokkos::View<Vec3*>& of_visitors,
                                     const Kokkos::View<Vec3*>& home) {
  const auto layout_of = [](const Kokkos::View<Vec3*>& vectors) {
    RecordLayout layout;
    grain_columns_detail::add_to(layout, vectors);
    return layout;
  };
  send(layout_of(of_visitors), counts_.back(), {});
  take(layout_of(home), counts_.back(), row_);
}

}  // namespace barchan
