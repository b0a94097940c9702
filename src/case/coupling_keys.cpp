#include "src/case/coupling_keys.hpp"

#include "src/case/case_values.hpp"
#include "src/toml/key_builder.hpp"

namespace barchan {

void add_coupling(Sections& all) {
  Keys key(add(all, "coupling", "Forces between grains and flow"),
           [](auto& c) { return &c.coupling; });
  using C = CouplingConfig;
  key("drag", &C::drag, "drag law");
  key("shape_drag", &C::shape_drag, "drag of clumps, as a factor on that of a sphere");
  key("scheme", &C::scheme,
      "exchange of momentum: layer by layer over the height of a grain; with the flow interpolated "
      "to its centre; likewise, then smoothed; as in CFDEM; or none: the flow is resolved around "
      "the grains");
  key("smoothing_length", &C::smoothing_length, between(0, 1e6), "m",
      "smoothing length of the void fraction, and of the exchange if that is smoothed; 0: no "
      "smoothing")
      .by_default = "3 d";
  key("alpha_time_derivative", &C::alpha_time_derivative,
      "include d(alpha_f)/dt in the continuity equation");
  key("forces", &C::forces,
      "forces of the flow on the grains: a list, or those of the paper, or all");
}

void add_schemes(Sections& all) {
  const char* of_volume = "distribution of the volume of a grain over cells";
  Keys centred(add(all, "coupling.centred", "Keys of the scheme \"centred\""),
               [](auto& c) { return &c.coupling.centred; });
  centred("void_fraction", &CentredConfig::void_fraction, of_volume);
  Keys smoothed(add(all, "coupling.smoothed", "Keys of the scheme \"smoothed\""),
                [](auto& c) { return &c.coupling.smoothed; });
  smoothed("void_fraction", &CentredConfig::void_fraction, of_volume);
  Keys cfdem(add(all, "coupling.cfdem", "Keys of the scheme \"cfdem\""),
             [](auto& c) { return &c.coupling.cfdem; });
  cfdem("smooth_exchange", &CfdemConfig::smooth_exchange, "smooths the exchange of momentum, too");
}

}  // namespace barchan
