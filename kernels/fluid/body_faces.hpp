// Faces of the grid that bodies at rest close, and those next to them, which their walls slow down.
#pragma once

#include "kernels/fluid/stencil.hpp"

namespace barchan {

/// Middle of a face across x (axis 0), y (1) or z (2).
template <class Rows>
KOKKOS_INLINE_FUNCTION Vec3 face_middle(const BasicGrid<Rows>& grid, int axis, int i, int j,
                                        int k) {
  return {axis == 0 ? grid.x_face(i) : grid.x_centre(i),
          axis == 1 ? grid.y_face(j) : grid.y_centre(j),
          axis == 2 ? grid.z_face(k) : grid.z_centre(k)};
}

/// True if a face is closed: its middle lies in a body or on its surface. Round-off, as part of a
/// cell, must not decide that: a body often ends just where cells do.
template <class Solids, class Rows>
KOKKOS_INLINE_FUNCTION bool is_closed_by(const Solids& bodies, const BasicGrid<Rows>& grid,
                                         int axis, int i, int j, int k) {
  const Real size = Kokkos::min(Kokkos::min(grid.dx, grid.dy(j)), grid.dz);
  const Vec3 middle = face_middle(grid, axis, i, j, k);
  return !(bodies.nearest(middle).surface.distance >= Real(1e-6) * size);
}

/// The distance from bodies at which a cell of row j holds fluid on any mesh [m].
template <class Rows>
KOKKOS_INLINE_FUNCTION Real far_from_bodies(const BasicGrid<Rows>& grid, int j) {
  return 2 * Kokkos::max(Kokkos::max(grid.dx, grid.dy(j)), grid.dz);
}

/// Share of the way from a, in the fluid, to b, which is not, that lies in the fluid.
template <class Solids>
KOKKOS_INLINE_FUNCTION Real share_in_fluid(const Solids& bodies, const Vec3& a, const Vec3& b) {
  Real fluid = 0, solid = 1;
  if (bodies.nearest(b).surface.distance >= 0) return 1;
  for (int halved = 0; halved < 50; ++halved) {
    const Real middle = (fluid + solid) / 2;
    const bool is_fluid = bodies.nearest(fma(middle, b - a, a)).surface.distance > 0;
    (is_fluid ? fluid : solid) = middle;
  }
  return (fluid + solid) / 2;
}

/// A wall at theta h from a velocity u, h the distance to the next one, which is closed. In the
/// stencil that one stands for a wall at h; what is missing of its friction is
///   nu (1/theta - 1) u / (h H)
/// per mass, H the width of u's cell: then the flux of momentum into the wall is nu u / (theta h).
/// Gibou et al., J. Comput. Phys. 176, 205 (2002), eq. 7: second order. theta is held above 0.05.
KOKKOS_INLINE_FUNCTION Real friction_of_wall(Real nu, Real theta, Real h, Real width) {
  return nu * (1 / Kokkos::max(theta, Real(0.05)) - 1) / (h * width);
}

/// A face that the body `body` closes, or slows down by -friction u per mass.
struct BodyFace {
  int i = 0, j = 0, k = 0;
  int axis = 0;  // 0: across x, 1: y, 2: z
  int body = 0;
  bool closed = false;
  Real friction = 0;  // [1/s]

  /// Factor of the implicit friction of a wall on an increment of u over dt; 0 on a closed face.
  KOKKOS_FORCEINLINE_FUNCTION Real damping(Real dt) const {
    return closed ? Real(0) : 1 / (1 + dt * friction);
  }
  template <class Component>
  KOKKOS_FORCEINLINE_FUNCTION const Component& of(const BasicFaceVector<Component>& f) const {
    return axis == 0 ? f.x : axis == 1 ? f.y : f.z;
  }
  /// A cell field.
  KOKKOS_FORCEINLINE_FUNCTION Real mean(const GridRef& grid, const ConstFieldRef& f) const {
    if (axis == 0) return cell_to_xface(f, i, j, k);
    return axis == 1 ? cell_to_yface(grid, f, i, j, k) : cell_to_zface(f, i, j, k);
  }
  KOKKOS_FORCEINLINE_FUNCTION Real gradient(const GridRef& grid, const ConstFieldRef& f) const {
    if (axis == 0) return ddx_at_xface(grid, f, i, j, k);
    return axis == 1 ? ddy_at_yface(grid, f, i, j, k) : ddz_at_zface(grid, f, i, j, k);
  }
  /// [m^3]
  KOKKOS_FORCEINLINE_FUNCTION Real volume(const GridRef& grid) const {
    return grid.dx * grid.dz * (axis == 1 ? grid.dy_centre(j) : grid.dy(j));
  }
};

/// A cell in a body; without open faces it has no equation of pressure.
struct BodyCell {
  int i = 0, j = 0, k = 0;
  bool closed = false;
};

/// Direct forcing: damps u* and the mobility c at the faces of bodies.
struct DirectForcing {
  GridRef grid;
  const BodyFace* faces;
  ConstFieldRef alpha;
  FaceRef u_star, c;
  Real* unforced;  // u* before [m/s]
  Real dt;

  /// Adds up what flow rate along x [m^2/s], and response to a drive along x and z [m], they lose.
  KOKKOS_FUNCTION void operator()(int n, Vec3& lost) const {
    const BodyFace f = faces[n];
    Real &u = f.of(u_star)(f.i, f.j, f.k), &mobility = f.of(c)(f.i, f.j, f.k);
    const Real damping = f.damping(dt), dy = (1 - damping) * grid.dy(f.j);
    unforced[n] = u;
    if (f.axis == 0) lost.x += f.mean(grid, alpha) * u * dy, lost.y += mobility * dy;
    if (f.axis == 2) lost.z += mobility * dy;
    u *= damping;
    mobility *= damping;
  }
};

/// Damps the drive across at the faces of bodies, after it has acted on all faces.
struct ForcingAcross {
  const BodyFace* faces;
  FieldRef u_z;
  Real drive_dt, dt;
  KOKKOS_FUNCTION void operator()(int n) const {
    const BodyFace f = faces[n];
    if (f.axis == 2) u_z(f.i, f.j, f.k) -= (1 - f.damping(dt)) * drive_dt;
  }
};

/// Stops the fluid in bodies; adds up its speeds [m/s].
struct StopInBodies {
  const BodyFace* faces;
  FaceRef u;
  KOKKOS_FUNCTION void operator()(int n, Real& ran) const {
    const BodyFace f = faces[n];
    if (!f.closed) return;
    ran += Kokkos::abs(f.of(u)(f.i, f.j, f.k));
    f.of(u)(f.i, f.j, f.k) = 0;
  }
};

/// A cell field, zero in bodies, or in those of their cells that have no open face.
struct ClearInBodies {
  const BodyCell* cells;
  FieldRef f;
  bool closed_alone;
  KOKKOS_FUNCTION void operator()(int n) const {
    const BodyCell at = cells[n];
    if (at.closed || !closed_alone) f(at.i, at.j, at.k) = 0;
  }
};

/// Closed faces, of what is not to act there.
struct CloseBodyFaces {
  const BodyFace* faces;
  FaceRef f;
  KOKKOS_FUNCTION void operator()(int n) const {
    const BodyFace face = faces[n];
    if (face.closed) face.of(f)(face.i, face.j, face.k) = 0;
  }
};

/// a = b in closed cells.
struct CopyInBodies {
  const BodyCell* cells;
  ConstFieldRef b;
  FieldRef a;
  KOKKOS_FUNCTION void operator()(int n) const {
    const BodyCell at = cells[n];
    if (at.closed) a(at.i, at.j, at.k) = b(at.i, at.j, at.k);
  }
};

/// Adds up the solid that the fraction alpha leaves for closed cells [m^3].
struct SolidInBodies {
  GridRef grid;
  const BodyCell* cells;
  ConstFieldRef alpha;
  KOKKOS_FUNCTION void operator()(int n, Real& sum) const {
    const BodyCell at = cells[n];
    if (at.closed) sum += (1 - alpha(at.i, at.j, at.k)) * grid.cell_volume(at.j);
  }
};

/// Force [N] and torque [N m].
struct ForceAndTorque {
  Vec3 force, torque;
  KOKKOS_FORCEINLINE_FUNCTION ForceAndTorque& operator+=(const ForceAndTorque& b) {
    force += b.force, torque += b.torque;
    return *this;
  }
};

/// Force of a step's flow on a body, face by face. At a closed face it is what would have moved the
/// fluid there,
///   V (rho alpha u* / dt + rho f - grad p),
/// at others the friction, rho alpha V k u. All of it is what the momentum of the fluid lacks.
struct LoadOnBody {
  GridRef grid;
  const BodyFace* faces;
  const Real* unforced;  // u* before the direct forcing
  ConstFaceRef u;        // after the step
  ConstFieldRef p, alpha;
  Vec3 foot;   // torque is about it
  Vec3 drive;  // f [m/s^2]
  Real density, dt;

  KOKKOS_INLINE_FUNCTION Real force(int n) const {
    const BodyFace f = faces[n];
    const Real mass = density * f.mean(grid, alpha) * f.volume(grid);
    if (!f.closed) return mass * f.friction * f.of(u)(f.i, f.j, f.k);
    const Real push = f.axis == 0 ? drive.x : f.axis == 1 ? drive.y : drive.z;
    return mass * unforced[n] / dt + f.volume(grid) * (density * push - f.gradient(grid, p));
  }
  KOKKOS_FUNCTION void operator()(int n, ForceAndTorque& load) const {
    const BodyFace f = faces[n];
    const Real along = force(n);
    const Vec3 on_body{f.axis == 0 ? along : 0, f.axis == 1 ? along : 0, f.axis == 2 ? along : 0};
    Vec3 arm = face_middle(grid, f.axis, f.i, f.j, f.k) - foot;
    arm.x -= grid.lx * Kokkos::round(arm.x / grid.lx);
    arm.z -= grid.lz * Kokkos::round(arm.z / grid.lz);
    load += {on_body, cross(arm, on_body)};
  }
};

/// The loads on many small bodies, each added up by one thread: the same bits on any number of
/// them.
struct LoadsOnMany {
  LoadOnBody load;         // of all faces; its foot is not read
  const int* first;        // face of each, and one more
  const Vec3* foot;        // of each [m]
  ForceAndTorque* result;  // of each
  KOKKOS_FUNCTION void operator()(int body) const {
    LoadOnBody of_body = load;
    of_body.foot = foot[body];
    ForceAndTorque sum{};
    for (int n = first[body]; n < first[body + 1]; ++n) of_body(n, sum);
    result[body] = sum;
  }
};

/// One step of finding the cells that fluid reaches through open faces. Returns 1 where it gets.
struct SpreadFluid {
  ConstFaceRef open;      // 1 or 0, with ghosts
  ConstFieldRef reached;  // 1 or 0, with ghosts
  FieldRef after;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    const Real ways =
        open.x(i, j, k) * reached(i - 1, j, k) + open.x(i + 1, j, k) * reached(i + 1, j, k) +
        open.y(i, j, k) * reached(i, j - 1, k) + open.y(i, j + 1, k) * reached(i, j + 1, k) +
        open.z(i, j, k) * reached(i, j, k - 1) + open.z(i, j, k + 1) * reached(i, j, k + 1);
    const Real before = reached(i, j, k);
    const Real now = before > 0 || ways > 0 ? Real(1) : Real(0);
    after(i, j, k) = now;
    return now - before;
  }
};

}  // namespace barchan
