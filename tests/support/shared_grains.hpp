// Grains on one rank alone and among all ranks, side by side.
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "src/diagnostics/gathered_grains.hpp"
#include "tests/support/grain_bench.hpp"

namespace barchan::test {

/// The numbers of all ranks, one rank after the other.
inline std::vector<double> from_all_ranks(const std::vector<double>& mine) {
  return broadcast(on_rank_0(MPI_COMM_WORLD, mine), MPI_COMM_WORLD);
}

/// Position, velocity, spin, contact force and torque of the owned grains by id.
using GrainNumbers = std::map<std::int64_t, std::vector<double>>;
inline std::vector<double> numbers_of(const GrainState& s) {
  const auto kin = host_copy(s.kin);
  const auto id = host_copy(s.id);
  const auto force = host_copy(s.contact_force), torque = host_copy(s.contact_torque);
  std::vector<double> numbers;
  for (int g = 0; g < s.n; ++g) {
    numbers.push_back(static_cast<double>(id(g)));
    for (const Vec3& v : {kin(g).x, kin(g).u, kin(g).omega, force(g), torque(g)})
      numbers.insert(numbers.end(), {v.x, v.y, v.z});
  }
  return numbers;
}
/// Fails on an id that is there twice.
inline GrainNumbers by_id(const std::vector<double>& numbers) {
  constexpr std::size_t width = 16;
  GrainNumbers grains;
  for (auto at = numbers.begin(); at != numbers.end(); at += width) {
    const bool is_new =
        grains.emplace(static_cast<std::int64_t>(*at), std::vector<double>(at + 1, at + width))
            .second;
    EXPECT_TRUE(is_new) << "grain " << *at << " is on two ranks";
  }
  return grains;
}

/// Largest difference of each vector relative to its largest component among all grains; infinity
/// if the grains are not the same.
inline std::vector<double> differences(const GrainNumbers& a, const GrainNumbers& b) {
  std::vector<double> off(5, 0), size(5, 1e-300);
  for (const auto& [id, numbers] : a) {
    const auto other = b.find(id);
    if (other == b.end() || a.size() != b.size()) return std::vector<double>(5, INFINITY);
    for (std::size_t q = 0; q < numbers.size(); ++q) {
      off[q / 3] = std::max(off[q / 3], std::abs(numbers[q] - other->second[q]));
      size[q / 3] = std::max(size[q / 3], std::abs(numbers[q]));
    }
  }
  for (std::size_t q = 0; q < off.size(); ++q) off[q] /= size[q];
  return off;
}

/// The rows [begin, end).
inline void move_by_the_last_bit(const GrainState& grains, int begin, int end) {
  const auto kin = grains.kin;
  Kokkos::parallel_for(
      "test: last bit", Kokkos::RangePolicy<>(begin, end),
      KOKKOS_LAMBDA(int row) { kin(row).x.x *= 1 + 4e-16; });
}

/// One case twice: on one rank, and among all.
struct SharedGrains {
  SharedGrains(const Config& c, const InitialGrains& grains)
      : whole(c, grains, MPI_COMM_SELF), shared(c, grains, MPI_COMM_WORLD) {}
  void advance(int n, Real dt) {
    for (GrainBench* s : {&whole, &shared}) {
      s->advance(n, dt);
      s->solver.remove_left(s->state);
    }
  }
  std::vector<double> off() const {
    return differences(by_id(numbers_of(whole.state)),
                       by_id(from_all_ranks(numbers_of(shared.state))));
  }
  GrainBench whole, shared;
};

}  // namespace barchan::test
