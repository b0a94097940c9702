#include "src/results/flow_outputs.hpp"

#include <string>

#include "src/fluid/fluid_state.hpp"

namespace barchan {

std::vector<Output> outputs_of(const Field&, const FluidField& about) {
  return {{about.name, about.unit, about.meaning}};
}

std::vector<Output> outputs_of(const FaceVector&, const FluidField& about) {
  const std::string name = about.name, meaning = about.meaning;
  const bool velocity = name == "u";
  return {{velocity ? "u" : name + "_x", about.unit, meaning + " along x"},
          {velocity ? "v" : name + "_y", about.unit, meaning + " along y, upwards"},
          {velocity ? "w" : name + "_z", about.unit, meaning + " along z"}};
}

std::vector<Output> flow_outputs() {
  std::vector<Output> all;
  for_each_fluid_field(FluidState(), [&](const auto& member, const FluidField& about) {
    if ((about.uses & kInFrame) == 0) return;
    for (const Output& one : outputs_of(member, about)) all.push_back(one);
  });
  return all;
}

}  // namespace barchan
