// Faces that are closed: bodies in the flow, made of whole cells.
#pragma once

#include "kernels/fluid/stencil.hpp"

namespace barchan {

/// Closes faces of a face vector: `open` is 1 where water may pass, 0 where it may not. Velocity
/// and mobility are zero there. Velocities along a surface vanish where they stand, half a cell
/// inside.
struct CloseFacesOf {
  ConstFaceRef open;
  FaceRef f;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    f.x(i, j, k) *= open.x(i, j, k);
    f.y(i, j, k) *= open.y(i, j, k);
    f.z(i, j, k) *= open.z(i, j, k);
  }
};

/// u_z += f_z dt: the drive across, where it acts.
struct DriveAcross {
  FieldRef u_z;
  Real drive_dt;  // [m/s]
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    u_z(i, j, k) += drive_dt;
  }
};

}  // namespace barchan
