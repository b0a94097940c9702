#include "src/halo.hpp"

#include "src/launch.hpp"

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

}  // namespace

void Halo::fill(const Field& f) const {
  // The functor for x takes j as the inner index: one row of the launch is one plane's rim.
  for_each_cell("halo: wrap x", CellRange{-1, grid_.ny + 1, 0, 1, 0, grid_.nz}, WrapX{f, grid_.nx});
  for_each_cell("halo: wrap z", CellRange{-1, grid_.nx + 1, -1, grid_.ny + 1, 0, 1},
                WrapZ{f, grid_.nz});
}

}  // namespace barchan
