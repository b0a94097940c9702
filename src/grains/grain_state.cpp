#include "src/grains/grain_state.hpp"

#include <algorithm>
#include <type_traits>

#include "kernels/grains/sphere.hpp"
#include "src/grains/grain_arrays.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/decomposition.hpp"
#include "src/parallel/launch.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

namespace {

/// Allocates the arrays that exist on this occasion.
void allocate(GrainState& s, Allocated when) {
  for_each_grain_array(s, [&](const GrainArray& about, auto& array) {
    using View = std::remove_reference_t<decltype(array)>;
    if constexpr (View::rank() == 1) {  // others are the solver's; this one exists without grains
      if (about.allocated == when)
        array = View(std::string(about.name), static_cast<std::size_t>(std::max(s.n, 1)));
    }
  });
}

/// Reorders the first n entries of an array with entries no wider than a Vec4.
template <class Entries>
void take_entries(const Entries& entries, const Kokkos::View<int*>& entry, int n,
                  const Kokkos::View<Vec4*>& room) {
  using Value = typename Entries::non_const_value_type;
  static_assert(sizeof(Value) <= sizeof(Vec4) && alignof(Value) <= alignof(Vec4));
  const Kokkos::View<Value*, Kokkos::MemoryUnmanaged> copy(reinterpret_cast<Value*>(room.data()),
                                                           room.extent(0));
  Kokkos::parallel_for(
      "grains: reorder", items(n), KOKKOS_LAMBDA(int g) { copy(g) = entries(entry(g)); });
  Kokkos::parallel_for(
      "grains: take in order", items(n), KOKKOS_LAMBDA(int g) { entries(g) = copy(g); });
}

/// Calls action(entries) for the parts of an array that are no wider than a Vec4.
template <class T, class Action>
requires(sizeof(T) <= sizeof(Vec4)) void for_each_part(const Kokkos::View<T*>& array,
                                                       const Action& action) {
  action(array);
}
template <class T, class Action>
requires(sizeof(T) > sizeof(Vec4)) void for_each_part(const Kokkos::View<T*>& array,
                                                      const Action& action) {
  constexpr int n = sizeof(T) / sizeof(Vec4);
  static_assert(sizeof(T) == n * sizeof(Vec4));
  using Parts = Kokkos::View<Vec4* [n], Kokkos::LayoutRight, Kokkos::MemoryUnmanaged>;
  const Parts parts(reinterpret_cast<Vec4*>(array.data()), array.extent(0));
  for (int part = 0; part < n; ++part) action(Kokkos::subview(parts, Kokkos::ALL(), part));
}
template <class Action>
void for_each_part(const Kokkos::View<Vec3**, Kokkos::LayoutLeft>& history, const Action& action) {
  for (std::size_t w = 0; w < history.extent(1); ++w)
    action(Kokkos::subview(history, Kokkos::ALL(), w));
}

}  // namespace

GrainState make_grain_entries(int n, MPI_Comm ranks) {
  GrainState s;
  s.n = n;
  s.ranks = ranks;
  allocate(s, Allocated::always);
  return s;
}

GrainState make_grain_state(const InitialGrains& initial, Real density, MPI_Comm ranks) {
  return make_grain_state(initial, std::span(&density, 1), ranks);
}

GrainState make_grain_state(const InitialGrains& initial, std::span<const Real> density,
                            MPI_Comm ranks) {
  const int n_all = static_cast<int>(initial.size());
  const BlockPartition shares{.n = n_all, .parts = rank_count(ranks)};
  const int first = shares.begin(rank_of(ranks)), n = shares.count(rank_of(ranks));
  GrainState s = make_grain_entries(n, ranks);
  const bool has_clumps = !initial.clump.empty();
  s.last_id = initial.last_id;
  for (const std::int64_t one : initial.id) {
    if (has_clumps && member_of_id(one) > 0) continue;
    ++s.n_initial;
    s.last_id = std::max(s.last_id, one);
  }

  if (!initial.heap.empty()) add_heaps(s, initial.heap_names);

  const auto kin = mirror(s.kin);
  const auto id = mirror(s.id);
  const bool has_kinds = !initial.kind.empty(), has_heaps = !initial.heap.empty();
  if (has_kinds) s.kind = Kokkos::View<std::uint8_t*>("kind", s.id.extent(0));
  const auto kind = mirror(s.kind), heap = mirror(s.heap);
  if (has_clumps) s.clump = Kokkos::View<ClumpMotion*>("clump", s.id.extent(0));
  const auto clump = mirror(s.clump);
  for (int g = 0; g < n; ++g) {
    const auto q = static_cast<std::size_t>(first) + static_cast<std::size_t>(g);
    const Real r = initial.diameter[q] / 2;
    const std::size_t k = density.size() > 1 ? static_cast<std::size_t>(initial.kind_of(q)) : 0;
    kin(g) = GrainKinematics{.x = initial.x[q],
                             .r = r,
                             .u = initial.u[q],
                             .m = density[k] * sphere_volume(r),
                             .omega = initial.omega[q]};
    id(g) = initial.id[q];
    if (has_clumps) clump(g) = initial.clump[q], kin(g).m = clump(g).m;
    if (has_kinds) kind(g) = initial.kind[q];
    if (has_heaps) heap(g) = initial.heap[q];
  }
  s.r_min = n_all > 0 ? initial.diameter[0] / 2 : 0;
  Real d3 = 0, d2 = 0;
  for (std::size_t g = 0; g < initial.size(); ++g) {
    s.r_max = std::max(s.r_max, initial.diameter[g] / 2);
    s.r_min = std::min(s.r_min, initial.diameter[g] / 2);
    if (has_clumps && member_of_id(initial.id[g]) > 0) continue;
    const Real d = has_clumps ? initial.clump[g].d : initial.diameter[g];
    d2 += d * d;
    d3 += d * d * d;
  }
  s.sauter_diameter = n_all > 0 ? d3 / d2 : 1;
  Kokkos::deep_copy(s.kin, kin);
  Kokkos::deep_copy(s.id, id);
  Kokkos::deep_copy(s.kind, kind);
  Kokkos::deep_copy(s.heap, heap);
  Kokkos::deep_copy(s.clump, clump);
  return s;
}

void add_heaps(GrainState& s, const std::vector<std::string>& names) {
  s.heap = Kokkos::View<std::uint8_t*>("heap", s.kin.extent(0));
  s.heap_names = names;
}

void reserve_entries(GrainState& s, int n, unsigned uses) {
  for_each_grain_array(s, uses, [n](const auto&, auto& array) { reserve_entries(array, n); });
}

void add_fluid(GrainState& s) {
  s.fluid.has_fluid = true;
  allocate(s, Allocated::with_fluid);
}

void add_exchange(GrainState& s, const ForceSwitches& forces) {
  allocate(s, Allocated::with_flow);
  if (forces.lift) allocate(s, Allocated::with_lift);
  s.fluid.has_torque = forces.torque;
  if (forces.torque) allocate(s, Allocated::with_torque);
}

void add_parts(GrainState& s) {
  s.fluid.part = Kokkos::View<PartOfClump*>("part", s.kin.extent(0));
}

void add_resolved_forces(GrainState& s) { allocate(s, Allocated::when_resolved); }

void add_immersed(GrainState& s) {
  add_resolved_forces(s);
  s.fluid.is_resolved = true;
  allocate(s, Allocated::when_immersed);
}

Kokkos::View<Real*> add_extra(GrainState& s, const std::string& name, const std::string& unit,
                              unsigned uses) {
  const Kokkos::View<Real*> values(name, s.kin.extent(0));
  s.extra.push_back({name, unit, uses, values});
  return values;
}

void permute(GrainState& s, const Kokkos::View<int*>& entry, int n,
             const Kokkos::View<Vec4*>& room) {
  for_each_grain_array(s, kAnyUse, [&](const auto&, const auto& array) {
    for_each_part(array, [&](const auto& entries) { take_entries(entries, entry, n, room); });
  });
  s.n = n;
}

}  // namespace barchan
