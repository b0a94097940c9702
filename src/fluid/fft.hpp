// Real Fourier transforms over x and z of every row of a grid field, whichever ranks own it.
#pragma once

#include "src/fluid/line_fft.hpp"
#include "src/parallel/grid.hpp"
#include "src/parallel/transpose.hpp"

namespace barchan {

/// Fourier coefficients (kx, j, kz), kx fastest, y untransformed and whole: those of one rank.
using Spectrum = Kokkos::View<Kokkos::complex<Real>***, Kokkos::LayoutLeft>;

/// Directions in which a field goes on as its mirror image beyond both ends: zero gradient there.
/// Else it goes on periodically.
struct EvenExtension {
  bool x = false, z = false;
  bool operator==(const EvenExtension&) const = default;
};

/// Transforms around a solve that couples rows alone. All ranks call together. With even the field
/// and its image are one period, at twice the cost: the image is made where a line is whole, and
/// dropped there again.
///
/// Over ranks the lines of x, then of z, then the rows are made whole, three transposes in each
/// direction:
///   (x, y, z) -> (x, y', z) -> along x -> (kx, y', z) -> (kx', y', z) -> along z -> (kx', y, kz')
/// where a prime means a share of the ranks beside each other.
class PlaneFft {
 public:
  explicit PlaneFft(const Grid& grid, EvenExtension even = {});

  /// Cells of all ranks in a period along x and z.
  int period_x() const { return period_x_; }
  int period_z() const { return period_z_; }
  /// Wave number of the first mode of this rank along x and z.
  int first_mode_x() const { return first_x_; }
  int first_mode_z() const { return first_z_; }
  /// Order of the columns of modes that solve() wants.
  ModeGroups groups() const;
  /// Transforms, solves and transforms back, without normalisation: what leaves the modes alone
  /// multiplies with period_x period_z. in and out may be the same field; ghosts of `out` are left
  /// alone.
  void solve(const Field& in, const ColumnSolve& columns, Field& out) const;

 private:
  void forward(const Field& in) const;
  void backward(Field& out) const;
  /// Spectra between the transposes, (kx', y', all z) and (all kx, y', z); where a transpose has
  /// nothing to do, two of them are one.
  const Spectrum& modes_of_planes() const {
    return columns_.is_trivial() ? spectrum_ : modes_of_planes_;
  }
  const Spectrum& modes_of_rows() const {
    return planes_.is_trivial() ? modes_of_planes() : modes_of_rows_;
  }
  StridedArray lines_of_x(const Field& f) const;

  EvenExtension even_;
  int period_x_ = 0, period_z_ = 0;
  Transpose rows_, planes_, columns_;  // that make the lines of x, the lines of z, the rows whole
  LineFft lines_;
  Field::Storage lines_of_x_;                 // whole, with their images; empty where not needed
  Spectrum modes_of_rows_, modes_of_planes_;  // empty where not needed
  int first_x_ = 0, first_z_ = 0;
  Spectrum spectrum_;
};

}  // namespace barchan
