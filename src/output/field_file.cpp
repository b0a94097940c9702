#include "src/output/field_file.hpp"

#include <algorithm>

namespace barchan {

namespace {

std::uint64_t size(int n) { return static_cast<std::uint64_t>(n); }

Extents whole_extents(const Grid& grid) {
  return {size(grid.nz_all + 2), size(grid.ny + 2), size(grid.nx_all + 2)};
}

/// Cells of one direction, ghosts counted from 0, that this rank writes: its own, and the ghosts at
/// the ends of the domain.
struct Written {
  int begin, count;
  Written(int first, int n, int n_all)
      : begin(first == 0 ? 0 : 1), count((first + n == n_all ? n + 2 : n + 1) - begin) {}
};

}  // namespace

void save_field(CheckpointWriter& file, const std::string& name, const Grid& grid, const Field& f) {
  if (!grid.ranks || f.origin == nullptr) {
    file.array(name, f.storage);
    return;
  }
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, f.storage);
  const Written x(grid.i_begin, grid.nx, grid.nx_all), z(grid.k_begin, grid.nz, grid.nz_all);
  std::vector<double> values;
  values.reserve(size(x.count) * size(grid.ny + 2) * size(z.count));
  for (int k = z.begin; k < z.begin + z.count; ++k)
    for (int j = 0; j < grid.ny + 2; ++j)
      for (int i = x.begin; i < x.begin + x.count; ++i) values.push_back(host(i, j, k));
  file.array(name, std::span<const double>(values),
             {size(z.count), size(grid.ny + 2), size(x.count)},
             {.whole = whole_extents(grid),
              .first = {size(grid.k_begin + z.begin), 0, size(grid.i_begin + x.begin)}});
}

void load_field(const CheckpointReader& file, const std::string& name, const Grid& grid,
                const Field& f) {
  if (!grid.ranks || f.origin == nullptr) {
    file.array(name, f.storage);
    return;
  }
  const std::vector<double> values =
      file.part<double>(name, whole_extents(grid), {size(grid.k_begin), 0, size(grid.i_begin)},
                        {size(grid.nz + 2), size(grid.ny + 2), size(grid.nx + 2)});
  const auto host = Kokkos::create_mirror_view(f.storage);
  std::copy(values.begin(), values.end(), host.data());
  Kokkos::deep_copy(f.storage, host);
}

}  // namespace barchan
