#include "src/case/output_checks.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "src/toml/names.hpp"

namespace barchan {
namespace {

std::string probe_key(std::size_t n, std::string_view key) {
  return fmt::format("output.probe.{}.{}", n + 1, key);
}

void check_probe_name(const std::vector<ProbeConfig>& probes, std::size_t n, Findings& found) {
  const std::string& name = probes[n].name;
  check_name(name, {probe_key(n, "name")}, found);
  for (std::size_t before = 0; before < n; ++before)
    found.error_if(probes[before].name == name, {probe_key(n, "name")},
                   "must be another one: \"{}\" is the name of an earlier probe", name);
}

/// Checks that a probe is a point or a line, whole, and not both.
void check_probe_shape(const ProbeConfig& probe, std::size_t n, Findings& found) {
  const bool line = probe.from || probe.to || probe.points != 0;
  if (found.error_if(probe.at && line, {probe_key(n, "at"), probe_key(n, "from")},
                     "contradicts from, to and points: a probe is a point or a line"))
    return;
  found.error_if(!probe.at && !line, {probe_key(n, "name"), probe_key(n, "at")},
                 "must come with at = [x, y, z], or with from, to and points");
  if (!line) return;
  if (found.error_if(!probe.from || !probe.to,
                     {probe_key(n, probe.from ? "from"
                                   : probe.to ? "to"
                                              : "points")},
                     "must come with {}: a line has from, to and points",
                     probe.from ? "to"
                     : probe.to ? "from"
                                : "from and to"))
    return;
  found.error_if(probe.points < 2, {probe_key(n, "points"), probe_key(n, "from")},
                 "must be at least 2 on a line");
  found.error_if(*probe.from == *probe.to, {probe_key(n, "to"), probe_key(n, "from")},
                 "must be another point than from");
}

void check_probe_inside(const ProbeConfig& probe, std::size_t n, const std::array<double, 3>& size,
                        Findings& found) {
  const auto check = [&](const char* key, const std::optional<std::array<double, 3>>& point) {
    if (!point) return;
    const auto& p = *point;
    found.error_if(
        p[0] > size[0] || p[1] > size[1] || p[2] > size[2], {probe_key(n, key), "domain.size"},
        "must be inside the domain, 0 to [{:.6g}] m along x, y and z", fmt::join(size, ", "));
  };
  check("at", probe.at);
  check("from", probe.from);
  check("to", probe.to);
}

void check_slice(const std::vector<SliceConfig>& slices, std::size_t n,
                 const std::array<double, 3>& size, Findings& found) {
  const SliceConfig& slice = slices[n];
  const auto key = [&](const char* name) { return fmt::format("output.slice.{}.{}", n + 1, name); };
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  };
  found.error_if(slice.name.empty() || !std::ranges::all_of(slice.name, is_plain), {key("name")},
                 "must be of letters, digits, _ and -: it is part of a file name");
  for (std::size_t before = 0; before < n; ++before)
    found.error_if(slices[before].name == slice.name, {key("name")},
                   "must be another one: \"{}\" is the name of an earlier slice", slice.name);
  const double length = size[static_cast<std::size_t>(slice.normal)];
  found.error_if(slice.at > length, {key("at"), "domain.size"},
                 "must be inside the domain, 0 to {:.6g} m", length);
}

}  // namespace

void check_slice_keys(const Config& c, Findings& found) {
  const std::vector<SliceConfig>& slices = c.output.slices;
  if (found.error_if(!c.fluid && !slices.empty(), {"output.slice", "fluid"},
                     "must be absent without a [fluid] section"))
    return;
  for (std::size_t n = 0; n < slices.size(); ++n) check_slice(slices, n, c.size, found);
}

void check_probe_keys(const Config& c, Findings& found) {
  const std::vector<ProbeConfig>& probes = c.output.probes;
  if (found.error_if(!c.fluid && !probes.empty(), {"output.probe", "fluid"},
                     "must be absent without a [fluid] section"))
    return;
  for (std::size_t n = 0; n < probes.size(); ++n) {
    check_probe_name(probes, n, found);
    check_probe_shape(probes[n], n, found);
    check_probe_inside(probes[n], n, c.size, found);
  }
}

}  // namespace barchan
