#include "src/parallel/halo.hpp"

#include <algorithm>

#include "src/parallel/pack.hpp"

namespace barchan {

namespace {

/// Two planes of one shape, for the rank before and the one after.
template <class T>
using Planes = std::array<T*, 2>;

/// Sends planes at the sides of a pencil to the neighbours, and receives theirs in the planes `to`.
template <BoxCopy take, class T>
void exchange_planes(const HaloBuffers& buffers, const BoxShape& plane, const Planes<T>& from,
                     const Planes<T>& to) {
  const auto& [line, send, receive] = buffers;
  const std::size_t n = plane.size();
  const auto halves = [n](const MessageBuffer& b) { return Planes<Real>{b.data(), b.data() + n}; };
  copy_boxes<BoxCopy::pack>("halo: pack", plane, from, halves(send));
  // Order of the blocks where both neighbours are the same rank: the block sent to the one after is
  // received from the one before.
  const MessageBlock before{line.lower(), 0, n}, after{line.upper(), n, n};
  exchange(line.communicator, send, std::array{after, before}, receive, std::array{before, after});
  copy_boxes<take>(take == BoxCopy::add ? "halo: add" : "halo: unpack", plane, to, halves(receive));
}

HaloBuffers buffers_for(const RankAxis& line, int n) {
  if (line.count == 1) return {};
  const std::size_t room = 2 * static_cast<std::size_t>(n);
  return {line, {"halo: send", room}, {"halo: receive", room}};
}

/// Fills the ghosts of an uncut grid, up to three fields at once.
void fill_uncut(const Grid& grid, std::span<const FieldWithWalls> fields) {
  for (; !fields.empty(); fields = fields.subspan(std::min<std::size_t>(fields.size(), 3))) {
    FillGhosts fill{.nx = grid.nx, .ny = grid.ny, .nz = grid.nz, .field = {}};
    for (const FieldWithWalls& field : fields.first(std::min<std::size_t>(fields.size(), 3)))
      fill.field[fill.n++] = field;
    const int longest = fill.longest(), per_item = kOnHost ? longest : 1;
    Kokkos::parallel_for(
        "halo: ghosts", items(fill.n * fill.lines() * longest / per_item), KOKKOS_LAMBDA(int item) {
          const int at = item * per_item, begin = at % longest - 1;
          fill(at / longest, begin, begin + per_item);
        });
  }
}

/// Indices [begin, begin + n) along one direction.
struct Stretch {
  int begin, n;
};
/// Part on this rank of the cells [begin, end) of all ranks; `first` is this rank's first of n.
Stretch part_here(int begin, int end, int first, int n) {
  const int here = std::max(begin - first, 0);
  return {here, std::max(std::min(end - first, n) - here, 0)};
}

/// Fills ghosts along a cut direction from the ranks beside this one.
void exchange_x(const Grid& grid, const HaloBuffers& buffers, const FieldRef& f, const Stretch& y,
                const Stretch& z) {
  const BoxShape plane{.n = {y.n, 1, z.n}, .stride = {f.stride_y, 0, f.stride_z}};
  const auto at = [&](int i) { return &f(i, y.begin, z.begin); };
  exchange_planes<BoxCopy::unpack>(buffers, plane, Planes<Real>{at(0), at(grid.nx - 1)},
                                   Planes<Real>{at(-1), at(grid.nx)});
}
void exchange_z(const Grid& grid, const HaloBuffers& buffers, const FieldRef& f, const Stretch& x,
                const Stretch& y) {
  const BoxShape plane{.n = {x.n, y.n, 1}, .stride = {1, f.stride_y, 0}};
  const auto at = [&](int k) { return &f(x.begin, y.begin, k); };
  exchange_planes<BoxCopy::unpack>(buffers, plane, Planes<Real>{at(0), at(grid.nz - 1)},
                                   Planes<Real>{at(-1), at(grid.nz)});
}

void fill_x(const Grid& grid, const HaloBuffers& buffers, const FieldRef& f) {
  const int nx = grid.nx, ny = grid.ny, nz = grid.nz;
  if (!buffers.is_cut()) {  // j is the inner index
    for_each_cell(
        "halo: wrap x", CellRange{-1, ny + 1, 0, 1, 0, nz}, KOKKOS_LAMBDA(int j, int, int k) {
          f(-1, j, k) = f(nx - 1, j, k);
          f(nx, j, k) = f(0, j, k);
        });
    return;
  }
  exchange_x(grid, buffers, f, {-1, ny + 2}, {0, nz});
}

void fill_z(const Grid& grid, const HaloBuffers& buffers, const FieldRef& f) {
  const int nx = grid.nx, ny = grid.ny, nz = grid.nz;
  if (!buffers.is_cut()) {
    for_each_cell(
        "halo: wrap z", CellRange{-1, nx + 1, -1, ny + 1, 0, 1}, KOKKOS_LAMBDA(int i, int j, int) {
          f(i, j, -1) = f(i, j, nz - 1);
          f(i, j, nz) = f(i, j, 0);
        });
    return;
  }
  exchange_z(grid, buffers, f, {-1, nx + 2}, {-1, ny + 2});
}

}  // namespace

Halo::Halo(const Grid& grid, int n_sums) : grid_(grid) {
  if (!grid.ranks) return;
  const auto numbers = [&](int columns, int columns_of_sums) {
    return std::max((grid.ny + 2) * columns, grid.ny * columns_of_sums * n_sums);
  };
  x_ = buffers_for(grid.ranks->along_x(), numbers(grid.nz, grid.nz + 2));
  z_ = buffers_for(grid.ranks->along_z(), numbers(grid.nx + 2, grid.nx));
}

void Halo::fill_with_walls(std::span<const FieldWithWalls> fields) const {
  if (!x_.is_cut() && !z_.is_cut()) return fill_uncut(grid_, fields);
  for (const FieldWithWalls& field : fields) {
    if (field.has_rules())
      for_each_cell("halo: walls", CellRange{0, grid_.nx, 0, 1, 0, grid_.nz}, FillWalls{field});
    fill_x(grid_, x_, field.f);
    fill_z(grid_, z_, field.f);
  }
}

void Halo::fill_between_ranks(const FieldRef& f, const CellRange& bounds) const {
  const Stretch x = part_here(bounds.i0, bounds.i1, grid_.i_begin, grid_.nx);
  const Stretch z = part_here(bounds.k0, bounds.k1, grid_.k_begin, grid_.nz);
  const Stretch y{bounds.j0, bounds.j1 - bounds.j0};
  if (x_.is_cut() && y.n > 0 && z.n > 0) exchange_x(grid_, x_, f, y, z);
  if (z_.is_cut() && y.n > 0 && x.n > 0) exchange_z(grid_, z_, f, x, y);
}

void Halo::scatter_add(const CellSums& sums) const {
  using Sum = std::int64_t;
  const int nx = grid_.nx, ny = grid_.ny, nz = grid_.nz, n_sums = sums.extent_int(1);
  const std::ptrdiff_t stride_y = nx + 2, stride_z = stride_y * ny;
  const auto stride_q = static_cast<std::ptrdiff_t>(sums.stride(1));
  const auto at = [&](int i, int k) { return sums.data() + i + 1 + stride_z * (k + 1); };
  if (x_.is_cut()) {  // the corners are passed on along z
    const BoxShape plane{.n = {nz + 2, ny, n_sums}, .stride = {stride_z, stride_y, stride_q}};
    exchange_planes<BoxCopy::add>(x_, plane, Planes<Sum>{at(-1, -1), at(nx, -1)},
                                  Planes<Sum>{at(0, -1), at(nx - 1, -1)});
  }
  if (z_.is_cut()) {
    const BoxShape plane{.n = {nx, ny, n_sums}, .stride = {1, stride_y, stride_q}};
    exchange_planes<BoxCopy::add>(z_, plane, Planes<Sum>{at(0, -1), at(0, nz)},
                                  Planes<Sum>{at(0, 0), at(0, nz - 1)});
  }
}

}  // namespace barchan
