// One or a few grains through the real solver, watched sub-step by sub-step, and reference tables.
#pragma once

#include "kernels/grains/contact_law.hpp"
#include "kernels/grains/grain.hpp"
#include "tests/support/grain_cases.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/reference_table.hpp"

namespace barchan::testing {

/// Grains that are looked at one by one, by their ids, counted from 1.
struct GrainBench : GrainSystem {
  using GrainSystem::GrainSystem;

  GrainKinematics grain(std::int64_t id) const { return host_copy(state.kin)(row_of(id)); }
  /// Sum of its contact forces in the last sub-step [N].
  Vec3 contact_force(std::int64_t id) const { return host_copy(state.contact_force)(row_of(id)); }

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

}  // namespace barchan::testing
