// Volume-averaged momentum fluxes on the staggered grid, and the explicit predictor.
#pragma once

#include "kernels/fluid/stencil.hpp"

namespace barchan {

/// -div(alpha u u) on faces [m/s^2], second-order central.
/// Mass fluxes alpha u are averaged to the faces of the momentum cell with the areas they pass,
/// velocities with 1/2 also where the grid is stretched: so kinetic energy is conserved exactly
/// when alpha = 1 and div u = 0 (Verstappen & Veldman, J. Comput. Phys. 187, 343 (2003)).
struct Convection {
  GridRef grid;
  ConstFaceRef u;     // velocity [m/s], with ghosts
  ConstFaceRef flux;  // alpha u [m/s], with ghosts

  KOKKOS_FORCEINLINE_FUNCTION Real x(int i, int j, int k) const {
    const ConstFieldRef &q = u.x, &fx = flux.x, &fy = flux.y, &fz = flux.z;
    const Real c = q(i, j, k);
    const Real ex = (fx(i, j, k) + fx(i + 1, j, k)) * (c + q(i + 1, j, k)) -
                    (fx(i - 1, j, k) + fx(i, j, k)) * (q(i - 1, j, k) + c);
    const Real ey = (fy(i - 1, j + 1, k) + fy(i, j + 1, k)) * (c + q(i, j + 1, k)) -
                    (fy(i - 1, j, k) + fy(i, j, k)) * (q(i, j - 1, k) + c);
    const Real ez = (fz(i - 1, j, k + 1) + fz(i, j, k + 1)) * (c + q(i, j, k + 1)) -
                    (fz(i - 1, j, k) + fz(i, j, k)) * (q(i, j, k - 1) + c);
    return ex * (Real(-0.25) / grid.dx) + ey * (Real(-0.25) / grid.dy(j)) +
           ez * (Real(-0.25) / grid.dz);
  }

  KOKKOS_FORCEINLINE_FUNCTION Real y(int i, int j, int k) const {
    const ConstFieldRef &q = u.y, &fx = flux.x, &fy = flux.y, &fz = flux.z;
    const Real below = grid.dy(j - 1), above = grid.dy(j);
    const Real per_height = 1 / (below + above);  // the momentum cell is half of that high
    const Real c = q(i, j, k);
    const auto x_flux = [&](int ii) { return below * fx(ii, j - 1, k) + above * fx(ii, j, k); };
    const auto z_flux = [&](int kk) { return below * fz(i, j - 1, kk) + above * fz(i, j, kk); };
    const Real ex = x_flux(i + 1) * (c + q(i + 1, j, k)) - x_flux(i) * (q(i - 1, j, k) + c);
    const Real ey = (fy(i, j, k) + fy(i, j + 1, k)) * (c + q(i, j + 1, k)) -
                    (fy(i, j - 1, k) + fy(i, j, k)) * (q(i, j - 1, k) + c);
    const Real ez = z_flux(k + 1) * (c + q(i, j, k + 1)) - z_flux(k) * (q(i, j, k - 1) + c);
    return ex * (Real(-0.5) * per_height / grid.dx) + ey * (Real(-0.5) * per_height) +
           ez * (Real(-0.5) * per_height / grid.dz);
  }

  KOKKOS_FORCEINLINE_FUNCTION Real z(int i, int j, int k) const {
    const ConstFieldRef &q = u.z, &fx = flux.x, &fy = flux.y, &fz = flux.z;
    const Real c = q(i, j, k);
    const Real ex = (fx(i + 1, j, k - 1) + fx(i + 1, j, k)) * (c + q(i + 1, j, k)) -
                    (fx(i, j, k - 1) + fx(i, j, k)) * (q(i - 1, j, k) + c);
    const Real ey = (fy(i, j + 1, k - 1) + fy(i, j + 1, k)) * (c + q(i, j + 1, k)) -
                    (fy(i, j, k - 1) + fy(i, j, k)) * (q(i, j - 1, k) + c);
    const Real ez = (fz(i, j, k) + fz(i, j, k + 1)) * (c + q(i, j, k + 1)) -
                    (fz(i, j, k - 1) + fz(i, j, k)) * (q(i, j, k - 1) + c);
    return ex * (Real(-0.25) / grid.dx) + ey * (Real(-0.25) / grid.dy(j)) +
           ez * (Real(-0.25) / grid.dz);
  }
};

/// div(2 (nu + nu_t) S) on faces [m/s^2], S the rate of strain; the full symmetric tensor because
/// nu_t varies. Ghosts of u and nu_t carry the wall: no-slip mirrors u and makes nu_t vanish
/// there, free slip leaves no tangential stress.
struct StressDivergence {
  GridRef grid;
  ConstFaceRef u;      // with ghosts
  ConstFieldRef nu_t;  // [m^2/s], with ghosts
  Real nu;             // [m^2/s]

  /// Components of 2 (nu + nu_t) S [m^2/s^2]: xx, yy, zz at cells, xy at the edge of x-face i and
  /// y-face j, and so on.
  KOKKOS_FORCEINLINE_FUNCTION Real xx(int i, int j, int k) const {
    return (nu + nu_t(i, j, k)) * (2 / grid.dx) * (u.x(i + 1, j, k) - u.x(i, j, k));
  }
  KOKKOS_FORCEINLINE_FUNCTION Real yy(int i, int j, int k) const {
    return (nu + nu_t(i, j, k)) * (2 / grid.dy(j)) * (u.y(i, j + 1, k) - u.y(i, j, k));
  }
  KOKKOS_FORCEINLINE_FUNCTION Real zz(int i, int j, int k) const {
    return (nu + nu_t(i, j, k)) * (2 / grid.dz) * (u.z(i, j, k + 1) - u.z(i, j, k));
  }
  KOKKOS_FORCEINLINE_FUNCTION Real xy(int i, int j, int k) const {
    const Real n = nu + Real(0.25) * (nu_t(i - 1, j - 1, k) + nu_t(i, j - 1, k) +
                                      nu_t(i - 1, j, k) + nu_t(i, j, k));
    return n * ((u.x(i, j, k) - u.x(i, j - 1, k)) * (1 / grid.dy_centre(j)) +
                (u.y(i, j, k) - u.y(i - 1, j, k)) * (1 / grid.dx));
  }
  KOKKOS_FORCEINLINE_FUNCTION Real xz(int i, int j, int k) const {
    const Real n = nu + Real(0.25) * (nu_t(i - 1, j, k - 1) + nu_t(i, j, k - 1) +
                                      nu_t(i - 1, j, k) + nu_t(i, j, k));
    return n * ((u.x(i, j, k) - u.x(i, j, k - 1)) * (1 / grid.dz) +
                (u.z(i, j, k) - u.z(i - 1, j, k)) * (1 / grid.dx));
  }
  KOKKOS_FORCEINLINE_FUNCTION Real yz(int i, int j, int k) const {
    const Real n = nu + Real(0.25) * (nu_t(i, j - 1, k - 1) + nu_t(i, j, k - 1) +
                                      nu_t(i, j - 1, k) + nu_t(i, j, k));
    return n * ((u.y(i, j, k) - u.y(i, j, k - 1)) * (1 / grid.dz) +
                (u.z(i, j, k) - u.z(i, j - 1, k)) * (1 / grid.dy_centre(j)));
  }

  KOKKOS_FORCEINLINE_FUNCTION Real x(int i, int j, int k) const {
    return (xx(i, j, k) - xx(i - 1, j, k)) * (1 / grid.dx) +
           (xy(i, j + 1, k) - xy(i, j, k)) * (1 / grid.dy(j)) +
           (xz(i, j, k + 1) - xz(i, j, k)) * (1 / grid.dz);
  }
  KOKKOS_FORCEINLINE_FUNCTION Real y(int i, int j, int k) const {
    return (xy(i + 1, j, k) - xy(i, j, k)) * (1 / grid.dx) +
           (yy(i, j, k) - yy(i, j - 1, k)) * (1 / grid.dy_centre(j)) +
           (yz(i, j, k + 1) - yz(i, j, k)) * (1 / grid.dz);
  }
  KOKKOS_FORCEINLINE_FUNCTION Real z(int i, int j, int k) const {
    return (xz(i + 1, j, k) - xz(i, j, k)) * (1 / grid.dx) +
           (yz(i, j + 1, k) - yz(i, j, k)) * (1 / grid.dy(j)) +
           (zz(i, j, k) - zz(i, j, k - 1)) * (1 / grid.dz);
  }
};

/// Fluid fraction: one everywhere, so that nobody reads it, or another field.
enum class Fraction { uniform, variable };
KOKKOS_FORCEINLINE_FUNCTION constexpr bool is_variable(Fraction fraction) {
  return fraction == Fraction::variable;
}

/// A cell field on faces; 1 where the fraction is uniform, without a look at the field.
template <Fraction fraction>
struct FractionOnFaces {
  GridRef grid;
  ConstFieldRef alpha;

  KOKKOS_FORCEINLINE_FUNCTION Real x(int i, int j, int k) const {
    if constexpr (is_variable(fraction)) return cell_to_xface(alpha, i, j, k);
    return 1;
  }
  KOKKOS_FORCEINLINE_FUNCTION Real y(int i, int j, int k) const {
    if constexpr (is_variable(fraction)) return cell_to_yface(grid, alpha, i, j, k);
    return 1;
  }
  KOKKOS_FORCEINLINE_FUNCTION Real z(int i, int j, int k) const {
    if constexpr (is_variable(fraction)) return cell_to_zface(alpha, i, j, k);
    return 1;
  }
};

/// share div(2 (nu + nu_t) S) on faces [m/s^2]. The share of the stress that the fluid takes is its
/// fraction (Set II), raw or smoothed.
template <Fraction fraction>
struct SharedStress {
  FractionOnFaces<fraction> share;
  StressDivergence stress;

  KOKKOS_FORCEINLINE_FUNCTION Real x(int i, int j, int k) const {
    return share.x(i, j, k) * stress.x(i, j, k);
  }
  KOKKOS_FORCEINLINE_FUNCTION Real y(int i, int j, int k) const {
    return share.y(i, j, k) * stress.y(i, j, k);
  }
  KOKKOS_FORCEINLINE_FUNCTION Real z(int i, int j, int k) const {
    return share.z(i, j, k) * stress.z(i, j, k);
  }
};

/// N, the sum of the explicit terms of the momentum equation on faces [m/s^2]. A term is a type
/// with x, y and z.
template <class... Terms>
struct ExplicitTerms : Terms... {
  KOKKOS_FORCEINLINE_FUNCTION Real x(int i, int j, int k) const {
    return (this->Terms::x(i, j, k) + ...);
  }
  KOKKOS_FORCEINLINE_FUNCTION Real y(int i, int j, int k) const {
    return (this->Terms::y(i, j, k) + ...);
  }
  KOKKOS_FORCEINLINE_FUNCTION Real z(int i, int j, int k) const {
    return (this->Terms::z(i, j, k) + ...);
  }
};

/// Explicit terms of the volume-averaged momentum equation.
template <Fraction fraction>
using MomentumTerms = ExplicitTerms<Convection, SharedStress<fraction>>;

/// Weights of the explicit terms, now and one step ago, times dt [s].
struct AdamsBashforth {
  Real now = 0, before = 0;
};

/// Explicit predictor: with N the explicit terms,
///   alpha' u* = alpha u + now N + before N_before + impulse / rho,
/// primes are the new time level. Without exchange the impulse is zero. The drive is added later.
template <Fraction fraction, bool with_exchange>
struct Predict {
  GridRef grid;
  MomentumTerms<fraction> terms;
  ConstFaceRef flux;                    // alpha u; u where the fraction is uniform [m/s]
  FractionOnFaces<fraction> alpha_new;  // alpha'
  FaceRef rate;                         // N_before on entry, N on return [m/s^2]
  FaceRef u_star;
  ConstFaceRef impulse;  // given to the fluid per volume [N s/m^3]
  AdamsBashforth weight;
  Real inv_density;  // 1 / rho [m^3/kg]

  KOKKOS_FORCEINLINE_FUNCTION Real advance(const Real n, const Real n_before, const Real momentum,
                                           const Real alpha_here, const Real given) const {
    const Real all = momentum + weight.now * n + weight.before * n_before + given * inv_density;
    if constexpr (is_variable(fraction)) return all / alpha_here;
    return all;
  }
  KOKKOS_FORCEINLINE_FUNCTION static Real at(const ConstFieldRef& f, int i, int j, int k) {
    if constexpr (with_exchange) return f(i, j, k);
    return 0;
  }

  /// Returns alpha' u*_x dy, what this x-face adds to the flow rate [m^2/s].
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    const Real inside = j > 0 ? Real(1) : Real(0);  // y-face 0 is the wall

    const Real alpha_x = alpha_new.x(i, j, k), nx = terms.x(i, j, k);
    const Real ux = advance(nx, rate.x(i, j, k), flux.x(i, j, k), alpha_x, at(impulse.x, i, j, k));
    rate.x(i, j, k) = nx;
    u_star.x(i, j, k) = ux;

    const Real alpha_y = alpha_new.y(i, j, k), ny = terms.y(i, j, k);
    const Real uy = advance(ny, rate.y(i, j, k), flux.y(i, j, k), alpha_y, at(impulse.y, i, j, k));
    rate.y(i, j, k) = inside * ny;
    u_star.y(i, j, k) = inside * uy;

    const Real alpha_z = alpha_new.z(i, j, k), nz = terms.z(i, j, k);
    const Real uz = advance(nz, rate.z(i, j, k), flux.z(i, j, k), alpha_z, at(impulse.z, i, j, k));
    rate.z(i, j, k) = nz;
    u_star.z(i, j, k) = uz;
    return alpha_x * ux * grid.dy(j);
  }
};

/// Sets the flux through the lid to zero, and all of it below the floor, where the stencil of the
/// lowest cells reads it: for all i and k, those of ghosts, too.
struct CloseFaces {
  FaceRef flux;
  FieldRef v_star;
  int ny;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int, int k) const {
    flux.y(i, ny, k) = v_star(i, ny, k) = 0;
    flux.x(i, -1, k) = flux.y(i, -1, k) = flux.z(i, -1, k) = 0;
  }
};

/// flux = alpha u on faces [m/s]; to be called on ghost faces, too.
struct MassFlux {
  GridRef grid;
  ConstFaceRef u;
  ConstFieldRef alpha;
  FaceRef flux;

  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    flux.x(i, j, k) = cell_to_xface(alpha, i, j, k) * u.x(i, j, k);
    flux.y(i, j, k) = cell_to_yface(grid, alpha, i, j, k) * u.y(i, j, k);
    flux.z(i, j, k) = cell_to_zface(alpha, i, j, k) * u.z(i, j, k);
  }
};

}  // namespace barchan
