#include "src/fluid/passage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "kernels/fluid/body_faces.hpp"
#include "src/base/errors.hpp"
#include "src/fluid/domain.hpp"
#include "src/fluid/flow_schedule.hpp"

namespace barchan {
namespace {

struct Cell {
  int i, j, k;
};

class Ways {
 public:
  Ways(const Bodies& bodies, const HostGrid& grid, int axis)
      : bodies_(bodies), grid_(grid), axis_(axis), most_(largest_distance()) {}

  /// A row of open faces from end to end, the upper ones first: most bodies leave many.
  bool has_straight_one() const {
    const int length = axis_ == 0 ? grid_.nx : grid_.nz, rows = axis_ == 0 ? grid_.nz : grid_.nx;
    for (int j = grid_.ny; j-- > 0;)
      for (int row = 0; row < rows; ++row) {
        const auto cell = [&](int n) { return axis_ == 0 ? Cell{n, j, row} : Cell{row, j, n}; };
        bool open = true, source = false;
        for (int n = 0; n < length && open; ++n) {
          open = is_open(axis_, cell(n));
          source = source || is_source(cell(n));
        }
        if (open && source) return true;
      }
    return false;
  }

  /// Water spreads from each source. It has gone round when it meets itself a turn ahead.
  bool has_any() {
    turn_.assign(std::size_t(grid_.nx) * std::size_t(grid_.ny) * std::size_t(grid_.nz), kDry);
    for (int j = grid_.ny; j-- > 0;)
      for (int k = 0; k < grid_.nz; ++k)
        for (int i = 0; i < grid_.nx; ++i)
          if (turn({i, j, k}) == kDry && is_source({i, j, k}) && goes_round_from({i, j, k}))
            return true;
    return false;
  }

 private:
  static constexpr int kDry = -1000000000;

  Real distance(const Cell& c) const {
    const Vec3 centre{grid_.x_centre(c.i), grid_.y_centre(c.j), grid_.z_centre(c.k)};
    return bodies_.nearest(centre).surface.distance;
  }
  bool is_open(int axis, const Cell& c) const {
    return !is_closed_by(bodies_, grid_, axis, c.i, c.j, c.k);
  }
  bool is_source(const Cell& c) const {
    return distance(c) >= std::min(far_from_bodies(grid_, c.j), most_ / 2);
  }
  /// Largest distance of a cell's centre from a body; no more than makes the farthest cells
  /// sources.
  Real largest_distance() const {
    Real widest = 0, most = 0;
    for (int j = 0; j < grid_.ny; ++j) widest = std::max(widest, far_from_bodies(grid_, j));
    for (int j = grid_.ny; j-- > 0;)
      for (int k = 0; k < grid_.nz; ++k)
        for (int i = 0; i < grid_.nx && most < 2 * widest; ++i)
          most = std::max(most, distance({i, j, k}));
    return most;
  }
  int& turn(const Cell& c) {
    return turn_[std::size_t(c.i) +
                 std::size_t(grid_.nx) *
                     (std::size_t(c.j) + std::size_t(grid_.ny) * std::size_t(c.k))];
  }

  /// The next cell along an axis, and how many turns farther it is; outside the lid: j = ny.
  std::pair<Cell, int> neighbour(const Cell& c, int axis, int side) const {
    Cell next = c;
    int& n = axis == 0 ? next.i : axis == 1 ? next.j : next.k;
    const int count = axis == 0 ? grid_.nx : axis == 1 ? grid_.ny : grid_.nz;
    n += side;
    if (axis == 1 || (n >= 0 && n < count)) return {next, 0};
    n = side > 0 ? 0 : count - 1;
    return {next, axis == axis_ ? side : 0};
  }

  bool goes_round_from(const Cell& source) {
    std::vector<Cell> wet{source};
    turn(source) = 0;
    while (!wet.empty()) {
      const Cell here = wet.back();
      wet.pop_back();
      const int turns = turn(here);
      for (const int axis : {0, 1, 2})
        for (const int side : {-1, 1}) {
          const auto [next, farther] = neighbour(here, axis, side);
          if (next.j < 0 || next.j >= grid_.ny) continue;
          if (!is_open(axis, side > 0 ? next : here)) continue;
          int& its = turn(next);
          if (its != kDry && its != turns + farther) return true;
          if (its != kDry) continue;
          its = turns + farther;
          wet.push_back(next);
        }
    }
    return false;
  }

  const Bodies& bodies_;
  const HostGrid& grid_;
  int axis_;
  Real most_;  // distance of a cell from a body [m]
  std::vector<int> turn_;
};

}  // namespace

bool passes(const Bodies& bodies, const HostGrid& grid, int axis) {
  Ways ways(bodies, grid, axis);
  return ways.has_straight_one() || ways.has_any();
}

void check_passage(const FluidCase& config) {
  if (config.bodies.n == 0) return;
  const std::array driven{
      config.fluid.pressure_gradient.value_or(0) != 0 || goes_along(config.schedule),
      goes_across(config.schedule)};
  const HostGrid grid = make_grid(config).on_host();
  for (const int axis : {0, 2}) {
    if (!driven[axis == 0 ? 0 : 1] || passes(config.bodies, grid, axis)) continue;
    throw InputError(fmt::format(
        "{}: [[body]] must leave water beside or above: together the bodies close the channel to "
        "the flow along {}, on this mesh (fluid.cells)",
        config.file.string(), axis == 0 ? 'x' : 'z'));
  }
}

}  // namespace barchan
