// What keys of a case may choose from. Their words are in values.hpp.
#pragma once

namespace barchan {

enum class Turbulence { none, wale };
enum class WallFlow { no_slip, free_slip };
enum class CoulombLimit { total, elastic };  // normal force that limits friction
enum class RollingModel { none, epsd2, theta_m, cdt };
enum class ContactModel { hertz_mindlin, linear };
enum class GrainBoundaryX { exit, periodic, wall, follow };
enum class GrainBoundaryZ { periodic, wall };
enum class GrainFloor { smooth, glued };
enum class PourShape { cone, bed };
enum class HeapShape { cone, ridge, bed };
enum class FeedAmount { given, as_lost };
enum class BodyShape { cylinder, sphere, half_sphere, box, fence, dune, wave };
enum class BodyAxis { x, y, z };
enum class DragLaw {
  gidaspow,
  di_felice,
  koch_hill,
  syamlal_obrien,
  beetstra,
  paper_repaired,
  gidaspow_blended,
  none
};
enum class VoidFraction { divided, centre };
enum class CouplingScheme { layered, centred, smoothed, cfdem };
enum class Preconditioner { fft, local_fft };

}  // namespace barchan
