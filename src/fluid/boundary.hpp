// Boundary treatment of every field: the one table.
#pragma once

#include "kernels/fluid/boundary_values.hpp"
#include "src/config/config.hpp"
#include "src/parallel/halo.hpp"

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
GhostRule ghost_rule(FieldKind kind, WallFlow wall);

/// Fills ghost cells: the walls at y = 0 and y = Ly by the table, x and z through the halo.
class Boundary {
 public:
  /// top_velocity: of the wall at Ly along x [m/s], felt where it is no slip.
  Boundary(const Grid& grid, WallFlow bottom, WallFlow top, Real top_velocity = 0)
      : grid_(grid), halo_(grid), bottom_(bottom), top_(top), top_velocity_(top_velocity) {}

  void fill(Field& f, FieldKind kind) const;
  void fill_velocity(FaceVector& u) const;
  /// Only x and z, for face vectors that no wall rule applies to.
  void fill_periodic(FaceVector& f) const;
  const Halo& halo() const { return halo_; }
  WallFlow bottom() const { return bottom_; }
  WallFlow top() const { return top_; }

 private:
  Grid grid_;
  Halo halo_;
  WallFlow bottom_, top_;
  Real top_velocity_;
};

}  // namespace barchan
