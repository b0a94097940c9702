// Conjugate gradients for the pressure equation. Inner products are sums over cells weighted with
// their height (dx dz is the same everywhere), in which the operator is self-adjoint.
#pragma once

#include "kernels/fluid/pressure.hpp"
#include "kernels/math/device_scalar.hpp"

namespace barchan {

/// Numbers that one kernel leaves for the next ones. Means are over the height of all columns.
enum GradientNumber : int {
  kNormOfB,  // <b, b>; then <b, 1> and nothing
  kSumOfB,
  kSumOfP = 3,  // <p, 1> near the grains before the relaxation, and after it
  kSumOfRelaxed,
  kRR,         // <r, r>
  kRZ,         // <r, z>
  kCurvature,  // <d, A d>
  kSumOfD,     // <d, 1>
  kRZBefore,   // <r, z> one iteration before
  kMeanOfB,
  kBeta,  // the next d is keep z + beta d
  kKeep,
  kA,        // the next p is p + a d - surplus
  kSurplus,  // of the mean of p
  kEnough,   // <r, r> at which the iterations end
  kGoesOn,   // 1 until then, 0 after: iterations launched ahead change nothing more
  kStep,     // a, or 0 after the end: the next r is r - step A d
  kPending,  // a, with which the next direction advances p; 0 after the end, for AdvancePressure
  kPendingSurplus,  // surplus, likewise
  kDirections,      // directions that were taken
  kGradientNumbers
};
/// Mean of b from its sum.
struct FindMeanOfB {
  Real* number;
  Real height;
  KOKKOS_FUNCTION void operator()(int) const { number[kMeanOfB] = number[kSumOfB] / height; }
};
/// Sets the end of the iterations, before the first one.
struct FindEnd {
  Real* number;
  Real tolerance;  // of the residual over the right-hand side
  KOKKOS_FUNCTION void operator()(int) const {
    const Real norm_of_b = number[kNormOfB] - number[kSumOfB] * number[kMeanOfB];
    number[kEnough] = tolerance * tolerance * norm_of_b;
    number[kGoesOn] = number[kRR] > number[kEnough] ? 1 : 0;
    number[kDirections] = 0;
  }
};
/// Sets the surplus that the relaxation added to the mean of p, and the end of the iterations.
struct FindSurplus {
  Real* number;
  Real height;
  FindEnd end;
  KOKKOS_FUNCTION void operator()(int n) const {
    number[kSurplus] = -(number[kSumOfP] / height) + number[kSumOfRelaxed] / height;
    end(n);
  }
};
/// Decides whether another iteration is needed.
struct FindWhetherDone {
  Real* number;
  KOKKOS_FUNCTION void operator()(int) const {
    number[kDirections] += number[kGoesOn];
    if (!(number[kRR] > number[kEnough])) number[kGoesOn] = 0;
  }
};
/// Before the next direction.
struct FindBeta {
  Real* number;
  KOKKOS_FUNCTION void operator()(int) const {
    const bool goes_on = number[kGoesOn] != 0;
    number[kKeep] = goes_on ? 1 : 0;
    number[kBeta] = goes_on ? number[kRZ] / number[kRZBefore] : 1;
    number[kPending] = goes_on ? number[kA] : 0;
    number[kPendingSurplus] = goes_on ? number[kSurplus] : 0;
  }
};
/// After the direction d and A d.
struct FindStep {
  Real* number;
  Real height;
  bool is_first;  // later NextDirection has taken off what there was
  KOKKOS_FUNCTION void operator()(int) const {
    number[kStep] = 0;
    if (number[kGoesOn] == 0) return;
    number[kA] = number[kStep] = number[kRZ] / number[kCurvature];
    const Real before = is_first ? number[kSurplus] : 0;
    number[kSurplus] = before + number[kA] * (number[kSumOfD] / height);
    number[kRZBefore] = number[kRZ];
  }
};

/// Adds up <b, b> and <b, 1>.
struct NormAndMean {
  GridRef grid;
  ConstFieldRef b;
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(int i, int j, int k) const {
    const Real value = b(i, j, k), weighted = value * grid.dy(j);
    return {value * weighted, weighted, 0};
  }
};
/// b -= E p, after a copy; adds up <b, b> and <b, 1> of before.
struct SubtractObstruction {
  NormAndMean of_b;
  ConstFaceRef c;
  ConstFieldRef p;
  FieldRef b, copy;
  KOKKOS_FORCEINLINE_FUNCTION Vec3 operator()(int i, int j, int k) const {
    const Vec3 sums = of_b(i, j, k);
    const Real before = b(i, j, k);
    copy(i, j, k) = before;
    b(i, j, k) = before - obstruction(of_b.grid, c, p, i, j, k);
    return sums;
  }
};
/// r = b - A p; adds up <r, r>.
struct Residual {
  GridRef grid;
  ConstFaceRef c;
  ConstFieldRef p, b;
  FieldRef r;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    const Real value = b(i, j, k) - pressure_operator(grid, c, p, i, j, k);
    r(i, j, k) = value;
    return value * value * grid.dy(j);
  }
};
/// q = A d; adds up <d, q>.
struct ApplyOperator {
  GridRef grid;
  ConstFaceRef c;
  ConstFieldRef d;
  FieldRef q;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    const Real value = pressure_operator(grid, c, d, i, j, k);
    q(i, j, k) = value;
    return value * d(i, j, k) * grid.dy(j);
  }
};
/// r -= step q; adds up <r, r>.
struct AdvanceResidual {
  GridRef grid;
  ConstFieldRef q;
  FieldRef r;
  DeviceScalar step;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    const Real value = r(i, j, k) - step * q(i, j, k);
    r(i, j, k) = value;
    return value * value * grid.dy(j);
  }
};
/// p += a d - surplus.
struct AdvancePressure {
  ConstFieldRef d;
  FieldRef p;
  DeviceScalar a, surplus;
  KOKKOS_FORCEINLINE_FUNCTION void operator()(int i, int j, int k) const {
    p(i, j, k) += a * d(i, j, k) - surplus;
  }
};
/// Advances p, then sets the next direction, d = keep z + b d; adds up d.
struct NextDirection {
  GridRef grid;
  AdvancePressure advance;
  ConstFieldRef z;
  DeviceScalar keep, b;
  FieldRef d;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    advance(i, j, k);
    const Real value = keep * z(i, j, k) + b * d(i, j, k);
    d(i, j, k) = value;
    return value * grid.dy(j);
  }
};
/// Adds up <a, b>.
struct InnerProduct {
  GridRef grid;
  ConstFieldRef a, b;
  KOKKOS_FORCEINLINE_FUNCTION Real operator()(int i, int j, int k) const {
    return a(i, j, k) * b(i, j, k) * grid.dy(j);
  }
};

}  // namespace barchan
