#include "src/fluid/boundary.hpp"

#include "src/parallel/launch.hpp"

namespace barchan {

GhostRule ghost_rule(FieldKind kind, WallFlow wall) {
  if (kind == FieldKind::velocity_y) return GhostRule::wall_face;
  const bool follows_wall = kind != FieldKind::scalar && wall == WallFlow::no_slip;
  return follows_wall ? GhostRule::opposite : GhostRule::same;
}

void Boundary::fill(Field& f, FieldKind kind) const {
  for_each_cell("boundary: walls", CellRange{0, grid_.nx, 0, 1, 0, grid_.nz},
                FillWallGhosts{.f = f,
                               .ny = grid_.ny,
                               .bottom = ghost_rule(kind, bottom_),
                               .top = ghost_rule(kind, top_),
                               .top_value = kind == FieldKind::velocity_x ? top_velocity_ : 0});
  halo_.fill(f);
}

void Boundary::fill_velocity(FaceVector& u) const {
  fill(u.x, FieldKind::velocity_x);
  fill(u.y, FieldKind::velocity_y);
  fill(u.z, FieldKind::velocity_z);
}

void Boundary::fill_periodic(FaceVector& f) const {
  halo_.fill(f.x);
  halo_.fill(f.y);
  halo_.fill(f.z);
}

}  // namespace barchan
