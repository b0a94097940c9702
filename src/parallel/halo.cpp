#include "src/parallel/halo.hpp"

#include <algorithm>

#include "src/parallel/pack.hpp"

namespace barchan {

namespace {

struct WrapX {
  FieldRef f;
  int n;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int j, int, int k) const {
    f(-1, j, k) = f(n - 1, j, k);
    f(n, j, k) = f(0, j, k);
  }
};

struct WrapZ {
  FieldRef f;
  int n;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int) const {
    f(i, j, -1) = f(i, j, n - 1);
    f(i, j, n) = f(i, j, 0);
  }
};

/// Two planes of one shape, towards the rank before and the one after.
template <class T>
using Planes = std::array<T*, 2>;

/// Planes at the sides of a pencil to the neighbours, and theirs into the planes `to`.
template <BoxCopy take, class T>
void exchange_planes(const RankLine& line, const HaloBuffers& buffers, const BoxShape& plane,
                     const Planes<T>& from, const Planes<T>& to) {
  copy_boxes<BoxCopy::pack>("halo: pack", plane, from,
                            Planes<Real>{buffers.to_before.data(), buffers.to_after.data()});
  exchange(line, buffers, plane.size());
  copy_boxes<take>(take == BoxCopy::add ? "halo: add" : "halo: unpack", plane, to,
                   Planes<Real>{buffers.from_before.data(), buffers.from_after.data()});
}

}  // namespace

Halo::Halo(const Grid& grid, int n_sums) : grid_(grid) {
  if (!grid.ranks) return;
  const auto of_rows = [&](int columns, int columns_of_sums) {
    return HaloBuffers(static_cast<std::size_t>(
        std::max((grid.ny + 2) * columns, grid.ny * columns_of_sums * n_sums)));
  };
  if (grid.ranks->along_x().count > 1) x_ = of_rows(grid.nz, grid.nz + 2);
  if (grid.ranks->along_z().count > 1) z_ = of_rows(grid.nx + 2, grid.nx);
}

void Halo::fill(Field& f) const {
  const int nx = grid_.nx, ny = grid_.ny, nz = grid_.nz;
  const FieldRef cell = f;
  if (!x_.is_cut()) {  // j is the inner index
    for_each_cell("halo: wrap x", CellRange{-1, ny + 1, 0, 1, 0, nz}, WrapX{f, nx});
  } else {
    const BoxShape plane{.n = {ny + 2, 1, nz}, .stride = {f.stride_y, 0, f.stride_z}};
    const auto at = [&](int i) { return &cell(i, -1, 0); };
    exchange_planes<BoxCopy::unpack>(grid_.ranks->along_x(), x_, plane,
                                     Planes<Real>{at(0), at(nx - 1)}, Planes<Real>{at(-1), at(nx)});
  }
  if (!z_.is_cut()) {
    for_each_cell("halo: wrap z", CellRange{-1, nx + 1, -1, ny + 1, 0, 1}, WrapZ{f, nz});
  } else {
    const BoxShape plane{.n = {nx + 2, ny + 2, 1}, .stride = {1, f.stride_y, 0}};
    const auto at = [&](int k) { return &cell(-1, -1, k); };
    exchange_planes<BoxCopy::unpack>(grid_.ranks->along_z(), z_, plane,
                                     Planes<Real>{at(0), at(nz - 1)}, Planes<Real>{at(-1), at(nz)});
  }
}

void Halo::scatter_add(const CellSums& sums) const {
  using Sum = std::int64_t;
  const int nx = grid_.nx, ny = grid_.ny, nz = grid_.nz, n_sums = sums.extent_int(1);
  const std::ptrdiff_t stride_y = nx + 2, stride_z = stride_y * ny;
  const auto stride_q = static_cast<std::ptrdiff_t>(sums.stride(1));
  const auto at = [&](int i, int k) { return sums.data() + i + 1 + stride_z * (k + 1); };
  if (x_.is_cut()) {  // the corners go on along z
    const BoxShape plane{.n = {nz + 2, ny, n_sums}, .stride = {stride_z, stride_y, stride_q}};
    exchange_planes<BoxCopy::add>(grid_.ranks->along_x(), x_, plane,
                                  Planes<Sum>{at(-1, -1), at(nx, -1)},
                                  Planes<Sum>{at(0, -1), at(nx - 1, -1)});
  }
  if (z_.is_cut()) {
    const BoxShape plane{.n = {nx, ny, n_sums}, .stride = {1, stride_y, stride_q}};
    exchange_planes<BoxCopy::add>(grid_.ranks->along_z(), z_, plane,
                                  Planes<Sum>{at(0, -1), at(0, nz)},
                                  Planes<Sum>{at(0, 0), at(0, nz - 1)});
  }
}

}  // namespace barchan
