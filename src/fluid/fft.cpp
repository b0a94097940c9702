#include "src/fluid/fft.hpp"

#include <array>
#include <string>

#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

RankAxis along_x(const Grid& grid) { return grid.ranks ? grid.ranks->along_x() : RankAxis{}; }
RankAxis along_z(const Grid& grid) { return grid.ranks ? grid.ranks->along_z() : RankAxis{}; }

StridedArray inside(const Field& f) { return {f.origin, {1, f.stride_y, f.stride_z}}; }
StridedArray array(const Spectrum& s) {
  return contiguous(reinterpret_cast<Real*>(s.data()),
                    {s.extent_int(0), s.extent_int(1), s.extent_int(2)});
}
template <class View>
View view_of(const std::string& label, const std::array<int, 3>& extents) {
  return View(label, extents[0], extents[1], extents[2]);
}

/// Lines of x where they are: in a field, or one after the other.
RealLines lines_in_field(const Grid& grid) {
  const Field like("fft: field", grid);
  return {grid.nx, grid.ny, grid.nz, like.stride_y, like.stride_z};
}
RealLines lines_in_a_row(const std::array<int, 3>& e) {
  return {e[0], e[1], e[2], e[0], static_cast<std::ptrdiff_t>(e[0]) * e[1]};
}

/// `extents` with another number along an axis.
std::array<int, 3> with(std::array<int, 3> extents, std::size_t axis, int n) {
  extents[axis] = n;
  return extents;
}

/// Lines along x of `extents`, from one array to another, there followed by their images or not.
void copy_lines(const StridedArray& from, const StridedArray& to, const std::array<int, 3>& extents,
                bool image) {
  const Real* in = from.data;
  Real* out = to.data;
  const std::ptrdiff_t in_y = from.stride[1], in_z = from.stride[2];
  const std::ptrdiff_t out_y = to.stride[1], out_z = to.stride[2];
  const int last = 2 * extents[0] - 1;
  for_each_cell(
      "fft: lines and images", CellRange{0, extents[0], 0, extents[1], 0, extents[2]},
      KOKKOS_LAMBDA(int i, int j, int k) {
        const Real value = in[i + j * in_y + k * in_z];
        Real* line = out + j * out_y + k * out_z;
        line[i] = value;
        if (image) line[last - i] = value;
      });
}

/// Planes of the first half become those of the second, the last first.
void mirror_planes(const Spectrum& modes) {
  const int planes = modes.extent_int(2);
  for_each_cell(
      "fft: image in z", CellRange{0, modes.extent_int(0), 0, modes.extent_int(1), 0, planes / 2},
      KOKKOS_LAMBDA(int i, int j, int k) { modes(i, j, planes - 1 - k) = modes(i, j, k); });
}

}  // namespace

PlaneFft::PlaneFft(const Grid& grid, EvenExtension even)
    : even_(even),
      period_x_(even.x ? 2 * grid.nx_all : grid.nx_all),
      period_z_(even.z ? 2 * grid.nz_all : grid.nz_all),
      rows_(along_x(grid), {grid.nx_all, grid.ny, grid.nz}, 0, 1, 1),
      planes_(along_z(grid), {period_x_ / 2 + 1, rows_.joined_extents()[1], grid.nz_all}, 2, 0, 2),
      columns_(along_x(grid), {planes_.joined_extents()[0], grid.ny, period_z_}, 1, 2, 2),
      lines_(rows_.is_trivial() && !even.x
                 ? lines_in_field(grid)
                 : lines_in_a_row(with(rows_.joined_extents(), 0, period_x_)),
             {period_z_, planes_.joined_extents()[0], planes_.joined_extents()[1]}),
      first_x_(BlockPartition{.n = period_x_ / 2 + 1, .parts = along_z(grid).count}.begin(
          along_z(grid).position)),
      first_z_(BlockPartition{.n = period_z_, .parts = along_x(grid).count}.begin(
          along_x(grid).position)) {
  if (!rows_.is_trivial() || even.x)
    lines_of_x_ =
        view_of<Field::Storage>("fft: lines of x", with(rows_.joined_extents(), 0, period_x_));
  if (!planes_.is_trivial())
    modes_of_rows_ = view_of<Spectrum>("fft: modes of rows", planes_.cut_extents());
  if (!columns_.is_trivial())
    modes_of_planes_ =
        view_of<Spectrum>("fft: modes of planes", with(planes_.joined_extents(), 2, period_z_));
  spectrum_ = view_of<Spectrum>("fft: spectrum", columns_.joined_extents());
}

ModeGroups PlaneFft::groups() const {
  return columns_.is_trivial() ? lines_.groups()
                               : plane_by_plane(spectrum_.extent_int(0), spectrum_.extent_int(2));
}

StridedArray PlaneFft::lines_of_x(const Field& f) const {
  if (rows_.is_trivial() && !even_.x) return inside(f);
  return contiguous(lines_of_x_.data(), with(rows_.joined_extents(), 0, period_x_));
}

void PlaneFft::solve(const Field& in, const ColumnSolve& columns, Field& out) const {
  forward(in);
  if (columns_.is_trivial()) {
    lines_.solve_z(modes_of_planes().data(), columns);
  } else {
    lines_.forward_z(modes_of_planes_.data());
    columns_.join(array(modes_of_planes_), array(spectrum_));
    solve_columns(columns, spectrum_.data());
    columns_.cut(array(spectrum_), array(modes_of_planes_));
    lines_.backward_z(modes_of_planes_.data());
  }
  backward(out);
}

/// From cells to whole lines of z.
void PlaneFft::forward(const Field& in) const {
  const StridedArray lines = lines_of_x(in);
  if (!rows_.is_trivial()) rows_.join(inside(in), lines);
  if (even_.x) {
    copy_lines(rows_.is_trivial() ? inside(in) : lines, lines, rows_.joined_extents(), true);
  }
  lines_.forward_x(lines.data, modes_of_rows().data());
  if (!planes_.is_trivial()) planes_.join(array(modes_of_rows()), array(modes_of_planes()));
  if (even_.z) mirror_planes(modes_of_planes());
}

/// From lines of z to cells.
void PlaneFft::backward(Field& out) const {
  if (!planes_.is_trivial()) planes_.cut(array(modes_of_planes()), array(modes_of_rows()));
  const StridedArray lines = lines_of_x(out);
  lines_.backward_x(modes_of_rows().data(), lines.data);
  if (!rows_.is_trivial()) {
    rows_.cut(lines, inside(out));
  } else if (even_.x) {
    copy_lines(lines, inside(out), rows_.joined_extents(), false);
  }
}

}  // namespace barchan
