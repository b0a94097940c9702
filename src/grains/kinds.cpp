#include "src/grains/kinds.hpp"

#include <algorithm>

#include <fmt/ranges.h>

#include "src/base/words.hpp"

namespace barchan {

std::vector<KindConfig> all_kinds(const GrainConfig& grains) {
  if (!grains.kinds.empty()) return grains.kinds;
  return {{.name = {},
           .density = grains.density,
           .material = grains.material,
           .shape = grains.shape,
           .sizes = grains.sizes}};
}

std::vector<SizeClass> poured_sizes(const GrainConfig& grains) {
  std::vector<SizeClass> sizes;
  int number = 0;
  for (const KindConfig& kind : all_kinds(grains)) {
    for (const SizeClass& size : kind.sizes)
      sizes.push_back({.diameter = size.diameter, .count = size.count, .kind = number});
    ++number;
  }
  return sizes;
}

std::string section_of_kind(const GrainConfig& grains, std::size_t kind) {
  return grains.kinds.empty() ? "grains" : fmt::format("grains.kind.{}", kind + 1);
}

int kind_of_name(const GrainConfig& grains, std::string_view name) {
  const std::vector<std::string> names = names_of_kinds(grains);
  const auto at = std::ranges::find(names, name);
  return at == names.end() ? -1 : static_cast<int>(at - names.begin());
}

std::vector<std::string> names_of_kinds(const GrainConfig& grains) {
  std::vector<std::string> names;
  for (const KindConfig& kind : all_kinds(grains)) names.push_back(kind.name);
  return names;
}

std::string unknown_kinds(const GrainConfig& grains, const std::vector<std::string>& names) {
  const std::vector<std::string> ours = names_of_kinds(grains);
  for (const std::string& name : names) {
    const bool any_will_do = name.empty() && ours.size() == 1;
    if (any_will_do || kind_of_name(grains, name) >= 0) continue;
    if (name.empty())
      return fmt::format("say of which kind each grain is, \"{}\"", fmt::join(ours, "\" or \""));
    if (grains.kinds.empty())
      return fmt::format("hold grains of one kind; there is no [[grains.kind]] \"{}\"", name);
    return fmt::format("hold kinds of [[grains.kind]] alone; \"{}\" is none{}", name,
                       did_you_mean(nearest(name, ours)));
  }
  return {};
}

std::vector<SizeClass> with_kinds_of(const GrainConfig& grains, const GrainConfig& other,
                                     std::vector<SizeClass> sizes) {
  const std::vector<std::string> theirs = names_of_kinds(other);
  for (SizeClass& size : sizes) {
    const auto& name = theirs[static_cast<std::size_t>(size.kind)];
    size.kind = std::max(kind_of_name(grains, name), 0);
  }
  return sizes;
}

}  // namespace barchan
