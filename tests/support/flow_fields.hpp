// Grid fields in tests: set and read them on the host, on any backend.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "src/config/mesh.hpp"
#include "src/fluid/boundary.hpp"
#include "src/fluid/domain.hpp"

namespace barchan::test {

/// A field's values on the host, with its ghosts.
struct HostField {
  Kokkos::View<Real***, Kokkos::LayoutLeft, Kokkos::HostSpace> values;
  Real operator()(int i, int j, int k) const { return values(i + 1, j + 1, k + 1); }
  /// As kernels see a field, for those of their functions that a test calls on the host.
  FieldRef ref() const {
    const int row = static_cast<int>(values.extent(0)),
              plane = row * static_cast<int>(values.extent(1));
    return {values.data() + 1 + row + plane, row, plane};
  }
};

inline HostField to_host(const Field& f) {
  HostField host{decltype(HostField::values)("host", f.storage.extent(0), f.storage.extent(1),
                                             f.storage.extent(2))};
  Kokkos::deep_copy(host.values, f.storage);
  return host;
}

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
  decltype(HostField::values) host("host", f.storage.extent(0), f.storage.extent(1),
                                   f.storage.extent(2));
  for_owned_cells(grid, [&](int i, int j, int k) { host(i + 1, j + 1, k + 1) = value(i, j, k); });
  Kokkos::deep_copy(f.storage, host);
}

/// value(i, j, k) in all cells, ghosts included.
template <class Value>
HostField host_field(const GridRef& grid, const Value& value) {
  HostField f{decltype(HostField::values)("f", grid.nx + 2, grid.ny + 2, grid.nz + 2)};
  for (int k = -1; k <= grid.nz; ++k)
    for (int j = -1; j <= grid.ny; ++j)
      for (int i = -1; i <= grid.nx; ++i) f.values(i + 1, j + 1, k + 1) = value(i, j, k);
  return f;
}
template <class Value>
void set_everywhere(const Field& f, const GridRef& grid, const Value& value) {
  Kokkos::deep_copy(f.storage, host_field(grid, value).values);
}

inline FaceVector make_faces(const Grid& grid) {
  return {Field("x", grid), Field("y", grid), Field("z", grid)};
}

/// Independent numbers in [-1, 1] in the owned cells.
inline void set_random(const Field& f, const Grid& grid, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  set_field(f, grid, [&](int, int, int) { return uniform(engine); });
}

/// Where cell centres and faces are, on the host.
struct HostGrid {
  explicit HostGrid(const Grid& g) : grid(g) {
    const auto face = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), g.y_face_);
    for (std::size_t n = 0; n < face.extent(0); ++n) faces.push_back(face(n));
    const auto centre = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), g.y_centre_);
    for (std::size_t n = 0; n < centre.extent(0); ++n) centres.push_back(centre(n));
  }
  /// As kernels see a grid, for those of their functions that a test calls on the host.
  GridRef ref() const {
    GridRef r = grid;
    r.y_face_ = faces.data();
    r.y_centre_ = centres.data();
    return r;
  }
  double x_face(int i) const { return grid.x0 + i * grid.dx; }
  double x(int i) const { return grid.x0 + (i + 0.5) * grid.dx; }
  double z_face(int k) const { return grid.z0 + k * grid.dz; }
  double z(int k) const { return grid.z0 + (k + 0.5) * grid.dz; }
  double y_face(int j) const { return faces[static_cast<std::size_t>(j) + 1]; }
  double y(int j) const { return 0.5 * (y_face(j) + y_face(j + 1)); }
  double dy(int j) const { return y_face(j + 1) - y_face(j); }
  double volume(int j) const { return grid.dx * dy(j) * grid.dz; }

  Grid grid;
  std::vector<double> faces, centres;  // with those of the ghost rows
};

/// Stretched unless `first` is zero.
inline Grid stretched_grid(std::array<int, 3> n, std::array<double, 3> size, double first,
                           const Decomposition* ranks = nullptr) {
  return make_grid(n[0], n[2], size[0], size[2], stretched_faces(size[1], n[1], first), ranks);
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
