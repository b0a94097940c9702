// Distances to bodies against the table that the Python package is tested against as well.
#include <gtest/gtest.h>

#include <string>

#include "kernels/bodies/body.hpp"
#include "src/bodies/make_bodies.hpp"
#include "src/case/load.hpp"
#include "tests/support/reference_table.hpp"

namespace barchan {
namespace {

TEST(BodyTable, DistancesAreThoseOfThePythonPackage) {
  const auto rows = test::reference_table("body_distances.csv");
  int compared = 0;
  for (const std::string name : {"bodies", "bodies-2"}) {
    const Config config = load_config(test::reference_file(name + ".toml"));
    const Bodies bodies = make_bodies(config.bodies, config.size);
    for (const test::ReferenceRow& row : rows) {
      if (row.at("file") != name) continue;
      const int b = std::stoi(row.at("body"));
      ASSERT_LT(b, bodies.n);
      const Vec3 x{test::number(row, "x"), test::number(row, "y"), test::number(row, "z")};
      // The table has 15 digits of lengths below 0.1 m.
      EXPECT_NEAR(bodies.body[b].distance(x), test::number(row, "distance"), 1e-15)
          << name << ", body " << b << " at " << x.x << ", " << x.y << ", " << x.z;
      ++compared;
    }
  }
  EXPECT_EQ(compared, static_cast<int>(rows.size()));
}

}  // namespace
}  // namespace barchan
