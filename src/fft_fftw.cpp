// PlaneFft by FFTW, on the host.
#include <fftw3.h>

#include <cstddef>
#include <stdexcept>

#include "src/fft.hpp"
#include "src/launch.hpp"

namespace barchan {

static_assert(runs_on_host, "FFTW works on the host only: a device needs a library of its own");

namespace {

fftw_complex* as_fftw(Kokkos::complex<Real>* z) { return reinterpret_cast<fftw_complex*>(z); }

fftw_plan checked(fftw_plan plan) {
  if (plan == nullptr) throw std::runtime_error("FFTW could not make a plan for this grid");
  return plan;
}

}  // namespace

/// One-dimensional plans, applied to one z plane (x) or one row (z) at a time: FFTW's own threads
/// would plan the strided z direction badly without measuring.
struct PlaneFft::Library {
  fftw_plan x_forward = nullptr, x_backward = nullptr, z_forward = nullptr, z_backward = nullptr;
  ~Library() {
    for (fftw_plan plan : {x_forward, x_backward, z_forward, z_backward}) {
      if (plan != nullptr) fftw_destroy_plan(plan);
    }
  }
};

PlaneFft::PlaneFft(const Grid& grid)
    : nx_(grid.nx),
      ny_(grid.ny),
      nz_(grid.nz),
      spectrum_(make_spectrum("fft: spectrum")),
      library_(std::make_unique<Library>()) {
  const int modes = nx_ / 2 + 1;
  const Field field("fft: field", grid);
  Real* real = field.origin;
  fftw_complex* z = as_fftw(spectrum_.data());
  // Rows of a field start anywhere, hence unaligned; estimating keeps the plan reproducible.
  const unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
  library_->x_forward = checked(fftw_plan_many_dft_r2c(
      1, &nx_, ny_, real, nullptr, 1, field.stride_y, z, nullptr, 1, modes, flags));
  library_->x_backward = checked(fftw_plan_many_dft_c2r(1, &nx_, ny_, z, nullptr, 1, modes, real,
                                                        nullptr, 1, field.stride_y, flags));
  const int stride = modes * ny_;
  library_->z_forward = checked(fftw_plan_many_dft(1, &nz_, modes, z, nullptr, stride, 1, z,
                                                   nullptr, stride, 1, FFTW_FORWARD, flags));
  library_->z_backward = checked(fftw_plan_many_dft(1, &nz_, modes, z, nullptr, stride, 1, z,
                                                    nullptr, stride, 1, FFTW_BACKWARD, flags));
}

PlaneFft::~PlaneFft() = default;

void PlaneFft::forward(const Field& in, const Spectrum& out) const {
  const fftw_plan along_x = library_->x_forward, along_z = library_->z_forward;
  const std::ptrdiff_t plane = in.stride_z, modes = nx_ / 2 + 1, ny = ny_;
  Real* from = in.origin;
  Kokkos::complex<Real>* to = out.data();
  Kokkos::parallel_for("fft: forward x", nz_, [=](int k) {
    fftw_execute_dft_r2c(along_x, from + k * plane, as_fftw(to + k * modes * ny));
  });
  if (nz_ == 1) return;
  Kokkos::parallel_for("fft: forward z", ny_, [=](int j) {
    fftw_execute_dft(along_z, as_fftw(to + j * modes), as_fftw(to + j * modes));
  });
}

void PlaneFft::backward(const Spectrum& in, const Field& out) const {
  const fftw_plan along_x = library_->x_backward, along_z = library_->z_backward;
  const std::ptrdiff_t plane = out.stride_z, modes = nx_ / 2 + 1, ny = ny_;
  Kokkos::complex<Real>* from = in.data();
  Real* to = out.origin;
  if (nz_ > 1) {
    Kokkos::parallel_for("fft: backward z", ny_, [=](int j) {
      fftw_execute_dft(along_z, as_fftw(from + j * modes), as_fftw(from + j * modes));
    });
  }
  Kokkos::parallel_for("fft: backward x", nz_, [=](int k) {
    fftw_execute_dft_c2r(along_x, as_fftw(from + k * modes * ny), to + k * plane);
  });
}

}  // namespace barchan
