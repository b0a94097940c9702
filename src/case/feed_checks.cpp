#include "src/case/feed_checks.hpp"

#include "src/case/derived.hpp"

namespace barchan {

void check_following(const Config& c, Findings& found) {
  if (c.grains->boundary_x != GrainBoundaryX::follow) return;
  const KeyNames keys{"grains.boundary_x", "fluid", "output.dune_interval", "fluid.cells"};
  if (found.error_if(!c.fluid, keys, "must not be \"follow\" without a [fluid] section")) return;
  found.error_if(c.output.dune_interval == 0, keys,
                 "must come with an output.dune_interval above 0: with dune.csv the window moves");
  found.error_if(c.fluid->cells[0] < 8, keys,
                 "must come with 8 fluid.cells along x or more: grains leave within two of them");
  found.error_if(c.grains->frozen, keys, "must not be \"follow\" with frozen grains");
}

void check_feed(const Config& c, Findings& found) {
  if (!c.grains->feed) return;
  const FeedConfig& feed = *c.grains->feed;
  found.error_if(feed.amount == FeedAmount::given && feed.rate == 0,
                 {"grains.feed.rate", "grains.feed.amount"},
                 "must be above 0 with amount = \"given\"");
  found.error_if(feed.amount == FeedAmount::as_lost && !grains_leave(*c.grains),
                 {"grains.feed.amount", "grains.boundary_x"},
                 "must be \"given\" where no grain leaves: boundary_x is neither \"exit\" nor "
                 "\"follow\"");
  found.error_if(c.grains->frozen, {"grains.feed.amount", "grains.frozen"},
                 "contradicts frozen: grains could not move on");
  found.error_if(feed.x >= c.size[0], {"grains.feed.x", "domain.size"},
                 "must lie within the domain, below {:.4g} m", c.size[0]);
  const double strip = half_edge_strip(c);
  found.error_if(feed.x < strip, {"grains.feed.x", "grains.boundary_x", "fluid.cells"},
                 "must be at least a cell, {:.4g} m, with boundary_x = \"follow\": nearer to where "
                 "the ends of the window meet grains leave",
                 strip);
  found.error_if(strip > 0 && feed.x > c.size[0] / 2, {"grains.feed.x", "domain.size"},
                 "must be at most half the domain, {:.4g} m, with boundary_x = \"follow\": there "
                 "the dune is",
                 c.size[0] / 2);
  const auto [from, to] = feed.across;
  found.error_if(from > to || to > c.size[2] || (from == to && to > 0),
                 {"grains.feed.across", "domain.size"},
                 "must be [from, to] with from below to, within the width of {:.4g} m", c.size[2]);
  found.error_if(feed.height >= c.size[1], {"grains.feed.height", "domain.size"},
                 "must be below the height of the domain, {:.4g} m", c.size[1]);
  found.warning_if(feed.start >= c.time.end, {"grains.feed.start", "time.end"},
                   "is after the end of the run: no grain comes in");
}

void check_fed_sizes(const Config& c, double width, Findings& found) {
  if (!c.grains->feed) return;
  const FeedConfig& feed = *c.grains->feed;
  found.error_if(feed.height + width > c.size[1],
                 {"grains.feed.height", "grains.sizes", "domain.size"},
                 "must leave room for the largest grain, {:.4g} m, below the top", width);
  found.error_if(c.grains->boundary_x != GrainBoundaryX::follow && feed.x + width > c.size[0],
                 {"grains.feed.x", "grains.sizes", "domain.size"},
                 "must leave room for the largest grain, {:.4g} m, before the outlet", width);
}

}  // namespace barchan
