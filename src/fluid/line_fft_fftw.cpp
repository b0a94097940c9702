// LineFft by FFTW, on the host.
#include <fftw3.h>

#include <stdexcept>
#include <vector>

#include "src/fluid/line_fft.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

static_assert(kOnHost || kRehearsal,
              "FFTW works on the host only: a device needs a library of its own");

namespace {

fftw_complex* as_fftw(Kokkos::complex<Real>* z) { return reinterpret_cast<fftw_complex*>(z); }

/// FFTW takes what it only reads without const.
double* read_only(const Real* real) {
  return const_cast<double*>(real);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

/// Every row of a contiguous array in place.
void transform_rows(const char* label, fftw_plan plan, const ComplexLines& z,
                    Kokkos::complex<Real>* modes) {
  if (z.n == 1 || plan == nullptr) return;
  const std::ptrdiff_t lines = z.lines;
  Kokkos::parallel_for(label, z.rows, [=](int j) {
    fftw_execute_dft(plan, as_fftw(modes + j * lines), as_fftw(modes + j * lines));
  });
}

using Plan = std::unique_ptr<fftw_plan_s, decltype([](fftw_plan p) { fftw_destroy_plan(p); })>;

Plan checked(fftw_plan plan) {
  if (plan == nullptr) throw std::runtime_error("FFTW could not make a plan for this grid");
  return Plan(plan);
}

}  // namespace

/// One-dimensional plans, applied to one z plane (x) or one row (z) at a time: FFTW's own threads
/// would plan the strided z direction badly without measuring.
struct LineFft::Library {
  /// Plans along x: for a plane that starts as those of a field do, in which FFTW may use vectors;
  /// and for one that starts anywhere.
  struct AlongX {
    Plan forward, backward;
  };
  AlongX x_as_planned, x_anywhere;
  int alignment = 0;  // FFTW's, of the planes of x_as_planned
  Plan z_forward, z_backward;

  const AlongX& along_x(const double* plane) const {
    return fftw_alignment_of(read_only(plane)) == alignment ? x_as_planned : x_anywhere;
  }
};

LineFft::LineFft(const RealLines& x, const ComplexLines& z)
    : x_(x), z_(z), library_(std::make_unique<Library>()) {
  // Estimating keeps the plan reproducible and leaves the arrays alone, which therefore need not be
  // those of the transforms.
  const int modes = x.n / 2 + 1, stride = z.lines * z.rows;
  const int row_stride = static_cast<int>(x.row_stride);
  std::vector<Real> real(static_cast<std::size_t>(x.first + x.rows * x.row_stride + x.n));
  std::vector<Kokkos::complex<Real>> complex(
      static_cast<std::size_t>(std::max(modes * x.rows, stride * z.n)));
  double* const r = real.data() + x.first;
  fftw_complex* const c = as_fftw(complex.data());
  const auto along_x = [&](unsigned flags) -> Library::AlongX {
    return {checked(fftw_plan_many_dft_r2c(1, &x.n, x.rows, r, nullptr, 1, row_stride, c, nullptr,
                                           1, modes, flags)),
            checked(fftw_plan_many_dft_c2r(1, &x.n, x.rows, c, nullptr, 1, modes, r, nullptr, 1,
                                           row_stride, flags))};
  };
  if (x.rows > 0) {
    library_->alignment = fftw_alignment_of(r);
    library_->x_as_planned = along_x(FFTW_ESTIMATE);
    library_->x_anywhere = along_x(FFTW_ESTIMATE | FFTW_UNALIGNED);
  }
  if (z.lines == 0) return;
  const auto along_z = [&](int sign) {
    return checked(fftw_plan_many_dft(1, &z.n, z.lines, c, nullptr, stride, 1, c, nullptr, stride,
                                      1, sign, FFTW_ESTIMATE));
  };
  library_->z_forward = along_z(FFTW_FORWARD);
  library_->z_backward = along_z(FFTW_BACKWARD);
}

LineFft::~LineFft() = default;

void LineFft::forward_x(const Real* real, Kokkos::complex<Real>* modes) const {
  const Library& plans = *library_;
  const std::ptrdiff_t plane = x_.plane_stride, modes_plane = x_.modes_per_plane();
  if (x_.rows == 0) return;
  Kokkos::parallel_for("fft: forward x", x_.planes, [=, &plans](int k) {
    const Real* first = real + k * plane;
    fftw_execute_dft_r2c(plans.along_x(first).forward.get(), read_only(first),
                         as_fftw(modes + k * modes_plane));
  });
}

void LineFft::backward_x(Kokkos::complex<Real>* modes, Real* real) const {
  const Library& plans = *library_;
  const std::ptrdiff_t plane = x_.plane_stride, modes_plane = x_.modes_per_plane();
  if (x_.rows == 0) return;
  Kokkos::parallel_for("fft: backward x", x_.planes, [=, &plans](int k) {
    Real* first = real + k * plane;
    fftw_execute_dft_c2r(plans.along_x(first).backward.get(), as_fftw(modes + k * modes_plane),
                         first);
  });
}

void LineFft::forward_z(Kokkos::complex<Real>* modes) const {
  transform_rows("fft: forward z", library_->z_forward.get(), z_, modes);
}

void LineFft::backward_z(Kokkos::complex<Real>* modes) const {
  transform_rows("fft: backward z", library_->z_backward.get(), z_, modes);
}

}  // namespace barchan
