// Clumps for tests: their cases, and sums over all of them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "src/grains/clumps.hpp"
#include "tests/support/config_problems.hpp"
#include "tests/support/coupled_run.hpp"
#include "tests/support/grain_bench.hpp"

namespace barchan::test {

/// Three unlike spheres: three unlike moments of inertia, no symmetry.
inline std::vector<ClumpSphere> crooked() {
  return {{{0, 0, 0}, 1}, {{1.2, 0, 0}, 0.8}, {{0.3, 0.9, 0.1}, 0.6}};
}

/// Four spheres in a row.
inline std::vector<ClumpSphere> rod() {
  return {{{0, 0, 0}, 1}, {{2, 0, 0}, 1}, {{4, 0, 0}, 1}, {{6, 0, 0}, 1}};
}

/// A dry case of clumps without gravity in a box of 10 mm.
inline Config clump_config(const std::vector<ClumpSphere>& spheres) {
  Config c = grain_config();
  c.grains->shape = {.shape = GrainShape::clump, .spheres = spheres};
  return c;
}
inline Config clump_config(NamedClump name) {
  Config c = grain_config();
  c.grains->shape = {.shape = GrainShape::clump, .clump = name};
  return c;
}

/// Keys of [grains] for cubes of eight spheres.
inline const std::string kCube = "shape = \"clump\"\nclump = \"cube\"\n";

/// A case with more lines in [grains].
inline Config case_of(const std::string& lines) {
  return load_config_text(grain_case(lines), "case.toml");
}

/// Adds one grain with an orientation.
inline void add_turned(InitialGrains& grains, Real d, const Vec3& x, const Quaternion& q,
                       const Vec3& u = {}, const Vec3& omega = {}) {
  add_grain(grains, d, x, u, omega);
  grains.q.push_back(q);
}

/// A case of clumps with its solver.
struct ClumpBench : GrainBench {
  ClumpBench(const Config& c, const InitialGrains& grains, MPI_Comm ranks = MPI_COMM_SELF)
      : GrainBench(c, as_spheres(grains, *c.grains, 1), ranks) {}

  /// Motion of each clump of this rank in the order of their numbers.
  std::vector<ClumpMotion> clumps() const {
    const GrainState whole = whole_grains(state);
    const auto motion = host_copy(whole.clump);
    const auto id = host_copy(whole.id);
    std::map<std::int64_t, ClumpMotion> by_number;
    for (int c = 0; c < whole.n; ++c) by_number[id(c)] = motion(c);
    std::vector<ClumpMotion> all;
    for (const auto& [number, one] : by_number) all.push_back(one);
    return all;
  }
};

/// A case of clumps in water that is stepped by hand.
struct ClumpRun : CoupledRun {
  ClumpRun(const Config& c, const InitialGrains& grains)
      : CoupledRun(c, as_spheres(grains, *c.grains, 1)) {}
  /// Centre, velocity, spin and size of the first clump.
  GrainKinematics first() const { return host_copy(whole_grains(*state.grains).kin)(0); }
};

/// Sums over all clumps: momentum [N s], angular momentum about the origin [N m s], energy [J].
struct ClumpSums {
  Vec3 momentum, angular;
  Real energy = 0;
};
inline ClumpSums sums_of(const GrainState& s) {
  const ClumpsOfGrains clumps = clumps_of(s);
  ClumpSums sums{};
  Kokkos::parallel_reduce("test: energy", s.members.n, ClumpKineticEnergy{clumps}, sums.energy);
  const auto motion = host_copy(whole_grains(s).clump);
  for (int c = 0; c < s.members.n; ++c) {
    const Vec3 p = motion(c).m * motion(c).u;
    sums.momentum += p;
    sums.angular += motion(c).j + cross(motion(c).x, p);
  }
  return sums;
}

}  // namespace barchan::test
