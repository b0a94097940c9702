// Solids at rest in the flow: the bodies of a case, and frozen grains.
#pragma once

#include <vector>

#include "kernels/bodies/body.hpp"

namespace barchan {

/// A frozen grain.
struct FrozenGrain {
  Vec3 x;      // its centre, in the domain [m]
  Real r = 0;  // [m]
};

/// Any number of spheres in a domain that is periodic along x and z, found by cells, on the host.
class FrozenGrains {
 public:
  FrozenGrains() = default;
  /// `reach`: distance from a surface up to which it is found [m].
  FrozenGrains(std::vector<FrozenGrain> grains, Real lx, Real lz, Real reach);

  int count() const { return static_cast<int>(grains_.size()); }
  const FrozenGrain& operator[](int n) const { return grains_[static_cast<std::size_t>(n)]; }
  /// The one whose surface is nearest to x, as Bodies::nearest has it; beyond the reach none, at
  /// that distance.
  Bodies::Nearest nearest(const Vec3& x) const;

 private:
  /// Cells along one axis.
  struct Cells {
    int n = 1;
    Real start = 0, size = 1;  // [m]
    int of(Real at) const { return static_cast<int>(Kokkos::floor((at - start) / size)); }
  };
  void look_in(int i, int j, int k, const Vec3& x, Bodies::Nearest& found) const;
  void look_around(int ring, const int (&cell)[3], const Vec3& x, Bodies::Nearest& found) const;

  std::vector<FrozenGrain> grains_;
  Real lx_ = 1, lz_ = 1, reach_ = 0, r_max_ = 0;
  Cells x_, y_, z_;
  std::vector<int> first_, entry_;  // of each cell in entry_; grains by cell
};

/// Bodies and frozen grains that the flow goes round.
class Solids {
 public:
  explicit Solids(const Bodies& bodies, FrozenGrains grains = {})
      : bodies_(bodies), grains_(std::move(grains)) {}

  int count() const { return bodies_.n + grains_.count(); }
  int grains() const { return grains_.count(); }
  /// Bodies first, grains after them.
  Bodies::Nearest nearest(const Vec3& x) const;
  /// The point that the torque on one is about: the middle of a body's underside, the centre of a
  /// grain [m].
  Vec3 foot(int n) const { return n < bodies_.n ? bodies_.body[n].foot : grains_[n - bodies_.n].x; }

 private:
  Bodies bodies_;
  FrozenGrains grains_;
};

}  // namespace barchan
