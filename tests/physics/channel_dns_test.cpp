// Channels without grains against DNS: the paper's Fig. 2 and Table I, about 45 minutes on one
// core; on finer cells, 90 minutes; and at a lower Reynolds number without a model, 50 minutes.
#include "src/case/load.hpp"
#include "src/run/simulation.hpp"
#include "tests/support/coupled_case.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/reference_table.hpp"

namespace barchan {
namespace {

using test::number;

/// Columns of a table as curves over y+.
struct Profiles {
  std::vector<test::ReferenceRow> rows;
  std::string y_plus;

  struct Peak {
    double y_plus, value;
  };
  /// Vertex of the parabola in ln y+ through the largest of scale x column and its neighbours.
  Peak peak(const std::string& column, double scale) const {
    std::size_t top = 1;
    for (std::size_t n = 1; n + 1 < rows.size(); ++n) {
      if (scale * number(rows[n], column) > scale * number(rows[top], column)) top = n;
    }
    const auto y = [&](std::size_t n) { return std::log(number(rows[n], y_plus)); };
    const auto f = [&](std::size_t n) { return scale * number(rows[n], column); };
    if (top < 2) return {std::exp(y(top)), f(top)};
    const double left = (f(top) - f(top - 1)) / (y(top) - y(top - 1));
    const double right = (f(top + 1) - f(top)) / (y(top + 1) - y(top));
    const double curvature = (right - left) / (y(top + 1) - y(top - 1));
    const double slope = left + curvature * (y(top) - y(top - 1));  // at the top
    const double shift = -slope / (2 * curvature);
    return {std::exp(y(top) + shift), f(top) + slope * shift + curvature * shift * shift};
  }
};

/// A case, the DNS beside it, and how near its run must come.
struct Comparison {
  std::string config;    // in configs/validation
  const char* finished;  // environment variable that names a finished run to judge, from the root
  std::string dns;
  double u_star;       // of the DNS at this bulk velocity [m/s]
  double peak, place;  // tolerances
  double u_star_within = 0.02, mean = 0.05, total = 0.02;
};

/// Statistics of a run: one made now, or a finished one.
Profiles statistics(const Comparison& c, const std::filesystem::path& scratch) {
  const std::filesystem::path root(BARCHAN_SOURCE_DIR);
  const char* finished = std::getenv(c.finished);  // NOLINT(concurrency-mt-unsafe): nobody sets it
  if (finished != nullptr && *finished != '\0') {
    return {test::table(root / finished / "statistics.csv"), "y_plus"};
  }
  const Config config = load_config(root / "configs/validation" / c.config);
  report::start(report::Shown::problems);
  Simulation simulation(config, {.folder = scratch, .restart = {}}, {});
  EXPECT_EQ(simulation.run(), Outcome::done);
  report::stop_log();
  return {test::table(scratch / "statistics.csv"), "y_plus"};
}

void compare(const Comparison& c) {
  const TemporaryFolder scratch;
  const Profiles run = statistics(c, scratch.path() / "run");
  const Profiles dns{test::reference_table(c.dns), "yplus"};
  const double depth = 0.025, nu = 1e-6;
  const double u_star = number(run.rows[0], "y_plus") / number(run.rows[0], "y") * nu;
  test::expect_relative("u*", u_star, c.u_star, c.u_star_within);

  double mean = 0, linear = 0;
  for (const auto& row : run.rows) {
    const double y_plus = number(row, "y_plus"), y = number(row, "y") / depth;
    if (y_plus > 5)
      mean = std::max(
          mean,
          std::abs(number(row, "U_plus") / test::linear(dns.rows, dns.y_plus, "U", y_plus) - 1));
    linear = std::max(linear, std::abs(number(row, "total_stress") / (u_star * u_star) - (1 - y)));
  }
  test::expect_below("largest error of U+ in y+ > 5", mean, c.mean);
  test::expect_below("largest error of the total stress", linear, c.total);

  for (const std::string stress : {"uu", "vv", "ww", "uv", "k"}) {
    const double sign = stress == "uv" ? -1 : 1;
    const Profiles::Peak got = run.peak(stress, sign / (u_star * u_star));
    const Profiles::Peak reference = dns.peak(stress, sign);
    test::expect_relative(stress + ", peak", got.value, reference.value, c.peak);
    test::expect_relative(stress + ", y+ of the peak", got.y_plus, reference.y_plus, c.place);
  }
}

TEST(ChannelNightly, MeanFlowAndStressesAreThoseOfTheDns) {
  compare({.config = "channel-mesh-1.toml",
           .finished = "BARCHAN_CHANNEL_RUN",
           .dns = "dns_channel_mkm1999_chan395.csv",
           .u_star = 0.0160,
           .peak = 0.2,
           .place = 0.2,
           .u_star_within = 0.05});
}

/// Cells of 13 wall units along and across, half the paper's.
TEST(ChannelNightly, FineMeshIsTheDnsWithinTenPercent) {
  compare({.config = "channel-fine.toml",
           .finished = "BARCHAN_CHANNEL_FINE_RUN",
           .dns = "dns_channel_mkm1999_chan395.csv",
           .u_star = 0.28 / 17.545,
           .peak = 0.1,
           .place = 0.1});
}

/// Every eddy resolved, no model: only the solver is judged.
TEST(ChannelNightly, ResolvedFlowIsTheDns) {
  compare({.config = "channel-dns-180.toml",
           .finished = "BARCHAN_CHANNEL_DNS_RUN",
           .dns = "dns_channel_mkm1999_chan180.csv",
           .u_star = 0.1117 / 15.679,
           .peak = 0.05,
           .place = 0.1,
           .mean = 0.02});
}

}  // namespace
}  // namespace barchan
