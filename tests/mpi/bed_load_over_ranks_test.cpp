// Table of the bed load on any number of ranks and across a restart.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "src/base/atomic_file.hpp"
#include "src/run/simulation.hpp"
#include "tests/support/coupled_case.hpp"
#include "tests/support/shared_folder.hpp"
#include "tests/support/shared_grains.hpp"
#include "tests/support/shared_grid.hpp"
#include "tests/support/whole_run.hpp"

namespace barchan {
namespace {

/// Runs to the end of `config`; returns the last restart file.
std::filesystem::path run(const Config& config, const std::filesystem::path& folder,
                          const std::optional<std::filesystem::path>& restart = {}) {
  const auto last = test::run_to_end(config, folder, restart);
  MPI_Barrier(MPI_COMM_WORLD);
  return last;
}

TEST(BedLoadOverRanks, ARestartKeepsTheBits) {
  const test::SharedFolder folder;
  Config whole = test::coupled_config();
  whole.time.end /= 2;
  whole.grains->boundary_x = GrainBoundaryX::periodic;
  whole.statistics.emplace();
  whole.statistics->interval = 3 * whole.time.fluid_step;
  whole.statistics->bed_load = true;
  Config half = whole;
  half.time.end = whole.time.end / 2;
  run(whole, folder.path() / "whole");
  const auto middle = run(half, folder.path() / "parts");
  run(whole, folder.path() / "parts", middle);
  const std::string text = read_text(folder.path() / "whole/bedload.csv");
  EXPECT_EQ(text, read_text(folder.path() / "parts/bedload.csv"));
  std::istringstream lines(text);
  int n = 0;
  for (std::string line; std::getline(lines, line);) ++n;
  EXPECT_EQ(n, 1 + 120) << "6 mm in layers of a quarter of 0.2 mm, and the header";
}

TEST(BedLoadOverRanks, HasTheNumbersOfOneRank) {
  const std::array<double, 3> size{0.04, 0.02, 0.03};
  const test::SharedGrid grids({16, 6, 12}, size, 1e-3);
  FluidState whole = make_fluid_state(grids.whole), mine = make_fluid_state(grids.mine);
  for (const auto& [fluid, grid] : {std::pair(&whole, &grids.whole), std::pair(&mine, &grids.mine)})
    test::set_everywhere(fluid->u.x, *grid, [g = grid](int i, int j, int k) {
      return std::sin(0.7 * (i + g->i_begin)) + std::cos(0.5 * (k + g->k_begin)) + j;
    });
  InitialGrains table;  // in one half of the box
  for (int g = 0; g < 500; ++g)
    table.add(g + 1, 1e-3, {0.02 * std::fmod(0.618 * g, 1.0), 5e-4 + 1e-5 * g, 0.015},
              {1e-4 * g, 0, 0});
  BedLoad on_one({.fluid_density = 1000, .viscosity = 1e-3, .gravity = {0, -9.8, 0}}, grids.whole);
  BedLoad on_all({.fluid_density = 1000, .viscosity = 1e-3, .gravity = {0, -9.8, 0}}, grids.mine);
  const GrainState all = make_grain_state(table, Real(2500));
  const GrainState share = make_grain_state(table, Real(2500), MPI_COMM_WORLD);
  for (const double t : {0.5, 1.0}) {
    on_one.sample(whole, all, t);
    on_all.sample(mine, share, t);
  }
  const auto a = on_one.table(), b = on_all.table();
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.size(), 80u);
  EXPECT_GT(a[0].load, 0);
  EXPECT_NE(a[0].total_stress, 0);
  for (std::size_t k = 0; k < a.size(); ++k) {  // sums in another order
    for (const auto& column : kBedLoadColumns) {
      if (const auto* real = std::get_if<double BedLoadRecord::*>(&column.member)) {
        const double one = a[k].*(*real), other = b[k].*(*real);
        EXPECT_NEAR(one, other, 1e-10 * std::abs(one) + 1e-13) << column.name << " " << k;
      }
    }
  }
}

}  // namespace
}  // namespace barchan
