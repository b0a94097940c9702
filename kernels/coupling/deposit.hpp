// Grain to fluid: volume and momentum of the grains as densities on cells, then on faces.
// Equations: docs/theory-coupling.md.
#pragma once

#include "kernels/coupling/deposit_cache.hpp"
#include "kernels/coupling/row_exchange.hpp"
#include "kernels/fluid/stencil.hpp"
#include "kernels/grains/fluid_on_grains.hpp"

namespace barchan {

/// What one grain gives to the fluid in one fluid step.
struct GrainExchange {
  Real volume;   // [m^3]
  Vec3 impulse;  // drag, added mass and lift on the grain during the grain steps [N s]
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
  /// beta_p dt [kg].
  KOKKOS_INLINE_FUNCTION Real beta_dt(int g) const { return dt * on_grains.beta(g); }
};

/// Bounds of the grains' centres, without a lower one for the height [m].
struct GrainExtent {
  Real left = 0, right = -1, top = 0, front = 0, back = 0;  // no grains
};

/// What all grains together give: volume [m^3], beta_p dt [kg], sum of |impulse| components and the
/// impulse itself [N s]; and their extent. Bounds of what one cell can get.
struct GrainTotals {
  ExchangeOfGrain of_grain;
  KOKKOS_FUNCTION void operator()(int g, Real& volume, Real& beta_dt, Real& size, Real& x, Real& y,
                                  Real& z, Real& left, Real& right, Real& top, Real& front,
                                  Real& back) const {
    const GrainExchange e = of_grain(g);
    volume += e.volume;
    beta_dt += of_grain.beta_dt(g);
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

/// Deposits the volume and the exchange of grains in the cells of their points, or by row. A work
/// item is some grains that follow one another, one on a device.
template <int grains_per_item>
struct DepositGrains {
  ExchangeOfGrain of_grain;
  ExchangeByRow by_row;
  Deposits deposits;
  int n = 0;  // all grains

  using Cache = DepositCache<(grains_per_item > 1 ? 16 : 1)>;
  static constexpr int items_for(int n) { return (n + grains_per_item - 1) / grains_per_item; }
  KOKKOS_FUNCTION void operator()(int item) const {
    Cache cache(deposits);
    const int end = Kokkos::min((item + 1) * grains_per_item, n);
    for (int g = item * grains_per_item; g < end; ++g) deposit(g, cache);
  }

 private:
  KOKKOS_INLINE_FUNCTION void deposit(int g, Cache& cache) const {
    const GrainKinematics grain = of_grain.grains(g);
    const GrainRows rows = by_row.stencil.rows_of(grain);
    const GrainExchange given = of_grain(g);
    to_cells(by_row.stencil(grain, rows), given, cache);
    if (by_row.on) to_rows(g, rows, by_row.velocity(rows, grain), given.impulse, cache);
  }
  /// By shares of the points; by row the volume alone.
  KOKKOS_INLINE_FUNCTION void to_cells(const GrainCells& cells, const GrainExchange& given,
                                       Cache& cache) const {
    for (int q = 0; q < cells.n; ++q) {
      const Real w = cells.weight(q);
      const Vec3 impulse = by_row.on ? Vec3{} : w * given.impulse;
      add(cache, cells.cell[q],
          {.volume = deposits.volume.encode(w * given.volume),
           .impulse_x = deposits.impulse.encode(impulse.x),
           .impulse_y = deposits.impulse.encode(impulse.y),
           .impulse_z = deposits.impulse.encode(impulse.z)});
    }
  }
  /// To the momentum cell of row j at face f goes J_jf = w_j c_f (J + beta_p dt (u_jf - u_ff +
  /// phi (u_ff - u_f))), and the conductance c_f C_j to the row below; upwards w_j J to row j. A
  /// cell that flows faster than the grain sees on average drags it more: the differences add up
  /// to nothing over the grain.
  KOKKOS_INLINE_FUNCTION void to_rows(int g, const GrainRows& rows, const VelocityByRow& u,
                                      const Vec3& impulse, Cache& cache) const {
    const Real beta_dt = of_grain.beta_dt(g);
    const Real K = beta_dt * of_grain.on_grains.inv_fluid_mass(g);
    const Real joined_x = u.x_faces.joined(K), joined_z = u.z_faces.joined(K);
    for (int r = 0; r < rows.n; ++r) {
      const int j = rows.row[r];
      const Real w = rows.weight(r);
      const Real C_j = beta_dt * conductance_below(rows, j);
      add(cache, {u.i, j, u.k}, {.impulse_y = deposits.impulse.encode(w * impulse.y)});
      for (int side = 0; side < 2; ++side) {
        const Real c_x = u.x_faces.weight(side), c_z = u.z_faces.weight(side);
        if (c_x > 0) {
          const Real faster =
              (u.x[side][r] - u.mean_of_x[side]) + joined_x * (u.mean_of_x[side] - u.mean_x);
          const Real lost = w * c_x * (impulse.x + beta_dt * faster);
          add(cache, by_row.x_face(u, side, j),
              {.conductance_x = deposits.conductance.encode(c_x * C_j),
               .impulse_x = deposits.impulse.encode(lost)});
        }
        if (c_z > 0) {
          const Real faster =
              (u.z[side][r] - u.mean_of_z[side]) + joined_z * (u.mean_of_z[side] - u.mean_z);
          const Real lost = w * c_z * (impulse.z + beta_dt * faster);
          add(cache, by_row.z_face(u, side, j),
              {.conductance_z = deposits.conductance.encode(c_z * C_j),
               .impulse_z = deposits.impulse.encode(lost)});
        }
      }
    }
  }
  KOKKOS_INLINE_FUNCTION void add(Cache& cache, const CellIndex& cell,
                                  const CellDeposit& given) const {
    cache.add(cell.linear(by_row.stencil.grid), given);
  }
};

/// Volume of the grains that belong to each momentum cell along the floor, which may be more than
/// what of them lies there.
struct DepositSolid {
  ExchangeByRow by_row;
  Kokkos::View<const GrainKinematics*> grains;
  Deposits deposits;

  KOKKOS_FUNCTION void operator()(int g) const {
    const GrainKinematics grain = grains(g);
    const GrainRows rows = by_row.stencil.rows_of(grain);
    const GrainColumn column = by_row.column(rows, grain);
    for (int r = 0; r < rows.n; ++r) {
      const Real volume = rows.weight(r) * sphere_volume(grain.r);
      for (int side = 0; side < 2; ++side) {
        const Real of_x = column.x_faces.weight(side), of_z = column.z_faces.weight(side);
        add(by_row.x_face(column, side, rows.row[r]),
            {.conductance_x = deposits.volume.encode(of_x * volume)});
        add(by_row.z_face(column, side, rows.row[r]),
            {.conductance_z = deposits.volume.encode(of_z * volume)});
      }
    }
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION void add(const CellIndex& cell, const CellDeposit& given) const {
    deposits.add(cell.linear(by_row.stencil.grid), given);
  }
};

/// The largest solid fraction that CFDEM's void fraction models leave: its alphaMin is 0.1.
inline constexpr Real kMaxSolid = 1 - 0.1;

/// One quantity of the deposits as a density on cells, sum / cell volume, without what is above
/// `most`.
struct DecodeDeposit {
  GridRef grid;
  Deposits deposits;
  FixedPoint point;
  Deposits::Quantity quantity = Deposits::kVolume;
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
