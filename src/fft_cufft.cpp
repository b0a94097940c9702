// PlaneFft by cuFFT, on the stream of Kokkos' default execution space: nothing of it waits for the
// device or allocates after the plans are made.
#include <cufft.h>

#include <stdexcept>
#include <string>

#include "src/fft.hpp"
#include "src/launch.hpp"

namespace barchan {

namespace {

void check(cufftResult result, const char* what) {
  if (result == CUFFT_SUCCESS) return;
  throw std::runtime_error(std::string("cuFFT could not ") + what + " (error " +
                           std::to_string(static_cast<int>(result)) + ")");
}

cufftDoubleComplex* as_cufft(const Spectrum& z) {
  return reinterpret_cast<cufftDoubleComplex*>(z.data());
}

// cuFFT wants complex alignment also of real data, which the inside of a field does not have.
using Inside = Kokkos::View<Real***, Kokkos::LayoutLeft>;  // (nx, ny, nz), no ghosts

struct Pack {
  FieldRef field;
  Inside inside;
  KOKKOS_FUNCTION void operator()(int i, int j, int k) const { inside(i, j, k) = field(i, j, k); }
};
struct Unpack {
  FieldRef field;
  Inside inside;
  KOKKOS_FUNCTION void operator()(int i, int j, int k) const { field(i, j, k) = inside(i, j, k); }
};

}  // namespace

/// A transform over x and z of all rows at once: batches j lie side by side in a plane.
struct PlaneFft::Library {
  CellRange cells;
  Inside inside;
  cufftHandle forward = 0, backward = 0;

  explicit Library(const Grid& grid)
      : cells(owned_cells(grid)), inside("fft: inside", grid.nx, grid.ny, grid.nz) {
    const int modes = grid.nx / 2 + 1;
    // Slowest first; a row of the second extent is what lies between two planes. One plane alone
    // has no transform along z.
    int n[2] = {grid.nz, grid.nx};
    int real[2] = {grid.nz, grid.nx * grid.ny}, spectral[2] = {grid.nz, modes * grid.ny};
    const int first = grid.nz > 1 ? 0 : 1, rank = 2 - first;
    check(cufftPlanMany(&forward, rank, n + first, real + first, 1, grid.nx, spectral + first, 1,
                        modes, CUFFT_D2Z, grid.ny),
          "plan a forward transform for this grid");
    check(cufftPlanMany(&backward, rank, n + first, spectral + first, 1, modes, real + first, 1,
                        grid.nx, CUFFT_Z2D, grid.ny),
          "plan a backward transform for this grid");
    for (const cufftHandle plan : {forward, backward}) {
      check(cufftSetStream(plan, Kokkos::DefaultExecutionSpace().cuda_stream()), "set a stream");
    }
  }
  ~Library() {
    for (const cufftHandle plan : {forward, backward}) {
      if (plan != 0) cufftDestroy(plan);
    }
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

PlaneFft::PlaneFft(const Grid& grid)
    : nx_(grid.nx),
      ny_(grid.ny),
      nz_(grid.nz),
      spectrum_(make_spectrum("fft: spectrum")),
      library_(std::make_unique<Library>(grid)) {}

PlaneFft::~PlaneFft() = default;

void PlaneFft::forward(const Field& in, const Spectrum& out) const {
  for_each_cell("fft: pack", library_->cells, Pack{in, library_->inside});
  check(cufftExecD2Z(library_->forward, library_->inside.data(), as_cufft(out)),
        "transform forward");
}

void PlaneFft::backward(const Spectrum& in, const Field& out) const {
  check(cufftExecZ2D(library_->backward, as_cufft(in), library_->inside.data()),
        "transform backward");
  for_each_cell("fft: unpack", library_->cells, Unpack{out, library_->inside});
}

}  // namespace barchan
