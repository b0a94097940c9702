// Files of clumps that a case starts from.
#include "src/grains/clumps.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "src/case/resolved.hpp"
#include "src/coupling/state_checks.hpp"
#include "src/initial/initial_state.hpp"
#include "src/restart/checkpoint.hpp"
#include "src/results/output_files.hpp"
#include "tests/support/clumps.hpp"
#include "tests/support/config_problems.hpp"
#include "tests/support/packing.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using namespace test;

/// Orientations are those of the shape that a file holds, so another shape is refused.
TEST(ClumpsOfFiles, GrainsOfAnotherShapeAreRefused) {
  const std::string clump = "shape = \"clump\"\n", sand_lines = clump + "clump = \"sand\"\n";
  const Config sand = case_of(sand_lines);
  InitialGrains grains;
  add_grain(grains, 2e-4, {0.05, 1e-3, 0.02});
  const ClumpBench bench(sand, grains);
  const TemporaryFolder with_case, without;
  const Provenance origin{.config = to_toml(sand)};
  OutputFiles(with_case.path(), origin).write_grains(whole_grains(bench.state), 0, 0);
  OutputFiles(without.path(), {}).write_grains(whole_grains(bench.state), 0, 0);
  CheckpointWriter restart(with_case.path(), 5, origin);
  const auto rows = std::make_pair(0, bench.state.n);
  restart.array("grains/id", Kokkos::subview(bench.state.id, rows));
  restart.array("grains/kin", Kokkos::subview(bench.state.kin, rows));
  restart.array("grains/clump", Kokkos::subview(bench.state.clump, rows));
  std::string same_by_table = clump + "spheres = [";
  for (const auto& [c, r] : spheres_of(sand.grains->shape))
    same_by_table += fmt::format("[{}, {}, {}, {}], ", 3 * c.x, 3 * c.y, 3 * c.z, 3 * r);
  same_by_table += "]\n";
  for (const auto& file : {with_case / "grains.h5", without / "grains.h5", restart.commit(1)}) {
    const auto told = [&](const std::string& lines) {
      Config c = case_of(lines);
      c.initial.pour.reset();
      return message_of([&] { checked_grains(c, file); });
    };
    const std::string must = file.string() + ": it must hold ";
    EXPECT_EQ(told(sand_lines), "");
    EXPECT_EQ(told(same_by_table), "");
    EXPECT_EQ(told(kCube),
              must + "clumps \"cube\", as grains.clump says; it holds clumps \"sand\"");
    EXPECT_EQ(told(clump + "spheres = [[0, 0, 0, 1], [1.5, 0, 0, 1]]\n"),
              must + "clumps of 2 spheres, as grains.spheres says; it holds clumps \"sand\"");
    EXPECT_EQ(told(""), must + "spheres, as grains.shape says; it holds clumps \"sand\"");
  }
}

/// Spheres that touch are those of the case, whatever roundings they have in the file.
TEST(ClumpsOfFiles, SpheresOfAFileAreThoseThatWroteIt) {
  for (const std::string name : {"dimer", "tetrahedron", "cube", "sand"}) {
    Config c = case_of("shape = \"clump\"\nclump = \"" + name + "\"\n");
    c.initial.pour.reset();
    InitialGrains grains;
    add_grain(grains, 2e-4, {0.05, 1e-3, 0.02});
    const ClumpBench bench(c, grains);
    const TemporaryFolder folder;
    OutputFiles(folder.path(), {}).write_grains(whole_grains(bench.state), 0, 0);
    EXPECT_EQ(checked_grains(c, folder / "grains.h5").size(), 1u) << name;
  }
}

/// Kinds are compared by name; a case that another starts from is refused before it runs.
TEST(ClumpsOfFiles, KindsOfAnotherShapeAreRefused) {
  const TemporaryFolder folder;
  const std::string a = "[[grains.kind]]\nname = \"a\"\n", b = "[[grains.kind]]\nname = \"b\"\n",
                    sizes = "sizes = [[0.3e-3, 1]]\n";
  std::ofstream(folder / "heap.toml") << grain_case(a + b + kCube + sizes);
  const auto starts = [&](const std::string& kinds) {
    return lines_of([&] {
      load_case_text(
          "[time]\nend = 1.0\n[domain]\nsize = [0.1, 0.025, 0.04]\n[initial]\n"
          "grains = \"heap.toml\"\n[grains]\n" +
              kinds,
          folder / "case.toml");
    });
  };
  EXPECT_EQ(starts(b + kCube + a), Lines{});
  const Lines lines = starts(b + a + kCube);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_TRUE(contains(lines[0],
                       "must hold clumps \"cube\" of the kind \"a\", as "
                       "grains.kind.2.clump says; it holds spheres"))
      << lines[0];
}

}  // namespace
}  // namespace barchan
