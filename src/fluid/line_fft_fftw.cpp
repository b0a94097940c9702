// LineFft by FFTW, on the host.
#include <fftw3.h>

#include <algorithm>
#include <stdexcept>

#include "src/fluid/line_fft.hpp"

namespace barchan {

static_assert(kOnHost || kRehearsal,
              "FFTW works on the host only: a device needs a library of its own");

namespace {

/// Lines that are transformed together: few enough for the nearest cache, and along z enough to
/// fill its lines.
constexpr int kRowsOfX = 8;
constexpr int kLinesOfZ = 8;

using Complex = Kokkos::complex<Real>;
/// Work space, of which every thread has a part.
template <class T>
using Space = Kokkos::View<T**, Kokkos::LayoutLeft, Kokkos::HostSpace>;
using Plan = std::unique_ptr<fftw_plan_s, decltype([](fftw_plan p) { fftw_destroy_plan(p); })>;

fftw_complex* as_fftw(Complex* z) { return reinterpret_cast<fftw_complex*>(z); }

Plan checked(fftw_plan plan) {
  if (plan == nullptr) throw std::runtime_error("FFTW could not make a plan for this grid");
  return Plan(plan);
}

/// Count of numbers that keeps what follows them aligned.
constexpr int aligned(int n) { return (n + 7) / 8 * 8; }

/// Shares items 0..n-1 out among threads, in stretches: work(item, thread).
template <class Work>
void share_out(const char* label, int n, int threads, const Work& work) {
  const auto first = [=](int t) { return static_cast<int>(std::int64_t{n} * t / threads); };
  Kokkos::parallel_for(label, threads, [&](int t) {
    for (int item = first(t); item < first(t + 1); ++item) work(item, t);
  });
}

/// Copies up to kLinesOfZ modes that lie beside each other. That many are whole vectors.
void copy_modes(const Complex* from, int n, Complex* to) {
  if (n == kLinesOfZ) {
    std::copy_n(from, kLinesOfZ, to);
  } else {
    std::copy_n(from, n, to);
  }
}

}  // namespace

/// One-dimensional plans, applied to lines that are copied into aligned memory: there FFTW uses
/// vectors, and a line is in the nearest cache. FFTW's own threads would plan the strided z
/// direction badly without measuring.
struct LineFft::Library {
  RealLines x;
  ComplexLines z;
  int rows = 0, row_length = 0, modes = 0;  // of x together; of one; its modes
  int blocks = 0;                           // of kLinesOfZ lines of z; the last may have fewer
  int threads = Kokkos::DefaultExecutionSpace().concurrency();
  Space<Real> rows_of_x;
  Space<Complex> modes_of_x, lines_of_z, columns;  // the last: (line, z, row)
  Plan x_forward, x_backward, z_forward, z_backward;

  Library(const RealLines& along_x, const ComplexLines& along_z);

  /// Modes of a row of a block, (line, z).
  std::size_t z_row() const { return std::size_t{kLinesOfZ} * static_cast<std::size_t>(z.n); }
  template <class Work>
  void each_rows(const char* label, const Work& work) const {
    if (rows == 0) return;
    share_out(label, x.planes, threads, [&](int k, int thread) {
      for (int j = 0; j < x.rows; j += rows) {
        const int first = std::min(j, x.rows - rows);
        work(first * x.row_stride + k * x.plane_stride,
             k * x.modes_per_plane() + std::ptrdiff_t{first} * modes, &rows_of_x(0, thread),
             &modes_of_x(0, thread));
      }
    });
  }
  /// Copies row j of a block into or out of an array of its own.
  void gather(const Complex* all, int block, int j, Complex* row) const {
    const auto [from, n] = start(block, j);
    for (int k = 0; k < z.n; ++k) copy_modes(all + from + k * plane(), n, row + k * kLinesOfZ);
  }
  void scatter(const Complex* row, int block, int j, Complex* all) const {
    const auto [to, n] = start(block, j);
    for (int k = 0; k < z.n; ++k) copy_modes(row + k * kLinesOfZ, n, all + to + k * plane());
  }
  std::ptrdiff_t plane() const { return std::ptrdiff_t{z.lines} * z.rows; }
  std::pair<std::ptrdiff_t, int> start(int block, int j) const {
    const int first = block * kLinesOfZ;
    return {std::ptrdiff_t{j} * z.lines + first, std::min(kLinesOfZ, z.lines - first)};
  }
  void transform_z(const char* label, const Plan& plan, Complex* all) const {
    share_out(label, blocks * z.rows, threads, [&](int item, int thread) {
      const int block = item / z.rows, j = item % z.rows;
      Complex *in = &lines_of_z(0, thread), *out = &columns(0, thread);
      gather(all, block, j, in);
      fftw_execute_dft(plan.get(), as_fftw(in), as_fftw(out));
      scatter(out, block, j, all);
    });
  }
};

LineFft::Library::Library(const RealLines& along_x, const ComplexLines& along_z)
    : x(along_x),
      z(along_z),
      rows(std::min(kRowsOfX, x.rows)),
      row_length(aligned(x.n)),
      modes(x.n / 2 + 1),
      blocks((z.lines + kLinesOfZ - 1) / kLinesOfZ),
      rows_of_x("fft: rows of x", aligned(row_length * rows), threads),
      modes_of_x("fft: modes of x", aligned(modes * rows), threads),
      lines_of_z("fft: lines of z", z.lines > 0 ? z_row() : 0, threads),
      columns("fft: columns", z.lines > 0 ? z_row() * z.rows : 0, threads) {
  // Estimating keeps the plan reproducible.
  if (rows > 0) {
    double* const r = rows_of_x.data();
    fftw_complex* const c = as_fftw(modes_of_x.data());
    x_forward = checked(fftw_plan_many_dft_r2c(1, &x.n, rows, r, nullptr, 1, row_length, c, nullptr,
                                               1, modes, FFTW_ESTIMATE));
    x_backward = checked(fftw_plan_many_dft_c2r(1, &x.n, rows, c, nullptr, 1, modes, r, nullptr, 1,
                                                row_length, FFTW_ESTIMATE));
  }
  if (z.lines == 0 || z.rows == 0) return;
  fftw_complex *const in = as_fftw(lines_of_z.data()), *const out = as_fftw(columns.data());
  const int n = kLinesOfZ;
  z_forward = checked(fftw_plan_many_dft(1, &z.n, n, in, nullptr, n, 1, out, nullptr, n, 1,
                                         FFTW_FORWARD, FFTW_ESTIMATE));
  z_backward = checked(fftw_plan_many_dft(1, &z.n, n, out, nullptr, n, 1, in, nullptr, n, 1,
                                          FFTW_BACKWARD, FFTW_ESTIMATE));
}

LineFft::LineFft(const RealLines& x, const ComplexLines& z)
    : x_(x), z_(z), library_(std::make_unique<Library>(x, z)) {}

LineFft::~LineFft() = default;

void LineFft::forward_x(const Real* real, Complex* modes) const {
  const Library& my = *library_;
  my.each_rows("fft: forward x", [&](std::ptrdiff_t from, std::ptrdiff_t to, Real* r, Complex* c) {
    for (int j = 0; j < my.rows; ++j)
      std::copy_n(real + from + j * x_.row_stride, x_.n, r + j * my.row_length);
    fftw_execute_dft_r2c(my.x_forward.get(), r, as_fftw(c));
    std::copy_n(c, my.rows * my.modes, modes + to);
  });
}

void LineFft::backward_x(Complex* modes, Real* real) const {
  const Library& my = *library_;
  my.each_rows("fft: backward x", [&](std::ptrdiff_t to, std::ptrdiff_t from, Real* r, Complex* c) {
    std::copy_n(modes + from, my.rows * my.modes, c);
    fftw_execute_dft_c2r(my.x_backward.get(), as_fftw(c), r);
    for (int j = 0; j < my.rows; ++j)
      std::copy_n(r + j * my.row_length, x_.n, real + to + j * x_.row_stride);
  });
}

void LineFft::forward_z(Complex* modes) const {
  library_->transform_z("fft: forward z", library_->z_forward, modes);
}

void LineFft::backward_z(Complex* modes) const {
  library_->transform_z("fft: backward z", library_->z_backward, modes);
}

void LineFft::solve_z(Complex* modes, const ColumnSolve& columns) const {
  if (!kOnHost) return solve_in_turn(modes, columns);  // columns lie as on a device
  const Library& my = *library_;
  const std::size_t row = my.z_row();
  share_out("fft: along z and columns", my.blocks, my.threads, [&](int block, int thread) {
    Complex *lines = &my.lines_of_z(0, thread), *all = &my.columns(0, thread);
    for (int j = 0; j < z_.rows; ++j) {
      my.gather(modes, block, j, lines);
      fftw_execute_dft(my.z_forward.get(), as_fftw(lines), as_fftw(all + j * row));
    }
    columns.solve(all, 0, static_cast<int>(row), block);
    for (int j = 0; j < z_.rows; ++j) {
      fftw_execute_dft(my.z_backward.get(), as_fftw(all + j * row), as_fftw(lines));
      my.scatter(lines, block, j, modes);
    }
  });
}

ModeGroups LineFft::groups() const {
  return kOnHost ? ModeGroups{kLinesOfZ, z_.n, z_.lines, z_.n} : plane_by_plane(z_.lines, z_.n);
}

}  // namespace barchan
