// Grain to fluid: volume and momentum of the grains as densities on cells, then on faces.
// Equations: docs/model.md.
#pragma once

#include "kernels/coupling/row_exchange.hpp"
#include "kernels/fluid/stencil.hpp"
#include "kernels/grains/fluid_on_grains.hpp"

namespace barchan {

/// Sums on owned cells in fixed point.
struct Deposits {
  static constexpr int kQuantities = 5;  // volume, conductance between rows, impulse x, y, z
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

/// What all grains together give: volume [m^3], drag coefficient times dt [kg], sum of |impulse|
/// components and the impulse itself [N s].
struct SumExchange {
  ExchangeOfGrain of_grain;
  KOKKOS_FUNCTION void operator()(int g, Real& volume, Real& drag, Real& size, Real& x, Real& y,
                                  Real& z) const {
    const GrainExchange e = of_grain(g);
    volume += e.volume;
    drag += of_grain.drag(g);
    size += Kokkos::abs(e.impulse.x) + Kokkos::abs(e.impulse.y) + Kokkos::abs(e.impulse.z);
    x += e.impulse.x;
    y += e.impulse.y;
    z += e.impulse.z;
  }
};

/// Deposits the volume and the exchange of each grain in the cells of its points.
struct DepositGrain {
  ExchangeOfGrain of_grain;
  ExchangeByRow rows;
  Deposits deposits;

  KOKKOS_FUNCTION void operator()(int g) const {
    const GrainKinematics grain = of_grain.grains(g);
    const GrainCells cells = rows.stencil(grain);
    const GrainRows in_rows = rows.rows_of(grain);
    if (rows.on && in_rows.n > 1) {
      const VelocityByRow v = rows.velocity(in_rows, grain);
      const Real drag = of_grain.drag(g);
      // A row that flows faster than the grain sees on average drags it more: the difference adds
      // up to nothing over the grain.
      add(g, cells, [&](int j) {
        const int r = in_rows.find(j);
        return InRow{.impulse = {drag * (v.x[r] - v.mean_x), 0, drag * (v.z[r] - v.mean_z)},
                     .conductance = drag * in_rows.conductance_below(j) / in_rows.weight(r)};
      });
    } else {
      add(g, cells, [](int) { return InRow{}; });
    }
  }

 private:
  /// Of a point of the grain, times the number of its points.
  struct InRow {
    Vec3 impulse{};        // beyond that of the whole grain [N s]
    Real conductance = 0;  // between this row and the one below [kg]
  };
  template <class OfRow>
  KOKKOS_INLINE_FUNCTION void add(int g, const GrainCells& cells, const OfRow& of_row) const {
    const GrainExchange e = of_grain(g);
    for (int q = 0; q < cells.n; ++q) {
      const InRow in_row = of_row(cells.cell[q].j);
      const Vec3 impulse = e.impulse + in_row.impulse;
      const Real w = cells.weight(q);
      const std::int64_t cell = cells.cell[q].linear(rows.stencil.grid);
      const auto put = [&](int quantity, const FixedPoint& point, Real value) {
        Kokkos::atomic_add(&deposits.sum(cell, quantity), point.encode(w * value));
      };
      put(0, deposits.volume, e.volume);
      if (in_row.conductance > 0) put(1, deposits.conductance, in_row.conductance);
      put(2, deposits.impulse, impulse.x);
      put(3, deposits.impulse, impulse.y);
      put(4, deposits.impulse, impulse.z);
    }
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

/// Cell densities to faces, integrals kept: half of a cell's content to each of its two faces.
struct SpreadToFaces {
  GridRef grid;
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
    given.x(i, j, k) = -cell_to_xface(impulse_x, i, j, k);
    given.y(i, j, k) = -on_y_face(impulse_y, i, j, k);
    given.z(i, j, k) = -cell_to_zface(impulse_z, i, j, k);
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
