#include "src/fft.hpp"

#include <fftw3.h>

#include <stdexcept>

#include "src/launch.hpp"

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
  const Field field("fft: field", grid);
  real_ = Kokkos::create_mirror_view(field.storage);
  spectrum_ = Kokkos::create_mirror_view(make_spectrum("fft: spectrum"));
  row_ = field.stride_y;
  plane_ = field.stride_z;
  Real* real = real_.data() + 1 + row_ + plane_;
  fftw_complex* z = as_fftw(spectrum_.data());
  // Rows of a field start anywhere, hence unaligned; estimating keeps the plan reproducible.
  const unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
  plans_->x_forward = checked(fftw_plan_many_dft_r2c(1, &nx_, ny_, real, nullptr, 1, field.stride_y,
                                                     z, nullptr, 1, modes, flags));
  plans_->x_backward = checked(fftw_plan_many_dft_c2r(1, &nx_, ny_, z, nullptr, 1, modes, real,
                                                      nullptr, 1, field.stride_y, flags));
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

void PlaneFft::forward_on_host(const Real* in, Kokkos::complex<Real>* out) const {
  const fftw_plan along_x = plans_->x_forward, along_z = plans_->z_forward;
  const std::ptrdiff_t plane = plane_, modes = nx_ / 2 + 1, ny = ny_;
  Kokkos::parallel_for("fft: forward x", Kokkos::RangePolicy<Host>(0, nz_), [=](int k) {
    // FFTW's interface lacks a const; a real transform out of place keeps its input.
    fftw_execute_dft_r2c(along_x, const_cast<Real*>(in) + k * plane, as_fftw(out + k * modes * ny));
  });
  if (nz_ == 1) return;
  Kokkos::parallel_for("fft: forward z", Kokkos::RangePolicy<Host>(0, ny_), [=](int j) {
    fftw_execute_dft(along_z, as_fftw(out + j * modes), as_fftw(out + j * modes));
  });
}

void PlaneFft::backward_on_host(Kokkos::complex<Real>* in, Real* out) const {
  const fftw_plan along_x = plans_->x_backward, along_z = plans_->z_backward;
  const std::ptrdiff_t plane = plane_, modes = nx_ / 2 + 1, ny = ny_;
  if (nz_ > 1) {
    Kokkos::parallel_for("fft: backward z", Kokkos::RangePolicy<Host>(0, ny_), [=](int j) {
      fftw_execute_dft(along_z, as_fftw(in + j * modes), as_fftw(in + j * modes));
    });
  }
  Kokkos::parallel_for("fft: backward x", Kokkos::RangePolicy<Host>(0, nz_), [=](int k) {
    fftw_execute_dft_c2r(along_x, as_fftw(in + k * modes * ny), out + k * plane);
  });
}

void PlaneFft::forward(const Field& in, const Spectrum& out) const {
  if constexpr (runs_on_host) {
    forward_on_host(in.origin, out.data());
  } else {
    Kokkos::deep_copy(real_, in.storage);
    forward_on_host(real_.data() + 1 + row_ + plane_, spectrum_.data());
    Kokkos::deep_copy(out, spectrum_);
  }
}

void PlaneFft::backward(const Spectrum& in, const Field& out) const {
  if constexpr (runs_on_host) {
    backward_on_host(in.data(), out.origin);
  } else {
    Kokkos::deep_copy(spectrum_, in);
    backward_on_host(spectrum_.data(), real_.data() + 1 + row_ + plane_);
    Kokkos::deep_copy(out.storage, real_);
  }
}

}  // namespace barchan
