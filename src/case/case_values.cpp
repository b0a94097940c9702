#include "src/case/case_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace barchan {

Mismatch convert(const Node& node, PlaneVelocity& value) {
  std::array<double, 2> both{};
  const Mismatch alone = convert(node, both[0]);
  if (!alone || !convert(node, both)) {
    value = {both[0], both[1]};
    return {};
  }
  if (std::holds_alternative<double>(node.value)) return alone;
  return "a number, along x, or [along x, along z]";
}

Mismatch convert(const Node& node, std::vector<SizeClass>& value) {
  const std::string expected = "an array of [diameter in m above 0, count above 0]";
  const auto* classes = std::get_if<NodeArray>(&node.value);
  if (classes == nullptr) return expected;
  constexpr std::int64_t max = std::numeric_limits<int>::max();  // largest number of a grain
  std::int64_t total = 0;
  for (const Node& element : *classes) {
    const auto* pair = std::get_if<NodeArray>(&element.value);
    SizeClass size;
    if (pair == nullptr || pair->size() != 2 || convert((*pair)[0], size.diameter) ||
        convert((*pair)[1], size.count) || size.diameter <= 0 || size.count <= 0) {
      return fmt::format("{}; {} is not", expected, toml_text(element));
    }
    if (size.count > max - total) return fmt::format("sizes of at most {} grains in all", max);
    total += size.count;
    value.push_back(size);
  }
  return {};
}

Mismatch convert(const Node& node, std::vector<ClumpSphere>& value) {
  const std::string expected = "an array of [x, y, z, radius above 0]";
  const auto* spheres = std::get_if<NodeArray>(&node.value);
  if (spheres == nullptr) return expected;
  for (const Node& element : *spheres) {
    std::array<double, 4> numbers{};
    if (convert(element, numbers) || !(numbers[3] > 0))
      return fmt::format("{}; {} is not", expected, toml_text(element));
    const auto& [x, y, z, radius] = numbers;
    const double largest = std::max({std::abs(x), std::abs(y), std::abs(z), radius});
    if (largest > 1e9 || radius < 1e-9)  // their powers must be numbers
      return fmt::format("an array of numbers up to 1e9, radii from 1e-9; {} is not",
                         toml_text(element));
    value.push_back({{x, y, z}, radius});
  }
  return {};
}

namespace {

/// Turns a word into the set that it stands for.
Mismatch convert_set(const Node& word, ForceSwitches& value) {
  std::vector<std::string_view> names;
  for (const ForceSet& set : kForceSets) names.push_back(set.name);
  std::size_t at = 0;
  if (const Mismatch mismatch = convert_name(word, names, at)) {
    return fmt::format("an array of names, or {}", *mismatch);
  }
  value = kForceSets[at].forces;
  return {};
}

}  // namespace

Mismatch convert(const Node& node, ForceSwitches& value) {
  const auto* chosen = std::get_if<NodeArray>(&node.value);
  if (chosen == nullptr) return convert_set(node, value);
  std::vector<std::string_view> names;
  for (const ForceName& force : kForceNames) names.push_back(force.name);
  for (const ForceName& force : kForceNames) value.*force.on = false;
  for (const Node& element : *chosen) {
    std::size_t at = 0;
    if (const Mismatch mismatch = convert_name(element, names, at)) {
      return fmt::format("an array; {} must be {}", toml_text(element), *mismatch);
    }
    value.*kForceNames[at].on = true;
  }
  return {};
}

std::string toml_text(const PlaneVelocity& velocity) {
  return velocity.z == 0 ? toml_text(velocity.x) : toml_text(std::array{velocity.x, velocity.z});
}

std::string toml_text(const std::vector<SizeClass>& sizes) {
  std::vector<std::string> classes;
  for (const SizeClass& size : sizes) {
    classes.push_back(fmt::format("[{}, {}]", toml_text(size.diameter), size.count));
  }
  return fmt::format("[{}]", fmt::join(classes, ", "));
}

std::string toml_text(const std::vector<ClumpSphere>& spheres) {
  std::vector<std::string> rows;
  for (const auto& [c, radius] : spheres)
    rows.push_back(toml_text(std::array{c.x, c.y, c.z, radius}));
  return fmt::format("[{}]", fmt::join(rows, ", "));
}

std::string toml_text(const ForceSwitches& forces) {
  std::vector<std::string> names;
  for (const ForceName& force : kForceNames) {
    if (forces.*force.on) names.push_back(toml_text(force.name));
  }
  return fmt::format("[{}]", fmt::join(names, ", "));
}

Mismatch check(const PlaneVelocity& value, const Range& range) {
  return check(std::array{value.x, value.z}, range);
}

Mismatch check(const SizeClass& value, const Range& range) { return check(value.diameter, range); }

Form ValueKind<PlaneVelocity>::form() {
  using enum Form::Of;
  return {.of = any_of, .parts = {{number}, {.of = number, .count = 2}}};
}

Form ValueKind<std::vector<SizeClass>>::form() {
  using enum Form::Of;
  return {.of = list, .parts = {{.of = tuple, .parts = {{number}, {positive}}}}};
}

Form ValueKind<std::vector<ClumpSphere>>::form() {
  using enum Form::Of;
  return {.of = list, .parts = {{.of = number, .count = 4}}};
}

Form ValueKind<ForceSwitches>::form() {
  Form name{.of = Form::Of::choice}, set{.of = Form::Of::choice};
  for (const ForceName& force : kForceNames) name.names.push_back(force.name);
  for (const ForceSet& of : kForceSets) set.names.push_back(of.name);
  return {.of = Form::Of::any_of, .parts = {set, {.of = Form::Of::list, .parts = {name}}}};
}

std::string ValueKind<ForceSwitches>::type() {
  std::vector<std::string> sets;
  for (const ForceSet& set : kForceSets) sets.push_back(toml_text(set.name));
  return fmt::format("{} or array of {}", fmt::join(sets, ", "),
                     toml_text(kForceSets.back().forces));
}

}  // namespace barchan
