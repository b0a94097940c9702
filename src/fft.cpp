#include "src/fft.hpp"

#include <fftw3.h>

#include <stdexcept>

namespace barchan {

namespace {

using Host = Kokkos::DefaultHostExecutionSpace;

fftw_complex* as_fftw(Kokkos::complex<Real>* z) { return reinterpret_cast<fftw_complex*>(z); }

fftw_plan checked(fftw_plan plan) {
  if (plan == nullptr) throw std::runtime_error("FFTW could not make a plan for this grid");
  return plan;
}

}  // namespace

/// One-dimensional plans, applied to one z plane (x) or one row (z) at a time: FFTW's own threads
/// would plan the strided z direction badly without measuring.
struct PlaneFft::Plans {
  fftw_plan x_forward = nullptr, x_backward = nullptr, z_forward = nullptr, z_backward = nullptr;
  ~Plans() {
    for (fftw_plan plan : {x_forward, x_backward, z_forward, z_backward}) {
      if (plan != nullptr) fftw_destroy_plan(plan);
    }
  }
};

PlaneFft::PlaneFft(const Grid& grid)
    : plans_(std::make_unique<Plans>()), nx_(grid.nx), ny_(grid.ny), nz_(grid.nz) {
  const int modes = nx_ / 2 + 1;
  const Field real("fft plan: real", grid);
  const Spectrum spectrum = make_spectrum("fft plan: spectrum");
  fftw_complex* z = as_fftw(spectrum.data());
  // Rows of a field start anywhere, hence unaligned; estimating keeps the plan reproducible.
  const unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
  plans_->x_forward = checked(fftw_plan_many_dft_r2c(1, &nx_, ny_, real.origin, nullptr, 1,
                                                     real.stride_y, z, nullptr, 1, modes, flags));
  plans_->x_backward = checked(fftw_plan_many_dft_c2r(
      1, &nx_, ny_, z, nullptr, 1, modes, real.origin, nullptr, 1, real.stride_y, flags));
  const int stride = modes * ny_;
  plans_->z_forward = checked(fftw_plan_many_dft(1, &nz_, modes, z, nullptr, stride, 1, z, nullptr,
                                                 stride, 1, FFTW_FORWARD, flags));
  plans_->z_backward = checked(fftw_plan_many_dft(1, &nz_, modes, z, nullptr, stride, 1, z, nullptr,
                                                  stride, 1, FFTW_BACKWARD, flags));
}

PlaneFft::~PlaneFft() = default;

Spectrum PlaneFft::make_spectrum(const char* label) const {
  return Spectrum(label, nx_ / 2 + 1, ny_, nz_);
}

void PlaneFft::forward(const Field& in, const Spectrum& out) const {
  const fftw_plan along_x = plans_->x_forward, along_z = plans_->z_forward;
  Kokkos::parallel_for("fft: forward x", Kokkos::RangePolicy<Host>(0, nz_), [=](int k) {
    fftw_execute_dft_r2c(along_x, &in(0, 0, k), as_fftw(&out(0, 0, k)));
  });
  if (nz_ == 1) return;
  Kokkos::parallel_for("fft: forward z", Kokkos::RangePolicy<Host>(0, ny_), [=](int j) {
    fftw_execute_dft(along_z, as_fftw(&out(0, j, 0)), as_fftw(&out(0, j, 0)));
  });
}

void PlaneFft::backward(const Spectrum& in, const Field& out) const {
  const fftw_plan along_x = plans_->x_backward, along_z = plans_->z_backward;
  if (nz_ > 1) {
    Kokkos::parallel_for("fft: backward z", Kokkos::RangePolicy<Host>(0, ny_), [=](int j) {
      fftw_execute_dft(along_z, as_fftw(&in(0, j, 0)), as_fftw(&in(0, j, 0)));
    });
  }
  Kokkos::parallel_for("fft: backward x", Kokkos::RangePolicy<Host>(0, nz_), [=](int k) {
    fftw_execute_dft_c2r(along_x, as_fftw(&in(0, 0, k)), &out(0, 0, k));
  });
}

}  // namespace barchan
