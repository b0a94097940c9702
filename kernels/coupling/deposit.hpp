// Grain to fluid: volume and momentum of the grains as densities on cells, then on faces; and back
// to the grains what the implicit drag took. Equations: docs/model.md.
#pragma once

#include "kernels/coupling/flow_at_grains.hpp"

namespace barchan {

/// Sums on owned cells in fixed point.
struct Deposits {
  static constexpr int kQuantities = 5;  // volume, implicit coefficient, impulse x, y, z
  Kokkos::View<std::int64_t* [kQuantities], Kokkos::LayoutLeft> sum;
  FixedPoint volume, implicit, impulse;
};

/// What one grain gives to the fluid in one fluid step.
struct GrainExchange {
  Real volume;    // [m^3]
  Real implicit;  // dt beta + added mass [kg]
  Vec3 impulse;   // drag, added mass and lift on the grain during the sub-steps [N s]
};

struct ExchangeOfGrain {
  Real dt = 0;
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;
  ExchangeOnGrains exchange;

  KOKKOS_INLINE_FUNCTION GrainExchange operator()(int g) const {
    const GrainKinematics grain = grains(g);
    const Real added_mass = on_grains.added_mass(g);
    Vec3 steady = exchange.added_mass_force(g);
    if (exchange.lift.extent(0) > 0) steady += exchange.lift(g);
    return {.volume = sphere_volume(grain.r),
            .implicit = dt * on_grains.beta(g) + added_mass,
            .impulse = on_grains.drag_impulse(g) + dt * steady -
                       added_mass * (grain.u - on_grains.u_start(g))};
  }
};

/// Impulse that the rows of one grain exchange through it, as a bound [N s].
KOKKOS_INLINE_FUNCTION Real between_rows(const ExchangeOfGrain& of_grain, const ExchangeByRow& rows,
                                         int g) {
  const VelocityByRow v = rows(of_grain.grains(g));
  Real sum = 0;
  for (int r = 0; r < v.rows.n; ++r) {
    sum += v.rows.weight(r) * (Kokkos::abs(v.x[r] - v.mean_x) + Kokkos::abs(v.z[r] - v.mean_z));
  }
  return of_grain.dt * of_grain.on_grains.beta(g) * sum;
}

/// What all grains together give: volume [m^3], implicit coefficient [kg], sum of |impulse|
/// components and the impulse itself [N s].
struct SumExchange {
  ExchangeOfGrain of_grain;
  ExchangeByRow rows;
  KOKKOS_FUNCTION void operator()(int g, Real& volume, Real& implicit, Real& size, Real& x, Real& y,
                                  Real& z) const {
    const GrainExchange e = of_grain(g);
    volume += e.volume;
    implicit += e.implicit;
    size += Kokkos::abs(e.impulse.x) + Kokkos::abs(e.impulse.y) + Kokkos::abs(e.impulse.z);
    if (rows.on) size += between_rows(of_grain, rows, g);
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
    const GrainCells cells = rows.stencil(of_grain.grains(g));
    if (rows.on) {
      const VelocityByRow v = rows(of_grain.grains(g));
      const Real drag = of_grain.dt * of_grain.on_grains.beta(g);
      // A row that flows faster than the grain sees on average drags it more: the difference adds
      // up to nothing over the grain.
      add(g, cells, [&](int j) {
        const int r = v.rows.find(j);
        return Vec3{drag * (v.x[r] - v.mean_x), 0, drag * (v.z[r] - v.mean_z)};
      });
    } else {
      add(g, cells, [](int) { return Vec3{}; });
    }
  }

 private:
  template <class InRow>
  KOKKOS_INLINE_FUNCTION void add(int g, const GrainCells& cells, const InRow& of_row) const {
    const GrainExchange e = of_grain(g);
    for (int q = 0; q < cells.n; ++q) {
      const Vec3 impulse = e.impulse + of_row(cells.cell[q].j);
      const Real w = cells.weight(q);
      const std::int64_t cell = cells.cell[q].linear(rows.stencil.grid);
      const auto put = [&](int quantity, const FixedPoint& point, Real value) {
        Kokkos::atomic_add(&deposits.sum(cell, quantity), point.encode(w * value));
      };
      put(0, deposits.volume, e.volume);
      put(1, deposits.implicit, e.implicit);
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
  ConstFieldRef implicit, impulse_x, impulse_y, impulse_z;  // on cells, ghosts in x and z valid
  FaceRef a, m;  // impulse and implicit coefficient on faces

  KOKKOS_INLINE_FUNCTION Real on_y_face(const ConstFieldRef& f, int i, int j, int k) const {
    if (j == 0) return 0;
    return (f(i, j - 1, k) * grid.dy(j - 1) * y_face_shares(j - 1, grid.ny).upper +
            f(i, j, k) * grid.dy(j) * y_face_shares(j, grid.ny).lower) /
           grid.dy_centre(j);
  }
  KOKKOS_INLINE_FUNCTION void operator()(int i, int j, int k) const {
    // The fluid gets the opposite of what the grains got.
    a.x(i, j, k) = -cell_to_xface(impulse_x, i, j, k);
    a.y(i, j, k) = -on_y_face(impulse_y, i, j, k);
    a.z(i, j, k) = -cell_to_zface(impulse_z, i, j, k);
    m.x(i, j, k) = cell_to_xface(implicit, i, j, k);
    m.y(i, j, k) = on_y_face(implicit, i, j, k);
    m.z(i, j, k) = cell_to_zface(implicit, i, j, k);
  }
};

/// Integrals over the volumes of the faces of one direction, for the ledger: of the impulse
/// density, and of what the implicit part took while the velocity changed at the rate du_dt
/// (nothing on the wall).
struct FaceVolume {
  GridRef grid;
  bool y_faces;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int j) const {
    return grid.dx * grid.dz * (y_faces ? grid.dy_centre(j) : grid.dy(j));
  }
};
struct SumImpulse {
  FaceVolume volume;
  ConstFieldRef impulse;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    return impulse(i, j, k) * volume(j);
  }
};
struct SumImplicit {
  FaceVolume volume;
  ConstFieldRef implicit, du_dt;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    return volume.y_faces && j == 0 ? 0 : implicit(i, j, k) * du_dt(i, j, k) * volume(j);
  }
};

/// Change of the fluid velocity within the step on cells: the adjoint of SpreadToFaces.
struct VelocityChangeOnCells {
  GridRef grid;
  ConstFaceRef du_dt;
  Real dt = 0;
  FieldRef x, y, z;

  KOKKOS_INLINE_FUNCTION void operator()(int i, int j, int k) const {
    const FaceShares share = y_face_shares(j, grid.ny);
    x(i, j, k) = dt * (du_dt.x(i, j, k) + du_dt.x(i + 1, j, k)) / 2;
    y(i, j, k) = dt * (share.lower * du_dt.y(i, j, k) + share.upper * du_dt.y(i, j + 1, k));
    z(i, j, k) = dt * (du_dt.z(i, j, k) + du_dt.z(i, j, k + 1)) / 2;
  }
};

/// What the implicit drag took from the fluid within the step beyond the sub-steps' impulse goes
/// back to the grains, in the weights it was deposited with. Returns the sum over the grains.
struct CarryToGrain {
  DepositStencil stencil;
  ExchangeOfGrain of_grain;
  ConstFieldRef x, y, z;  // smoothed change of the fluid velocity on cells [m/s]
  Kokkos::View<Vec3*> carried_impulse;

  KOKKOS_FUNCTION void operator()(int g, Real& sum_x, Real& sum_y, Real& sum_z) const {
    const GrainCells cells = stencil(of_grain.grains(g));
    const Vec3 change{mean_over(cells, x), mean_over(cells, y), mean_over(cells, z)};
    const Vec3 carried = of_grain(g).implicit * change;
    carried_impulse(g) += carried;
    sum_x += carried.x;
    sum_y += carried.y;
    sum_z += carried.z;
  }
};

}  // namespace barchan
