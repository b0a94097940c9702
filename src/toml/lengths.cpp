#include "src/toml/lengths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace barchan {
namespace {

constexpr std::string_view kDiameters = "d";

struct Unit {
  std::string_view name;
  double metres;
};
constexpr Unit kUnits[] = {{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}};

struct WrittenLength {
  double number = 0;
  std::string_view unit;
};

std::optional<WrittenLength> parse(std::string_view text) {
  text = without_blanks(text);
  WrittenLength length;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length.number);
  if (error != std::errc() || !std::isfinite(length.number)) return {};
  length.unit = without_blanks({end, text.data() + text.size()});
  const bool known = length.unit == kDiameters ||
                     std::ranges::find(kUnits, length.unit, &Unit::name) != std::end(kUnits);
  return known ? std::optional(length) : std::nullopt;
}

/// Length [m] as one would write it: 0.2 mm is 2e-4, and 3 d of 0.2 mm are 6e-4, to the last digit.
double metres_of(const WrittenLength& length, double diameter) {
  const bool in_diameters = length.unit == kDiameters;
  const double unit =
      in_diameters ? diameter : std::ranges::find(kUnits, length.unit, &Unit::name)->metres;
  return rounded(length.number * unit, 12);
}

}  // namespace

double rounded(double x, int digits) {
  const std::string text = fmt::format("{:.{}g}", x, digits);
  std::from_chars(text.data(), text.data() + text.size(), x);
  return x;
}

bool is_in_diameters(const Node& value) {
  if (const auto* list = std::get_if<NodeArray>(&value.value))
    return std::ranges::any_of(*list, is_in_diameters);
  const auto* text = std::get_if<std::string>(&value.value);
  const auto length = text != nullptr ? parse(*text) : std::nullopt;
  return length && length->unit == kDiameters;
}

Mismatch make_metres(Node& value, double diameter) {
  if (auto* list = std::get_if<NodeArray>(&value.value)) {
    for (Node& element : *list) {
      if (const Mismatch mismatch = make_metres(element, diameter)) return mismatch;
    }
    return {};
  }
  const auto* text = std::get_if<std::string>(&value.value);
  if (text == nullptr) return {};
  const auto length = parse(*text);
  if (!length)
    return "a number of metres, or a length as \"0.2 mm\" or, in mean grain diameters, \"3 d\"";
  value.value = metres_of(*length, diameter);
  return {};
}

}  // namespace barchan
