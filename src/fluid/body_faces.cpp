#include "src/fluid/body_faces.hpp"

#include <algorithm>
#include <array>

#include "src/fluid/fluid_state.hpp"
#include "src/parallel/mirror.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

using HostValues = Field::Storage::host_mirror_type;
Real& at(const HostValues& f, int i, int j, int k) { return f(i + 1, j + 1, k + 1); }

/// Finds the faces of one rank, on the host.
class FaceFinder {
 public:
  FaceFinder(const Solids& solids, const Grid& grid, const Halo& halo, Real nu)
      : solids_(solids),
        cells_(grid),
        grid_(grid.on_host()),
        halo_(halo),
        nu_(nu),
        open_(make_faces("bodies: open", grid)),
        reached_("bodies: reached", grid) {
    for (std::size_t axis = 0; axis < 3; ++axis) host_[axis] = mirror(component(axis).storage);
  }

  BodyFaces find() {
    close_inside();
    flood();
    close_unreached();
    BodyFaces found;
    each_cell([&](int i, int j, int k) {
      for (int axis = 0; axis < 3; ++axis) add_face(axis, i, j, k, found.faces);
      add_cell(i, j, k, found.cells);
    });
    std::stable_sort(found.faces.begin(), found.faces.end(),
                     [](const BodyFace& a, const BodyFace& b) { return a.body < b.body; });
    return found;
  }

 private:
  Field& component(std::size_t axis) { return axis == 0 ? open_.x : axis == 1 ? open_.y : open_.z; }
  template <class Action>
  void each_cell(const Action& action) const {
    for (int k = 0; k < grid_.nz; ++k)
      for (int j = 0; j < grid_.ny; ++j)
        for (int i = 0; i < grid_.nx; ++i) action(i, j, k);
  }
  Real distance(const Vec3& x) const { return solids_.nearest(x).surface.distance; }
  Vec3 centre(int i, int j, int k) const {
    return {grid_.x_centre(i), grid_.y_centre(j), grid_.z_centre(k)};
  }
  bool is_closed(int axis, int i, int j, int k) const {
    return at(host_[static_cast<std::size_t>(axis)], i, j, k) == 0;
  }
  void to_device() {
    for (std::size_t axis = 0; axis < 3; ++axis)
      Kokkos::deep_copy(component(axis).storage, host_[axis]);
    halo_.fill(open_.x, open_.y, open_.z);
  }

  /// 1 on open faces; walls of the domain stay 0.
  void close_inside() {
    each_cell([&](int i, int j, int k) {
      for (int axis = 0; axis < 3; ++axis) {
        const bool is_wall = axis == 1 && j == 0;
        const bool opens = !is_wall && !is_closed_by(solids_, grid_, axis, i, j, k);
        at(host_[static_cast<std::size_t>(axis)], i, j, k) = opens ? 1 : 0;
      }
    });
    to_device();
  }

  /// Finds the cells that fluid reaches from those far enough from bodies.
  void flood() {
    Real most = 0;
    each_cell([&](int i, int j, int k) { most = std::max(most, distance(centre(i, j, k))); });
    most = max_over(ranks_of(cells_), most);
    const auto sources = mirror(reached_.storage);
    each_cell([&](int i, int j, int k) {
      const Real far = std::min(far_from_bodies(grid_, j), most / 2);
      at(sources, i, j, k) = distance(centre(i, j, k)) >= far ? 1 : 0;
    });
    Kokkos::deep_copy(reached_.storage, sources);
    Field after("bodies: reached next", cells_);
    Real more = 1;
    while (more > 0) {
      halo_.fill(reached_);
      more = sum_each_cell("bodies: fluid", cells_, SpreadFluid{open_, reached_, after});
      std::swap(reached_, after);
    }
    halo_.fill(reached_);
  }

  void close_unreached() {
    const auto reached = host_copy(reached_.storage);
    each_cell([&](int i, int j, int k) {
      if (at(reached, i, j, k) == 0 || at(reached, i - 1, j, k) == 0) at(host_[0], i, j, k) = 0;
      if (at(reached, i, j, k) == 0 || at(reached, i, j - 1, k) == 0) at(host_[1], i, j, k) = 0;
      if (at(reached, i, j, k) == 0 || at(reached, i, j, k - 1) == 0) at(host_[2], i, j, k) = 0;
    });
    to_device();
    for (std::size_t axis = 0; axis < 3; ++axis)
      Kokkos::deep_copy(host_[axis], component(axis).storage);  // with ghosts
  }

  void add_face(int axis, int i, int j, int k, std::vector<BodyFace>& faces) const {
    if (axis == 1 && j == 0) return;
    BodyFace face{.i = i, .j = j, .k = k, .axis = axis};
    face.closed = is_closed(axis, i, j, k);
    if (!face.closed) face.friction = friction(axis, i, j, k);
    if (!face.closed && face.friction == 0) return;
    face.body = solids_.nearest(face_middle(grid_, axis, i, j, k)).body;
    faces.push_back(face);
  }

  /// Friction of the walls between an open face and the closed ones next to it [1/s].
  Real friction(int axis, int i, int j, int k) const {
    const Vec3 here = face_middle(grid_, axis, i, j, k);
    Real sum = 0;
    const auto add = [&](int di, int dj, int dk, Real h, Real width) {
      if (!is_closed(axis, i + di, j + dj, k + dk)) return;
      const Vec3 there = face_middle(grid_, axis, i + di, j + dj, k + dk);
      sum += friction_of_wall(nu_, share_in_fluid(solids_, here, there), h, width);
    };
    for (const int side : {-1, 1}) {
      add(side, 0, 0, grid_.dx, grid_.dx);
      add(0, 0, side, grid_.dz, grid_.dz);
    }
    const bool is_y = axis == 1;
    const Real width = is_y ? grid_.dy_centre(j) : grid_.dy(j);
    if (j > (is_y ? 1 : 0)) add(0, -1, 0, is_y ? grid_.dy(j - 1) : grid_.dy_centre(j), width);
    if (j + 1 < grid_.ny) add(0, 1, 0, is_y ? grid_.dy(j) : grid_.dy_centre(j + 1), width);
    return sum;
  }

  void add_cell(int i, int j, int k, std::vector<BodyCell>& cells) const {
    const bool closed = is_closed(0, i, j, k) && is_closed(0, i + 1, j, k) &&
                        is_closed(1, i, j, k) && is_closed(1, i, j + 1, k) &&
                        is_closed(2, i, j, k) && is_closed(2, i, j, k + 1);
    if (closed || distance(centre(i, j, k)) < 0) cells.push_back({i, j, k, closed});
  }

  const Solids& solids_;
  Grid cells_;
  HostGrid grid_;
  const Halo& halo_;
  Real nu_;
  FaceVector open_;
  std::array<HostValues, 3> host_;
  Field reached_;
};

}  // namespace

BodyFaces find_body_faces(const Solids& solids, const Grid& grid, const Halo& halo, Real nu) {
  return FaceFinder(solids, grid, halo, nu).find();
}

}  // namespace barchan
