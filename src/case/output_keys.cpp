#include "src/case/output_keys.hpp"

#include "src/case/case_values.hpp"
#include "src/toml/key_builder.hpp"

namespace barchan {

void add_output(Sections& all) {
  Section& section = all.emplace_back(
      Section{.name = "output", .meaning = "Intervals in simulated time; 0: no such file"});
  Keys key(section, [](auto& c) { return &c.output; });
  using O = OutputConfig;
  key("history_interval", &O::history_interval, at_least(0), "s", "interval of `history.csv`");
  key("dune_interval", &O::dune_interval, at_least(0), "s", "interval of `dune.csv`");
  key("grains_interval", &O::grains_interval, at_least(0), "s", "interval of `grains.h5`");
  key("fields_interval", &O::fields_interval, at_least(0), "s", "interval of `fields.h5`");
  key("tracks_interval", &O::tracks_interval, at_least(0), "s",
      "interval of `tracks.h5`: only ids and positions of the grains");
  key("grain_forces", &O::grain_forces, "write each force separately to `grains.h5`");
}

void add_probes(Sections& all) {
  Section& section = all.emplace_back(Section{
      .name = "output.probe",
      .meaning = "Points at which the flow is written to `probes.csv`: `at`, or `from`, `to` and "
                 "`points` for a line"});
  auto key = repeated_keys(section, [](auto& c) { return &c.output.probes; });
  using P = ProbeConfig;
  key("name", &P::name, at_most(60), "", "name in tables and pictures", required);
  key("at", &P::at, at_least(0), "m", "[x, y, z] of the point");
  key("from", &P::from, at_least(0), "m", "[x, y, z] of the first point of a line");
  key("to", &P::to, at_least(0), "m", "[x, y, z] of its last point");
  key("points", &P::points, between(0, 10000), "",
      "number of points of a line, at equal distances; at least 2");
  key("interval", &P::interval, above(0), "s", "interval of its rows");
}

void add_slices(Sections& all) {
  Section& section = all.emplace_back(
      Section{.name = "output.slice",
              .meaning = "Layers of cells whose fields are written to `slice_NAME.h5`, as "
                         "`fields.h5` is for all cells"});
  auto key = repeated_keys(section, [](auto& c) { return &c.output.slices; });
  using S = SliceConfig;
  key("name", &S::name, at_most(60), "", "name of the file: letters, digits, _ and -", required);
  key("normal", &S::normal, "axis across the layer");
  key("at", &S::at, at_least(0), "m", "place along `normal`: the layer of cells that holds it",
      required);
  key("interval", &S::interval, above(0), "s", "interval of its frames");
}

}  // namespace barchan
