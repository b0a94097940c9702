#include "src/case/kind_checks.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "src/base/words.hpp"
#include "src/grains/kinds.hpp"

namespace barchan {
namespace {

/// Tells if a name has only letters, digits, points, dashes and underscores: a cell of a table, an
/// element of a list.
bool is_plain(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
    return (c < 0x80 && std::isalnum(c) != 0) || c == '_' || c == '-' || c == '.';
  });
}

void check_names(const GrainConfig& grains, Findings& found) {
  std::set<std::string> names;
  for (std::size_t k = 0; k < grains.kinds.size(); ++k) {
    const KindConfig& kind = grains.kinds[k];
    const KeyNames key{fmt::format("grains.kind.{}.name", k + 1)};
    found.error_if(!is_plain(kind.name), key,
                   "must be a word of letters, digits, \".\", \"-\" and \"_\"; \"{}\" is not",
                   kind.name);
    found.error_if(!names.insert(kind.name).second, key,
                   "must be another one for each kind; two are \"{}\"", kind.name);
  }
}

/// Warns of keys without use: those in [grains] that every kind has of its own, and elastic
/// constants beside linear springs.
void check_use(const GrainConfig& grains, Findings& found) {
  const auto all_differ = [&](auto KindConfig::*member, const auto& common) {
    return std::ranges::none_of(grains.kinds,
                                [&](const KindConfig& kind) { return kind.*member == common; });
  };
  found.error_if(!grains.sizes.empty() && all_differ(&KindConfig::sizes, grains.sizes),
                 {"grains.sizes", "grains.kind"},
                 "must be absent: every [[grains.kind]] has its own");
  found.error_if(
      grains.density != GrainConfig{}.density && all_differ(&KindConfig::density, grains.density),
      {"grains.density", "grains.kind"}, "must be absent: every [[grains.kind]] has its own");
  if (!grains.contact_model.is<LinearSpring>()) return;
  for (std::size_t k = 0; k < grains.kinds.size(); ++k) {
    const KindConfig& kind = grains.kinds[k];
    const Material &own = kind.material, &common = grains.material;
    found.error_if(
        own.youngs_modulus != common.youngs_modulus || own.poisson_ratio != common.poisson_ratio,
        {fmt::format("grains.kind.{}", k + 1), "grains.contact_model"},
        "\"{}\" must be without youngs_modulus and poisson_ratio: contact_model = "
        "\"linear\" has one linear_stiffness for all",
        kind.name);
  }
}

void check_pairs(const GrainConfig& grains, Findings& found) {
  const std::vector<std::string> names = names_of_kinds(grains);
  std::set<std::set<std::string>> pairs;
  for (std::size_t p = 0; p < grains.pairs.size(); ++p) {
    const PairConfig& pair = grains.pairs[p];
    const std::string section = fmt::format("grains.pair.{}", p + 1);
    const KeyNames key{section + ".kinds"};
    const auto& [a, b] = pair.kinds;
    bool known = true;
    for (const std::string& name : pair.kinds) {
      if (kind_of_name(grains, name) >= 0) continue;
      known = false;
      found.error_if(true, key, "must be names of [[grains.kind]]; \"{}\" is none{}", name,
                     did_you_mean(nearest(name, names)));
    }
    if (!known) continue;
    found.error_if(a == b, key,
                   "must be two kinds; contacts of \"{}\" with itself are those of its "
                   "[[grains.kind]]",
                   a);
    found.error_if(!pairs.insert({a, b}).second, key,
                   "must be another pair each time; two are \"{}\", \"{}\"", a, b);
    found.error_if(!pair.restitution && !pair.sliding_friction && !pair.rolling_friction,
                   {section, section + ".restitution", section + ".sliding_friction",
                    section + ".rolling_friction"},
                   "of \"{}\", \"{}\" must say restitution, sliding_friction or rolling_friction",
                   a, b);
  }
}

}  // namespace

void check_kinds(const GrainConfig& grains, Findings& found) {
  found.error_if(grains.kinds.empty() && !grains.pairs.empty(), {"grains.pair", "grains.kind"},
                 "must be absent without [[grains.kind]]");
  if (grains.kinds.empty()) return;
  check_names(grains, found);
  check_use(grains, found);
  check_pairs(grains, found);
}

}  // namespace barchan
