#include "src/coupling/smoother.hpp"

#include <algorithm>
#include <cmath>

#include "src/parallel/decomposition.hpp"

namespace barchan {

namespace {

constexpr std::size_t kSizesKept = 2;  // a dune may waver between two
constexpr Real kWorthIt = 0.8;         // part of the columns; if more are needed, all are solved

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

/// Grid cut to nx columns, periodic in x.
Grid with_columns(Grid grid, int nx) {
  grid.nx = grid.nx_all = nx;
  grid.i_begin = 0;
  grid.lx = nx * grid.dx;
  return grid;
}

bool is_cut_along_x(const Grid& grid) { return grid.ranks && grid.ranks->along_x().count > 1; }

/// Copies a stretch of x, then as many zeros as a good size takes; zero beyond the region.
struct TakeIn {
  RegionRef region;
  ConstFieldRef f;
  int first, length, nx;  // columns of f, which is periodic
  FieldRef out;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    const int at = first + i < nx ? first + i : first + i - nx;
    out(i, j, k) = i < length && region.has(at, j, k) ? f(at, j, k) : Real(0);
  }
};
struct PutBack {
  RegionRef region;
  ConstFieldRef in;
  int first, nx;
  FieldRef f;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    const int at = first + i < nx ? first + i : first + i - nx;
    if (region.has(at, j, k)) f(at, j, k) = in(i, j, k);
  }
};

}  // namespace

Smoother::Columns::Columns(const Grid& whole, int nx, const EvenExtension& even, Real length)
    : grid(with_columns(whole, nx)),
      poisson(grid, std::make_shared<const PlaneFft>(grid, EvenExtension{.z = even.z}), 1,
              square(length)),
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

const Smoother::Columns& Smoother::columns(int nx) const {
  const auto known = std::find_if(columns_.begin(), columns_.end(),
                                  [nx](const Columns& c) { return c.grid.nx == nx; });
  if (known != columns_.end()) {
    columns_.splice(columns_.begin(), columns_, known);
  } else {
    if (columns_.size() == kSizesKept) columns_.pop_back();
    columns_.emplace_front(grid_, nx, even_, length_);
  }
  return columns_.front();
}

const PoissonFft& Smoother::whole() const {
  if (!whole_) whole_ = std::make_unique<const PoissonFft>(grid_, whole_fft_, 1, square(length_));
  return *whole_;
}

/// Tells if one solve over all columns is the cheaper one, or the only one.
bool Smoother::takes_all(const std::vector<ColumnMap::Interval>& stretches) const {
  int columns = 0;
  bool at_wall = false;
  for (const auto& [first, last] : stretches) {
    columns += good_for_fft(last - first);
    at_wall = at_wall || (even_.x && (first == 0 || last >= grid_.nx_all));
  }
  return at_wall || is_cut_along_x(grid_) || columns > kWorthIt * grid_.nx_all;
}

void Smoother::solve(Field& f, const Region& region) const {
  if (length_ == 0 || region.columns().is_empty()) return;
  const auto stretches = region.columns().stretches_of_x(1);
  if (takes_all(stretches)) {
    Field all = f;
    const TakeIn zero_beyond{region.ref(), f, 0, grid_.nx, grid_.nx, all};
    for_each_cell("smoother: all columns", grid_, zero_beyond);
    return whole().solve(f, f);
  }
  for (const auto& [first, last] : stretches) {
    const int length = last - first;
    const Columns& some = columns(good_for_fft(length));
    Field inside = some.f;
    for_each_cell("smoother: take in", some.grid,
                  TakeIn{region.ref(), f, first, length, grid_.nx, inside});
    some.poisson.solve(inside, inside);
    for_each_cell("smoother: put back", CellRange{0, length, 0, grid_.ny, 0, grid_.nz},
                  PutBack{region.ref(), inside, first, grid_.nx, f});
  }
}

}  // namespace barchan
