// Preconditioners of the pressure equation, as a case chooses them.
#pragma once

#include "kernels/math/alternatives.hpp"

namespace barchan {

/// Direct solve for clear fluid.
struct PlainFft {
  static constexpr Named named{"fft", "direct solve for clear fluid"};
  static constexpr bool relaxes = false;
};

/// Direct solve between sweeps over the columns that grains hinder (column_relaxation.hpp).
struct RelaxedFft {
  static constexpr Named named{"local_fft", "the same, and a relaxation in cells with grains"};
  static constexpr bool relaxes = true;
};

using Preconditioners = Alternatives<PlainFft, RelaxedFft>;

}  // namespace barchan
