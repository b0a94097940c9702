// A flow that was computed on another mesh of the same box, or of one of which this is a part.
#pragma once

#include "kernels/fluid/interpolation.hpp"

namespace barchan {

/// Sets face vectors and cell values of one grid to those of another, which is as large or larger,
/// trilinear between its nodes; at walls its ghost rows take part. Exact for fields that are linear
/// along each axis.
struct FlowFromMesh {
  GridRef from, to;
  Vec3 corner;  // of this box in the other [m]
  ConstFaceRef u_from, du_dt_from;
  ConstFieldRef p_from, nu_t_from, alpha_from;
  FaceRef u, du_dt;  // velocity [m/s] and its change in time [m/s^2]
  FieldRef p, nu_t, alpha;

  KOKKOS_INLINE_FUNCTION PointStencil at(Real x, Real y, Real z) const {
    return {from, from.box(true), corner + Vec3{x, y, z}};
  }
  KOKKOS_INLINE_FUNCTION void operator()(int i, int j, int k) const {
    const Real x = to.x_centre(i), y = to.y_centre(j), z = to.z_centre(k);
    const PointStencil on_x = at(to.x_face(i), y, z), on_y = at(x, to.y_face(j), z),
                       on_z = at(x, y, to.z_face(k)), centre = at(x, y, z);
    const auto set = [&](const FaceRef& v, const ConstFaceRef& of) {
      v.x(i, j, k) = interpolate(of.x, on_x.x_faces, on_x.y_centre);
      v.y(i, j, k) = j > 0 ? interpolate(of.y, on_y.centres, on_y.y_face) : 0;
      v.z(i, j, k) = interpolate(of.z, on_z.z_faces, on_z.y_centre);
    };
    set(u, u_from);
    set(du_dt, du_dt_from);
    p(i, j, k) = interpolate_cell(p_from, centre);
    nu_t(i, j, k) = interpolate_cell(nu_t_from, centre);
    alpha(i, j, k) = interpolate_cell(alpha_from, centre);
  }
};

/// v = factor v on the faces of a cell.
struct ScaleFaces {
  Real factor;
  FaceRef v;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    v.x(i, j, k) *= factor;
    v.y(i, j, k) *= factor;
    v.z(i, j, k) *= factor;
  }
};

}  // namespace barchan
