#include "src/grain_state.hpp"

#include <algorithm>

namespace barchan {

namespace {

template <class View>
View rows(const char* label, int n) {
  return View(label, static_cast<std::size_t>(n));
}

/// One spare array per element type, so that reordering allocates once.
template <class T>
Kokkos::View<T*>& spare() {
  static Kokkos::View<T*> array;
  static bool hooked = false;
  if (!hooked) {
    Kokkos::push_finalize_hook([] { array = {}; });
    hooked = true;
  }
  return array;
}

template <class T>
void take_rows(Kokkos::View<T*>& array, const Kokkos::View<int*>& row, int n) {
  Kokkos::View<T*>& target = spare<T>();
  if (target.extent(0) != array.extent(0)) {
    target = Kokkos::View<T*>(array.label(), array.extent(0));
  }
  const Kokkos::View<T*> from = array, to = target;
  Kokkos::parallel_for(
      "grains: reorder", n, KOKKOS_LAMBDA(int g) { to(g) = from(row(g)); });
  std::swap(array, target);
}

void take_rows(Kokkos::View<Vec3**, Kokkos::LayoutLeft>& array, const Kokkos::View<int*>& row,
               int n) {
  for (std::size_t w = 0; w < array.extent(1); ++w) {
    Kokkos::View<Vec3*>& copy = spare<Vec3>();
    if (copy.extent(0) != array.extent(0)) copy = Kokkos::View<Vec3*>("rows", array.extent(0));
    const Kokkos::View<Vec3*> from = copy;
    const auto column = Kokkos::subview(array, Kokkos::ALL(), w);
    Kokkos::deep_copy(from, column);
    Kokkos::parallel_for(
        "grains: reorder wall history", n, KOKKOS_LAMBDA(int g) { column(g) = from(row(g)); });
  }
}

}  // namespace

GrainState make_grain_state(const InitialGrains& initial, Real density) {
  GrainState s;
  const int n = static_cast<int>(initial.id.size());
  s.n = n;
  s.n_initial = n;
  s.kin = rows<decltype(s.kin)>("grain kinematics", n);
  s.id = rows<decltype(s.id)>("grain id", n);
  for (Kokkos::View<Vec3*>* array :
       {&s.contact_force, &s.contact_torque, &s.x_reference, &s.fluid.u_f, &s.fluid.steady_force,
        &s.fluid.drag_impulse, &s.exchange.u_start, &s.exchange.added_mass_force,
        &s.exchange.fluid_force, &s.exchange.carried_impulse, &s.exchange.paid_impulse}) {
    *array = rows<Kokkos::View<Vec3*>>("grain vector", n);
  }
  s.fluid.beta = rows<Kokkos::View<Real*>>("drag coefficient", n);
  s.fluid.added_mass = rows<Kokkos::View<Real*>>("added mass", n);
  s.wall_touching = rows<Kokkos::View<std::uint8_t*>>("wall touching", n);

  const auto kin = Kokkos::create_mirror_view(s.kin);
  const auto id = Kokkos::create_mirror_view(s.id);
  s.r_min = n > 0 ? initial.diameter[0] / 2 : 0;
  Real d3 = 0, d2 = 0;
  for (int g = 0; g < n; ++g) {
    const auto q = static_cast<std::size_t>(g);
    const Real r = initial.diameter[q] / 2;
    kin(g) = GrainKinematics{.x = initial.x[q],
                             .r = r,
                             .u = initial.u[q],
                             .m = density * sphere_volume(r),
                             .omega = initial.omega[q]};
    id(g) = initial.id[q];
    s.r_max = std::max(s.r_max, r);
    s.r_min = std::min(s.r_min, r);
    d2 += 4 * r * r;
    d3 += 8 * r * r * r;
  }
  s.sauter_diameter = n > 0 ? d3 / d2 : 1;
  Kokkos::deep_copy(s.kin, kin);
  Kokkos::deep_copy(s.id, id);
  return s;
}

void permute(GrainState& s, const Kokkos::View<int*>& row, int n) {
  take_rows(s.kin, row, n);
  take_rows(s.id, row, n);
  for (Kokkos::View<Vec3*>* array :
       {&s.contact_force, &s.contact_torque, &s.x_reference, &s.fluid.u_f, &s.fluid.steady_force,
        &s.fluid.drag_impulse, &s.exchange.u_start, &s.exchange.added_mass_force,
        &s.exchange.fluid_force, &s.exchange.carried_impulse, &s.exchange.paid_impulse}) {
    take_rows(*array, row, n);
  }
  take_rows(s.fluid.beta, row, n);
  take_rows(s.fluid.added_mass, row, n);
  take_rows(s.wall_xi_t, row, n);
  take_rows(s.wall_torque, row, n);
  take_rows(s.wall_touching, row, n);
  s.n = n;
}

}  // namespace barchan
