// Geometry of contacts between two grains.
#pragma once

#include "kernels/grains/grain.hpp"

namespace barchan {

/// Effective radius [m] and mass [kg] of a pair.
struct EffectivePair {
  Real r, m;
};
/// R_eff = r_a r_b / (r_a + r_b) (A2) and m_eff = m_a m_b / (m_a + m_b) (A3), by one division for
/// the two. Limits: half of each for equal grains; that of the smaller one beside a huge one.
KOKKOS_FORCEINLINE_FUNCTION constexpr EffectivePair effective_pair(Real r_a, Real r_b, Real m_a,
                                                                   Real m_b) {
  const Real one_over = 1 / ((r_a + r_b) * (m_a + m_b));
  return {.r = r_a * r_b * (m_a + m_b) * one_over, .m = m_a * m_b * (r_a + r_b) * one_over};
}

/// Overlap of two grains over their mean diameter, 1 - |x_a - x_b| / (r_a + r_b) [-]; negative
/// while they do not touch.
KOKKOS_FORCEINLINE_FUNCTION Real relative_overlap(const PeriodicBox& box, const GrainKinematics& a,
                                                  const GrainKinematics& b) {
  return 1 - norm(box.nearest_image(a.x - b.x)) / (a.r + b.r);
}

}  // namespace barchan
