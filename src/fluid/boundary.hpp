// Boundary treatment of every field: the one table.
#pragma once

#include <array>
#include <concepts>

#include "kernels/fluid/boundary_values.hpp"
#include "src/fluid/fluid_case.hpp"
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

  void fill(Field& f, FieldKind kind) const {
    halo_.fill_with_walls(std::array{with_walls(f, kind, top_velocity_)});
  }
  template <std::same_as<Field>... Fields>
  void fill_scalars(Fields&... f) const {
    halo_.fill_with_walls(std::array{with_walls(f, FieldKind::scalar, 0)...});
  }
  /// The ghosts beside a region.
  template <std::same_as<Field>... Fields>
  void fill_scalars(const Region& region, Fields&... f) const {
    const Kokkos::Array fields{with_walls(f, FieldKind::scalar, 0)...};
    if (region.has_ghosts()) return halo_.fill_with_walls({fields.data(), fields.size()});
    for_each_cell("boundary: walls", region.floor(), FillWallsOf<sizeof...(f)>{fields});
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
  void fill_periodic(FaceVector& f) const { halo_.fill(f.x, f.y, f.z); }
  const Halo& halo() const { return halo_; }

 private:
  void fill(FaceVector& u, Real top_velocity) const {
    halo_.fill_with_walls(std::array{with_walls(u.x, FieldKind::velocity_x, top_velocity),
                                     with_walls(u.y, FieldKind::velocity_y, top_velocity),
                                     with_walls(u.z, FieldKind::velocity_z, top_velocity)});
  }
  FieldWithWalls with_walls(Field& f, FieldKind kind, Real top_velocity) const {
    return {.f = f,
            .ny = grid_.ny,
            .walls = {.bottom = ghost_rule(kind, bottom_),
                      .top = ghost_rule(kind, top_),
                      .top_value = kind == FieldKind::velocity_x ? top_velocity : 0}};
  }

  Grid grid_;
  Halo halo_;
  WallFlow bottom_, top_;
  Real top_velocity_;
};

}  // namespace barchan
