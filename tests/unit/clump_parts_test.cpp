// Parts of a clump in the flow, of unequal shares, against sums by hand.
#include "kernels/coupling/clump_parts.hpp"

#include <gtest/gtest.h>

#include "src/grains/grain_arrays.hpp"
#include "tests/support/clumps.hpp"

namespace barchan {
namespace {

using namespace test;

/// A clump of two spheres, apart, with 0.7 and 0.3 of its volume; the flow gives each its own.
struct TwoParts {
  static constexpr Real kShares[] = {0.7, 0.3};

  TwoParts() : bench(config(), one()) {
    GrainState& s = bench.state;
    add_fluid(s);
    add_exchange(s, {.torque = true});
    add_parts(s);
    Kokkos::parallel_for(1, PartsOfClumps{clumps_of(s), s.kin, s.kin, s.fluid.part});
    for (int k = 0; k < 2; ++k) entry.push_back(clumps_of(s).entry(0, k));
  }
  static Config config() {
    const Real r = std::cbrt(Real(3) / 7);
    return clump_config({{{0, 0, 0}, 1}, {{1 + r, 0, 0}, r}});
  }
  static InitialGrains one() {
    InitialGrains grains;
    add_grain(grains, 2e-4, {5e-3, 5e-3, 5e-3});
    return grains;
  }
  /// Sets the values of both parts.
  template <class View, class Value>
  void set(const View& view, Value first, Value second) {
    const auto host = host_copy(view);
    host(entry[0]) = first, host(entry[1]) = second;
    Kokkos::deep_copy(view, host);
  }
  template <class View>
  auto at(const View& view, int part) {
    return host_copy(view)(entry[static_cast<std::size_t>(part)]);
  }

  ClumpBench bench;
  std::vector<int> entry;
};

TEST(ClumpParts, HaveTheirSharesOfVolumeAndMass) {
  TwoParts two;
  const Real mass = two.bench.clumps()[0].m;
  for (int k = 0; k < 2; ++k) {
    const GrainKinematics part = two.at(two.bench.state.kin, k);
    EXPECT_NEAR(two.at(two.bench.state.fluid.part, k).share, TwoParts::kShares[k], 1e-12);
    EXPECT_NEAR(part.m / mass, TwoParts::kShares[k], 1e-12);
    EXPECT_NEAR(std::pow(part.r / 1e-4, 3), TwoParts::kShares[k], 1e-12);
  }
}

TEST(ClumpParts, JoinBySumsAndByShares) {
  TwoParts two;
  const FluidOnGrains& f = two.bench.state.fluid;
  two.set(f.explicit_force, Vec3{1, 2, 3}, Vec3{10, 20, 30});
  two.set(f.u_f, Vec3{1, 0, 2}, Vec3{11, 10, 0});
  two.set(f.acceleration, Vec3{0, 1, 0}, Vec3{10, 0, 20});
  two.set(f.omega_f, Vec3{2, 0, 0}, Vec3{0, 10, 4});
  two.set(f.inv_fluid_mass, Real(100), Real(1000));
  two.set(f.beta, Real(3), Real(4));
  two.set(f.added_mass, Real(5), Real(7));
  two.set(f.beta_r, Real(6), Real(9));
  Kokkos::parallel_for(1, JoinParts{clumps_of(two.bench.state), f});
  EXPECT_LT(norm(two.at(f.explicit_force, 0) - Vec3{11, 22, 33}), 1e-12);
  EXPECT_LT(norm(two.at(f.u_f, 0) - Vec3{4, 3, 1.4}), 1e-12);
  EXPECT_LT(norm(two.at(f.acceleration, 0) - Vec3{3, 0.7, 6}), 1e-12);
  EXPECT_LT(norm(two.at(f.omega_f, 0) - Vec3{1.4, 3, 1.2}), 1e-12);
  EXPECT_NEAR(two.at(f.inv_fluid_mass, 0), 0.49 * 100 + 0.09 * 1000, 1e-10);
  EXPECT_NEAR(two.at(f.beta, 0), 7, 1e-12);
  EXPECT_NEAR(two.at(f.added_mass, 0), 12, 1e-12);
  EXPECT_NEAR(two.at(f.beta_r, 0), 15, 1e-12);
  for (const auto& view : {f.explicit_force, f.u_f, f.acceleration, f.omega_f})
    EXPECT_EQ(norm(two.at(view, 1)), 0);
  for (const auto& view : {f.inv_fluid_mass, f.beta, f.added_mass, f.beta_r})
    EXPECT_EQ(two.at(view, 1), 0);
}

TEST(ClumpParts, SplitByShares) {
  TwoParts two;
  const FluidOnGrains& f = two.bench.state.fluid;
  two.set(f.impulse, Vec3{10, 20, 30}, Vec3{});
  two.set(f.beta, Real(4), Real(0));
  two.set(f.inv_fluid_mass, Real(21), Real(0));
  Kokkos::parallel_for(1, SplitOverParts{clumps_of(two.bench.state), f});
  EXPECT_LT(norm(two.at(f.impulse, 0) - Vec3{7, 14, 21}), 1e-12);
  EXPECT_LT(norm(two.at(f.impulse, 1) - Vec3{3, 6, 9}), 1e-12);
  EXPECT_NEAR(two.at(f.beta, 0), 2.8, 1e-12);
  EXPECT_NEAR(two.at(f.beta, 1), 1.2, 1e-12);
  EXPECT_NEAR(two.at(f.inv_fluid_mass, 0), 30, 1e-12);
  EXPECT_NEAR(two.at(f.inv_fluid_mass, 1), 70, 1e-12);
}

}  // namespace
}  // namespace barchan
