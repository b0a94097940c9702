#include "src/fluid/fft.hpp"

#include <array>

namespace barchan {

namespace {

RankLine along_x(const Grid& grid) { return grid.ranks ? grid.ranks->along_x() : RankLine{}; }
RankLine along_z(const Grid& grid) { return grid.ranks ? grid.ranks->along_z() : RankLine{}; }

StridedArray inside(const Field& f) { return {f.origin, {1, f.stride_y, f.stride_z}}; }
StridedArray array(const Spectrum& s) {
  return contiguous(reinterpret_cast<Real*>(s.data()),
                    {s.extent_int(0), s.extent_int(1), s.extent_int(2)});
}
template <class View>
View view_of(const char* label, const std::array<int, 3>& extents) {
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

}  // namespace

PlaneFft::PlaneFft(const Grid& grid)
    : rows_(along_x(grid), {grid.nx_all, grid.ny, grid.nz}, 0, 1, 1),
      planes_(along_z(grid), {grid.nx_all / 2 + 1, rows_.joined_extents()[1], grid.nz_all}, 2, 0,
              2),
      columns_(along_x(grid), {planes_.joined_extents()[0], grid.ny, grid.nz_all}, 1, 2, 2),
      lines_(rows_.is_trivial() ? lines_in_field(grid) : lines_in_a_row(rows_.joined_extents()),
             {grid.nz_all, planes_.joined_extents()[0], planes_.joined_extents()[1]}),
      first_x_(Split{.n = grid.nx_all / 2 + 1, .parts = along_z(grid).count}.begin(
          along_z(grid).position)),
      first_z_(
          Split{.n = grid.nz_all, .parts = along_x(grid).count}.begin(along_x(grid).position)) {
  if (!rows_.is_trivial())
    lines_of_x_ = view_of<Field::Storage>("fft: lines of x", rows_.joined_extents());
  if (!planes_.is_trivial())
    modes_of_rows_ = view_of<Spectrum>("fft: modes of rows", planes_.cut_extents());
  if (!columns_.is_trivial())
    modes_of_planes_ = view_of<Spectrum>("fft: modes of planes", planes_.joined_extents());
  spectrum_ = view_of<Spectrum>("fft: spectrum", columns_.joined_extents());
}

PlaneFft::Stages PlaneFft::stages(const Spectrum& modes) const {
  const Spectrum& planes = columns_.is_trivial() ? modes : modes_of_planes_;
  return {planes_.is_trivial() ? planes : modes_of_rows_, planes};
}

StridedArray PlaneFft::lines_of_x(const Field& f) const {
  if (rows_.is_trivial()) return inside(f);
  return contiguous(lines_of_x_.data(), rows_.joined_extents());
}

void PlaneFft::forward(const Field& in, const Spectrum& out) const {
  const Stages stage = stages(out);
  const StridedArray lines = lines_of_x(in);
  if (!rows_.is_trivial()) rows_.join(inside(in), lines);
  lines_.forward_x(lines.data, stage.rows.data());
  if (!planes_.is_trivial()) planes_.join(array(stage.rows), array(stage.planes));
  lines_.forward_z(stage.planes.data());
  if (!columns_.is_trivial()) columns_.join(array(stage.planes), array(out));
}

void PlaneFft::backward(const Spectrum& in, Field& out) const {
  const Stages stage = stages(in);
  if (!columns_.is_trivial()) columns_.cut(array(in), array(stage.planes));
  lines_.backward_z(stage.planes.data());
  if (!planes_.is_trivial()) planes_.cut(array(stage.planes), array(stage.rows));
  const StridedArray lines = lines_of_x(out);
  lines_.backward_x(stage.rows.data(), lines.data);
  if (!rows_.is_trivial()) rows_.cut(lines, inside(out));
}

}  // namespace barchan
