// What friction, restitution and rolling friction do to a dune, as the paper says in the text on
// its Figs 4 to 9, judged from dune.csv of finished runs that differ in one number each.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/reference_table.hpp"

namespace barchan::test {

/// The main dune at the time the runs are compared at; lengths are means over the second before.
struct DuneSeen {
  double width = 0, length = 0;  // [m]
  double way = 0;                // of the centroid along the flow since the start [m]
  double shed = 0;               // grains that the dune has lost since the start
};

/// The rows of the main dune in a run's dune.csv.
inline std::vector<ReferenceRow> main_dune(const std::filesystem::path& run) {
  std::vector<ReferenceRow> rows = table(run / "dune.csv");
  std::erase_if(rows, [](const ReferenceRow& row) { return row.at("dune") != "0"; });
  if (rows.size() < 2) throw std::runtime_error("no dune in " + run.string());
  return rows;
}

inline DuneSeen dune_at(const std::vector<ReferenceRow>& rows, double time) {
  DuneSeen seen;
  int n = 0;
  for (const ReferenceRow& row : rows) {
    const double t = number(row, "t"), slack = 1e-6;
    if (t > time + slack) break;
    seen.way = number(row, "Cx") - number(rows[0], "Cx");
    seen.shed = number(rows[0], "n_grains") - number(row, "n_grains");
    if (t < time - 1 - slack) continue;
    seen.width += number(row, "W"), seen.length += number(row, "L"), ++n;
  }
  seen.width /= n, seen.length /= n;
  return seen;
}

/// All runs at the last time that all have reached.
inline std::vector<DuneSeen> dunes_at_the_same_time(
    const std::vector<std::filesystem::path>& runs) {
  std::vector<std::vector<ReferenceRow>> dunes;
  double time = HUGE_VAL;
  for (const std::filesystem::path& run : runs) {
    dunes.push_back(main_dune(run));
    time = std::min(time, number(dunes.back().back(), "t"));
  }
  if (time < 1.5) throw std::runtime_error("a run has not reached 1.5 s: its heap still slumps");
  std::vector<DuneSeen> seen;
  for (const auto& rows : dunes) seen.push_back(dune_at(rows, time));
  return seen;
}

/// Something the paper says, and the number it is said about: greater than the other one or not.
struct Ordering {
  std::string claim;
  double less = 0, more = 0;
  bool holds() const { return less < more; }
};

/// Below mu = 0.4 the dune is wider and sheds more grains.
inline std::vector<Ordering> sliding_friction_rules(const DuneSeen& base, const DuneSeen& low) {
  return {{"low mu: wider [m]", base.width, low.width},
          {"low mu: more grains shed", base.shed, low.shed}};
}

/// Rolling friction slows the dune.
inline std::vector<Ordering> rolling_friction_rules(const DuneSeen& base, const DuneSeen& high) {
  return {{"high mu_r: slower [m]", high.way, base.way}};
}

/// The effect of restitution is negligible: beside that of either friction on the same quantity.
inline std::vector<Ordering> restitution_rules(const DuneSeen& base, const DuneSeen& bouncy,
                                               const DuneSeen& low_mu, const DuneSeen& high_mu_r) {
  std::vector<Ordering> rules;
  const auto add = [&](const std::string& what, double DuneSeen::*q) {
    const double change = std::abs(bouncy.*q - base.*q);
    rules.push_back(
        {"e changes the " + what + " less than mu", change, std::abs(low_mu.*q - base.*q)});
    rules.push_back(
        {"e changes the " + what + " less than mu_r", change, std::abs(high_mu_r.*q - base.*q)});
  };
  add("width [m]", &DuneSeen::width);
  add("length [m]", &DuneSeen::length);
  add("way [m]", &DuneSeen::way);
  add("grains shed", &DuneSeen::shed);
  return rules;
}

}  // namespace barchan::test
