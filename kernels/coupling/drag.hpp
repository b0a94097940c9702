// Drag of the fluid on one grain: one small type per law. `DragLaws` at the end lists those that a
// case can choose. Every law returns beta [kg/s] with F_drag = beta (u_f - u_p) on ONE grain, u_f
// the interstitial velocity, force in the sense of model A (no further 1 / alpha_f). All are finite
// at zero slip.
#pragma once

#include <numbers>

#include "kernels/grains/sphere.hpp"
#include "kernels/math/alternatives.hpp"

namespace barchan {

/// The flow a grain sees.
struct LocalFlow {
  Real alpha_f = 1;  // fluid volume fraction [-]
  Real rho_f = 0;    // [kg/m^3]
  Real mu_f = 0;     // [Pa s]
  Real slip = 0;     // |u_f - u_p| [m/s]
  Real d_p = 0;      // grain diameter [m]
};

/// Re = alpha_f d slip / nu of the superficial velocity [-].
KOKKOS_FORCEINLINE_FUNCTION Real reynolds_number(const LocalFlow& f, Real alpha_f, Real d) {
  return alpha_f * f.rho_f * d * f.slip / f.mu_f;
}

/// Stokes (1851): 3 pi mu d.
KOKKOS_FORCEINLINE_FUNCTION Real stokes_coefficient(const LocalFlow& f, Real d) {
  return 3 * std::numbers::pi_v<Real> * f.mu_f * d;
}

/// Schiller & Naumann (1935) at a Reynolds number: C_d = 24/Re (1 + 0.15 Re^0.687); for Re < 1000.
KOKKOS_FORCEINLINE_FUNCTION Real schiller_naumann(const LocalFlow& f, Real reynolds) {
  return stokes_coefficient(f, f.d_p) * (1 + Real(0.15) * Kokkos::pow(reynolds, Real(0.687)));
}

/// Drag of a grain alone.
struct SchillerNaumann {
  KOKKOS_INLINE_FUNCTION Real operator()(const LocalFlow& f) const {
    return schiller_naumann(f, reynolds_number(f, 1, f.d_p));
  }
};

/// Wen & Yu (1966) with Schiller-Naumann; Re = alpha_f d slip / nu.
KOKKOS_FORCEINLINE_FUNCTION Real wen_yu(const LocalFlow& f) {
  return schiller_naumann(f, reynolds_number(f, f.alpha_f, f.d_p)) *
         Kokkos::pow(f.alpha_f, Real(-2.65));
}

/// Ergun (1952).
KOKKOS_FORCEINLINE_FUNCTION Real ergun(const LocalFlow& f) {
  return sphere_volume(f.d_p / 2) * (150 * (1 - f.alpha_f) * f.mu_f / (f.alpha_f * f.d_p * f.d_p) +
                                     Real(1.75) * f.rho_f * f.slip / f.d_p);
}

/// Gidaspow (1994): Wen & Yu (1966) with Schiller-Naumann where alpha_f > 0.8, Ergun (1952) at and
/// below. Re = alpha_f d slip / nu. As CFDEM's GidaspowDrag evaluates it (no cap at Re > 1000);
/// Lima et al. (2022) B2 with its misprints put right. Limit: Schiller-Naumann at alpha_f = 1.
struct Gidaspow {
  static constexpr Named named{"gidaspow",
                               "Gidaspow (1994): Wen & Yu (1966), and Ergun (1952) where dense"};
  KOKKOS_INLINE_FUNCTION Real operator()(const LocalFlow& f) const {
    return f.alpha_f > Real(0.8) ? wen_yu(f) : ergun(f);
  }
};

/// Share of Wen-Yu in a blend with Ergun across alpha_f = 0.8 by Huilin & Gidaspow (2003): beta =
/// (1 - phi) Ergun + phi Wen-Yu, phi = atan(150 * 1.75 (0.2 - (1 - alpha_f)))/pi + 1/2. Limits:
/// half of each at alpha_f = 0.8; within 1 % of either beyond 0.12 from it.
KOKKOS_INLINE_FUNCTION Real wen_yu_share(Real alpha_f) {
  return Kokkos::atan(Real(150 * 1.75) * (alpha_f - Real(0.8))) / std::numbers::pi_v<Real> +
         Real(0.5);
}
struct GidaspowBlended {
  static constexpr Named named{"gidaspow_blended",
                               "Gidaspow's two blended, Huilin & Gidaspow (2003)"};
  KOKKOS_INLINE_FUNCTION Real operator()(const LocalFlow& f) const {
    const Real phi = wen_yu_share(f.alpha_f);
    return (1 - phi) * ergun(f) + phi * wen_yu(f);
  }
};

/// Di Felice (1994) with C_d of Dalla Valle (1948); Re = alpha_f d slip / nu; alpha_f >= 0.3.
struct DiFelice {
  static constexpr Named named{"di_felice", "Di Felice (1994)"};
  KOKKOS_INLINE_FUNCTION Real operator()(const LocalFlow& f) const {
    const Real alpha = f.alpha_f > Real(0.3) ? f.alpha_f : Real(0.3);
    const Real re_per_slip = alpha * f.rho_f * f.d_p / f.mu_f;
    const Real reynolds = re_per_slip * f.slip;
    const Real root = Real(0.63) * Kokkos::sqrt(f.slip) +
                      Real(4.8) / Kokkos::sqrt(re_per_slip);  // sqrt(C_d slip)
    const Real log_re = reynolds > 0 ? Kokkos::log10(reynolds) : Real(-30);
    const Real bend = Real(1.5) - log_re;
    const Real exponent = Real(3.7) - Real(0.65) * Kokkos::exp(-bend * bend / 2);
    return root * root * f.rho_f * std::numbers::pi_v<Real> / 8 * f.d_p * f.d_p *
           Kokkos::pow(alpha, 2 - exponent);
  }
};

/// Koch & Hill (2001); Re = alpha_f d slip / nu; alpha_f >= 0.4.
struct KochHill {
  static constexpr Named named{"koch_hill", "Koch & Hill (2001)"};
  KOKKOS_INLINE_FUNCTION Real operator()(const LocalFlow& f) const {
    const Real alpha = f.alpha_f > Real(0.4) ? f.alpha_f : Real(0.4);
    const Real s = 1 - alpha > Real(1e-12) ? 1 - alpha : Real(1e-12);
    const Real reynolds = reynolds_number(f, alpha, f.d_p);
    const Real f0 = s < Real(0.4) ? (1 + 3 * Kokkos::sqrt(s / 2) +
                                     Real(135.0 / 64) * s * Kokkos::log(s) + Real(16.14) * s) /
                                        (1 + s * (Real(0.681) + s * (Real(-8.48) + s * Real(8.16))))
                                  : 10 * s / (alpha * alpha * alpha);
    const Real f3 = Real(0.0673) + Real(0.212) * s + Real(0.0232) / Kokkos::pow(alpha, Real(5));
    return sphere_volume(f.d_p / 2) * 18 * f.mu_f * alpha * alpha * (f0 + f3 * reynolds / 2) /
           (f.d_p * f.d_p);
  }
};

/// Ratio V_r of Syamlal & O'Brien (1987), Lima et al. (2022) B5 and B6 put right; V_r(1) = 1.
KOKKOS_INLINE_FUNCTION Real terminal_velocity_ratio(Real alpha_f, Real reynolds) {
  const Real a1 = Kokkos::pow(alpha_f, Real(4.14));
  const Real a2 = alpha_f <= Real(0.85) ? Real(0.8) * Kokkos::pow(alpha_f, Real(1.28))
                                        : Kokkos::pow(alpha_f, Real(2.65));
  const Real b = Real(0.06) * reynolds;
  return (a1 - b + Kokkos::sqrt(b * b + 2 * b * (2 * a2 - a1) + a1 * a1)) / 2;
}

/// V_r of a grain and sqrt(C_d slip), C_d of Dalla Valle (1948) at Re / V_r; Re = d slip / nu
/// without alpha_f.
struct TerminalDrag {
  Real v_r, root;
};
KOKKOS_INLINE_FUNCTION TerminalDrag terminal_drag(const LocalFlow& f) {
  const Real re_per_slip = f.rho_f * f.d_p / f.mu_f;
  const Real v_r = terminal_velocity_ratio(f.alpha_f, re_per_slip * f.slip);
  return {v_r, Real(0.63) * Kokkos::sqrt(f.slip) + Real(4.8) * Kokkos::sqrt(v_r / re_per_slip)};
}

/// Syamlal & O'Brien (1987).
struct SyamlalOBrien {
  static constexpr Named named{"syamlal_obrien", "Syamlal & O'Brien (1987)"};
  KOKKOS_INLINE_FUNCTION Real operator()(const LocalFlow& f) const {
    const TerminalDrag d = terminal_drag(f);
    return sphere_volume(f.d_p / 2) * Real(0.75) * d.root * d.root * f.rho_f * f.alpha_f /
           (d.v_r * d.v_r * f.d_p);
  }
};

/// The paper's B2-B6 with the misprints put right: Wen-Yu's form with the C_d of Syamlal-O'Brien.
/// No published program evaluates this mixture; offered for comparison.
struct PaperRepaired {
  static constexpr Named named{"paper_repaired",
                               "Lima et al. (2022), B2 to B6, misprints put right"};
  KOKKOS_INLINE_FUNCTION Real operator()(const LocalFlow& f) const {
    const TerminalDrag d = terminal_drag(f);
    return sphere_volume(f.d_p / 2) * Real(0.75) * d.root * d.root * f.rho_f *
           Kokkos::pow(f.alpha_f, Real(-1.65)) / f.d_p;
  }
};

/// Beetstra, van der Hoef & Kuipers (2007) for mixtures of sizes: F of the mean grain times
/// alpha_f y + s y^2 + 0.064 alpha_f y^3, y = d / d_mean (Sauter mean); Re = alpha_f d_mean slip /
/// nu.
struct Beetstra {
  static constexpr Named named{"beetstra", "Beetstra et al. (2007), for mixtures of sizes"};
  Real d_mean = 0;  // sum n d^3 / sum n d^2 of all grains [m]
  static Beetstra from(Real sauter_diameter) { return {.d_mean = sauter_diameter}; }
  KOKKOS_INLINE_FUNCTION Real operator()(const LocalFlow& f) const {
    const Real a = f.alpha_f, s = 1 - a, y = f.d_p / d_mean;
    const Real reynolds = reynolds_number(f, a, d_mean) + Real(1e-12);
    const Real viscous = 10 * s / (a * a) + a * a * (1 + Real(1.5) * Kokkos::sqrt(s));
    const Real inertial =
        Real(0.413) * reynolds / (24 * a * a) *
        (1 / a + 3 * s * a + Real(8.4) * Kokkos::pow(reynolds, Real(-0.343))) /
        (1 + Kokkos::pow(Real(10), 3 * s) * Kokkos::pow(reynolds, -(1 + 4 * s) / 2));
    const Real mixture = a * y + s * y * y + Real(0.064) * a * y * y * y;
    // F scales the Stokes drag of the mean grain at the superficial slip.
    return stokes_coefficient(f, d_mean) * a * (viscous + inertial) * mixture;
  }
};

/// No drag: for tests and sensitivity runs.
struct NoDrag {
  static constexpr Named named{"none", "no drag"};
  KOKKOS_INLINE_FUNCTION Real operator()(const LocalFlow&) const { return 0; }
};

using DragLaws = Alternatives<Gidaspow, DiFelice, KochHill, SyamlalOBrien, Beetstra, PaperRepaired,
                              GidaspowBlended, NoDrag>;

}  // namespace barchan
