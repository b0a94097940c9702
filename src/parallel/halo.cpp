#include "src/parallel/halo.hpp"

#include "src/parallel/launch.hpp"

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

template <bool pack>
KOKKOS_FORCEINLINE_FUNCTION void copy(Real& cell, Real& message) {
  if constexpr (pack) {
    message = cell;
  } else {
    cell = message;
  }
}

/// The planes i = first and i = last to or from two buffers, rows j = -1 .. rows - 2.
template <bool pack>
struct CopyPlanesX {
  FieldRef f;
  int first, last, rows;
  Real *before, *after;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int j, int, int k) const {
    const int at = j + 1 + rows * k;
    copy<pack>(f(first, j, k), before[at]);
    copy<pack>(f(last, j, k), after[at]);
  }
};

/// The planes k = first and k = last, i = -1 .. length - 2 with the ghosts in x.
template <bool pack>
struct CopyPlanesZ {
  FieldRef f;
  int first, last, length;
  Real *before, *after;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int) const {
    const int at = i + 1 + length * (j + 1);
    copy<pack>(f(i, j, first), before[at]);
    copy<pack>(f(i, j, last), after[at]);
  }
};

Rims make_rims(int n) {
  const auto size = static_cast<std::size_t>(n);
  return {MessageBuffer("halo: to before", size), MessageBuffer("halo: to after", size),
          MessageBuffer("halo: from before", size), MessageBuffer("halo: from after", size)};
}

}  // namespace

Halo::Halo(const Grid& grid) : grid_(grid) {
  if (!grid.ranks) return;
  if (grid.ranks->along_x().count > 1) x_ = make_rims((grid.ny + 2) * grid.nz);
  if (grid.ranks->along_z().count > 1) z_ = make_rims((grid.nx + 2) * (grid.ny + 2));
}

void Halo::fill(Field& f) const {
  const int nx = grid_.nx, nz = grid_.nz, rows = grid_.ny + 2, length = nx + 2;
  // The functor for x takes j as the inner index: one row of the launch is one plane's rim.
  const CellRange across_x{-1, grid_.ny + 1, 0, 1, 0, nz};
  if (x_.to_after.size() == 0) {
    for_each_cell("halo: wrap x", across_x, WrapX{f, nx});
  } else {
    for_each_cell("halo: pack x", across_x,
                  CopyPlanesX<true>{f, 0, nx - 1, rows, x_.to_before.data(), x_.to_after.data()});
    exchange(grid_.ranks->along_x(), x_);
    for_each_cell("halo: unpack x", across_x,
                  CopyPlanesX<false>{f, -1, nx, rows, x_.from_before.data(), x_.from_after.data()});
  }
  const CellRange across_z{-1, nx + 1, -1, grid_.ny + 1, 0, 1};
  if (z_.to_after.size() == 0) {
    for_each_cell("halo: wrap z", across_z, WrapZ{f, nz});
  } else {
    for_each_cell("halo: pack z", across_z,
                  CopyPlanesZ<true>{f, 0, nz - 1, length, z_.to_before.data(), z_.to_after.data()});
    exchange(grid_.ranks->along_z(), z_);
    for_each_cell(
        "halo: unpack z", across_z,
        CopyPlanesZ<false>{f, -1, nz, length, z_.from_before.data(), z_.from_after.data()});
  }
}

}  // namespace barchan
