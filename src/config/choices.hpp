// What keys of a case may choose from. The words are those that the types name themselves, or the
// enumerators as they stand here.
#pragma once

#include "kernels/bodies/body.hpp"
#include "kernels/coupling/drag.hpp"
#include "kernels/fluid/preconditioners.hpp"
#include "kernels/fluid/start_flows.hpp"  // IWYU pragma: export
#include "kernels/grains/law_table.hpp"   // IWYU pragma: export

namespace barchan {

using BodyShape = Choice<BodyShapes>;
using ContactModel = Choice<ContactModels>;
using DragLaw = Choice<DragLaws>;
using Preconditioner = Choice<Preconditioners>;
using RollingModel = Choice<RollingModels>;

enum class Turbulence { none, wale };
enum class WallFlow { no_slip, free_slip };
enum class CoulombLimit { total, elastic };  // normal force that limits friction
enum class GrainBoundaryX { exit, periodic, wall, follow };
enum class GrainBoundaryZ { periodic, wall };
enum class GrainFloor { smooth, glued };
enum class PourShape { cone, bed };
enum class HeapShape { cone, ridge, bed };
enum class FeedAmount { given, as_lost };
enum class VoidFraction { divided, centre };
enum class CouplingScheme { layered, centred, smoothed, cfdem };

}  // namespace barchan
