// LineFft by FFTW, on the host.
#include <fftw3.h>

#include <stdexcept>
#include <vector>

#include "src/fluid/line_fft.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

static_assert(runs_on_host, "FFTW works on the host only: a device needs a library of its own");

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
  Plan x_forward, x_backward, z_forward, z_backward;
};

LineFft::LineFft(const RealLines& x, const ComplexLines& z)
    : x_(x), z_(z), library_(std::make_unique<Library>()) {
  // Rows of a field start anywhere, hence unaligned; estimating keeps the plan reproducible and
  // leaves the arrays alone, which therefore need not be those of the transforms.
  const unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
  const int modes = x.n / 2 + 1, stride = z.lines * z.rows;
  const int row_stride = static_cast<int>(x.row_stride);
  std::vector<Real> real(static_cast<std::size_t>(x.rows * x.row_stride + x.n));
  std::vector<Kokkos::complex<Real>> complex(
      static_cast<std::size_t>(std::max(modes * x.rows, stride * z.n)));
  fftw_complex* c = as_fftw(complex.data());
  if (x.rows > 0) {
    library_->x_forward = checked(fftw_plan_many_dft_r2c(1, &x.n, x.rows, real.data(), nullptr, 1,
                                                         row_stride, c, nullptr, 1, modes, flags));
    library_->x_backward = checked(fftw_plan_many_dft_c2r(
        1, &x.n, x.rows, c, nullptr, 1, modes, real.data(), nullptr, 1, row_stride, flags));
  }
  if (z.lines == 0) return;
  const auto along_z = [&](int sign) {
    return checked(fftw_plan_many_dft(1, &z.n, z.lines, c, nullptr, stride, 1, c, nullptr, stride,
                                      1, sign, flags));
  };
  library_->z_forward = along_z(FFTW_FORWARD);
  library_->z_backward = along_z(FFTW_BACKWARD);
}

LineFft::~LineFft() = default;

void LineFft::forward_x(const Real* real, Kokkos::complex<Real>* modes) const {
  const fftw_plan plan = library_->x_forward.get();
  const std::ptrdiff_t plane = x_.plane_stride, modes_plane = x_.modes_per_plane();
  if (plan == nullptr) return;
  Kokkos::parallel_for("fft: forward x", x_.planes, [=](int k) {
    fftw_execute_dft_r2c(plan, read_only(real + k * plane), as_fftw(modes + k * modes_plane));
  });
}

void LineFft::backward_x(Kokkos::complex<Real>* modes, Real* real) const {
  const fftw_plan plan = library_->x_backward.get();
  const std::ptrdiff_t plane = x_.plane_stride, modes_plane = x_.modes_per_plane();
  if (plan == nullptr) return;
  Kokkos::parallel_for("fft: backward x", x_.planes, [=](int k) {
    fftw_execute_dft_c2r(plan, as_fftw(modes + k * modes_plane), real + k * plane);
  });
}

void LineFft::forward_z(Kokkos::complex<Real>* modes) const {
  transform_rows("fft: forward z", library_->z_forward.get(), z_, modes);
}

void LineFft::backward_z(Kokkos::complex<Real>* modes) const {
  transform_rows("fft: backward z", library_->z_backward.get(), z_, modes);
}

}  // namespace barchan
