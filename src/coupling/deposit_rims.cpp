#include "src/coupling/deposit_rims.hpp"

#include "kernels/grains/pack.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

/// A plane of cells across one direction; `a` counts along the other one.
struct DepositPlane {
  GridRef grid;
  Deposits deposits;
  bool across_x;
  int at, n_a;

  KOKKOS_FORCEINLINE_FUNCTION std::int64_t cell(int index) const {
    const int a = index % n_a + (across_x ? -1 : 0), j = index / n_a;
    return across_x ? CellIndex{at, j, a}.linear(grid) : CellIndex{a, j, at}.linear(grid);
  }
  KOKKOS_FORCEINLINE_FUNCTION int size() const { return n_a * grid.ny; }
};

struct PackPlane {
  DepositPlane plane;
  Real* words;
  KOKKOS_FUNCTION void operator()(int index) const {
    for (int q = 0; q < Deposits::kQuantities; ++q) {
      put_words(words + std::ptrdiff_t{q} * plane.size() + index,
                plane.deposits.sum(plane.cell(index), q));
    }
  }
};
struct AddPlane {
  DepositPlane plane;
  const Real* words;
  KOKKOS_FUNCTION void operator()(int index) const {
    for (int q = 0; q < Deposits::kQuantities; ++q) {
      std::int64_t sum = 0;
      take_words(words + std::ptrdiff_t{q} * plane.size() + index, sum);
      plane.deposits.sum(plane.cell(index), q) += sum;
    }
  }
};

Rims make_rims(int n_cells) {
  const auto n = static_cast<std::size_t>(n_cells) * Deposits::kQuantities;
  return {MessageBuffer("deposits: to before", n), MessageBuffer("deposits: to after", n),
          MessageBuffer("deposits: from before", n), MessageBuffer("deposits: from after", n)};
}

void add_across(const Grid& grid, const Deposits& deposits, const RankLine& line, bool across_x,
                const Rims& rims) {
  // Along z the ghosts in x are done with; along x those in z still travel.
  const int last = across_x ? grid.nx : grid.nz, n_a = across_x ? grid.nz + 2 : grid.nx;
  const auto plane = [&](int at) { return DepositPlane{grid, deposits, across_x, at, n_a}; };
  const auto all = items(n_a * grid.ny);
  Kokkos::parallel_for("deposits: pack", all, PackPlane{plane(-1), rims.to_before.data()});
  Kokkos::parallel_for("deposits: pack", all, PackPlane{plane(last), rims.to_after.data()});
  exchange(line, rims);
  Kokkos::parallel_for("deposits: add", all, AddPlane{plane(0), rims.from_before.data()});
  Kokkos::parallel_for("deposits: add", all, AddPlane{plane(last - 1), rims.from_after.data()});
}

}  // namespace

DepositRims::DepositRims(const Grid& grid) : grid_(grid) {
  if (!grid.ranks) return;
  if (grid.ranks->along_x().count > 1) x_ = make_rims((grid.nz + 2) * grid.ny);
  if (grid.ranks->along_z().count > 1) z_ = make_rims(grid.nx * grid.ny);
}

void DepositRims::add(const Deposits& deposits) const {
  if (!grid_.ranks) return;
  const RankLine &along_x = grid_.ranks->along_x(), &along_z = grid_.ranks->along_z();
  if (along_x.count > 1) add_across(grid_, deposits, along_x, true, x_);
  if (along_z.count > 1) add_across(grid_, deposits, along_z, false, z_);
}

}  // namespace barchan
