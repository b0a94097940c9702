// The names of the choices in a configuration, in the order of the values of each enum.
#pragma once

#include <array>
#include <string_view>
#include <type_traits>

#include "src/config/config.hpp"

namespace barchan {

namespace detail {

template <class... Names>
constexpr auto list(Names... names) {
  return std::array<std::string_view, sizeof...(names)>{names...};
}

constexpr auto names_of(Turbulence) { return list("none", "wale"); }
constexpr auto names_of(WallFlow) { return list("no_slip", "free_slip"); }
constexpr auto names_of(CoulombLimit) { return list("total", "elastic"); }
constexpr auto names_of(RollingModel) { return list("none", "epsd2", "theta_m", "cdt"); }
constexpr auto names_of(ContactModel) { return list("hertz_mindlin", "linear"); }
constexpr auto names_of(GrainBoundaryX) { return list("exit", "periodic", "wall"); }
constexpr auto names_of(GrainBoundaryZ) { return list("periodic", "wall"); }
constexpr auto names_of(DragLaw) {
  return list("gidaspow", "di_felice", "koch_hill", "syamlal_obrien", "beetstra", "paper_repaired",
              "none");
}
constexpr auto names_of(VoidFraction) { return list("divided", "cfdem_faithful", "centre"); }
constexpr auto names_of(Preconditioner) { return list("fft", "local_fft"); }

}  // namespace detail

template <class Choice>
inline constexpr auto choice_names = detail::names_of(Choice{});

// A value added at the end of an enum without its name here fails these.
static_assert(choice_names<RollingModel>.size() == std::size_t(RollingModel::cdt) + 1);
static_assert(choice_names<GrainBoundaryX>.size() == std::size_t(GrainBoundaryX::wall) + 1);
static_assert(choice_names<DragLaw>.size() == std::size_t(DragLaw::none) + 1);
static_assert(choice_names<VoidFraction>.size() == std::size_t(VoidFraction::centre) + 1);
static_assert(choice_names<Preconditioner>.size() == std::size_t(Preconditioner::local_fft) + 1);

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
