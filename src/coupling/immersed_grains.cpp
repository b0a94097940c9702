#include "src/coupling/immersed_grains.hpp"

#include <algorithm>
#include <span>

#include "src/grains/grain_arrays.hpp"
#include "src/parallel/decomposition.hpp"
#include "src/parallel/launch.hpp"
#include "src/parallel/mirror.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

/// Numbers of a grain that other ranks need: place, velocity, spin, radius.
constexpr std::size_t kWidth = 10;

/// Ranks along an axis that have cells [begin, begin + n) of a period.
struct RanksAlong {
  int first = 0;  // has the first cell
  bool has_me = false, are_several = false;
  RanksAlong(const BlockPartition& cells, int begin, int n, int me) {
    const auto rank_of_cell = [&](int q) {
      const int cell = (begin + q) % cells.n;
      return cells.part_of(cell < 0 ? cell + cells.n : cell);
    };
    first = rank_of_cell(0);
    for (int q = 0; q < std::min(n, cells.n); ++q) {
      const int rank = rank_of_cell(q);
      has_me = has_me || rank == me;
      are_several = are_several || rank != first;
    }
  }
};

/// Adds up the first n values over ranks; T is a struct of Reals.
template <class T>
void sum_values(MPI_Comm ranks, const Kokkos::View<T*>& values, int n) {
  static_assert(sizeof(T) % sizeof(Real) == 0);
  const auto all = Kokkos::subview(values, std::pair(0, n));
  const auto on_host = host_copy(all);
  const std::size_t width = sizeof(T) / sizeof(Real);
  all_reduce(
      ranks,
      std::span<Real>(reinterpret_cast<Real*>(on_host.data()), width * static_cast<std::size_t>(n)),
      MPI_SUM);
  Kokkos::deep_copy(all, on_host);
}

/// Hands what was read at the markers of shared grains to the sums over ranks, or back.
struct MoveShared {
  Kokkos::View<const int*> shared;
  int n_markers;
  Kokkos::View<Vec3*> read, sums;
  bool back;
  KOKKOS_FUNCTION void operator()(int q) const {
    const int grain = shared(q / n_markers);
    if (grain < 0) return;
    Vec3& sum = sums(grain * n_markers + q % n_markers);
    if (back) {
      read(q) = sum;
    } else {
      sum = read(q);
    }
  }
};

/// Hands the sums of grains here to those of all.
struct MoveWater {
  Kokkos::View<const int*> index;
  int n_led;
  Kokkos::View<const WaterOfGrain*> here;
  Kokkos::View<WaterOfGrain*> all;
  KOKKOS_FUNCTION void operator()(int g) const {
    all(index(g)) = {g < n_led ? here(g).given : ImpulseOnWater{}, here(g).inner};
  }
};

}  // namespace

void ImmersedGrains::place(const GrainState& grains) {
  n_own_ = grains.n;
  if (grid_.ranks == nullptr) {
    kin_ = grains.kin;
    n_ = n_led_ = n_all_ = grains.n;
    return;
  }
  fetch_all(grains);
  list_here();
  kin_ = here_;
}

void ImmersedGrains::fetch_all(const GrainState& grains) {
  const MPI_Comm ranks = grid_.ranks->all();
  const auto me = static_cast<std::size_t>(rank_of(ranks));
  counts_.assign(static_cast<std::size_t>(rank_count(ranks)), 0);
  counts_[me] = grains.n;
  sum_over(ranks, counts_);
  n_all_ = first_own_ = 0;
  for (std::size_t rank = 0; rank < counts_.size(); ++rank) {
    if (rank == me) first_own_ = n_all_;
    n_all_ += static_cast<int>(counts_[rank]);
  }
  numbers_.assign(kWidth * static_cast<std::size_t>(n_all_), 0);
  auto to = numbers_.begin() + static_cast<std::ptrdiff_t>(kWidth) * first_own_;
  const auto kin = host_copy(grains.kin);
  for (int g = 0; g < grains.n; ++g) {
    for (const Vec3& v : {kin(g).x, kin(g).u, kin(g).omega})
      for (const Real one : {v.x, v.y, v.z}) *to++ = one;
    *to++ = kin(g).r;
  }
  all_reduce(ranks, std::span<Real>(numbers_), MPI_SUM);
}

/// Lists the grains that reach cells of this rank, first those whose first cell it has.
void ImmersedGrains::list_here() {
  const Decomposition& pencils = *grid_.ranks;
  reserve_entries(here_, n_all_);
  reserve_entries(index_, n_all_);
  reserve_entries(shared_, n_all_);
  const auto kin = mirror(here_);
  const auto index = mirror(index_), shared = mirror(shared_);
  n_ = n_led_ = 0;
  for (const bool led : {true, false}) {
    n_shared_ = 0;
    for (int g = 0; g < n_all_; ++g) {
      const Real* const at = numbers_.data() + kWidth * static_cast<std::size_t>(g);
      const Vec3 centre{at[0], at[1], at[2]};
      const PatchCorner corner = patch_.corner(centre);
      // A cell more at both ends: the faces inside a grain may go on beyond those of its markers.
      const auto along = [&](int axis, const BlockPartition& cells, const RankAxis& line) {
        const int begin = corner.centre[axis] - 1;
        return RanksAlong(cells, begin, corner.face[axis] + patch_.n[axis] + 1 - begin,
                          line.position);
      };
      const RanksAlong x = along(0, pencils.x(), pencils.along_x());
      const RanksAlong z = along(2, pencils.z(), pencils.along_z());
      const int among_shared = x.are_several || z.are_several ? n_shared_++ : -1;
      const bool is_led =
          x.first == pencils.along_x().position && z.first == pencils.along_z().position;
      if (is_led != led || !x.has_me || !z.has_me) continue;
      GrainKinematics grain;
      grain.x = centre, grain.u = {at[3], at[4], at[5]}, grain.omega = {at[6], at[7], at[8]};
      grain.r = at[9];
      kin(n_) = grain, index(n_) = g, shared(n_) = among_shared;
      ++n_;
    }
    if (led) n_led_ = n_;
  }
  Kokkos::deep_copy(here_, kin);
  Kokkos::deep_copy(index_, index);
  Kokkos::deep_copy(shared_, shared);
}

void ImmersedGrains::combine_read(const Kokkos::View<Vec3*>& read, int n_markers) {
  if (grid_.ranks == nullptr || n_shared_ == 0) return;
  const int n = n_shared_ * n_markers;
  reserve_entries(read_, n);
  Kokkos::deep_copy(read_, Vec3{});
  MoveShared move{shared_, n_markers, read, read_, false};
  Kokkos::parallel_for("immersed: give what was read", items(n_ * n_markers), move);
  sum_values(grid_.ranks->all(), read_, n);
  move.back = true;
  Kokkos::parallel_for("immersed: take what was read", items(n_ * n_markers), move);
}

Kokkos::View<const WaterOfGrain*> ImmersedGrains::of_own(const Kokkos::View<WaterOfGrain*>& water) {
  if (grid_.ranks == nullptr) return water;
  reserve_entries(water_, n_all_);
  Kokkos::deep_copy(water_, WaterOfGrain{});
  Kokkos::parallel_for("immersed: give sums", items(n_), MoveWater{index_, n_led_, water, water_});
  sum_values(grid_.ranks->all(), water_, n_all_);
  return Kokkos::subview(water_, std::pair(first_own_, first_own_ + n_own_));
}

}  // namespace barchan
