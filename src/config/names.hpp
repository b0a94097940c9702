// The names of the choices in a configuration: one table per enum, in the order of its values.
#pragma once

#include <array>
#include <string_view>

#include "src/config/config.hpp"

namespace barchan {

template <class Choice>
struct ChoiceNames;  // unspecialised: not a configuration enum

template <>
struct ChoiceNames<Turbulence> {
  static constexpr std::array<std::string_view, 2> value{"none", "wale"};
};
template <>
struct ChoiceNames<WallFlow> {
  static constexpr std::array<std::string_view, 2> value{"no_slip", "free_slip"};
};
template <>
struct ChoiceNames<CoulombLimit> {
  static constexpr std::array<std::string_view, 2> value{"total", "elastic"};
};
template <>
struct ChoiceNames<RollingModel> {
  static constexpr std::array<std::string_view, 4> value{"none", "epsd2", "theta_m", "cdt"};
};
template <>
struct ChoiceNames<ContactModel> {
  static constexpr std::array<std::string_view, 2> value{"hertz_mindlin", "linear"};
};
template <>
struct ChoiceNames<GrainBoundaryX> {
  static constexpr std::array<std::string_view, 3> value{"exit", "periodic", "wall"};
};
template <>
struct ChoiceNames<GrainBoundaryZ> {
  static constexpr std::array<std::string_view, 2> value{"periodic", "wall"};
};
template <>
struct ChoiceNames<DragLaw> {
  static constexpr std::array<std::string_view, 7> value{
      "gidaspow", "di_felice", "koch_hill", "syamlal_obrien", "beetstra", "paper_repaired", "none"};
};
template <>
struct ChoiceNames<VoidFraction> {
  static constexpr std::array<std::string_view, 3> value{"divided", "cfdem_faithful", "centre"};
};
template <>
struct ChoiceNames<Preconditioner> {
  static constexpr std::array<std::string_view, 4> value{"fft", "local_fft", "jacobi", "none"};
};
// A value added at the end of an enum without its name here fails these.
static_assert(ChoiceNames<RollingModel>::value.size() == std::size_t(RollingModel::cdt) + 1);
static_assert(ChoiceNames<GrainBoundaryX>::value.size() == std::size_t(GrainBoundaryX::wall) + 1);
static_assert(ChoiceNames<DragLaw>::value.size() == std::size_t(DragLaw::none) + 1);
static_assert(ChoiceNames<VoidFraction>::value.size() == std::size_t(VoidFraction::centre) + 1);
static_assert(ChoiceNames<Preconditioner>::value.size() == std::size_t(Preconditioner::none) + 1);

/// The name of a choice as in the TOML file.
template <class Choice>
constexpr std::string_view choice_name(Choice choice) {
  return ChoiceNames<Choice>::value[static_cast<std::size_t>(choice)];
}

/// The members of coupling.forces, by name.
struct ForceName {
  std::string_view name;
  bool ForceSwitches::*on;
};
inline constexpr std::array<ForceName, 5> force_names{
    {{"drag", &ForceSwitches::drag},
     {"pressure_gradient", &ForceSwitches::pressure_gradient},
     {"stress", &ForceSwitches::stress},
     {"added_mass", &ForceSwitches::added_mass},
     {"buoyancy", &ForceSwitches::buoyancy}}};

}  // namespace barchan
