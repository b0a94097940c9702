// Probes: points of a case at which the flow is read.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "src/base/errors.hpp"
#include "src/case/resolved.hpp"
#include "src/diagnostics/probes.hpp"
#include "tests/support/config_problems.hpp"
#include "tests/support/flow_fields.hpp"

namespace barchan {
namespace {

constexpr double kLx = 0.04, kLy = 0.02, kLz = 0.03;

/// A box of stretched rows with a flow of value(axis, x, y, z) on all faces, ghosts included.
struct Flow {
  Config config = test::flow_config({16, 10, 12}, {kLx, kLy, kLz}, 1e-3);
  Grid grid = make_grid(config);
  FluidState fluid = make_fluid_state(grid);

  template <class Velocity>
  explicit Flow(const Velocity& velocity) {
    test::set_faces(fluid.u, grid, velocity);
    const test::HostGrid h(grid);
    test::set_everywhere(fluid.p, grid, [&](int i, int j, int k) {
      return 1 + 20 * h.x(i) - 30 * h.y(j) + 40 * h.z(k);
    });
  }
  ProbeRecord at(double x, double y, double z) {
    config.output.probes = {{.name = "here", .at = {{x, y, z}}}};
    return Probes(config).sample(0, fluid, 0.5)[0];
  }
};

double linear(std::size_t axis, double x, double y, double z) {
  return axis == 0   ? 1 + 2 * x - 3 * y + 4 * z
         : axis == 1 ? 2 - 5 * x + 6 * y - 7 * z
                     : 3 + 8 * x + 9 * y - 2 * z;
}

TEST(Probes, AreExactInALinearFlow) {
  Flow flow(linear);
  const test::HostGrid h(flow.grid);
  // Points within cells, on faces, centres and edges of cells, beside the floor and the top.
  const double xs[] = {0.3 * h.dx, h.x_face(4), h.x(5), 0.01234, kLx - 0.7 * h.dx};
  const double ys[] = {1e-5, h.y_face(1), h.y(3), 0.0087, kLy - 1e-5};
  const double zs[] = {0.6 * h.dz, h.z_face(7), h.z(2), 0.0299};
  for (const double x : xs) {
    for (const double y : ys) {
      for (const double z : zs) {
        const ProbeRecord row = flow.at(x, y, z);
        EXPECT_NEAR(row.u, linear(0, x, y, z), 1e-13);
        EXPECT_NEAR(row.v, linear(1, x, y, z), 1e-13);
        EXPECT_NEAR(row.w, linear(2, x, y, z), 1e-13);
        EXPECT_NEAR(row.p, 1 + 20 * x - 30 * y + 40 * z, 1e-13);
        EXPECT_EQ(row.t, 0.5);
      }
    }
  }
}

TEST(Probes, OfAPoiseuilleFlowErrWithTheSquareOfTheCells) {
  const auto parabola = [](std::size_t axis, double, double y, double) {
    return axis == 0 ? y * (2 * kLy - y) : 0;
  };
  double before = 0;
  for (const int rows : {10, 20, 40}) {
    Flow flow(parabola);
    flow.grid = test::stretched_grid({16, rows, 12}, {kLx, kLy, kLz}, 0);
    flow.fluid = make_fluid_state(flow.grid);
    test::set_faces(flow.fluid.u, flow.grid, parabola);
    const double dy = kLy / rows, y = 5.5 * kLy / 10;  // halfway between two nodes, or on a face
    double worst = 0;
    for (int part = 0; part < 7; ++part) {
      const double here = y + part * dy / 7;
      worst = std::max(worst, std::abs(flow.at(0.01, here, 0.01).u - parabola(0, 0, here, 0)));
    }
    EXPECT_LT(worst, dy * dy / 4 * (1 + 1e-9));  // |u''| dy^2 / 8
    if (before > 0) {
      EXPECT_NEAR(before / worst, 4, 0.7);
    }
    before = worst;
  }
}

TEST(Probes, TheStressAtTheFloorIsThatOfItsSlope) {
  Flow flow([](std::size_t axis, double x, double y, double) {
    return axis == 0 ? 8 * y * (1 + x) : axis == 2 ? -3 * y : 0;
  });
  for (const double height : {0.0, 0.007, kLy}) {
    const ProbeRecord row = flow.at(0.013, height, 0.021);
    EXPECT_NEAR(row.wall_shear_x, 1e-3 * 8 * 1.013, 1e-15) << height;  // rho nu = 1e-3 Pa s
    EXPECT_NEAR(row.wall_shear_z, -1e-3 * 3, 1e-15) << height;
  }
  flow.config.fluid->bottom = WallFlow::free_slip;
  EXPECT_EQ(flow.at(0.013, 0.007, 0.021).wall_shear_x, 0);
}

TEST(Probes, TheFarEndOfAPeriodicSideIsTheNearOne) {
  using std::numbers::pi;
  Flow flow([](std::size_t axis, double x, double y, double z) {
    return axis == 0 ? y * std::cos(2 * pi * x / kLx) + std::sin(2 * pi * z / kLz) : 0;
  });
  for (const double height : {0.002, 0.011}) {
    EXPECT_EQ(flow.at(kLx, height, 0.01).u, flow.at(0, height, 0.01).u);
    EXPECT_EQ(flow.at(0.01, height, kLz).u, flow.at(0.01, height, 0).u);
    EXPECT_NEAR(flow.at(0, height, 0.01).u, height + std::sin(2 * pi / 3), 0.04);
  }
}

TEST(Probes, ALineHasItsEndsAndEqualDistances) {
  const ProbeConfig line{
      .name = "line", .from = {{0.01, 0, 0.01}}, .to = {{0.03, 0.02, 0.01}}, .points = 5};
  const std::vector<Vec3> points = points_of(line);
  ASSERT_EQ(points.size(), 5u);
  for (int n = 0; n < 5; ++n) {
    const Vec3& x = points[static_cast<std::size_t>(n)];
    EXPECT_NEAR(x.x, 0.01 + 0.005 * n, 1e-17);
    EXPECT_NEAR(x.y, 0.005 * n, 1e-17);
    EXPECT_EQ(x.z, 0.01);
  }
  Flow flow(linear);
  flow.config.output.probes = {{.name = "point", .at = {{0.01, 0.01, 0.01}}}, line};
  Probes probes(flow.config);
  const auto rows = probes.sample(1, flow.fluid, 0);
  ASSERT_EQ(rows.size(), 5u);
  for (std::size_t n = 0; n < 5; ++n) {
    EXPECT_EQ(rows[n].probe, 1);
    EXPECT_EQ(rows[n].point, static_cast<std::int64_t>(n));
    EXPECT_EQ(rows[n].x, points[n].x);
  }
}

TEST(Probes, InABodyAreRefused) {
  Flow flow(linear);
  flow.config.bodies = {{.name = "post",
                         .shape = BodyShape::of<shapes::Cylinder>(),
                         .centre = {0.02, 0.015},
                         .radius = 0.004,
                         .height = 0.01}};
  const auto problem = [&](const ProbeConfig& probe) -> std::string {
    flow.config.output.probes = {probe};
    try {
      check_probes(flow.config);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(problem({.name = "beside", .at = {{0.02, 0.005, 0.0195}}}), "");
  EXPECT_EQ(problem({.name = "above", .at = {{0.02, 0.0101, 0.015}}}), "");
  EXPECT_NE(problem({.name = "in", .at = {{0.02, 0.005, 0.0185}}})
                .find("[[output.probe]] \"in\": the point [0.02, 0.005, 0.0185] m is inside the "
                      "body \"post\""),
            std::string::npos);
  const ProbeConfig through{
      .name = "through", .from = {{0, 0.005, 0.015}}, .to = {{0.04, 0.005, 0.015}}, .points = 3};
  EXPECT_NE(problem(through).find("\"through\": the point [0.02, 0.005, 0.015] m"),
            std::string::npos);
}

/// A case with a flow, and a probe of these lines.
std::string with_probe(const std::string& lines) {
  return test::fluid_case("[[output.probe]]\n" + lines);
}

TEST(Probes, BadOnesAreRefusedWithAReason) {
  using test::problems;
  const std::string name = "name = \"a\"\n", at = "at = [0.05, 0.01, 0.02]\n";
  EXPECT_TRUE(problems(with_probe(name + at)).empty());
  const std::string line = "from = [0.01, 0, 0]\nto = [0.02, 0.01, 0]\n";
  EXPECT_TRUE(problems(with_probe(name + line + "points = 2\n")).empty());
  const std::pair<std::string, std::string> wrong[] = {
      {name, "must come with at = [x, y, z], or with from, to and points"},
      {at, "name: required"},
      {name + at + "points = 3\n", "contradicts from, to and points"},
      {name + line, "must be at least 2 on a line"},
      {name + line + "points = 1\n", "must be at least 2 on a line"},
      {name + "from = [0.01, 0, 0]\npoints = 3\n", "must come with to"},
      {name + "points = 3\n", "must come with from and to"},
      {name + "from = [0.01, 0, 0]\nto = [0.01, 0, 0]\npoints = 3\n", "another point than from"},
      {name + "at = [0.05, 0.026, 0.02]\n", "must be inside the domain"},
      {name + "at = [0.05, -0.01, 0.02]\n", "at least 0"},
      {name + at + "interval = 0\n", "above 0"},
      {"name = \"a,b\"\n" + at, "must be one line"},
      {name + at + "[[output.probe]]\n" + name + at, "is the name of an earlier probe"},
  };
  for (const auto& [lines, why] : wrong) {
    const auto found = problems(with_probe(lines));
    ASSERT_EQ(found.size(), 2u) << lines;
    EXPECT_NE(found[0].find(why), std::string::npos) << found[0];
    EXPECT_NE(found[0].find("output.probe"), std::string::npos) << found[0];
  }
  const auto dry = problems(test::grain_case("[[output.probe]]\n" + name + at));
  ASSERT_EQ(dry.size(), 2u);
  EXPECT_NE(dry[0].find("without a [fluid] section"), std::string::npos) << dry[0];
}

TEST(Probes, ARestartKeepsThemAndMayAddSome) {
  const ProbeConfig a{.name = "a", .at = {{0.01, 0.01, 0.01}}}, b{.name = "b", .at = a.at};
  Config written, here;
  written.output.probes = here.output.probes = {a};
  here.output.probes[0].interval = 0.5;
  EXPECT_TRUE(restart_conflicts(here, written).empty());
  here.output.probes.push_back(b);
  EXPECT_TRUE(restart_conflicts(here, written).empty());
  here.output.probes = {b, a};
  ASSERT_EQ(restart_conflicts(here, written).size(), 1u);
  EXPECT_NE(restart_conflicts(here, written)[0].find("written with the probe \"a\" there"),
            std::string::npos);
  here.output.probes = {};
  EXPECT_EQ(restart_conflicts(here, written).size(), 1u);
}

}  // namespace
}  // namespace barchan
