// Real Fourier transforms over x and z of every row of a grid field, whichever ranks own it.
#pragma once

#include "src/fluid/line_fft.hpp"
#include "src/parallel/grid.hpp"
#include "src/parallel/transpose.hpp"

namespace barchan {

/// Fourier coefficients (kx, j, kz), kx fastest, y untransformed and whole: those of one rank.
using Spectrum = Kokkos::View<Kokkos::complex<Real>***, Kokkos::LayoutLeft>;

/// Both directions without normalisation: backward(forward(f)) = nx nz f, with the nx, nz of all
/// ranks. All ranks call together.
///
/// Over ranks the lines of x, then of z, then the rows are made whole, three transposes in each
/// direction:
///   (x, y, z) -> (x, y', z) -> along x -> (kx, y', z) -> (kx', y', z) -> along z -> (kx', y, kz')
/// where a prime means a share of the ranks beside each other.
class PlaneFft {
 public:
  explicit PlaneFft(const Grid& grid);

  /// Room for one spectrum, for those who transform there and straight back.
  const Spectrum& spectrum() const { return spectrum_; }
  /// Wave number of the first mode of this rank along x and z.
  int first_mode_x() const { return first_x_; }
  int first_mode_z() const { return first_z_; }
  void forward(const Field& in, const Spectrum& out) const;
  /// Destroys `in`. Ghosts of `out` are left alone.
  void backward(const Spectrum& in, Field& out) const;

 private:
  /// The spectra between the transposes; where one has nothing to do, two of them are one.
  struct Stages {
    Spectrum rows, planes;  // (all kx, y', z), (kx', y', all z)
  };
  Stages stages(const Spectrum& modes) const;
  StridedArray lines_of_x(const Field& f) const;

  Transpose rows_, planes_, columns_;  // that make the lines of x, the lines of z, the rows whole
  LineFft lines_;
  Field::Storage lines_of_x_;
  Spectrum modes_of_rows_, modes_of_planes_;  // empty where not needed
  int first_x_ = 0, first_z_ = 0;
  Spectrum spectrum_;
};

}  // namespace barchan
