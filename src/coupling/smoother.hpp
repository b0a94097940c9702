// Smoothing of coupling fields near the grains.
#pragma once

#include <list>
#include <memory>
#include <vector>

#include "src/fluid/poisson_fft.hpp"
#include "src/parallel/region.hpp"

namespace barchan {

/// Smoothing by one implicit step of diffusion over a length L, (1 - L^2 lap) phi = f, of fields
/// that vanish away from the grains. Far from them phi has decayed, and is not computed: it is cut
/// off at reach() cells, where less than kTolerance of a source is left.
class Smoother {
 public:
  static constexpr Real kTolerance = 1e-12;

  /// Makes a smoother. `whole`: the transforms of the grid; `even`: where it ends at walls of the
  /// grains. With a length of 0 nothing is smoothed.
  Smoother(const Grid& grid, std::shared_ptr<const PlaneFft> whole, const EvenExtension& even,
           Real length);

  /// Number of cells along x and z over which a smoothed field decays.
  int reach() const { return reach_; }
  /// Top of the rows [0, top) over which a field in the rows [0, from) decays.
  int top_above(int from) const;

  /// Turns f into phi in the cells of a region, in which it must be known. Beyond, it counts as
  /// zero, and afterwards holds no more than what has decayed. All ranks call it together.
  void solve(Field& f, const Region& region) const;

  /// Stretch of x or z that is solved as a periodic direction of `size` cells of its own.
  struct Stretch {
    int first, length, size;
    bool whole = false;  // the direction as it is
  };

 private:
  /// Some columns of cells as a periodic grid of their own: its ends feel each other as little as
  /// they feel the grains.
  struct Columns {
    Columns(const Grid& all, const Stretch& x, const Stretch& z, const EvenExtension& even,
            Real length);
    Grid grid;
    PoissonFft poisson;
    Field f;
  };
  const Columns& columns(const Stretch& x, const Stretch& z) const;
  const PoissonFft& whole() const;
  static std::vector<Stretch> stretches(const std::vector<ColumnMap::Interval>& intervals, int n,
                                        int n_all, bool even, bool is_cut);
  void solve_some(Field& f, const Region& region, const Stretch& x, const Stretch& z) const;

  Grid grid_;
  EvenExtension even_;
  Real length_;
  int reach_ = 0;
  std::vector<Real> decay_;  // decay from a row to the next
  std::shared_ptr<const PlaneFft> whole_fft_;
  mutable std::unique_ptr<const PoissonFft> whole_;  // made where it is needed
  mutable std::list<Columns> columns_;               // grids of the last sizes, the latest first
};

}  // namespace barchan
