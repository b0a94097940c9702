#include "src/case/no_effect.hpp"

#include <string_view>

#include "src/grains/clumps.hpp"
#include "src/toml/keys.hpp"

namespace barchan {
namespace {

bool has_fluid(const Config& c) { return c.fluid.has_value(); }
bool has_grains(const Config& c) { return c.grains.has_value(); }
bool is_hertzian(const Config& c) {
  return !c.grains || !c.grains->contact_model.is<LinearSpring>();
}

constexpr const char* kWithoutFluid = "must be absent without a [fluid] section";
constexpr const char* kWithoutGrains = "must be absent without a [grains] section";
template <CouplingScheme scheme>
bool is_scheme(const Config& c) {
  return c.coupling.scheme == scheme;
}

/// Tells if grains or flow come from a file or a case, and no grains are poured.
bool is_from_files(const Config& c) {
  const InitialConfig& i = c.initial;
  bool has_flow = c.fluid.has_value();
  StartFlows::each([&]<class Flow>() { has_flow = has_flow && !i.starts_as<Flow>(); });
  return !i.pour && i.heaps.empty() && (has_flow || !i.grains.empty());
}

bool is_unresolved(const Config& c) { return !is_scheme<CouplingScheme::resolved>(c); }
constexpr const char* kWhereResolved = "must be absent with scheme = \"resolved\"";

constexpr const char* kWithSprings =
    "must be absent with contact_model = \"linear\", which has a linear_stiffness";

/// Condition under which a key, or all keys of a section, have an effect.
struct Need {
  std::string_view key, rests_on;
  bool (*met)(const Config&);
  const char* message;
};

// Not listed: keys made void by grains.frozen, a friction of 0 or an initial.grains instead of what
// the case pours, which studies set on top of a complete case.
constexpr Need kNeeds[] = {
    {"coupling", "fluid", has_fluid, kWithoutFluid},
    {"coupling", "grains", has_grains, kWithoutGrains},
    {"coupling.drag", "coupling.forces", [](const Config& c) { return c.coupling.forces.drag; },
     "must be absent without \"drag\" in coupling.forces"},
    {"coupling.drag", "coupling.scheme", is_unresolved, kWhereResolved},
    {"coupling.shape_drag", "grains.shape", [](const Config& c) { return has_clumps(*c.grains); },
     "must be absent unless shape = \"clump\""},
    {"coupling.forces", "coupling.scheme", is_unresolved, kWhereResolved},
    {"coupling.smoothing_length", "coupling.scheme", is_unresolved, kWhereResolved},
    {"coupling.alpha_time_derivative", "coupling.scheme", is_unresolved, kWhereResolved},
    {"coupling.centred", "coupling.scheme", is_scheme<CouplingScheme::centred>,
     "must be absent unless scheme = \"centred\""},
    {"coupling.smoothed", "coupling.scheme", is_scheme<CouplingScheme::smoothed>,
     "must be absent unless scheme = \"smoothed\""},
    {"coupling.cfdem", "coupling.scheme", is_scheme<CouplingScheme::cfdem>,
     "must be absent unless scheme = \"cfdem\""},
    {"solver", "fluid", has_fluid, kWithoutFluid},
    {"time.grain_step", "grains", has_grains, kWithoutGrains},
    {"fluid.wale_constant", "fluid.turbulence",
     [](const Config& c) { return c.fluid->turbulence == Turbulence::wale; },
     "must be absent unless turbulence = \"wale\""},
    {"grains.rolling_theta_m", "grains.rolling_model",
     [](const Config& c) { return c.grains->rolling_model.is<ThetaM>(); },
     "must be absent unless rolling_model = \"theta_m\""},
    {"grains.thinnest_film", "grains.contact_model",
     [](const Config& c) { return c.grains->contact_model.is<HertzLubricated>(); },
     "must be absent unless contact_model = \"hertz_lubricated\""},
    {"grains.youngs_modulus", "grains.contact_model", is_hertzian, kWithSprings},
    {"grains.poisson_ratio", "grains.contact_model", is_hertzian, kWithSprings},
    {"grains.feed.rate", "grains.feed.amount",
     [](const Config& c) { return c.grains->feed->amount == FeedAmount::given; },
     "must be absent with amount = \"as_lost\", as many as leave"},
    {"initial.grains.pour.centre", "initial.grains.pour.shape",
     [](const Config& c) { return c.initial.pour->shape != HeapShape::bed; },
     "must be absent with shape = \"bed\", which covers the floor"},
    {"initial.window", "initial.grains", is_from_files,
     "must be absent where grains are poured, and where neither they nor the flow come from a file "
     "or a case"},
    {"output.fields_interval", "fluid", has_fluid, kWithoutFluid},
    {"output.dune_interval", "grains", has_grains, kWithoutGrains},
    {"output.grains_interval", "grains", has_grains, kWithoutGrains},
    {"output.tracks_interval", "grains", has_grains, kWithoutGrains},
    {"output.grain_forces", "output.grains_interval",
     [](const Config& c) { return c.grains && c.output.grains_interval > 0; },
     "must be absent without grains.h5, which needs [grains] and a grains_interval above 0"},
    {"restart.keep", "restart.interval",
     [](const Config& c) { return c.restart.interval > 0 || c.restart.wall_interval > 0; },
     "must be absent without restart files on the way: both intervals are 0"},
};

}  // namespace

void check_effects(const Config& c, Findings& found) {
  const Config unchanged = [&] {
    Config defaults;
    if (c.fluid) defaults.fluid.emplace();
    if (c.grains) defaults.grains.emplace();
    if (c.grains && c.grains->feed) defaults.grains->feed.emplace();
    if (c.initial.pour) defaults.initial.pour.emplace();
    return defaults;
  }();
  for (const Section& section : sections()) {
    for (const Key& key : section.keys) {
      for (const Need& need : kNeeds) {
        if (need.key != section.name && need.key != key.dotted()) continue;
        const auto text = key.text(c, 0);
        found.error_if(text && text != key.text(unchanged, 0) && !need.met(c),
                       {key.dotted(), std::string(need.rests_on)}, "{}", need.message);
      }
    }
  }
}

std::string_view switched_off_by(const std::string& dotted, const Config& config) {
  for (const Need& need : kNeeds) {
    const bool meant = need.key == dotted || dotted.starts_with(std::string(need.key) + ".");
    if (meant && !need.met(config)) return need.rests_on;
  }
  return {};
}

}  // namespace barchan
