// One or a few grains through the real solver, watched sub-step by sub-step, and reference tables.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "kernels/grains/contact_law.hpp"
#include "kernels/grains/sphere.hpp"
#include "tests/support/grain_cases.hpp"

namespace barchan::testing {

/// A case with its solver: list, contacts and integrator as in a run.
class GrainBench {
 public:
  GrainBench(const Config& config, const InitialGrains& grains)
      : state(make_grain_state(grains, config.grains->density)), solver_(config, state) {
    solver_.start(state);
  }

  void advance(int n, Real dt) { solver_.advance(state, n, dt); }

  /// All grains in the present order of rows, on the host.
  auto kinematics() const {
    return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, state.kin);
  }
  /// The grain of an id, counted from 1.
  GrainKinematics grain(std::int64_t id) const { return kinematics()(row_of(id)); }
  /// Sum of its contact forces in the last sub-step [N].
  Vec3 contact_force(std::int64_t id) const {
    return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{},
                                               state.contact_force)(row_of(id));
  }
  const GrainSolver& solver() const { return solver_; }

  GrainState state;

 private:
  int row_of(std::int64_t id) const {
    const auto ids = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace{}, state.id);
    for (int g = 0; g < state.n; ++g) {
      if (ids(g) == id) return g;
    }
    throw std::out_of_range("no grain " + std::to_string(id));
  }

  GrainSolver solver_;
};

/// Elastic plane that does not yield: 1/E_eff = (1 - s^2)/E of the grain.
inline constexpr Real kRigid = 1e30;  // [Pa]

/// A box of 100 grain radii whose wall is of the grains' material.
inline Config bench_config(const Material& material, Real density, Real radius) {
  Config config = grain_config();
  config.size = {100 * radius, 100 * radius, 100 * radius};
  config.grains->density = density;
  config.grains->material = config.grains->wall = material;
  config.grains->skin = 0.2 * radius;
  return config;
}

/// Rows of a reference table in tests/reference; '#' lines and the column names are left out.
inline std::vector<std::vector<std::string>> reference_rows(const std::string& name) {
  std::ifstream file(BARCHAN_SOURCE_DIR "/tests/reference/" + name);
  if (!file) throw std::runtime_error("no reference table " + name);
  std::vector<std::vector<std::string>> rows;
  std::string line;
  bool named = false;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#') continue;
    if (named) {
      std::vector<std::string>& cells = rows.emplace_back();
      std::istringstream in(line);
      for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    }
    named = true;
  }
  return rows;
}

inline std::vector<Real> numbers(const std::vector<std::string>& cells, std::size_t from = 0) {
  std::vector<Real> values;
  for (std::size_t c = from; c < cells.size(); ++c) values.push_back(std::stod(cells[c]));
  return values;
}

inline void print_measured(const std::string& claim, Real value, Real reference, Real tolerance) {
  std::printf("[ measured ] %s: %.7g (reference %.7g, tolerance %.2g)\n", claim.c_str(), value,
              reference, tolerance);
}

/// Tolerance relative to the reference; prints what was measured.
inline void expect_relative(const std::string& claim, Real value, Real reference, Real tolerance) {
  print_measured(claim, value, reference, tolerance);
  EXPECT_NEAR(value / reference, 1, tolerance) << claim << ": " << value;
}

inline void expect_absolute(const std::string& claim, Real value, Real reference, Real tolerance) {
  print_measured(claim, value, reference, tolerance);
  EXPECT_NEAR(value, reference, tolerance) << claim;
}

}  // namespace barchan::testing
