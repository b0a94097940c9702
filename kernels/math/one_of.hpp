// Value of one of several small types, on a device as on the host.
#pragma once

#include <Kokkos_Macros.hpp>

#include "kernels/math/alternatives.hpp"

namespace barchan {

template <class First, class... Rest>
union PartsOfOne {
  First first;
  PartsOfOne<Rest...> rest;

  KOKKOS_FUNCTION constexpr PartsOfOne() : first() {}
  KOKKOS_FUNCTION constexpr explicit PartsOfOne(const First& value) : first(value) {}
  template <class Type>
  KOKKOS_FUNCTION constexpr explicit PartsOfOne(const Type& value) : rest(value) {}
  template <class F>
  KOKKOS_FORCEINLINE_FUNCTION constexpr auto visit(std::size_t place, const F& f) const {
    return place == 0 ? f(first) : rest.visit(place - 1, f);
  }
};

template <class Last>
union PartsOfOne<Last> {
  Last first;

  KOKKOS_FUNCTION constexpr PartsOfOne() : first() {}
  KOKKOS_FUNCTION constexpr explicit PartsOfOne(const Last& value) : first(value) {}
  template <class F>
  KOKKOS_FORCEINLINE_FUNCTION constexpr auto visit(std::size_t, const F& f) const {
    return f(first);
  }
};

/// Variant for host and device. Its types can be copied bit by bit.
template <class List>
class OneOf;
template <class... Types>
class OneOf<Alternatives<Types...>> {
 public:
  OneOf() = default;
  template <class Type>
  explicit OneOf(const Type& value)
      : place_(Alternatives<Types...>::template place_of<Type>()), parts_(value) {}
  /// Returns f(the value that it holds).
  template <class F>
  KOKKOS_FORCEINLINE_FUNCTION constexpr auto visit(const F& f) const {
    return parts_.visit(place_, f);
  }

 private:
  static_assert((std::is_trivially_copyable_v<Types> && ...));
  std::size_t place_ = 0;
  PartsOfOne<Types...> parts_;
};

}  // namespace barchan
