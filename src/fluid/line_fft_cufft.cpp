// LineFft by cuFFT, on the stream of Kokkos' default execution space: nothing of it waits for the
// device or allocates after the plans are made.
#include <cufft.h>

#include <stdexcept>
#include <string>

#include "src/fluid/line_fft.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

void check(cufftResult result, const char* what) {
  if (result == CUFFT_SUCCESS) return;
  throw std::runtime_error(std::string("cuFFT could not ") + what + " (error " +
                           std::to_string(static_cast<int>(result)) + ")");
}

cufftDoubleComplex* as_cufft(Kokkos::complex<Real>* z) {
  return reinterpret_cast<cufftDoubleComplex*>(z);
}

// cuFFT wants complex alignment also of real data, which the inside of a field does not have.
using Inside = Kokkos::View<Real***, Kokkos::LayoutLeft>;  // (n, rows, planes)

}  // namespace

struct LineFft::Library {
  CellRange cells;
  Inside inside;
  cufftHandle x_forward = 0, x_backward = 0, z_both = 0;

  Library(const RealLines& x, const ComplexLines& z)
      : cells{0, x.n, 0, x.rows, 0, x.planes}, inside("fft: inside", x.n, x.rows, x.planes) {
    int nx = x.n, nz = z.n, modes = x.n / 2 + 1, stride = z.lines * z.rows;
    const int batch = x.rows * x.planes;
    if (batch > 0) {
      check(cufftPlanMany(&x_forward, 1, &nx, &nx, 1, nx, &modes, 1, modes, CUFFT_D2Z, batch),
            "plan a forward transform for this grid");
      check(cufftPlanMany(&x_backward, 1, &nx, &modes, 1, modes, &nx, 1, nx, CUFFT_Z2D, batch),
            "plan a backward transform for this grid");
    }
    if (stride > 0 && nz > 1) {
      check(cufftPlanMany(&z_both, 1, &nz, &nz, stride, 1, &nz, stride, 1, CUFFT_Z2Z, stride),
            "plan a transform along z for this grid");
    }
    for (const cufftHandle plan : {x_forward, x_backward, z_both}) {
      if (plan == 0) continue;
      check(cufftSetStream(plan, Kokkos::DefaultExecutionSpace().cuda_stream()), "set a stream");
    }
  }
  ~Library() {
    for (const cufftHandle plan : {x_forward, x_backward, z_both}) {
      if (plan != 0) cufftDestroy(plan);
    }
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

LineFft::LineFft(const RealLines& x, const ComplexLines& z)
    : x_(x), z_(z), library_(std::make_unique<Library>(x, z)) {}

LineFft::~LineFft() = default;

void LineFft::forward_x(const Real* real, Kokkos::complex<Real>* modes) const {
  const Library& library = *library_;
  if (library.x_forward == 0) return;
  const Inside inside = library.inside;
  const std::ptrdiff_t row = x_.row_stride, plane = x_.plane_stride;
  for_each_cell(
      "fft: pack", library.cells,
      KOKKOS_LAMBDA(int i, int j, int k) { inside(i, j, k) = real[i + j * row + k * plane]; });
  check(cufftExecD2Z(library.x_forward, library.inside.data(), as_cufft(modes)),
        "transform forward");
}

void LineFft::backward_x(Kokkos::complex<Real>* modes, Real* real) const {
  const Library& library = *library_;
  if (library.x_backward == 0) return;
  check(cufftExecZ2D(library.x_backward, as_cufft(modes), library.inside.data()),
        "transform backward");
  const Inside inside = library.inside;
  const std::ptrdiff_t row = x_.row_stride, plane = x_.plane_stride;
  for_each_cell(
      "fft: unpack", library.cells,
      KOKKOS_LAMBDA(int i, int j, int k) { real[i + j * row + k * plane] = inside(i, j, k); });
}

void LineFft::forward_z(Kokkos::complex<Real>* modes) const {
  if (library_->z_both == 0) return;
  check(cufftExecZ2Z(library_->z_both, as_cufft(modes), as_cufft(modes), CUFFT_FORWARD),
        "transform along z");
}

void LineFft::backward_z(Kokkos::complex<Real>* modes) const {
  if (library_->z_both == 0) return;
  check(cufftExecZ2Z(library_->z_both, as_cufft(modes), as_cufft(modes), CUFFT_INVERSE),
        "transform along z");
}

void LineFft::solve_z(Kokkos::complex<Real>* modes, const ColumnSolve& columns) const {
  solve_in_turn(modes, columns);
}

ModeGroups LineFft::groups() const { return plane_by_plane(z_.lines, z_.n); }

}  // namespace barchan
