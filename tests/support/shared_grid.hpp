// Problem on one rank alone and cut among all ranks, side by side.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "src/parallel/communicator.hpp"
#include "src/parallel/decomposition.hpp"
#include "tests/support/flow_fields.hpp"

namespace barchan::test {

/// Largest difference over the owned cells of all ranks, and largest magnitude.
struct Difference {
  double largest = 0, magnitude = 0;
};
inline Difference difference_over_ranks(const Field& of_whole, const Field& of_mine,
                                        const Grid& mine) {
  const HostField a = to_host(of_whole), b = to_host(of_mine);
  Difference d;
  for_owned_cells(mine, [&](int i, int j, int k) {
    const double exact = a(i + mine.i_begin, j, k + mine.k_begin);
    const double off = std::abs(b(i, j, k) - exact);
    d.largest = off <= d.largest ? d.largest : off;  // keeps what is not a number
    d.magnitude = std::max(d.magnitude, std::abs(exact));
  });
  MPI_Allreduce(MPI_IN_PLACE, &d, 2, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return d;
}

/// Every rank has all of the grid, and its pencil of it.
struct SharedGrid {
  SharedGrid(std::array<int, 3> n, std::array<double, 3> size, double first, int along_x = 0)
      : ranks(std::make_unique<const Decomposition>(MPI_COMM_WORLD, n[0], n[2], along_x)),
        whole(stretched_grid(n, size, first)),
        mine(stretched_grid(n, size, first, ranks.get())) {}

  /// Sets both to value(i, j, k) with the cells counted over all ranks.
  template <class Value>
  void set(const Field& of_whole, const Field& of_mine, Value value) const {
    set_field(of_whole, whole, value);
    set_field(of_mine, mine,
              [&](int i, int j, int k) { return value(i + mine.i_begin, j, k + mine.k_begin); });
  }

  /// Largest difference over the owned cells of all ranks, relative to the largest magnitude.
  double difference(const Field& of_whole, const Field& of_mine) const {
    const Difference d = difference_over_ranks(of_whole, of_mine, mine);
    return d.largest / d.magnitude;
  }

  std::unique_ptr<const Decomposition> ranks;
  Grid whole, mine;
};

/// Numbers of ranks along x that pencils of n cells allow: all shapes of as many ranks as there
/// are.
inline std::vector<int> shapes(std::array<int, 3> n) {
  const int count = rank_count(MPI_COMM_WORLD);
  std::vector<int> found;
  for (int x = 1; x <= count; ++x) {
    if (count % x == 0 && Decomposition::is_thick_enough(n[0], x) &&
        Decomposition::is_thick_enough(n[2], count / x)) {
      found.push_back(x);
    }
  }
  return found;
}

/// A number in [-1, 1] for each cell, the same on every rank.
inline double noise(int i, int j, int k, unsigned seed = 1) {
  std::uint64_t h = seed;
  for (const int n : {i, j, k}) {
    h = (h ^ static_cast<std::uint64_t>(n)) * 0x9e3779b97f4a7c15u;
    h ^= h >> 29;
  }
  return 2 * (static_cast<double>(h >> 11) * 0x1p-53) - 1;
}

}  // namespace barchan::test
