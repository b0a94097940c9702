// Bench for one or a few grains in the real solver, watched grain step by grain step, with
// reference tables.
#pragma once

#include "kernels/grains/contact_law.hpp"
#include "kernels/grains/grain.hpp"
#include "tests/support/grain_cases.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/reference_table.hpp"

namespace barchan::test {

/// A case with its solver: list, contacts and integrator as in a run.
struct GrainBench {
  GrainBench(const Config& config, const InitialGrains& grains, MPI_Comm ranks = MPI_COMM_SELF)
      : state(make_grain_state(grains, densities_of(*config.grains), ranks)),
        solver(config, state) {
    solver.start(state);
  }

  void advance(int n, Real dt) { solver.advance(state, n, dt); }

  /// All grains in the present order of rows, on the host.
  auto kinematics() const { return host_copy(state.kin); }
  /// The grain of an id, counted from 1.
  GrainKinematics grain(std::int64_t id) const { return kinematics()(row_of(id)); }
  /// Sum of its contact forces in the last grain step [N].
  Vec3 contact_force(std::int64_t id) const { return host_copy(state.contact_force)(row_of(id)); }
  /// Sum of their torques [N m].
  Vec3 contact_torque(std::int64_t id) const { return host_copy(state.contact_torque)(row_of(id)); }

  GrainState state;
  GrainSolver solver;

 private:
  int row_of(std::int64_t id) const {
    const auto ids = host_copy(state.id);
    for (int g = 0; g < state.n; ++g) {
      if (ids(g) == id) return g;
    }
    throw std::out_of_range("no grain " + std::to_string(id));
  }
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

/// Rows of a reference table as cells, without the column names.
inline std::vector<std::vector<std::string>> reference_rows(const std::string& name) {
  auto lines = test::table_lines(test::reference_file(name));
  lines.erase(lines.begin());
  return lines;
}

inline std::vector<Real> numbers(const std::vector<std::string>& cells, std::size_t from = 0) {
  std::vector<Real> values;
  for (std::size_t c = from; c < cells.size(); ++c) values.push_back(std::stod(cells[c]));
  return values;
}

}  // namespace barchan::test
