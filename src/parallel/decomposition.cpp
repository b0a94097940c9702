#include "src/parallel/decomposition.hpp"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

namespace barchan {

namespace {

/// Cost of a shape in a flow step, in numbers that pass through memory per row of cells. It has
/// three parts. Transposes: two for a cut in x (3 numbers a cell there and back), one for a cut in
/// z (2), each read or written six times on its way. Halos of some 40 fields. Messages: about 400
/// numbers a row, however short they are.
double cost_of(const BlockPartition& x, const BlockPartition& z) {
  const double cells = double(x.n) * z.n / (double(x.parts) * z.parts);
  const auto transposes = [cells](int parts, int numbers, int times) {
    return parts == 1 ? 0 : 6 * numbers * cells + 400 * times * (parts - 1);
  };
  const auto halo = [](int parts, const BlockPartition& other) {
    return parts == 1 ? 0 : 2.0 * other.count(0);
  };
  return transposes(x.parts, 3, 4) + transposes(z.parts, 2, 2) +
         40 * (halo(x.parts, z) + halo(z.parts, x));
}

/// Number of ranks along x, or 0 if `count` of them do not fit.
int best_count_along_x(int count, int nx, int nz) {
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int along_x = 1; along_x <= count; ++along_x) {
    const int along_z = count / along_x;
    if (along_x * along_z != count) continue;
    if (!Decomposition::is_thick_enough(nx, along_x)) continue;
    if (!Decomposition::is_thick_enough(nz, along_z)) continue;
    const double cost = cost_of({nx, along_x}, {nz, along_z});
    if (cost < least) least = cost, best = along_x;
  }
  return best;
}

[[noreturn]] void refuse(int count, int nx, int nz) {
  int fewer = count - 1;
  while (best_count_along_x(fewer, nx, nz) == 0) --fewer;
  throw std::runtime_error(fmt::format(
      "--ranks: {} ranks cannot share {} x {} columns of cells in pencils at least {} cells thick; "
      "the next smaller number that can is {}",
      count, nx, nz, Decomposition::kThinnest, fewer));
}

RankAxis line_of(MPI_Comm all, int colour, int key) {
  RankAxis line;
  MPI_Comm_split(all, colour, key, &line.communicator);
  MPI_Comm_size(line.communicator, &line.count);
  MPI_Comm_rank(line.communicator, &line.position);
  return line;
}

}  // namespace

Decomposition::Decomposition(MPI_Comm all, int nx, int nz, int along_x) {
  int count = 1, rank = 0;
  MPI_Comm_size(all, &count);
  MPI_Comm_rank(all, &rank);
  const int count_x = along_x > 0 ? along_x : best_count_along_x(count, nx, nz);
  if (count_x == 0) refuse(count, nx, nz);
  MPI_Comm_dup(all, &all_);
  x_ = {.n = nx, .parts = count_x};
  z_ = {.n = nz, .parts = count / count_x};
  along_x_ = line_of(all_, rank / count_x, rank % count_x);
  along_z_ = line_of(all_, rank % count_x, rank / count_x);
}

Decomposition::~Decomposition() {
  for (MPI_Comm* communicator : {&along_x_.communicator, &along_z_.communicator, &all_}) {
    if (*communicator != MPI_COMM_NULL) MPI_Comm_free(communicator);
  }
}

}  // namespace barchan
