#include "src/case/immersed_checks.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "kernels/grains/sphere.hpp"
#include "src/grains/grain_kinds.hpp"
#include "src/grains/kinds.hpp"

namespace barchan {

void check_immersed(const Config& c, Findings& found) {
  const GrainConfig& grains = *c.grains;
  const auto refuse = [&](bool has, KeyNames keys, const char* what) {
    keys.insert(keys.begin(), {"coupling.scheme", "grains.frozen"});
    found.error_if(has, keys, "must come with grains.frozen = true where a case has {}: {}", what,
                   "grains that move in a resolved flow do not work with it");
  };
  refuse(!c.bodies.empty(), {"body"}, "bodies");
  refuse(grains.feed.has_value(), {"grains.feed.amount"}, "grains that come in");
  refuse(grains.floor == GrainFloor::glued, {"grains.floor"}, "a glued floor");
  refuse(grains.boundary_x != GrainBoundaryX::periodic, {"grains.boundary_x"},
         "a boundary_x other than \"periodic\"");
  refuse(grains.boundary_z != GrainBoundaryZ::periodic, {"grains.boundary_z"},
         "a boundary_z other than \"periodic\"");
  const std::vector<KindConfig> kinds = all_kinds(grains);
  const auto is_light = [&](const KindConfig& kind) {
    return kind.density < 0.5 * c.fluid->density;
  };
  refuse(std::ranges::any_of(kinds, is_light), {"grains.density", "fluid.density"},
         "grains of less than half the density of the water");
  refuse(c.fluid->first_cell_height > 0, {"fluid.first_cell_height"}, "rows of different heights");
}

double film_step_limit(const Config& c, const std::vector<SizeClass>& sizes) {
  double limit = std::numeric_limits<double>::infinity();
  if (!c.grains->contact_model.is<HertzLubricated>()) return limit;
  GrainsCase the_case = c;
  the_case.grains.pairs.clear();  // their contacts have the same film
  const LawTables laws = laws_of_pairs(the_case.grains, kinds_of(the_case.grains), the_case.film);
  const auto* films = std::get_if<LawTableOfMany<HertzLubricated>>(&laws);
  if (films == nullptr) return limit;
  const std::vector<KindConfig> kinds = all_kinds(*c.grains);
  for (const SizeClass& size : sizes) {
    const double r = size.diameter / 2;
    const double m = kinds[static_cast<std::size_t>(size.kind)].density * sphere_volume(r);
    const ContactStiffness film = films->stiffness[0](r / 2, m / 2, -1e-12 * r);
    limit = std::min(limit, 0.5 * (m / 2) / film.gamma_n);
  }
  return limit;
}

double film_reach(const Config& c) {
  return c.grains->contact_model.is<HertzLubricated>() ? GrainsCase(c).film.reach : 0;
}

namespace {

void check_film_step(const Config& c, const GrainNumbers& n, Findings& found) {
  std::vector<SizeClass> smallest;
  for (std::size_t k = 0; k < n.kinds.size(); ++k)
    smallest.push_back({.diameter = n.kinds[k].d_min, .kind = static_cast<int>(k)});
  const double limit = film_step_limit(c, smallest);
  found.error_if(true_grain_step(c.time) > limit * (1 + 1e-9),
                 {"time.grain_step", "grains.contact_model", "fluid.kinematic_viscosity"},
                 "must be at most {:.3g} s: a thin film stops two grains in twice that time",
                 limit);
}

}  // namespace

void check_immersed_cells(const Config& c, const GrainNumbers& n, Findings& found) {
  const KeyNames keys{"fluid.cells", "domain.size", "grains.sizes"};
  const double widths[] = {c.size[0] / c.fluid->cells[0], c.size[1] / c.fluid->cells[1],
                           c.size[2] / c.fluid->cells[2]};
  const auto [least, most] = std::minmax_element(std::begin(widths), std::end(widths));
  found.error_if(*most > 1.1 * *least, keys,
                 "must make cells as long as they are high and wide, within 10 %, where grains "
                 "move in a resolved flow; they are {:.4g} x {:.4g} x {:.4g} m",
                 widths[0], widths[1], widths[2]);
  found.limit((1 - 1e-9) * *most / n.d_min, 1.0 / 10, 1.0 / 6, keys,
              fmt::format("must give the smallest grain 6 cells a diameter or more where grains "
                          "move in a resolved flow; it has {:.3g}",
                          n.d_min / *most),
              fmt::format("gives the smallest grain {:.3g} cells a diameter; below 10 its drag is "
                          "a few percent too high (docs/theory-resolved.md)",
                          n.d_min / *most));
  check_film_step(c, n, found);
}

}  // namespace barchan
