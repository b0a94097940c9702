// What the grains do to the fluid in one step.
#pragma once

#include "src/parallel/region.hpp"

namespace barchan {

/// On faces. Of the impulse wall faces and ghosts are not read.
struct ExchangeOnFaces {
  FaceVector impulse;                      // momentum per volume given to the fluid [N s/m^3]
  Field conductance_x{}, conductance_z{};  // of DragBetweenRows, on faces [kg/m^3]; empty: none
  Field stress_share{};              // of the stress, what the fluid takes; empty: its old fraction
  const NearGrains* near = nullptr;  // none: everywhere. Elsewhere water is clear: the new and the
                                     // old fraction are one, and nothing is exchanged or read
};

}  // namespace barchan
