// Grain to fluid: volume and momentum of the grains as densities on cells, then on faces.
// Equations: docs/theory-coupling.md.
#pragma once

#include "kernels/coupling/deposit_cache.hpp"
#include "kernels/coupling/layered_exchange.hpp"
#include "kernels/coupling/stresslet.hpp"
#include "kernels/fluid/stencil.hpp"
#include "kernels/grains/fluid_on_grains.hpp"
#include "kernels/grains/sphere.hpp"
#include "kernels/math/raise_to.hpp"

namespace barchan {

/// Volume and impulse that one grain gives to the fluid in one fluid step.
struct GrainExchange {
  Real volume;   // [m^3]
  Vec3 impulse;  // drag, added mass and lift on the grain during the grain steps [N s]
};

struct ExchangeOfGrain {
  Real dt = 0;
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;
  ExchangeOnGrains exchange;
  Stresslet stresslet{};

  KOKKOS_INLINE_FUNCTION GrainExchange operator()(int g) const {
    Vec3 steady = exchange.added_mass_force(g);
    if (exchange.lift.extent(0) > 0) steady += exchange.lift(g);
    return {.volume = sphere_volume(grains(g).r), .impulse = on_grains.impulse(g) + dt * steady};
  }
  /// Drag of the grain over the step, beta_p dt [kg].
  KOKKOS_INLINE_FUNCTION Real beta_dt(int g) const { return dt * on_grains.beta(g); }
  /// Interlayer drag of the grain over the step, at least beta_p dt [kg].
  KOKKOS_INLINE_FUNCTION Real rows_dt(const GridRef& grid, int g, const LayerVelocity& u) const {
    const GrainKinematics grain = grains(g);
    const Vec3 slip = Vec3{u.x.over_grain, 0, u.z.over_grain} - Vec3{grain.u.x, 0, grain.u.z};
    return dt * stresslet(grid, u.rows, grain, slip, u.solid, on_grains.beta(g));
  }
  KOKKOS_INLINE_FUNCTION Real most_dt(int g) const {
    return beta_dt(g) + dt * stresslet.most(grains(g).r);
  }
};

/// Marks the columns of cells, those of all ranks, that hold grains.
struct MarkColumns {
  GridRef grid;
  PeriodicBox box;  // periods of the grains
  Kokkos::View<const GrainKinematics*> grains;
  Real reach;               // radius of the largest grain [m]
  Kokkos::View<int*> mark;  // i + nx_all k, then the rows up to the highest

  KOKKOS_FUNCTION void operator()(int g) const {
    const Vec3 x = grains(g).x;
    const auto column = [](Real at, Real spacing, int n, Real period) {  // as place_x
      const int c = GridRef::cell_along(at, spacing);
      return period > 0 ? DepositStencil::wrap(c, n) : Kokkos::clamp(c, 0, n - 1);
    };
    const int i[2] = {column(x.x - reach, grid.dx, grid.nx_all, box.lx),
                      column(x.x + reach, grid.dx, grid.nx_all, box.lx)};
    const int k[2] = {column(x.z - reach, grid.dz, grid.nz_all, box.lz),
                      column(x.z + reach, grid.dz, grid.nz_all, box.lz)};
    for (const int kk : k) {
      for (const int ii : i) Kokkos::atomic_store(&mark(ii + grid.nx_all * kk), 1);
    }
    raise_to(&mark(grid.nx_all * grid.nz_all), grid.row_of(x.y + reach) + 1);
  }
};

/// Sums over all grains that bound what one cell can get: volume [m^3], largest interlayer drag
/// [kg], sum of |impulse| components, and the impulse itself [N s].
struct GrainTotals {
  Real volume = 0, rows_dt = 0, size = 0;
  Vec3 impulse;

  KOKKOS_FORCEINLINE_FUNCTION GrainTotals& operator+=(const GrainTotals& more) {
    volume += more.volume;
    rows_dt += more.rows_dt;
    size += more.size;
    impulse += more.impulse;
    return *this;
  }
};
/// Sums up GrainTotals over the grains.
struct AddTotals {
  ExchangeOfGrain of_grain;
  KOKKOS_FUNCTION void operator()(int g, GrainTotals& sum) const {
    const auto [volume, impulse] = of_grain(g);
    const Real size = Kokkos::abs(impulse.x) + Kokkos::abs(impulse.y) + Kokkos::abs(impulse.z);
    sum += {volume, of_grain.most_dt(g), size, impulse};
  }
};

/// Exchange of a grain with the cells of its volume, in the same shares.
struct CellExchange {
  static constexpr bool layered = false;
  DepositStencil stencil;
};

/// Deposits the volume of grains in their cells, and their exchange there
/// (CellExchange) or in the layers around them (LayerExchange). A work item is some grains that
/// follow one another, one on a device.
template <int grains_per_item, class Exchange>
struct DepositGrains {
  ExchangeOfGrain of_grain;
  Exchange exchange;
  Deposits deposits;
  int n = 0;  // number of all grains

  using Cache = DepositCache<(grains_per_item > 1 ? 32 : 1)>;
  static constexpr int items_for(int n) { return (n + grains_per_item - 1) / grains_per_item; }
  KOKKOS_FUNCTION void operator()(int item) const {
    Cache cache(exchange.stencil.grid, deposits);
    const int end = Kokkos::min((item + 1) * grains_per_item, n);
    for (int g = item * grains_per_item; g < end; ++g) deposit(g, cache);
  }

 private:
  KOKKOS_INLINE_FUNCTION void deposit(int g, Cache& cache) const {
    const GrainKinematics grain = of_grain.grains(g);
    const GrainRows rows = exchange.stencil.rows_of(grain);
    const GrainExchange given = of_grain(g);
    to_cells(exchange.stencil(grain, rows), given, cache);
    if constexpr (Exchange::layered)
      to_layers(g, rows, exchange.velocity(rows, grain), given.impulse, cache);
  }
  /// Deposits by the shares of the cells; with layers the volume alone.
  KOKKOS_INLINE_FUNCTION void to_cells(const GrainCells& cells, const GrainExchange& given,
                                       Cache& cache) const {
    for (int q = 0; q < cells.n; ++q) {
      const Real w = cells.weight(q);
      CellDeposit& cell = cache.at(cells.cell[q]);
      cell.volume += deposits.volume.encode(w * given.volume);
      if constexpr (Exchange::layered) continue;
      cell.impulse_x += deposits.impulse.encode(w * given.impulse.x);
      cell.impulse_y += deposits.impulse.encode(w * given.impulse.y);
      cell.impulse_z += deposits.impulse.encode(w * given.impulse.z);
    }
  }
  /// Adds J_jf = w_j c_f (J + beta_l dt (u_jf - u_ff) + beta_p dt phi (u_ff - u_f)) to the momentum
  /// cell of row j at face f, and the interlayer drag c_f C_j to the row below it. Upwards row j
  /// gets w_j J. A cell that flows faster than the grain sees on average drags it more; over the
  /// grain the differences add up to nothing. beta_l is beta_p, or the rate of the stresslet.
  KOKKOS_INLINE_FUNCTION void to_layers(int g, const GrainRows& rows, const LayerVelocity& u,
                                        const Vec3& impulse, Cache& cache) const {
    const Real beta_dt = of_grain.beta_dt(g);
    const Real K = beta_dt * of_grain.on_grains.inv_fluid_mass(g);
    const Real rows_dt = of_grain.rows_dt(exchange.stencil.grid, g, u);
    const Real limited_x = beta_dt * u.x_faces.limiter(K),
               limited_z = beta_dt * u.z_faces.limiter(K);
    const int main_x = u.x_faces.main_side(), main_z = u.z_faces.main_side();
    for (int r = 0; r < rows.n; ++r) {
      const int j = rows.row[r];
      const Real w = rows.weight(r);
      const Real C_j = rows_dt * interlayer_drag_below(rows, j);
      cache.at({u.i, j, u.k}).impulse_y += deposits.impulse.encode(w * impulse.y);
      const auto given = [&](const VelocityAtFaces& v, int side, Real limited, Real along) {
        const Real faster =
            rows_dt * (v.in_row[side][r] - v.mean[side]) + limited * (v.mean[side] - v.over_grain);
        return along + faster;
      };
      const auto along_x = [&](int side) {
        const Real c = u.x_faces.weight(side);
        if (c == 0) return;
        CellDeposit& cell = cache.at(exchange.x_face(u, side, j));
        cell.interlayer_drag_x += deposits.interlayer_drag.encode(c * C_j);
        cell.impulse_x += deposits.impulse.encode(w * c * given(u.x, side, limited_x, impulse.x));
      };
      const auto along_z = [&](int side) {
        const Real c = u.z_faces.weight(side);
        if (c == 0) return;
        CellDeposit& cell = cache.at(exchange.z_face(u, side, j));
        cell.interlayer_drag_z += deposits.interlayer_drag.encode(c * C_j);
        cell.impulse_z += deposits.impulse.encode(w * c * given(u.z, side, limited_z, impulse.z));
      };
      along_x(main_x), along_x(1 - main_x);
      along_z(main_z), along_z(1 - main_z);
    }
  }
};

/// Volume of the grains that belong to each momentum cell along the floor. More grains may belong
/// to a cell than lie in it.
struct DepositSolid {
  LayerExchange exchange;
  Kokkos::View<const GrainKinematics*> grains;
  Deposits deposits;

  KOKKOS_FUNCTION void operator()(int g) const {
    const GrainKinematics grain = grains(g);
    const GrainRows rows = exchange.stencil.rows_of(grain);
    const GrainColumn column = exchange.column(rows, grain);
    for (int r = 0; r < rows.n; ++r) {
      const Real volume = rows.weight(r) * sphere_volume(grain.r);
      for (int side = 0; side < 2; ++side) {
        const Real of_x = column.x_faces.weight(side), of_z = column.z_faces.weight(side);
        add(exchange.x_face(column, side, rows.row[r]),
            {.interlayer_drag_x = deposits.volume.encode(of_x * volume)});
        add(exchange.z_face(column, side, rows.row[r]),
            {.interlayer_drag_z = deposits.volume.encode(of_z * volume)});
      }
    }
  }

 private:
  KOKKOS_FORCEINLINE_FUNCTION void add(const CellIndex& cell, const CellDeposit& given) const {
    deposits.add(cell.linear(exchange.stencil.grid), given);
  }
};

/// A quantity of the deposits per volume of its cell.
KOKKOS_FORCEINLINE_FUNCTION Real density_of_deposit(const GridRef& grid, const Deposits& deposits,
                                                    const FixedPoint& point,
                                                    Deposits::Quantity quantity, int i, int j,
                                                    int k) {
  const std::int64_t cell = CellIndex{i, j, k}.linear(grid);
  return point.decode(deposits.sum(cell, quantity)) / grid.cell_volume(j);
}

/// The largest solid fraction that CFDEM's void fraction models leave: its alphaMin is 0.1.
inline constexpr Real kMaxSolid = 1 - 0.1;

/// Sets the sums of a cell to zero.
struct ClearDeposits {
  GridRef grid;
  Deposits deposits;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    const std::int64_t cell = CellIndex{i, j, k}.linear(grid);
    for (int q = 0; q < Deposits::kQuantities; ++q) deposits.sum(cell, q) = 0;
  }
};

/// Decodes one quantity of the deposits to a density on cells, sum / cell volume, cut off at
/// `most`.
struct DecodeDeposit {
  GridRef grid;
  Deposits deposits;
  FixedPoint point;
  Deposits::Quantity quantity = Deposits::kVolume;
  Real most = Kokkos::Experimental::infinity_v<Real>;
  FieldRef density;

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    density(i, j, k) =
        Kokkos::min(density_of_deposit(grid, deposits, point, quantity, i, j, k), most);
  }
};

/// Turns the solid fraction into alpha_f = 1 - solid fraction, in place; adds up the volume of the
/// grains [m^3].
struct SolidToFluidFraction {
  GridRef grid;
  FieldRef alpha;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    const Real solid = alpha(i, j, k);
    alpha(i, j, k) = 1 - solid;
    return solid * grid.cell_volume(j);
  }
};

/// Sets alpha_f to 1 where no grains are.
struct ClearWater {
  FieldRef alpha;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    alpha(i, j, k) = 1;
    return 0;
  }
};

}  // namespace barchan
