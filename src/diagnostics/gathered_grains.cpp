#include "src/diagnostics/gathered_grains.hpp"

#include <algorithm>

#include "src/parallel/communicator.hpp"

namespace barchan {

namespace {

/// On rank 0: how many numbers each rank has, and where these begin among all.
struct Gathered {
  std::vector<int> counts, starts{0};
  Gathered(MPI_Comm ranks, int n) : counts(static_cast<std::size_t>(rank_count(ranks))) {
    MPI_Gather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, ranks);
    for (const int count : counts) starts.push_back(starts.back() + count);
  }
};

}  // namespace

std::vector<double> on_rank_0(MPI_Comm ranks, const std::vector<double>& mine) {
  if (rank_count(ranks) == 1) return mine;
  const int n = static_cast<int>(mine.size());
  const Gathered of(ranks, n);
  std::vector<double> all;
  if (rank_of(ranks) == 0) all.resize(static_cast<std::size_t>(of.starts.back()));
  MPI_Gatherv(mine.data(), n, MPI_DOUBLE, all.data(), of.counts.data(), of.starts.data(),
              MPI_DOUBLE, 0, ranks);
  return all;
}

std::vector<int> from_rank_0(MPI_Comm ranks, const std::vector<int>& all, int n) {
  if (rank_count(ranks) == 1) return all;
  const Gathered of(ranks, n);
  std::vector<int> mine(static_cast<std::size_t>(n));
  MPI_Scatterv(all.data(), of.counts.data(), of.starts.data(), MPI_INT, mine.data(), n, MPI_INT, 0,
               ranks);
  return mine;
}

GatheredGrains::GatheredGrains(const GrainState& grains) {
  const auto kin = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, grains.kin);
  for (int g = 0; g < grains.n; ++g) {
    const Vec3& x = kin(g).x;
    centres_.insert(centres_.end(), {x.x, x.y, x.z});
    diameters_.push_back(2 * kin(g).r);
    u_x_.push_back(kin(g).u.x);
  }
  for (std::vector<double>* numbers : {&centres_, &diameters_, &u_x_})
    *numbers = on_rank_0(grains.ranks, *numbers);
}

std::vector<Vec3> gathered(const GrainState& grains, const Kokkos::View<Vec3*>& of_grain) {
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, of_grain);
  const auto* mine = reinterpret_cast<const double*>(host.data());
  const std::vector<double> all = on_rank_0(grains.ranks, {mine, mine + 3 * grains.n});
  std::vector<Vec3> vectors(all.size() / 3);
  std::copy(all.begin(), all.end(), reinterpret_cast<double*>(vectors.data()));
  return vectors;
}

}  // namespace barchan
