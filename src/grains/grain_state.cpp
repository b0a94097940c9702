#include "src/grains/grain_state.hpp"

#include <algorithm>

#include "src/grains/grain_arrays.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/decomposition.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

template <class View>
View rows(const char* label, int n) {
  return View(label, static_cast<std::size_t>(std::max(n, 1)));  // it exists even without grains
}

/// Reorders the n first of a column of values; any column fits the room.
template <class Column>
void take_rows(const Column& column, const Kokkos::View<int*>& row, int n,
               const Kokkos::View<Quad*>& room) {
  using Value = typename Column::non_const_value_type;
  static_assert(sizeof(Value) <= sizeof(Quad) && alignof(Value) <= alignof(Quad));
  const Kokkos::View<Value*, Kokkos::MemoryUnmanaged> copy(reinterpret_cast<Value*>(room.data()),
                                                           room.extent(0));
  Kokkos::parallel_for(
      "grains: reorder", items(n), KOKKOS_LAMBDA(int g) { copy(g) = column(row(g)); });
  Kokkos::parallel_for(
      "grains: take in order", items(n), KOKKOS_LAMBDA(int g) { column(g) = copy(g); });
}

}  // namespace

GrainState make_grain_rows(int n, MPI_Comm ranks) {
  GrainState s;
  s.n = n;
  s.ranks = ranks;
  s.kin = rows<decltype(s.kin)>("grain kinematics", n);
  s.id = rows<decltype(s.id)>("grain id", n);
  for (Kokkos::View<Vec3*>* array :
       {&s.contact_force, &s.contact_torque, &s.x_reference, &s.fluid.steady_force}) {
    *array = rows<Kokkos::View<Vec3*>>("grain vector", n);
  }
  s.wall_touching = rows<Kokkos::View<std::uint8_t*>>("wall touching", n);
  return s;
}

GrainState make_grain_state(const InitialGrains& initial, Real density, MPI_Comm ranks) {
  const int n_all = static_cast<int>(initial.size());
  const Split shares{.n = n_all, .parts = rank_count(ranks)};
  const int first = shares.begin(rank_of(ranks)), n = shares.count(rank_of(ranks));
  GrainState s = make_grain_rows(n, ranks);
  s.n_initial = n_all;

  const auto kin = Kokkos::create_mirror_view(s.kin);
  const auto id = Kokkos::create_mirror_view(s.id);
  for (int g = 0; g < n; ++g) {
    const auto q = static_cast<std::size_t>(first) + static_cast<std::size_t>(g);
    const Real r = initial.diameter[q] / 2;
    kin(g) = GrainKinematics{.x = initial.x[q],
                             .r = r,
                             .u = initial.u[q],
                             .m = density * sphere_volume(r),
                             .omega = initial.omega[q]};
    id(g) = initial.id[q];
  }
  s.r_min = n_all > 0 ? initial.diameter[0] / 2 : 0;
  Real d3 = 0, d2 = 0;
  for (const Real d : initial.diameter) {
    s.r_max = std::max(s.r_max, d / 2);
    s.r_min = std::min(s.r_min, d / 2);
    d2 += d * d;
    d3 += d * d * d;
  }
  s.sauter_diameter = n_all > 0 ? d3 / d2 : 1;
  Kokkos::deep_copy(s.kin, kin);
  Kokkos::deep_copy(s.id, id);
  return s;
}

void reserve_rows(GrainState& s, int n) {
  for_each_array(s, [n](auto& array) { reserve_rows(array, n); });
}

void add_fluid(GrainState& s) {
  s.fluid.none = false;
  for (Kokkos::View<Vec3*>* array : {&s.fluid.u_f, &s.fluid.drag_impulse, &s.fluid.u_start}) {
    *array = rows<Kokkos::View<Vec3*>>("grain vector", s.n);
  }
  s.fluid.beta = rows<Kokkos::View<Real*>>("drag coefficient", s.n);
  s.fluid.added_mass = rows<Kokkos::View<Real*>>("added mass", s.n);
}

void add_exchange(GrainState& s) {
  for (Kokkos::View<Vec3*>* array :
       {&s.exchange.added_mass_force, &s.exchange.fluid_force, &s.exchange.carried_impulse}) {
    *array = rows<Kokkos::View<Vec3*>>("grain vector", s.n);
  }
}

void permute(GrainState& s, const Kokkos::View<int*>& row, int n, const Kokkos::View<Quad*>& room) {
  for_each_column(s, [&](const auto& column) { take_rows(column, row, n, room); });
  s.n = n;
}

}  // namespace barchan
