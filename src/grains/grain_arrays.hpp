// All that belongs to a grain, column by column: for what reorders, moves or copies grains.
#pragma once

#include <type_traits>

#include "kernels/grains/pack.hpp"
#include "src/grains/grain_state.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

/// Calls action(array) for every per-grain array that the state has.
template <class Action>
void for_each_array(GrainState& s, const Action& action) {
  action(s.kin);
  action(s.id);
  for (Kokkos::View<Vec3*>* array :
       {&s.contact_force, &s.contact_torque, &s.x_reference, &s.fluid.u_f, &s.fluid.steady_force,
        &s.fluid.drag_impulse, &s.fluid.u_start, &s.exchange.added_mass_force,
        &s.exchange.fluid_force, &s.exchange.carried_impulse}) {
    if (array->extent(0) > 0) action(*array);
  }
  for (Kokkos::View<Real*>* array : {&s.fluid.beta, &s.fluid.added_mass}) {
    if (array->extent(0) > 0) action(*array);
  }
  for (auto* history : {&s.wall_xi_t, &s.wall_torque}) {
    if (history->extent(1) > 0) action(*history);
  }
  action(s.wall_touching);
}

namespace grain_columns_detail {

template <class T, class Action>
void for_each_column_of(const Kokkos::View<T*>& array, const Action& action) {
  action(array);
}
template <class Action>
void for_each_column_of(const Kokkos::View<GrainKinematics*>& kin, const Action& action) {
  using Parts = Kokkos::View<Quad* [3], Kokkos::LayoutRight, Kokkos::MemoryUnmanaged>;
  static_assert(sizeof(GrainKinematics) == 3 * sizeof(Quad));
  const Parts parts(reinterpret_cast<Quad*>(kin.data()), kin.extent(0));
  for (int part = 0; part < 3; ++part) action(Kokkos::subview(parts, Kokkos::ALL(), part));
}
template <class Action>
void for_each_column_of(const Kokkos::View<Vec3**, Kokkos::LayoutLeft>& history,
                        const Action& action) {
  for (std::size_t w = 0; w < history.extent(1); ++w)
    action(Kokkos::subview(history, Kokkos::ALL(), w));
}

}  // namespace grain_columns_detail

/// Calls action(column) for every column of them; none is wider than a Quad.
template <class Action>
void for_each_column(GrainState& s, const Action& action) {
  for_each_array(
      s, [&](const auto& array) { grain_columns_detail::for_each_column_of(array, action); });
}

namespace grain_columns_detail {

template <class T>
void add_to(RecordLayout& layout, const Kokkos::View<T*>& array) {
  // NOLINTNEXTLINE(bugprone-sizeof-expression): T may be Real itself
  layout.add(array.data(), sizeof(T), sizeof(T) / sizeof(Real));
}
inline void add_to(RecordLayout& layout, const Kokkos::View<Vec3**, Kokkos::LayoutLeft>& history) {
  for (std::size_t w = 0; w < history.extent(1); ++w)
    layout.add(history.data() + w * history.stride(1), sizeof(Vec3), sizeof(Vec3) / sizeof(Real));
}

}  // namespace grain_columns_detail

/// What of a grain travels together. `arrays` calls an action for each array of a state that does.
template <class Arrays>
RecordLayout record_layout(GrainState& state, const Arrays& arrays) {
  RecordLayout layout;
  arrays(state, [&](auto& array) { grain_columns_detail::add_to(layout, array); });
  return layout;
}

/// Room for n rows of one array, an eighth more where it grows; what it holds stays.
template <class View>
void reserve_rows(View& array, int n) {
  const auto rows = static_cast<std::size_t>(n);
  if (array.extent(0) >= rows) return;
  const std::size_t room = rows + rows / 8;
  if constexpr (View::rank() == 2) {
    Kokkos::resize(array, room, array.extent(1));
  } else {
    Kokkos::resize(array, room);
  }
}

}  // namespace barchan
