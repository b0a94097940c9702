#include "src/fluid/domain.hpp"

#include <stdexcept>

#include "src/base/errors.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

namespace {

/// The row at the lower end of each of equal parts of the height.
void set_rows_at(Grid& grid, const std::vector<double>& y_faces) {
  const int parts = Grid::kParts * grid.ny;
  grid.row_at_ = Kokkos::View<Real*>("grid: rows", parts);
  const auto row = mirror(grid.row_at_);
  int j = 0;
  for (int part = 0; part < parts; ++part) {
    const double y = part * grid.ly / parts;
    while (j + 1 < grid.ny && y >= y_faces[static_cast<std::size_t>(j + 1)]) ++j;
    row(part) = j;
  }
  Kokkos::deep_copy(grid.row_at_, row);
}

}  // namespace

Grid make_grid(int nx, int nz, Real lx, Real lz, const std::vector<double>& y_faces,
               const Decomposition* ranks) {
  Grid grid;
  grid.nx = grid.nx_all = nx;
  grid.ny = static_cast<int>(y_faces.size()) - 1;
  grid.nz = grid.nz_all = nz;
  grid.lx = lx;
  grid.ly = y_faces.back() - y_faces.front();
  grid.lz = lz;
  grid.dx = lx / nx;
  grid.dz = lz / nz;
  if (ranks) {
    grid.nx = ranks->x().count(ranks->along_x().position);
    grid.nz = ranks->z().count(ranks->along_z().position);
    grid.i_begin = ranks->x().begin(ranks->along_x().position);
    grid.k_begin = ranks->z().begin(ranks->along_z().position);
    grid.ranks = ranks;
  }
  grid.y_face_ = Kokkos::View<Real*>("grid: y faces", grid.ny + 3);
  grid.y_centre_ = Kokkos::View<Real*>("grid: y centres", grid.ny + 2);

  const auto face = mirror(grid.y_face_);
  const auto centre = mirror(grid.y_centre_);
  const std::size_t last = y_faces.size() - 1;
  for (std::size_t j = 0; j <= last; ++j) face(j + 1) = y_faces[j];
  face(0) = 2 * y_faces[0] - y_faces[1];
  face(last + 2) = 2 * y_faces[last] - y_faces[last - 1];
  for (std::size_t j = 0; j < last + 2; ++j) centre(j) = 0.5 * (face(j) + face(j + 1));
  Kokkos::deep_copy(grid.y_face_, face);
  Kokkos::deep_copy(grid.y_centre_, centre);
  set_rows_at(grid, y_faces);
  return grid;
}

Grid make_grid(const FluidCase& config, const Decomposition* ranks) {
  const auto& cells = config.fluid.cells;
  return make_grid(cells[0], cells[2], config.size[0], config.size[2], config.row_faces, ranks);
}

std::unique_ptr<const Decomposition> make_decomposition(const std::optional<FluidConfig>& fluid,
                                                        MPI_Comm communicator) {
  if (!fluid || rank_count(communicator) == 1) return {};
  try {
    const auto& cells = fluid->cells;
    return std::make_unique<const Decomposition>(communicator, cells[0], cells[2]);
  } catch (const std::runtime_error& problem) {
    throw ConfigError({problem.what()});
  }
}

}  // namespace barchan
