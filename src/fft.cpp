#include "src/fft.hpp"

#include <array>

namespace barchan {

namespace {

StridedArray inside(const Field& f) { return {f.origin, {1, f.stride_y, f.stride_z}}; }

}  // namespace

/// The way of a field to its modes over ranks, each step with the array that it leads to.
struct PlaneFft::Shared {
  Transpose rows_of_x;    // (x, y, z) -> (all x, y', z)
  Transpose planes_of_z;  // (all kx, y', z) -> (kx', y', all z)
  Transpose columns;      // (kx', y', all kz) -> (kx', all y, kz')
  std::array<int, 3> real, along_x, along_z;
  Kokkos::View<Real*> rows;  // (all x, y', z)
  Spectrum modes_of_rows;    // (all kx, y', z)
  Spectrum modes_of_planes;  // (kx', y', all z)

  explicit Shared(const Grid& grid)
      : rows_of_x(grid.ranks->along_x(), {grid.nx_all, grid.ny, grid.nz}, 0, 1, 1),
        planes_of_z(grid.ranks->along_z(),
                    {grid.nx_all / 2 + 1, rows_of_x.joined_extents()[1], grid.nz_all}, 2, 0, 2),
        columns(grid.ranks->along_x(), {planes_of_z.joined_extents()[0], grid.ny, grid.nz_all}, 1,
                2, 2),
        real(rows_of_x.joined_extents()),
        along_x(planes_of_z.cut_extents()),
        along_z(planes_of_z.joined_extents()),
        rows("fft: rows", size(real)),
        modes_of_rows("fft: modes of rows", along_x[0], along_x[1], along_x[2]),
        modes_of_planes("fft: modes of planes", along_z[0], along_z[1], along_z[2]) {}

  static std::size_t size(const std::array<int, 3>& e) {
    return static_cast<std::size_t>(e[0]) * static_cast<std::size_t>(e[1] * e[2]);
  }
  static StridedArray array(const Spectrum& s) {
    return contiguous(reinterpret_cast<Real*>(s.data()),
                      {s.extent_int(0), s.extent_int(1), s.extent_int(2)});
  }
};

PlaneFft::PlaneFft(const Grid& grid) : ny_(grid.ny), modes_x_(grid.nx / 2 + 1), modes_z_(grid.nz) {
  if (!grid.ranks) {
    const Field like("fft: field", grid);
    lines_ =
        std::make_shared<LineFft>(RealLines{grid.nx, ny_, grid.nz, like.stride_y, like.stride_z},
                                  ComplexLines{grid.nz, modes_x_, ny_});
  } else {
    shared_ = std::make_shared<Shared>(grid);
    const auto& [nx, rows, planes] = shared_->real;
    lines_ = std::make_shared<LineFft>(
        RealLines{nx, rows, planes, nx, static_cast<std::ptrdiff_t>(nx) * rows},
        ComplexLines{grid.nz_all, shared_->along_z[0], shared_->along_z[1]});
    modes_x_ = shared_->along_z[0];
    modes_z_ = shared_->columns.joined_extents()[2];
    const RankLine &along_x = grid.ranks->along_x(), &along_z = grid.ranks->along_z();
    first_x_ = Split{.n = grid.nx_all / 2 + 1, .parts = along_z.count}.begin(along_z.place);
    first_z_ = Split{.n = grid.nz_all, .parts = along_x.count}.begin(along_x.place);
  }
  spectrum_ = make_spectrum("fft: spectrum");
}

void PlaneFft::forward(const Field& in, const Spectrum& out) const {
  if (!shared_) {
    lines_->forward_x(in.origin, out.data());
    lines_->forward_z(out.data());
    return;
  }
  const Shared& s = *shared_;
  s.rows_of_x.join(inside(in), contiguous(s.rows.data(), s.real));
  lines_->forward_x(s.rows.data(), s.modes_of_rows.data());
  s.planes_of_z.join(Shared::array(s.modes_of_rows), Shared::array(s.modes_of_planes));
  lines_->forward_z(s.modes_of_planes.data());
  s.columns.join(Shared::array(s.modes_of_planes), Shared::array(out));
}

void PlaneFft::backward(const Spectrum& in, const Field& out) const {
  if (!shared_) {
    lines_->backward_z(in.data());
    lines_->backward_x(in.data(), out.origin);
    return;
  }
  const Shared& s = *shared_;
  s.columns.cut(Shared::array(in), Shared::array(s.modes_of_planes));
  lines_->backward_z(s.modes_of_planes.data());
  s.planes_of_z.cut(Shared::array(s.modes_of_planes), Shared::array(s.modes_of_rows));
  lines_->backward_x(s.modes_of_rows.data(), s.rows.data());
  s.rows_of_x.cut(contiguous(s.rows.data(), s.real), inside(out));
}

}  // namespace barchan
