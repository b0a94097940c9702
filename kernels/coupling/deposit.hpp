// Grain to fluid: volume and momentum of the grains as densities on cells, then on faces.
// Equations: docs/model.md.
#pragma once

#include "kernels/coupling/row_exchange.hpp"
#include "kernels/fluid/stencil.hpp"
#include "kernels/grains/fluid_on_grains.hpp"

namespace barchan {

/// Sums on owned cells in fixed point. By row the conductances and the impulses along the floor are
/// those of the momentum cells around the faces.
struct Deposits {
  // Volume; conductance between rows for the flow along x, along z; impulse x, y, z.
  static constexpr int kQuantities = 6;
  Kokkos::View<std::int64_t* [kQuantities], Kokkos::LayoutLeft> sum;
  FixedPoint volume, conductance, impulse;
};

/// What one grain gives to the fluid in one fluid step.
struct GrainExchange {
  Real volume;   // [m^3]
  Vec3 impulse;  // drag, added mass and lift on the grain during the sub-steps [N s]
};

struct ExchangeOfGrain {
  Real dt = 0;
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;
  ExchangeOnGrains exchange;

  KOKKOS_INLINE_FUNCTION GrainExchange operator()(int g) const {
    Vec3 steady = exchange.added_mass_force(g);
    if (exchange.lift.extent(0) > 0) steady += exchange.lift(g);
    return {.volume = sphere_volume(grains(g).r), .impulse = on_grains.impulse(g) + dt * steady};
  }
  /// [kg]
  KOKKOS_INLINE_FUNCTION Real drag(int g) const { return dt * on_grains.beta(g); }
};

/// Bounds of the grains' centres, without a lower one for the height [m].
struct GrainExtent {
  Real left = 0, right = -1, top = 0, front = 0, back = 0;  // no grains
};

/// What all grains together give: volume [m^3], drag coefficient times dt [kg], sum of |impulse|
/// components and the impulse itself [N s]; and their extent.
struct GrainTotals {
  ExchangeOfGrain of_grain;
  KOKKOS_FUNCTION void operator()(int g, Real& volume, Real& drag, Real& size, Real& x, Real& y,
                                  Real& z, Real& left, Real& right, Real& top, Real& front,
                                  Real& back) const {
    const GrainExchange e = of_grain(g);
    volume += e.volume;
    drag += of_grain.drag(g);
    size += Kokkos::abs(e.impulse.x) + Kokkos::abs(e.impulse.y) + Kokkos::abs(e.impulse.z);
    x += e.impulse.x;
    y += e.impulse.y;
    z += e.impulse.z;
    const Vec3 at = of_grain.grains(g).x;
    left = Kokkos::fmin(left, at.x), right = Kokkos::fmax(right, at.x);
    top = Kokkos::fmax(top, at.y);
    front = Kokkos::fmin(front, at.z), back = Kokkos::fmax(back, at.z);
  }
};

/// What grains give to cells, on its way to the sums of all. A few cells are kept until others take
/// their places: grains that follow one another in memory share cells, and an atomic addition takes
/// longer than all else.
template <int places>
class RecentCells {
 public:
  KOKKOS_INLINE_FUNCTION explicit RecentCells(const Deposits& deposits) : deposits_(deposits) {}
  KOKKOS_INLINE_FUNCTION ~RecentCells() {
    for (int place = 0; place < places; ++place) give_back(place);
  }
  RecentCells(const RecentCells&) = delete;

  KOKKOS_INLINE_FUNCTION void add(std::int64_t cell,
                                  const std::int64_t (&given)[Deposits::kQuantities]) {
    const auto place = static_cast<int>(cell % places);
    if (cell_[place] != cell) {
      give_back(place);
      cell_[place] = cell;
    }
    for (int q = 0; q < Deposits::kQuantities; ++q) sum_[place][q] += given[q];
  }

 private:
  KOKKOS_INLINE_FUNCTION void give_back(int place) {
    for (int q = 0; q < Deposits::kQuantities; ++q) {
      if (sum_[place][q] != 0) Kokkos::atomic_add(&deposits_.sum(cell_[place], q), sum_[place][q]);
      sum_[place][q] = 0;
    }
  }

  const Deposits& deposits_;
  std::int64_t cell_[places]{}, sum_[places][Deposits::kQuantities]{};
};

/// Deposits the volume and the exchange of grains in the cells of their points: a work item is
/// `together` grains that follow one another, one on a device.
template <int together>
struct DepositGrains {
  ExchangeOfGrain of_grain;
  ExchangeByRow rows;
  Deposits deposits;
  int n = 0;  // all grains

  using Recent = RecentCells<(together > 1 ? 16 : 1)>;
  static constexpr int items_for(int n) { return (n + together - 1) / together; }
  KOKKOS_FUNCTION void operator()(int item) const {
    Recent cells(deposits);
    const int end = Kokkos::min((item + 1) * together, n);
    for (int g = item * together; g < end; ++g) add(g, cells);
  }

 private:
  using Given = std::int64_t[Deposits::kQuantities];
  KOKKOS_INLINE_FUNCTION void add(int g, Recent& to) const {
    const GrainKinematics grain = of_grain.grains(g);
    const GrainRows in_rows = rows.stencil.rows_of(grain);
    const GrainCells cells = rows.stencil(grain, in_rows);
    const GrainExchange e = of_grain(g);
    for (int q = 0; q < cells.n; ++q) {
      const Real w = cells.weight(q);
      const Vec3 impulse = rows.on ? Vec3{} : w * e.impulse;
      give(to, cells.cell[q],
           {deposits.volume.encode(w * e.volume), 0, 0, deposits.impulse.encode(impulse.x),
            deposits.impulse.encode(impulse.y), deposits.impulse.encode(impulse.z)});
    }
    if (rows.on) add_by_row(g, grain, in_rows, e.impulse, to);
  }
  /// Along the floor to the momentum cells that the grain belongs to. A cell that flows faster
  /// than the grain sees on average drags it more: the difference adds up to nothing over the
  /// grain.
  KOKKOS_INLINE_FUNCTION void add_by_row(int g, const GrainKinematics& grain,
                                         const GrainRows& in_rows, const Vec3& impulse,
                                         Recent& to) const {
    const VelocityByRow v = rows.velocity(in_rows, grain);
    const Real drag = of_grain.drag(g);
    for (int r = 0; r < in_rows.n; ++r) {
      const int j = in_rows.row[r];
      const Real w = in_rows.weight(r);
      const Real coupling = drag * conductance_below(in_rows, j);
      give(to, CellIndex{v.i, j, v.k}, {0, 0, 0, 0, deposits.impulse.encode(w * impulse.y), 0});
      for (int side = 0; side < 2; ++side) {
        const Real wx = v.x_faces.weight(side), wz = v.z_faces.weight(side);
        if (wx > 0)
          give(to, rows.x_face(v, side, j),
               {0, deposits.conductance.encode(wx * coupling), 0,
                deposits.impulse.encode(w * wx * (impulse.x + drag * (v.x[side][r] - v.mean_x))), 0,
                0});
        if (wz > 0)
          give(to, rows.z_face(v, side, j),
               {0, 0, deposits.conductance.encode(wz * coupling), 0, 0,
                deposits.impulse.encode(w * wz * (impulse.z + drag * (v.z[side][r] - v.mean_z)))});
      }
    }
  }
  KOKKOS_INLINE_FUNCTION void give(Recent& to, const CellIndex& cell, const Given& given) const {
    to.add(cell.linear(rows.stencil.grid), given);
  }
};

/// The largest solid fraction that CFDEM's void fraction models leave: its alphaMin is 0.1.
inline constexpr Real kMostSolid = 1 - 0.1;

/// One quantity of the deposits as a density on cells, sum / cell volume, without what is above
/// `most`.
struct DecodeDeposit {
  GridRef grid;
  Deposits deposits;
  FixedPoint point;
  int quantity = 0;
  Real most = Kokkos::Experimental::infinity_v<Real>;
  FieldRef density;

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    const std::int64_t cell = CellIndex{i, j, k}.linear(grid);
    const Real all = point.decode(deposits.sum(cell, quantity)) / grid.cell_volume(j);
    density(i, j, k) = Kokkos::min(all, most);
  }
};

/// alpha_f = 1 - solid fraction, which it replaces; adds up the volume of the grains [m^3].
struct SolidToFluidFraction {
  GridRef grid;
  FieldRef alpha;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    const Real solid = alpha(i, j, k);
    alpha(i, j, k) = 1 - solid;
    return solid * grid.cell_volume(j);
  }
};

/// Shares of a cell's content that go to its lower and upper y-face; nothing goes to the walls.
struct FaceShares {
  Real lower, upper;
};
KOKKOS_INLINE_FUNCTION FaceShares y_face_shares(int j, int ny) {
  if (ny == 1) return {0, 0};
  if (j == 0) return {0, 1};
  return j == ny - 1 ? FaceShares{1, 0} : FaceShares{Real(0.5), Real(0.5)};
}

/// Cell densities to faces, integrals kept: half of a cell's content to each of its two faces. By
/// row those along the floor are on their faces already.
struct SpreadToFaces {
  GridRef grid;
  bool by_row = false;
  ConstFieldRef impulse_x, impulse_y, impulse_z;  // on cells, ghosts in x and z valid
  FaceRef given;                                  // on faces

  KOKKOS_INLINE_FUNCTION Real on_y_face(const ConstFieldRef& f, int i, int j, int k) const {
    if (j == 0) return 0;
    return (f(i, j - 1, k) * grid.dy(j - 1) * y_face_shares(j - 1, grid.ny).upper +
            f(i, j, k) * grid.dy(j) * y_face_shares(j, grid.ny).lower) /
           grid.dy_centre(j);
  }
  KOKKOS_INLINE_FUNCTION void operator()(int i, int j, int k) const {
    // The fluid gets the opposite of what the grains got.
    given.x(i, j, k) = -(by_row ? impulse_x(i, j, k) : cell_to_xface(impulse_x, i, j, k));
    given.y(i, j, k) = -on_y_face(impulse_y, i, j, k);
    given.z(i, j, k) = -(by_row ? impulse_z(i, j, k) : cell_to_zface(impulse_z, i, j, k));
  }
};

/// Integral of the impulse density over the volumes of the faces of one direction, for the ledger.
struct SumImpulse {
  GridRef grid;
  bool y_faces;
  ConstFieldRef impulse;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    return impulse(i, j, k) * (grid.dx * grid.dz * (y_faces ? grid.dy_centre(j) : grid.dy(j)));
  }
};

}  // namespace barchan
