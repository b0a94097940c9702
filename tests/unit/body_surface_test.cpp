// The surfaces that are written for programs that draw: on the bodies, by their distances.
#include "src/bodies/body_surface.hpp"

#include <gtest/gtest.h>

#include "src/bodies/make_bodies.hpp"
#include "src/case/load.hpp"
#include "tests/support/reference_table.hpp"

namespace barchan {
namespace {

TEST(BodySurface, BeginsAndEndsWhereTheDistanceIsZeroOrOnTheFloor) {
  for (const std::string file : {"bodies.toml", "bodies-2.toml"}) {
    const Config config = load_config(test::reference_file(file));
    const Bodies bodies = make_bodies(config.bodies, config.size);
    for (std::size_t b = 0; b < config.bodies.size(); ++b) {
      SCOPED_TRACE(config.bodies[b].name);
      const Body& body = bodies.body[b];
      const BodySurface found = body_surface(config.bodies[b], config.size);
      ASSERT_EQ(found.top.size(), found.lines * found.points);
      for (std::size_t c = 0; c < found.copies.size(); c += 2) {
        for (std::size_t n = 0; n < found.top.size(); ++n) {
          const double x = found.x[n] + found.copies[c], z = found.z[n] + found.copies[c + 1];
          const double low = found.bottom[n], high = found.top[n];
          ASSERT_NEAR(body.distance({x, high, z}), 0, 1e-11);
          ASSERT_NEAR(low > 1e-15 ? body.distance({x, low, z}) : 0, 0, 1e-11);
          ASSERT_LE(low, high);
          if (high - low < 1e-6) continue;
          ASSERT_LT(body.distance({x, (low + high) / 2, z}), 0);
        }
      }
    }
  }
}

TEST(BodySurface, NothingIsSolidBeyondItsOutline) {
  for (const std::string file : {"bodies.toml", "bodies-2.toml"}) {
    const Config config = load_config(test::reference_file(file));
    const Bodies bodies = make_bodies(config.bodies, config.size);
    for (std::size_t b = 0; b < config.bodies.size(); ++b) {
      const BodySurface found = body_surface(config.bodies[b], config.size);
      if (found.points == 2) continue;  // goes through the whole domain
      const auto place = [&](std::size_t n, double share) {
        const double x = found.x[0] + share * (found.x[n] - found.x[0]);
        return std::array{x + found.copies[0],
                          found.z[0] + share * (found.z[n] - found.z[0]) + found.copies[1]};
      };
      int looked_at = 0;
      for (std::size_t line = 0; line < found.lines; ++line) {
        const auto [x, z] = place((line + 1) * found.points - 1, 1 + 1e-5);
        if (z < 0 || z > config.size[2]) continue;
        ++looked_at;
        for (int n = 1; n <= 100; ++n)
          ASSERT_GT(bodies.body[b].distance({x, config.size[1] * n / 100, z}), 0)
              << config.bodies[b].name << " at " << x << ", " << z;
      }
      EXPECT_GT(looked_at, 150);
    }
  }
}

}  // namespace
}  // namespace barchan
