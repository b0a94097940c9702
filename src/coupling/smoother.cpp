#include "src/coupling/smoother.hpp"

#include <algorithm>
#include <cmath>

#include "src/parallel/decomposition.hpp"

namespace barchan {

namespace {

constexpr std::size_t kSizesKept = 4;  // a dune may waver between two along x and along z
constexpr Real kWorthIt = 0.8;         // part of an axis; if more is needed, all of it is solved

Real square(Real a) { return a * a; }

/// Decay of a field from a cell to the next, in a direction along which alone it varies: the root
/// below one of q^2 - (2 + h^2/L^2) q + 1 = 0.
Real decay_per_cell(Real spacing, Real length) {
  const Real half = 1 + square(spacing / length) / 2;
  return 1 / (half + std::sqrt(square(half) - 1));
}

/// Next even number that has no prime factors but 2, 3 and 5.
int good_for_fft(int n) {
  const auto fits = [](int size) {
    for (const int factor : {2, 3, 5})
      while (size % factor == 0) size /= factor;
    return size == 1;
  };
  int size = n + n % 2;
  while (!fits(size)) size += 2;
  return size;
}

bool is_cut_along_x(const Grid& grid) { return grid.ranks && grid.ranks->along_x().count > 1; }
bool is_cut_along_z(const Grid& grid) { return grid.ranks && grid.ranks->along_z().count > 1; }

/// Parts of a stretch on either side of the periodic end of a line of n cells: the cells
/// [begin, end) of the stretch are those `shift` further on the line.
struct Part {
  int begin, end, shift;
};
std::vector<Part> parts_of(const Smoother::Stretch& s, int n) {
  if (s.first + s.length <= n) return {{0, s.length, s.first}};
  return {{0, n - s.first, s.first}, {n - s.first, s.length, s.first - n}};
}

/// Copies a part of a field; zero beyond the region.
struct TakeIn {
  RegionRef region;
  ConstFieldRef f;
  int shift_x, shift_z;
  FieldRef out;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    const int x = i + shift_x, z = k + shift_z;
    out(i, j, k) = region.has(x, j, z) ? f(x, j, z) : Real(0);
  }
};
struct PutBack {
  RegionRef region;
  ConstFieldRef in;
  int shift_x, shift_z;
  FieldRef f;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    const int x = i + shift_x, z = k + shift_z;
    if (region.has(x, j, z)) f(x, j, z) = in(i, j, k);
  }
};
struct SetZero {
  FieldRef f;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const { f(i, j, k) = 0; }
};

/// Grid of which a direction that is not whole is cut to the size of a stretch.
Grid cut_to(Grid grid, const Smoother::Stretch& x, const Smoother::Stretch& z) {
  if (!x.whole) {
    grid.nx = grid.nx_all = x.size, grid.i_begin = 0;
    grid.lx = x.size * grid.dx;
  }
  if (!z.whole) {
    grid.nz = grid.nz_all = z.size, grid.k_begin = 0;
    grid.lz = z.size * grid.dz;
  }
  return grid;
}

}  // namespace

Smoother::Columns::Columns(const Grid& all, const Stretch& x, const Stretch& z,
                           const EvenExtension& even, Real length)
    : grid(cut_to(all, x, z)),
      poisson(grid,
              std::make_shared<const PlaneFft>(
                  grid, EvenExtension{.x = x.whole && even.x, .z = z.whole && even.z}),
              1, square(length)),
      f("smoother: columns", grid) {}

Smoother::Smoother(const Grid& grid, std::shared_ptr<const PlaneFft> whole,
                   const EvenExtension& even, Real length)
    : grid_(grid), even_(even), length_(length), whole_fft_(std::move(whole)) {
  if (length == 0) return;
  const auto cells = [&](Real spacing, int all) {
    const Real decay = decay_per_cell(spacing, length);
    if (decay == 1) return all;
    return static_cast<int>(std::min<Real>(all, std::ceil(std::log(kTolerance) / std::log(decay))));
  };
  reach_ = std::max(cells(grid.dx, grid.nx_all), cells(grid.dz, grid.nz_all));
  const HostGrid rows = grid.on_host();
  for (int j = 0; j < grid.ny; ++j) decay_.push_back(decay_per_cell(rows.dy(j), length));
}

int Smoother::top_above(int from) const {
  if (length_ == 0) return from;
  Real left = 1;
  int j = from;
  for (; j < grid_.ny && left > kTolerance; ++j) left *= decay_[static_cast<std::size_t>(j)];
  return j;
}

const Smoother::Columns& Smoother::columns(const Stretch& x, const Stretch& z) const {
  const auto fits = [&](const Columns& c) { return c.grid.nx == x.size && c.grid.nz == z.size; };
  const auto known = std::find_if(columns_.begin(), columns_.end(), fits);
  if (known != columns_.end()) {
    columns_.splice(columns_.begin(), columns_, known);
  } else {
    if (columns_.size() == kSizesKept) columns_.pop_back();
    columns_.emplace_front(grid_, x, z, even_, length_);
  }
  return columns_.front();
}

const PoissonFft& Smoother::whole() const {
  if (!whole_) whole_ = std::make_unique<const PoissonFft>(grid_, whole_fft_, 1, square(length_));
  return *whole_;
}

/// Stretches to be solved for intervals of a direction with n cells here and n_all in all: one, the
/// whole direction, if that is the cheaper one, or the only one.
std::vector<Smoother::Stretch> Smoother::stretches(
    const std::vector<ColumnMap::Interval>& intervals, int n, int n_all, bool even, bool is_cut) {
  std::vector<Stretch> found;
  int cells = 0;
  bool at_wall = false;
  for (const auto& [first, last] : intervals) {
    const int length = last - first;
    found.push_back({.first = first, .length = length, .size = good_for_fft(length)});
    cells += found.back().size;
    at_wall = at_wall || (even && (first == 0 || last >= n_all));
  }
  if (at_wall || is_cut || cells > kWorthIt * n_all)
    return {{.first = 0, .length = n, .size = n, .whole = true}};
  return found;
}

void Smoother::solve(Field& f, const Region& region) const {
  const ColumnMap& columns = region.columns();
  if (length_ == 0 || columns.is_empty()) return;
  const auto along_x =
      stretches(columns.stretches_of_x(1), grid_.nx, grid_.nx_all, even_.x, is_cut_along_x(grid_));
  const auto along_z =
      stretches(columns.stretches_of_z(1), grid_.nz, grid_.nz_all, even_.z, is_cut_along_z(grid_));
  if (along_x.empty() || along_z.empty()) return;  // the last grain has left
  if (along_x.front().whole && along_z.front().whole) {
    Field all = f;
    for_each_cell("smoother: all columns", grid_, TakeIn{region.ref(), f, 0, 0, all});
    return whole().solve(f, f);
  }
  for (const Stretch& x : along_x) {
    for (const Stretch& z : along_z) solve_some(f, region, x, z);
  }
}

void Smoother::solve_some(Field& f, const Region& region, const Stretch& x,
                          const Stretch& z) const {
  const Columns& some = columns(x, z);
  Field inside = some.f;
  const int ny = grid_.ny;
  const auto each_part = [&](const auto& action) {
    for (const Part& px : parts_of(x, grid_.nx)) {
      for (const Part& pz : parts_of(z, grid_.nz))
        action(CellRange{px.begin, px.end, 0, ny, pz.begin, pz.end}, px.shift, pz.shift);
    }
  };
  each_part([&](const CellRange& cells, int shift_x, int shift_z) {
    for_each_cell("smoother: take in", cells, TakeIn{region.ref(), f, shift_x, shift_z, inside});
  });
  const SetZero zero{inside};  // as many as a good size takes
  if (x.length < x.size)
    for_each_cell("smoother: rest", CellRange{x.length, x.size, 0, ny, 0, z.size}, zero);
  if (z.length < z.size)
    for_each_cell("smoother: rest", CellRange{0, x.length, 0, ny, z.length, z.size}, zero);
  some.poisson.solve(inside, inside);
  each_part([&](const CellRange& cells, int shift_x, int shift_z) {
    for_each_cell("smoother: put back", cells, PutBack{region.ref(), inside, shift_x, shift_z, f});
  });
}

}  // namespace barchan
