// Grid fields in tests: set and read them on the host, on any backend.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "src/case/config.hpp"
#include "src/fluid/boundary.hpp"
#include "src/fluid/domain.hpp"
#include "src/fluid/fluid_state.hpp"
#include "src/fluid/mesh.hpp"

namespace barchan::test {

/// A field's values on the host, with its ghosts.
struct HostField {
  Kokkos::View<Real***, Kokkos::LayoutLeft, Kokkos::HostSpace> values;
  Real operator()(int i, int j, int k) const { return values(i + 1, j + 1, k + 1); }
  /// Field as kernels see it, for those of their functions that a test calls on the host.
  FieldRef ref() const {
    const int row = static_cast<int>(values.extent(0)),
              plane = row * static_cast<int>(values.extent(1));
    return {values.data() + 1 + row + plane, row, plane};
  }
};

inline HostField to_host(const Field& f) { return {host_copy(f.storage)}; }

/// Calls each(i, j, k) for the owned cells.
template <class Each>
void for_owned_cells(const Grid& grid, const Each& each) {
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) each(i, j, k);
}

/// Sets the owned cells to value(i, j, k); ghosts become zero.
template <class Value>
void set_field(const Field& f, const Grid& grid, const Value& value) {
  decltype(HostField::values) host("host: values", f.storage.extent(0), f.storage.extent(1),
                                   f.storage.extent(2));
  for_owned_cells(grid, [&](int i, int j, int k) { host(i + 1, j + 1, k + 1) = value(i, j, k); });
  Kokkos::deep_copy(f.storage, host);
}

/// value(i, j, k) in all cells, ghosts included.
template <class Value>
HostField host_field(const GridRef& grid, const Value& value) {
  HostField f{decltype(HostField::values)("host: values", grid.nx + 2, grid.ny + 2, grid.nz + 2)};
  for (int k = -1; k <= grid.nz; ++k)
    for (int j = -1; j <= grid.ny; ++j)
      for (int i = -1; i <= grid.nx; ++i) f.values(i + 1, j + 1, k + 1) = value(i, j, k);
  return f;
}
template <class Value>
void set_everywhere(const Field& f, const GridRef& grid, const Value& value) {
  Kokkos::deep_copy(f.storage, host_field(grid, value).values);
}

/// Grid on the host: places of cell centres and faces.
struct HostGrid : barchan::HostGrid {
  explicit HostGrid(const Grid& grid) : barchan::HostGrid(grid.on_host()) {}
  /// Grid as kernels see it, for those of their functions that a test calls on the host.
  GridRef ref() const {
    return {static_cast<const GridExtents&>(*this), y_face_.data(), y_centre_.data(),
            row_at_.data()};
  }
  double x(int i) const { return x_centre(i); }
  double y(int j) const { return y_centre(j); }
  double z(int k) const { return z_centre(k); }
  double volume(int j) const { return cell_volume(j); }
};

/// value(axis, x, y, z) on all faces, ghosts included.
template <class Value>
void set_faces(const FaceVector& f, const Grid& grid, const Value& value) {
  const HostGrid h(grid);
  for (const std::size_t axis : {0u, 1u, 2u}) {
    set_everywhere(axis == 0   ? f.x
                   : axis == 1 ? f.y
                               : f.z,
                   grid, [&](int i, int j, int k) {
                     return value(axis, axis == 0 ? h.x_face(i) : h.x(i),
                                  axis == 1 ? h.y_face(j) : h.y(j),
                                  axis == 2 ? h.z_face(k) : h.z(k));
                   });
  }
}

/// Independent numbers in [-1, 1] in the owned cells.
inline void set_random(const Field& f, const Grid& grid, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  set_field(f, grid, [&](int, int, int) { return uniform(engine); });
}

/// Stretched unless `first` is zero.
inline Grid stretched_grid(std::array<int, 3> n, std::array<double, 3> size, double first,
                           const Decomposition* ranks = nullptr) {
  return make_grid(n[0], n[2], size[0], size[2], row_faces({size[1], n[1], first}), ranks);
}

inline Config flow_config(std::array<int, 3> n, std::array<double, 3> size, double first) {
  Config config;
  config.size = size;
  config.fluid = FluidConfig{};
  config.fluid->cells = n;
  config.fluid->first_cell_height = first;
  return config;
}

}  // namespace barchan::test
