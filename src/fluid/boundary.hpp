// Boundary treatment of every field: the one table.
#pragma once

#include "kernels/fluid/boundary_values.hpp"
#include "src/config/config.hpp"
#include "src/fluid/fluid_fields.hpp"
#include "src/parallel/halo.hpp"
#include "src/parallel/region.hpp"

namespace barchan {

enum class FieldKind { velocity_x, velocity_y, velocity_z, scalar, eddy_viscosity };

/// Field x wall -> ghost rule:
///
/// | field             | no slip   | free slip | x, z     |
/// |-------------------|-----------|-----------|----------|
/// | velocity_x, _z    | opposite* | same      | periodic |
/// | velocity_y        | wall_face | wall_face | periodic |
/// | scalar: p, alpha_f| same      | same      | periodic |
/// | eddy_viscosity    | opposite  | same      | periodic |
///
/// * the upper wall may move along x.
inline GhostRule ghost_rule(FieldKind kind, WallFlow wall) {
  if (kind == FieldKind::velocity_y) return GhostRule::wall_face;
  const bool follows_wall = kind != FieldKind::scalar && wall == WallFlow::no_slip;
  return follows_wall ? GhostRule::opposite : GhostRule::same;
}

/// Fills ghost cells: the walls at y = 0 and y = Ly by the table, x and z through the halo.
class Boundary {
 public:
  /// top_velocity: of the wall at Ly along x [m/s], felt where it is no slip.
  Boundary(const Grid& grid, WallFlow bottom, WallFlow top, Real top_velocity = 0)
      : grid_(grid), halo_(grid), bottom_(bottom), top_(top), top_velocity_(top_velocity) {}

  void fill(Field& f, FieldKind kind) const { fill(f, kind, top_velocity_); }
  /// The ghosts beside a region.
  void fill(Field& f, FieldKind kind, const Region& region) const {
    fill_walls(f, kind, top_velocity_, region.floor());
    if (region.has_ghosts()) halo_.fill(f);
  }
  void fill_velocity(FaceVector& u) const { fill(u, top_velocity_); }
  /// A rate of change of the velocity: walls do not accelerate.
  void fill_acceleration(FaceVector& du_dt) const { fill(du_dt, 0); }
  /// A field of the flow, by its line in fluid_fields.hpp.
  void fill(Field& f, Ghosts ghosts) const {
    fill(f, ghosts == Ghosts::eddy_viscosity ? FieldKind::eddy_viscosity : FieldKind::scalar);
  }
  void fill(FaceVector& f, Ghosts ghosts) const {
    fill(f, ghosts == Ghosts::velocity ? top_velocity_ : 0);
  }
  /// Only x and z, for face vectors that no wall rule applies to.
  void fill_periodic(FaceVector& f) const {
    for (Field* component : {&f.x, &f.y, &f.z}) halo_.fill(*component);
  }
  const Halo& halo() const { return halo_; }

 private:
  void fill(FaceVector& u, Real top_velocity) const {
    fill(u.x, FieldKind::velocity_x, top_velocity);
    fill(u.y, FieldKind::velocity_y, top_velocity);
    fill(u.z, FieldKind::velocity_z, top_velocity);
  }
  void fill(Field& f, FieldKind kind, Real top_velocity) const {
    fill_walls(f, kind, top_velocity, CellRange{0, grid_.nx, 0, 1, 0, grid_.nz});
    halo_.fill(f);
  }
  void fill_walls(Field& f, FieldKind kind, Real top_velocity, const CellRange& columns) const {
    for_each_cell("boundary: walls", columns,
                  FillWallGhosts{.f = f,
                                 .ny = grid_.ny,
                                 .bottom = ghost_rule(kind, bottom_),
                                 .top = ghost_rule(kind, top_),
                                 .top_value = kind == FieldKind::velocity_x ? top_velocity : 0});
  }

  Grid grid_;
  Halo halo_;
  WallFlow bottom_, top_;
  Real top_velocity_;
};

}  // namespace barchan
