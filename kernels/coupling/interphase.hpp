// The two sides of the exchange: fluid to grain (gather) and grain to fluid (deposit, spread),
// and the way back of what the implicit drag moved (return). Equations: docs/model.md.
#pragma once

#include "kernels/coupling/drag.hpp"
#include "kernels/coupling/void_fraction.hpp"
#include "kernels/fluid/convective_acceleration.hpp"
#include "kernels/fluid/interpolation.hpp"
#include "kernels/fluid/momentum.hpp"
#include "kernels/grains/grain_motion.hpp"

namespace barchan {

inline constexpr Real kAddedMassCoefficient = 0.5;  // of a sphere

/// Which forces of the fluid act, as numbers to multiply with.
struct FluidForces {
  Real drag = 1, pressure_gradient = 1, stress = 1, added_mass = 1, buoyancy = 1;
};

/// Fluid force per volume of grain on faces, -grad p + rho f e_x + rho div(2 (nu + nu_t) S) [N/m^3]
/// (Lima et al. 2022, B9 and B10; Set II: the same stress as in the fluid equation), and the
/// convective acceleration u . grad u [m/s^2] of the added mass.
struct FluidForceDensity {
  GridRef grid;
  FaceRef u;
  FieldRef p;
  StressDivergence stress;
  Real rho_f = 0, drive = 0;
  FluidForces forces;
  FaceRef force, convective;

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    const Real a = -forces.pressure_gradient, b = rho_f * forces.stress;
    force.x(i, j, k) = a * (ddx_at_xface(grid, p, i, j, k) - rho_f * drive) + b * stress.x(i, j, k);
    force.y(i, j, k) = a * ddy_at_yface(grid, p, i, j, k) + b * stress.y(i, j, k);
    force.z(i, j, k) = a * ddz_at_zface(grid, p, i, j, k) + b * stress.z(i, j, k);

    const ConvectiveAcceleration acceleration{grid, u};
    convective.x(i, j, k) = acceleration.x(i, j, k);
    convective.y(i, j, k) = j > 0 ? acceleration.y(i, j, k) : Real(0);
    convective.z(i, j, k) = acceleration.z(i, j, k);
  }
};

/// The force density on the lower wall takes the value of the first face inside; what ghosts hold
/// behind both walls is constant, too.
struct HoldForceAtWall {
  FieldRef force_y;
  int ny;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int, int k) const {
    force_y(i, 0, k) = force_y(i, ny > 1 ? 1 : 0, k);
  }
};

/// Bounds of the grains' centres, without a lower one for the height [m].
struct ExtentOfGrains {
  Kokkos::View<const GrainKinematics*> grains;
  KOKKOS_FUNCTION void operator()(int g, Real& left, Real& right, Real& top, Real& front,
                                  Real& back) const {
    const Vec3& x = grains(g).x;
    left = Kokkos::fmin(left, x.x), right = Kokkos::fmax(right, x.x);
    top = Kokkos::fmax(top, x.y);
    front = Kokkos::fmin(front, x.z), back = Kokkos::fmax(back, x.z);
  }
};

/// Per grain, what the gather keeps for the deposit and for the next step.
struct ExchangeOnGrains {
  Kokkos::View<Vec3*> added_mass_force;  // convective part, C_m rho V_p (u . grad u) [N]
  Kokkos::View<Vec3*> fluid_force;      // of pressure gradient and stress, as the grain sees it [N]
  Kokkos::View<Vec3*> carried_impulse;  // still owed to the grain by the implicit drag [N s]
};

/// Weight less buoyancy [N].
struct SubmergedWeight {
  Vec3 gravity;        // [m/s^2]
  Real displaced = 0;  // density of what a grain displaces [kg/m^3]; 0: no buoyancy
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(const GrainKinematics& grain) const {
    return (grain.m - displaced * sphere_volume(grain.r)) * gravity;
  }
};

/// Share by which a grain's view of the flow follows the flow in one fluid step. The exchange lags
/// one step, and in a dense bed the pore water resists squeezing with beta/alpha^2 and the inertia
/// of the water that has to leave, r (1 + C_m r) of the grain's own volume of it, r = (1 -
/// alpha)/alpha. Where that exceeds the grain's inertia, following at once overshoots more each
/// time (docs/numerics.md, "Dense beds"). About 1 in dilute flow; the delay vanishes with the step.
KOKKOS_INLINE_FUNCTION Real exchange_relaxation(Real inertia, Real displaced_mass, Real beta,
                                                Real alpha_f, Real dt) {
  const Real r = (1 - alpha_f) / alpha_f;
  const Real squeezed = displaced_mass * r * (1 + kAddedMassCoefficient * r);
  return inertia / (inertia + squeezed + beta * dt / (alpha_f * alpha_f));
}

/// What a grain keeps account of within a fluid step begins anew.
struct BeginFluidStep {
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;
  KOKKOS_FUNCTION void operator()(int g) const {
    on_grains.drag_impulse(g) = Vec3{};
    on_grains.u_start(g) = grains(g).u;
  }
};

/// Fluid velocity, drag coefficient and all steady forces at each grain, for one fluid step.
/// The drag coefficient is that of the slip at the start; the drag itself follows the grain.
template <class DragLaw>
struct GatherFluid {
  DragLaw drag;
  GridRef grid;
  FaceRef u, force, convective;
  FieldRef alpha_f;
  Real rho_f = 0, mu_f = 0, dt = 0;
  SubmergedWeight weight;
  FluidForces forces;
  bool wrap_x = false;
  bool at_once = false;  // no relaxation: the first step, grains that do not move
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;
  ExchangeOnGrains exchange;

  KOKKOS_FUNCTION void operator()(int g) const {
    const GrainKinematics grain = grains(g);
    const PointStencil at(grid, grain.x, wrap_x);
    const Real found = interpolate_cell(alpha_f, at);
    const Vec3 u_f = interpolate_faces(u, at);
    const Real volume = sphere_volume(grain.r);
    const Real added_mass = forces.added_mass * kAddedMassCoefficient * rho_f * volume;
    const Vec3 added = added_mass * interpolate_faces(convective, at);

    const Real alpha = found < Real(0.1) ? Real(0.1) : (found > 1 ? Real(1) : found);
    const LocalFlow flow{.alpha_f = alpha,
                         .rho_f = rho_f,
                         .mu_f = mu_f,
                         .slip = norm(u_f - grain.u),
                         .d_p = 2 * grain.r};
    const Real beta = forces.drag * drag(flow);
    const Real share =
        at_once ? Real(1)
                : exchange_relaxation(grain.m + added_mass, rho_f * volume, beta, alpha, dt);
    on_grains.u_f(g) += share * (u_f - on_grains.u_f(g));
    exchange.fluid_force(g) +=
        share * (volume * interpolate_faces(force, at) - exchange.fluid_force(g));
    const Vec3 paid = share * exchange.carried_impulse(g);
    exchange.carried_impulse(g) = exchange.carried_impulse(g) - paid;

    on_grains.beta(g) = beta;
    on_grains.added_mass(g) = added_mass;
    on_grains.steady_force(g) = weight(grain) + exchange.fluid_force(g) + added + (1 / dt) * paid;
    BeginFluidStep{grains, on_grains}(g);
    exchange.added_mass_force(g) = added;
  }
};

/// Still, unbounded fluid around grains without a flow solver: weight, buoyancy, Schiller-Naumann
/// drag, added mass. Without a fluid the weight alone.
struct GatherStillFluid {
  Real rho_f = 0, mu_f = 0;
  SubmergedWeight weight;
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;

  KOKKOS_FUNCTION void operator()(int g) const {
    const GrainKinematics grain = grains(g);
    on_grains.steady_force(g) = weight(grain);
    if (on_grains.none) return;
    const LocalFlow flow{
        .alpha_f = 1, .rho_f = rho_f, .mu_f = mu_f, .slip = norm(grain.u), .d_p = 2 * grain.r};
    on_grains.u_f(g) = Vec3{};
    on_grains.beta(g) = SchillerNaumann{}(flow);
    on_grains.added_mass(g) = kAddedMassCoefficient * rho_f * sphere_volume(grain.r);
    BeginFluidStep{grains, on_grains}(g);
  }
};

/// Grains held in place: the drag impulse of a whole fluid step.
struct DragOnFrozenGrains {
  Real dt = 0;
  FluidOnGrains on_grains;
  KOKKOS_FUNCTION void operator()(int g) const {
    on_grains.drag_impulse(g) = (dt * on_grains.beta(g)) * on_grains.u_f(g);
  }
};

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
  Vec3 impulse;   // drag and added mass on the grain during the sub-steps [N s]
};

struct ExchangeOfGrain {
  Real dt = 0;
  Kokkos::View<const GrainKinematics*> grains;
  FluidOnGrains on_grains;
  ExchangeOnGrains exchange;

  KOKKOS_INLINE_FUNCTION GrainExchange operator()(int g) const {
    const GrainKinematics grain = grains(g);
    const Real added_mass = on_grains.added_mass(g);
    return {.volume = sphere_volume(grain.r),
            .implicit = dt * on_grains.beta(g) + added_mass,
            .impulse = on_grains.drag_impulse(g) + dt * exchange.added_mass_force(g) -
                       added_mass * (grain.u - on_grains.u_start(g))};
  }
};

/// What all grains together give: volume [m^3], implicit coefficient [kg], sum of |impulse|
/// components and the impulse itself [N s].
struct SumExchange {
  ExchangeOfGrain of_grain;
  KOKKOS_FUNCTION void operator()(int g, Real& volume, Real& implicit, Real& size, Real& x, Real& y,
                                  Real& z) const {
    const GrainExchange e = of_grain(g);
    volume += e.volume;
    implicit += e.implicit;
    size += Kokkos::abs(e.impulse.x) + Kokkos::abs(e.impulse.y) + Kokkos::abs(e.impulse.z);
    x += e.impulse.x;
    y += e.impulse.y;
    z += e.impulse.z;
  }
};

/// Deposits the volume and the exchange of each grain in the cells of its points.
struct DepositGrain {
  DepositStencil stencil;
  ExchangeOfGrain of_grain;
  Deposits deposits;

  KOKKOS_FUNCTION void operator()(int g) const {
    const GrainCells cells = stencil(of_grain.grains(g));
    const GrainExchange e = of_grain(g);
    for (int q = 0; q < cells.n; ++q) {
      const Real w = cells.weight(q);
      const std::int64_t cell = cells.cell[q].linear(stencil.grid);
      const auto add = [&](int quantity, const FixedPoint& point, Real value) {
        Kokkos::atomic_add(&deposits.sum(cell, quantity), point.encode(w * value));
      };
      add(0, deposits.volume, e.volume);
      add(1, deposits.implicit, e.implicit);
      add(2, deposits.impulse, e.impulse.x);
      add(3, deposits.impulse, e.impulse.y);
      add(4, deposits.impulse, e.impulse.z);
    }
  }
};

/// One quantity of the deposits as a density on cells: sum / cell volume.
struct DecodeDeposit {
  GridRef grid;
  Deposits deposits;
  FixedPoint point;
  int quantity = 0;
  FieldRef density;

  KOKKOS_INLINE_FUNCTION void operator()(int i, int j, int k) const {
    const std::int64_t cell = CellIndex{i, j, k}.linear(grid);
    density(i, j, k) = point.decode(deposits.sum(cell, quantity)) / grid.cell_volume(j);
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
  FieldRef implicit, impulse_x, impulse_y, impulse_z;  // on cells, ghosts in x and z valid
  ExchangeRef exchange;

  KOKKOS_INLINE_FUNCTION Real on_y_face(const FieldRef& f, int i, int j, int k) const {
    if (j == 0) return 0;
    return (f(i, j - 1, k) * grid.dy(j - 1) * y_face_shares(j - 1, grid.ny).upper +
            f(i, j, k) * grid.dy(j) * y_face_shares(j, grid.ny).lower) /
           grid.dy_centre(j);
  }
  KOKKOS_INLINE_FUNCTION void operator()(int i, int j, int k) const {
    const FaceRef &a = exchange.impulse, &m = exchange.implicit;
    // The fluid gets the opposite of what the grains got.
    a.x(i, j, k) = -(impulse_x(i - 1, j, k) + impulse_x(i, j, k)) / 2;
    a.y(i, j, k) = -on_y_face(impulse_y, i, j, k);
    a.z(i, j, k) = -(impulse_z(i, j, k - 1) + impulse_z(i, j, k)) / 2;
    m.x(i, j, k) = (implicit(i - 1, j, k) + implicit(i, j, k)) / 2;
    m.y(i, j, k) = on_y_face(implicit, i, j, k);
    m.z(i, j, k) = (implicit(i, j, k - 1) + implicit(i, j, k)) / 2;
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
  FieldRef impulse;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    return impulse(i, j, k) * volume(j);
  }
};
struct SumImplicit {
  FaceVolume volume;
  FieldRef implicit, du_dt;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    return volume.y_faces && j == 0 ? 0 : implicit(i, j, k) * du_dt(i, j, k) * volume(j);
  }
};

/// Change of the fluid velocity within the step on cells: the adjoint of SpreadToFaces.
struct VelocityChangeOnCells {
  GridRef grid;
  FaceRef du_dt;
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
  FieldRef x, y, z;  // smoothed change of the fluid velocity on cells [m/s]
  Kokkos::View<Vec3*> carried_impulse;

  KOKKOS_FUNCTION void operator()(int g, Real& sum_x, Real& sum_y, Real& sum_z) const {
    const GrainCells cells = stencil(of_grain.grains(g));
    Vec3 change;
    for (int q = 0; q < cells.n; ++q) {
      const auto [i, j, k] = cells.cell[q];
      change += cells.weight(q) * Vec3{x(i, j, k), y(i, j, k), z(i, j, k)};
    }
    const Vec3 carried = of_grain(g).implicit * change;
    carried_impulse(g) += carried;
    sum_x += carried.x;
    sum_y += carried.y;
    sum_z += carried.z;
  }
};

}  // namespace barchan
