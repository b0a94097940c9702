// Small grain configurations that tests share.
#pragma once

#include <random>
#include <vector>

#include "src/case/config.hpp"
#include "src/grains/grain_solver.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan::test {

/// A dry case without gravity in a 10 x 10 x 10 mm box; change what the test needs.
inline Config grain_config() {
  Config c;
  c.title = "test";
  c.size = {0.01, 0.01, 0.01};
  c.grains.emplace();
  c.grains->gravity = {0, 0, 0};
  c.time.fluid_step = 2.5e-4;
  c.time.grain_step = 2.5e-6;
  c.output.grain_forces = true;  // so that the list keeps the force of each pair
  return c;
}

/// Adds one grain; ids count from 1.
inline void add_grain(InitialGrains& grains, Real diameter, const Vec3& x, const Vec3& u = {},
                      const Vec3& omega = {}) {
  grains.add(static_cast<std::int64_t>(grains.size()) + 1, diameter, x, u, omega);
}

/// Numbers in [0, 1), the same on every platform.
class Uniform {
 public:
  explicit Uniform(unsigned seed) : generator_(seed) {}
  double operator()() { return static_cast<double>(generator_() >> 11) * 0x1.0p-53; }

 private:
  std::mt19937_64 generator_;
};

/// n grains of Table II's range anywhere in the box, overlaps allowed.
inline InitialGrains random_grains(int n, const std::array<double, 3>& size, unsigned seed) {
  Uniform uniform(seed);
  InitialGrains grains;
  for (int g = 0; g < n; ++g) {
    const Real d = 1.5e-4 + 1e-4 * uniform();
    const Vec3 x{size[0] * uniform(), size[1] * uniform(), size[2] * uniform()};
    add_grain(grains, d, x, {uniform() - 0.5, uniform() - 0.5, uniform() - 0.5},
              {100 * uniform(), 0, 0});
  }
  return grains;
}

/// Rows of the state by id.
struct GrainRow {
  Vec3 x, u, omega;
};
inline std::vector<GrainRow> rows_by_id(const GrainState& s) {
  const auto kin = host_copy(s.kin);
  const auto id = host_copy(s.id);
  std::vector<GrainRow> rows(static_cast<std::size_t>(s.n_initial) + 1);
  for (int g = 0; g < s.n; ++g) {
    rows[static_cast<std::size_t>(id(g))] = {kin(g).x, kin(g).u, kin(g).omega};
  }
  return rows;
}

/// A constant force on every grain, g m, without fluid [m/s^2].
inline void set_weight(const GrainState& s, const Vec3& g) {
  const auto force = s.fluid.explicit_force;
  const auto kin = s.kin;
  Kokkos::parallel_for(
      "test: weight", s.n, KOKKOS_LAMBDA(int p) { force(p) = kin(p).m * g; });
}

/// Moves every grain by `distance` [m] along its velocity.
inline void drift(const GrainState& s, Real distance) {
  const auto kin = s.kin;
  Kokkos::parallel_for(
      "test: drift", s.n,
      KOKKOS_LAMBDA(int g) { kin(g).x += (distance / norm(kin(g).u)) * kin(g).u; });
}

/// Writes marks in the place of contact histories, which tell whose they are: the pair's ids, seen
/// from the grain of lower id; or counts the touching pairs whose marks are wrong.
inline int handle_marks(const GrainState& s, bool write) {
  const PairList l = s.list;
  const auto id = s.id;
  int wrong = 0;
  Kokkos::parallel_reduce(
      "test: marks", l.n_pairs,
      KOKKOS_LAMBDA(int p, int& errors) {
        const auto a = static_cast<Real>(id(l.i(p))), b = static_cast<Real>(id(l.j(p)));
        const Real sign = a < b ? 1 : -1;
        const Vec3 expected = sign * Vec3{Kokkos::min(a, b), Kokkos::max(a, b), 1};
        if (write) {
          l.xi_t(p) = expected;
          l.rolling(p) = Real(2) * expected;
          l.force(p) = Real(3) * expected;
          l.touching(p) = 1;
        } else if (l.touching(p)) {
          errors += norm(l.xi_t(p) - expected) > 0 || norm(l.rolling(p) - Real(2) * expected) > 0 ||
                    norm(l.force(p) - Real(3) * expected) > 0;
        }
      },
      wrong);
  return wrong;
}

}  // namespace barchan::test
