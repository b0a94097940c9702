// Computed work of kernels and steps. Bytes: every array a pass needs is streamed once, 8 bytes a
// double, writes without the line they fetch first; values that a kernel reads again come from
// cache. Flops: counted in the source; a division, a root and a comparison that selects are one
// each.
#pragma once

#include <cmath>

#include "kernels/grains/grain.hpp"

namespace barchan {

struct Work {
  double bytes = 0, flops = 0;

  Work operator+(const Work& other) const { return {bytes + other.bytes, flops + other.flops}; }
};
inline Work operator*(double times, const Work& work) {
  return {times * work.bytes, times * work.flops};
}

namespace work {

/// A pass over the cells: doubles read and written, flops, per cell.
inline Work pass(double doubles, double flops) { return {doubles * sizeof(Real), flops}; }

// --- grains, per grain and grain step
// ---------------------------------------------------------------

/// Sum, kicks, drift: kinematics there and back, reference position, steady force, wall bits; with
/// a fluid u_f, its acceleration, three numbers, and the impulse there and back. 105 flops, 60 more
/// with drag.
inline Work integrate(bool in_water) {
  const double alone = 2.0 * sizeof(GrainKinematics) + 2.0 * sizeof(Vec3) + 2;
  const double water = 4.0 * sizeof(Vec3) + 3.0 * sizeof(Real);
  return {alone + (in_water ? water : 0), in_water ? 165.0 : 105.0};
}
/// Pair forces: i, j and the slot of a pair; history (and rolling torque) and touching flag of a
/// contact there and back. 177 flops a contact, 44 more with a rolling spring.
inline Work pair_forces(double pairs, double contacts, bool rolling) {
  const double history = 2.0 * sizeof(Vec3) * (rolling ? 2 : 1) + 2;
  return {pairs * 3 * sizeof(int) + contacts * history, contacts * (rolling ? 221.0 : 177.0)};
}
/// List build: kinematics, twelve vectors and three numbers there and back in the new order, the
/// kinematics once for the windows and once for the search, sort keys and rows, windows and noted
/// partners there and back; of a pair i, j, flag and history written; of a contact partner and
/// history there and back. History of walls left out; flops do not matter.
inline Work list_build(double pairs, double contacts) {
  const double grain = 4.0 * sizeof(GrainKinematics) + 24.0 * sizeof(Vec3) + 6.0 * sizeof(Real) +
                       2 * (8 + 4) + 2.0 * (4 + 8) * sizeof(int);
  const double pair = 2 * sizeof(int) + 1 + sizeof(Vec3);
  return {grain + pairs * pair + contacts * 2 * (sizeof(int) + sizeof(Vec3)), 0};
}
/// Layered gather: kinematics seven times; flow, its change, convection, pressure and stress, and
/// three fractions written and read; the impulse read; six vectors and three numbers written.
/// Fields come from cache: four planes of 3 rows, 5 interpolations, 8 means over 29 points.
inline Work gather() {
  return {7.0 * sizeof(GrainKinematics) + 17.0 * sizeof(Vec3) + 9.0 * sizeof(Real),
          12 * 9 + 5 * 24 + 8 * 29 * 2 + 100};
}
/// Deposit: kinematics, two vectors and a number read; 29 points sorted into about four cells, to
/// each of which five sums are added in cache.
inline Work deposit() {
  return {sizeof(GrainKinematics) + 2.0 * sizeof(Vec3) + sizeof(Real), 29 * 16 + 4 * 5 * 3};
}

// --- flow, per cell and fluid step
// ------------------------------------------------------------------

/// WALE: u, v, w read, nu_t written.
inline Work wale() { return pass(4, 135); }
/// Predictor: u, v, w, nu_t, three old rates read; rates and u* written.
inline Work predict() { return pass(13, 298); }
/// Direct solve: FFT in x (there 2, back 2), in z (2, 2), columns (2 and half a pivot); real
/// transforms take 2.5 n log2 n flops, the columns 10 a cell.
inline Work poisson(int nx, int nz) { return pass(10.5, 5 * (std::log2(nx) + std::log2(nz)) + 10); }
/// Iteration of the conjugate gradients: a direct solve, direction and pressure (5).
inline Work pressure_iteration(int nx, int nz) { return poisson(nx, nz) + pass(5, 6); }

/// Fluid step without grains: WALE, predictor, source (4), solve, correction (13), continuity (3).
inline Work flow_step(int nx, int nz) {
  return wale() + predict() + pass(4, 9) + poisson(nx, nz) + pass(13, 32) + pass(3, 11);
}
/// The fluid's part of a coupled step: besides, the norm of the source (1), the pressure at last
/// (3), the fraction looked at (1) and set (1), iterations after the first. What is done near
/// grains alone, smoothing and the exchange among it, is left out.
inline Work coupled_step(int nx, int nz, double iterations) {
  return flow_step(nx, nz) + pass(6, 6) + (iterations - 1) * pressure_iteration(nx, nz);
}

}  // namespace work

}  // namespace barchan
