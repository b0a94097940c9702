// Clumps of spheres from the case to the state, its list and its sums.
#include "src/grains/clumps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "kernels/grains/contact_law.hpp"
#include "kernels/grains/sphere.hpp"
#include "src/case/grain_checks.hpp"
#include "src/case/heaps.hpp"
#include "src/case/resolved.hpp"
#include "src/coupling/state_checks.hpp"
#include "src/grains/kinds.hpp"
#include "src/initial/initial_state.hpp"
#include "src/initial/pour.hpp"
#include "src/restart/checkpoint.hpp"
#include "src/results/output_files.hpp"
#include "tests/support/clumps.hpp"
#include "tests/support/config_problems.hpp"
#include "tests/support/packing.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

using namespace test;

TEST(ClumpsOfACase, AreWrittenAsTheyAreRead) {
  const Config c =
      case_of("shape = \"clump\"\nspheres = [[0.0, 0.0, 0.0, 1.0], [1.5, 0.0, 0.25, 0.75]]\n");
  const std::vector<ClumpSphere> two{{{0, 0, 0}, 1}, {{1.5, 0, 0.25}, 0.75}};
  EXPECT_EQ(c.grains->shape.spheres, two);
  EXPECT_TRUE(has_clumps(*c.grains));
  EXPECT_EQ(config_as_written(to_toml(c), "case.toml").grains->shape, c.grains->shape);
  const Config named = case_of(kCube);
  EXPECT_EQ(spheres_of(named.grains->shape).size(), 8u);
  EXPECT_EQ(config_as_written(to_toml(named), "case.toml").grains->shape, named.grains->shape);
  Config other = named;
  other.grains->shape.clump = NamedClump::dimer;
  EXPECT_EQ(restart_conflicts(other, named).size(), 1u);
}

TEST(ClumpsOfACase, EachKindHasItsOwnShape) {
  const Config c = case_of("[[grains.kind]]\nname = \"a\"\n" + kCube +
                           "[[grains.kind]]\nname = \"b\"\nshape = \"clump\"\n"
                           "spheres = [[0, 0, 0, 1], [1, 0, 0, 1]]\n"
                           "[[grains.kind]]\nname = \"c\"\n");
  refused(grain_case(kCube + "[[grains.kind]]\nname = \"a\"\nshape = \"sphere\"\n"),
          "case.toml:10: [grains] shape = \"clump\": must be absent: every [[grains.kind]] has its "
          "own");
  const std::vector<KindConfig> kinds = all_kinds(*c.grains);
  EXPECT_EQ(config_as_written(to_toml(c), "case.toml").grains->kinds, c.grains->kinds);
  EXPECT_EQ(spheres_of(kinds[0].shape).size(), 8u);
  EXPECT_EQ(spheres_of(kinds[1].shape).size(), 2u);
  EXPECT_FALSE(is_clump(kinds[2].shape));
  const ClumpShapes shapes = clump_shapes(*c.grains);
  EXPECT_EQ(shapes.count(0), 8);
  EXPECT_EQ(shapes.count(1), 2);
  EXPECT_EQ(shapes.count(2), 1);
  EXPECT_EQ(shapes.largest_count(), 8);
  EXPECT_EQ(ClumpShapes().largest_count(), 0);
  EXPECT_DOUBLE_EQ(shapes.inertia[2].x, 0.1);  // 2/5 of 1/2 squared
}

TEST(ClumpsOfACase, MistakesAreToldWhereTheyAre) {
  const auto tells = [](const std::string& lines, const std::string& line) {
    SCOPED_TRACE(lines);
    refused(grain_case(lines), "case.toml:" + line);
  };
  tells("shape = \"clum\"\n",
        "10: [grains] shape = \"clum\": must be one of \"sphere\", \"clump\" (did you mean "
        "\"clump\"?)");
  tells("shape = \"clump\"\nclump = \"cbe\"\n",
        "11: [grains] clump = \"cbe\": must be one of \"dimer\", \"tetrahedron\", \"cube\", "
        "\"sand\" (did you mean \"cube\"?)");
  tells("shape = \"clump\"\n",
        "10: [grains] shape = \"clump\": must come with its spheres = [[x, y, z, radius], ...], "
        "or with the name of a clump");
  tells("clump = \"cube\"\n",
        "10: [grains] clump = \"cube\": must be absent unless shape = \"clump\"");
  tells(kCube + "spheres = [[0, 0, 0, 1]]\n",
        "12: [grains] spheres = [[0, 0, 0, 1]]: contradicts clump: give one of the two");
  tells("shape = \"clump\"\nspheres = [[0, 0, 1]]\n",
        "11: [grains] spheres = [[0, 0, 1]]: must be an array of [x, y, z, radius above 0]; [0, "
        "0, 1] is not");
  tells("shape = \"clump\"\nspheres = [[0, 0, 0, 1e10]]\n",
        "11: [grains] spheres = [[0, 0, 0, 10000000000.0]]: must be an array of numbers up to "
        "1e9, radii from 1e-9; [0, 0, 0, 10000000000.0] is not");
  tells("shape = \"clump\"\nspheres = [[0, 0, 0, 1], [3, 0, 0, 1]]\n",
        "11: [grains] spheres = [[0, 0, 0, 1], [3, 0, 0, 1]]: must be a whole: sphere 2 of a "
        "clump touches none that is joined to sphere 1");
  tells("shape = \"clump\"\nspheres = [[0, 0, 0, 0.5], [0.6, 0, 0, 1], [-0.6, 0, 0, 1]]\n",
        "11: [grains] spheres = [[0, 0, 0, 0.5], [0.6, 0, 0, 1], [-0.6, 0, 0, 1]]: must be a "
        "whole: sphere 1 of a clump is wholly inside the others; leave it out");
  const std::string cubes = "[[0.2e-3, 100]]\nshape = \"clump\"\nclump = \"cube\"";
  EXPECT_EQ(problems(coupled_case(cubes)), std::vector<std::string>{});
  EXPECT_EQ(problems(coupled_case(cubes + "\nfrozen = true\n[coupling]\nscheme = \"resolved\""))[0],
            "case.toml:11: [grains] shape = \"clump\": must be \"sphere\" with scheme = "
            "\"resolved\", whose markers lie on spheres");
  EXPECT_EQ(problems(coupled_case("[[0.2e-3, 100]]\n[coupling]\nshape_drag = \"ganser\"")),
            only("case.toml:12: [coupling] shape_drag = \"ganser\": must be absent unless shape = "
                 "\"clump\""));
}

/// What is said of the grains of a case by their sizes, about any of these keys.
std::vector<std::string> said_of_sizes(const Config& c, const std::vector<SizeClass>& sizes,
                                       const std::string& key) {
  std::vector<std::string> said;
  for (const Finding& f : check_grain_sizes(c, sizes))
    if (f.keys.front() == key) said.push_back(f.message);
  return said;
}

/// Rods are 2.52 d long: four diameters of their spheres, of which each is d / 4^(1/3).
TEST(ClumpsOfACase, ThoseWiderThanTheBoxOrHalfAPeriodAreRefused) {
  Config c = clump_config(rod());
  const double wide = 4 / std::cbrt(4.0) * 2e-4;
  EXPECT_NEAR(width_of(c.grains->shape) * 2e-4, wide, 1e-9 * wide);
  const std::vector<SizeClass> sizes{{.diameter = 2e-4, .count = 10}, {1e-4, 10}};
  const auto said = [&] { return said_of_sizes(c, sizes, "domain.size"); };
  const auto one = [](const std::string& message) { return std::vector<std::string>{message}; };
  EXPECT_TRUE(said().empty());
  c.size[1] = 1.001 * wide;
  EXPECT_TRUE(said().empty());
  c.size[1] = 0.999 * wide;
  EXPECT_EQ(said(), one("must be above 0.000504 m, the width of the largest clump"));
  c.size[1] = 0.01;
  const auto periods = [&] {
    return one(
        "must be at least 0.00109 m in a periodic direction: a "
        "clump would meet its own image");
  };
  const double least = 2 * (wide + c.grains->skin);
  c.grains->boundary_z = GrainBoundaryZ::periodic;
  c.size[2] = 1.001 * least;
  EXPECT_TRUE(said().empty());
  c.size[2] = 0.999 * least;
  EXPECT_EQ(said(), periods());
  c.grains->boundary_z = GrainBoundaryZ::wall;
  EXPECT_TRUE(said().empty());
  c.size[0] = 0.999 * least;
  EXPECT_TRUE(said().empty());
  c.grains->boundary_x = GrainBoundaryX::periodic;
  EXPECT_EQ(said(), periods());
  c.grains->shape = {};
  EXPECT_TRUE(said().empty()) << "spheres have room";
}

/// A run stops where a sphere goes kMaxDisplacement of its own radius in a step: a case is refused
/// for its smallest sphere, here after a fall over a diameter.
TEST(ClumpsOfACase, TheSmallestSphereLimitsTheStep) {
  const auto said = [](Real radius, Real of_limit) {
    Config c = clump_config({{{0, 0, 0}, 1}, {{1, 0, 0}, radius}});
    c.grains->gravity = {0, -9.81, 0};
    const Real speed = std::sqrt(2 * 9.81 * 2e-4);
    c.time.grain_step = c.time.fluid_step = of_limit * kMaxDisplacement * 1e-3 * 1e-4 / speed;
    return said_of_sizes(c, {{.diameter = 2e-4, .count = 10}}, "time.grain_step");
  };
  EXPECT_TRUE(said(1e-3, 0.99).empty());
  EXPECT_TRUE(said(2e-3, 1.01).empty());
  ASSERT_EQ(said(1e-3, 1.01).size(), 1u);
  EXPECT_EQ(said(1e-3, 1.01)[0],
            "must be at most 7.98e-07 s, or the smallest sphere of the grains, of radius 1e-07 m, "
            "goes more than half its radius in it at 0.0626 m/s; leave out spheres as small as "
            "this");
}

/// Grains that have not gone through as_spheres() have no motion of clumps, whatever their kind.
TEST(ClumpsOfACase, GrainsThatAreNoSpheresOfClumpsAreRefused) {
  Config c = clump_config(NamedClump::cube);
  InitialGrains grains;
  for (const Real x : {2e-3, 4e-3}) add_grain(grains, 2e-4, {x, 2e-3, 2e-3});
  const auto said = [&] { return message_of([&] { GrainBench(c, grains); }); };
  const std::string why =
      "2 of 2 grains are not spheres of a clump, and the case has clumps: its grains must go "
      "through as_spheres()";
  EXPECT_EQ(said(), why);
  c.grains->kinds.resize(2);
  c.grains->kinds[0].name = "sphere", c.grains->kinds[1].name = "cube";
  std::swap(c.grains->kinds[1].shape, c.grains->shape);
  EXPECT_EQ(said(), why) << "spheres in a case that has clumps, too";
  EXPECT_NO_THROW(ClumpBench(c, grains));
}

/// Beds that are timed for an estimate: no sphere of them lies below the floor by its centre.
TEST(ClumpsOfACase, PackedBedsStandOnTheFloor) {
  const Config c = case_of(
      "shape = \"clump\"\nspheres = [[0, 0, 0, 1], [2, 0, 0, 1], "
      "[4, 0, 0, 1], [6, 0, 0, 1]]\n");
  const InitialGrains spheres = spheres_at_start(packed_grains(poured_heaps(c), c.size), c);
  ASSERT_EQ(spheres.size(), 400u);
  for (std::size_t s = 0; s < spheres.size(); ++s)
    EXPECT_GE(spheres.x[s].y, spheres.diameter[s] / 2 * (1 - 1e-9));
}

/// A clump of one sphere, wherever it stands, is a sphere: the same bits in each step.
TEST(ClumpsOfACase, OneSphereIsASphere) {
  Config c = grain_config();
  c.size = {3e-3, 5e-3, 3e-3};
  const InitialGrains grains = lattice_packing(200, c.size, 0.5);
  GrainBench sphere(c, grains);
  c.grains->shape = {.shape = GrainShape::clump, .spheres = {{{1, 2, 3}, 4}}};
  ClumpBench one(c, grains);
  for (GrainBench* bench : {&sphere, static_cast<GrainBench*>(&one)}) bench->advance(200, 2e-6);
  EXPECT_GT(sphere.solver.contacts(sphere.state).n_contacts, 5);
  const auto a = rows_by_id(sphere.state), b = rows_by_id(one.state);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t g = 0; g < a.size(); ++g) {
    EXPECT_EQ(norm(a[g].x - b[g].x), 0);
    EXPECT_EQ(norm(a[g].u - b[g].u), 0);
    EXPECT_EQ(norm(a[g].omega - b[g].omega), 0);
  }
}

TEST(ClumpsOfACase, SpheresHaveTheVolumeMassAndMotionOfTheirClump) {
  const Config c = clump_config(NamedClump::tetrahedron);
  InitialGrains grains;
  add_grain(grains, 2e-4, {1e-3, 2e-3, 3e-3}, {0.1, 0, 0}, {0, 0, 100});
  grains.add(5, 3e-4, {4e-3, 2e-3, 3e-3});
  const InitialGrains spheres = as_spheres(grains, *c.grains, 1);
  ASSERT_EQ(spheres.size(), 8u);
  // Four spheres that touch in points: each has a quarter of the volume.
  EXPECT_NEAR(spheres.diameter[0], 2e-4 / std::cbrt(4.0), 1e-15);
  Vec3 centre, u;
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(clump_of_id(spheres.id[k]), 1);
    EXPECT_EQ(member_of_id(spheres.id[k]), static_cast<int>(k));
    EXPECT_EQ(clump_of_id(spheres.id[4 + k]), 5);
    centre += 0.25 * spheres.x[k], u += 0.25 * spheres.u[k];
    const Vec3 arm = spheres.x[k] - grains.x[0];
    EXPECT_NEAR(norm(spheres.u[k] - grains.u[0] - cross(grains.omega[0], arm)), 0, 1e-16);
  }
  EXPECT_NEAR(norm(centre - grains.x[0]), 0, 1e-16);
  EXPECT_NEAR(norm(u - grains.u[0]), 0, 1e-15);
  const GrainState state = ClumpBench(c, grains).state;
  EXPECT_EQ(state.n, 8);
  EXPECT_EQ(grain_count(state), 2);
  EXPECT_EQ(state.n_initial, 2);
  EXPECT_EQ(last_id(state), 5);
  const GrainState whole = whole_grains(state);
  const auto kin = host_copy(whole.kin);
  const auto id = host_copy(whole.id);
  const int first = id(0) == 1 ? 0 : 1;
  EXPECT_EQ(id(first), 1);
  EXPECT_EQ(id(1 - first), 5);
  EXPECT_EQ(kin(first).r, 1e-4);
  EXPECT_DOUBLE_EQ(kin(first).m, 2500 * sphere_volume(1e-4));
  EXPECT_EQ(norm(kin(first).x - grains.x[0]), 0);
  EXPECT_NEAR(norm(kin(first).omega - grains.omega[0]), 0, 1e-12);
}

/// Orientations are random ones of all directions, the same for a number wherever it stands.
TEST(ClumpsOfACase, OrientationsComeFromSeedAndNumber) {
  const Config c = clump_config(NamedClump::dimer);
  InitialGrains grains;
  for (int g = 0; g < 4000; ++g) add_grain(grains, 1e-4, {1e-3, 1e-3, 1e-3});
  const auto of = [&](std::uint64_t seed) { return as_spheres(grains, *c.grains, seed).clump; };
  const auto a = of(1), again = of(1), other = of(2);
  std::array<Real, 3> squares{};
  int same = 0;
  for (std::size_t g = 0; g < a.size(); g += 2) {
    EXPECT_EQ(a[g].q.w, again[g].q.w);
    same += a[g].q.w == other[g].q.w ? 1 : 0;
    EXPECT_NEAR(a[g].q.w * a[g].q.w + dot(a[g].q.vec(), a[g].q.vec()), 1, 1e-14);
    const Vec3 axis = rotate(a[g].q, {1, 0, 0});
    squares[0] += axis.x * axis.x, squares[1] += axis.y * axis.y, squares[2] += axis.z * axis.z;
  }
  EXPECT_EQ(same, 0);
  // Mean square of a component: 1/3, with a spread of 0.3 / sqrt(4000).
  for (const Real sum : squares) EXPECT_NEAR(sum / 4000, 1.0 / 3, 4 * 0.3 / std::sqrt(4000.0));
}

/// Pairs are all those of spheres of different clumps that are near each other, once.
TEST(ClumpsOfACase, ListHoldsThePairsOfOtherClumps) {
  Config c = clump_config(NamedClump::cube);
  c.size = {3e-3, 3e-3, 3e-3};
  c.grains->boundary_x = GrainBoundaryX::periodic;
  ClumpBench bench(c, random_grains(300, c.size, 3));
  const GrainState& s = bench.state;
  std::set<std::pair<std::int64_t, std::int64_t>> listed, near;
  const auto i = host_copy(s.list.i), j = host_copy(s.list.j);
  const auto id = host_copy(s.id);
  const auto kin = host_copy(s.kin);
  for (int p = 0; p < s.list.n_pairs; ++p) {
    EXPECT_TRUE(listed.insert(std::minmax({id(i(p)), id(j(p))})).second);
    EXPECT_NE(clump_of_id(id(i(p))), clump_of_id(id(j(p))));
  }
  for (int a = 0; a < s.n; ++a)
    for (int b = 0; b < a; ++b) {
      const Real apart = norm(bench.solver.box().nearest_image(kin(a).x - kin(b).x));
      const Real reach = kin(a).r + kin(b).r + kin(a).skin + kin(b).skin;
      if (apart < reach && clump_of_id(id(a)) != clump_of_id(id(b)))
        near.insert(std::minmax({id(a), id(b)}));
    }
  EXPECT_GT(near.size(), 1000u);
  EXPECT_EQ(listed, near);
}

/// Poured clumps do not reach into each other or the floor, however they are turned.
TEST(ClumpsOfACase, ArePouredByTheSpheresAroundThem) {
  Config c = case_of(kCube);
  const std::vector<HeapConfig> heaps = poured_heaps(c);
  EXPECT_NEAR(poured_spacing(heaps[0].sizes), 1.01 * 2e-4 * width_of(c.grains->shape), 1e-12);
  EXPECT_GT(width_of(c.grains->shape), 1.3);
  const InitialGrains grains = pour_grains(heaps, c.size);
  ASSERT_EQ(grains.size(), 100u);
  const InitialGrains spheres = spheres_at_start(grains, c);
  for (std::size_t a = 0; a < spheres.size(); ++a) {
    EXPECT_GT(spheres.x[a].y, spheres.diameter[a] / 2);
    for (std::size_t b = 0; b < a; ++b) {
      if (clump_of_id(spheres.id[a]) == clump_of_id(spheres.id[b])) continue;
      EXPECT_GT(norm(spheres.x[a] - spheres.x[b]), (spheres.diameter[a] + spheres.diameter[b]) / 2);
    }
  }
}

/// Clumps beyond the outlet leave as a whole, once.
TEST(ClumpsOfACase, LeaveAsAWhole) {
  Config c = clump_config(NamedClump::cube);
  c.size = {3e-3, 3e-3, 3e-3};
  c.grains->boundary_x = GrainBoundaryX::exit;
  InitialGrains grains = random_grains(60, {3e-3, 3e-3, 3e-3}, 3);
  for (std::size_t g = 0; g < grains.size(); ++g) {  // no two of them meet
    grains.x[g] = {4e-4 + 4e-4 * static_cast<double>(g % 6),
                   4e-4 + 4e-4 * static_cast<double>(g / 6 % 5),
                   4e-4 + 8e-4 * static_cast<double>(g / 30)};
    grains.u[g] = {1, 0, 0}, grains.omega[g] = {};
  }
  ClumpBench bench(c, grains);
  bench.advance(110, 1e-5);  // 1.1 mm
  bench.solver.remove_left(bench.state);
  EXPECT_EQ(grain_count(bench.state), 40);  // those from 2 mm on, two of six
  EXPECT_EQ(bench.state.n, 8 * 40);
  EXPECT_EQ(bench.state.n_left, 20);
}

/// Spheres of all clumps follow from grains.h5, as docs/files.md says.
TEST(ClumpsOfACase, TheirSpheresFollowFromTheFile) {
  const Config c = case_of("[[grains.kind]]\nname = \"a\"\n[[grains.kind]]\nname = \"b\"\n" +
                           kCube + "sizes = [[0.3e-3, 1]]\n");
  InitialGrains grains;
  grains.kind_names = {"a", "b"};
  for (const int kind : {0, 1}) {
    add_grain(grains, 2e-4 + 1e-4 * kind, {1e-3 + 2e-3 * kind, 2e-3, 3e-3});
    grains.kind.push_back(static_cast<std::uint8_t>(kind));
  }
  const ClumpBench bench(c, grains);
  const TemporaryFolder folder;
  OutputFiles output(folder.path(), {});
  output.write_grains(whole_grains(bench.state), 0, 0);
  output.write_tracks(whole_grains(bench.state), 0, 0);
  const Hdf5File tracks(folder / "tracks.h5", Hdf5File::Mode::read);
  EXPECT_EQ(tracks.info("frame_000000/orientation").extents, (Extents{2, 4}));
  const Hdf5File file(folder / "grains.h5", Hdf5File::Mode::read);
  const auto kinds = file.read<std::int32_t>("spheres/kind");
  const auto centres = file.read<double>("spheres/centre"),
             radii = file.read<double>("spheres/radius");
  EXPECT_EQ(kinds, (std::vector<std::int32_t>{0, 1, 1, 1, 1, 1, 1, 1, 1}));
  ASSERT_EQ(centres.size(), 27u);
  EXPECT_EQ(radii[0], 0.5);
  const auto x = file.read<double>("frame_000000/x"), d = file.read<double>("frame_000000/d");
  const auto q = file.read<double>("frame_000000/orientation");
  const auto kind = file.read<std::int32_t>("frame_000000/kind");
  const auto id = file.read<std::int64_t>("frame_000000/id");
  const auto entries = host_copy(bench.state.kin);
  const auto numbers = host_copy(bench.state.id);
  ASSERT_EQ(bench.state.n, 9);
  for (int e = 0; e < bench.state.n; ++e) {
    const std::size_t g = id[0] == clump_of_id(numbers(e)) ? 0 : 1;
    const auto s = static_cast<std::size_t>(kind[g] + member_of_id(numbers(e)));
    const Quaternion turn{q[4 * g], q[4 * g + 1], q[4 * g + 2], q[4 * g + 3]};
    const Vec3 centre{centres[3 * s], centres[3 * s + 1], centres[3 * s + 2]};
    const Vec3 place = Vec3{x[3 * g], x[3 * g + 1], x[3 * g + 2]} + d[g] * rotate(turn, centre);
    EXPECT_NEAR(norm(place - entries(e).x), 0, 1e-16);
    EXPECT_NEAR(entries(e).r, d[g] * radii[s], 1e-18);
    EXPECT_EQ(kinds[s], kind[g]);
  }
}

}  // namespace
}  // namespace barchan
