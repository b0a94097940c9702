#include "src/results/long_names.hpp"

#include <span>

namespace barchan {
namespace {

struct LongName {
  std::string_view name, words;
};

constexpr LongName kGrains[] = {
    {"id", "number of the grain, the same in all frames"},
    {"x", "position of the centre"},
    {"d", "diameter"},
    {"u", "velocity"},
    {"omega", "angular velocity"},
    {"dune", "label of the dune that the grain belongs to, -1: none"},
    {"kind", "kind of the grain, from 0; \"names\" has a line for each"},
    {"heap",
     "number of the heap that the grain came from, from 0, -1: of none; \"names\" has a line for "
     "each"},
    {"force_drag", "drag"},
    {"force_added_mass", "force of the added mass"},
    {"force_lift", "lift"},
    {"force_pressure_gradient", "force of the pressure gradient"},
    {"force_stress", "force of the viscous and subgrid stress"},
    {"force_flow", "force of the flow that is resolved around the grain"},
    {"torque_flow", "torque of the flow about the centre of the grain"},
    {"force_contact", "sum of the forces in contacts"},
    {"force_contact_normal", "sum of the normal forces in contacts"},
    {"force_contact_tangential", "sum of the tangential forces in contacts"},
    {"force_total", "sum of all forces"}};

constexpr LongName kFlow[] = {{"u", "velocity along x"},
                              {"v", "velocity along y, upwards"},
                              {"w", "velocity along z"},
                              {"p", "pressure without its hydrostatic and driving parts"},
                              {"alpha_f", "volume fraction of the fluid"},
                              {"nu_t", "subgrid viscosity"},
                              {"uu", "mean of u'u'"},
                              {"vv", "mean of v'v'"},
                              {"ww", "mean of w'w'"},
                              {"uv", "mean of u'v'"},
                              {"uw", "mean of u'w'"},
                              {"vw", "mean of v'w'"}};

constexpr LongName kGrid[] = {{"x", "centres of the cells along the stream"},
                              {"x_face", "faces of the cells along the stream"},
                              {"y", "centres of the cells, upwards"},
                              {"y_face", "faces of the cells, upwards"},
                              {"z", "centres of the cells across the stream"},
                              {"z_face", "faces of the cells across the stream"}};

std::span<const LongName> table_of(Arrays kind) {
  switch (kind) {
    case Arrays::grains:
      return kGrains;
    case Arrays::flow:
      return kFlow;
    case Arrays::grid:
      break;
  }
  return kGrid;
}

}  // namespace

std::string_view long_name(Arrays kind, std::string_view name) {
  name.remove_prefix(name.rfind('/') + 1);
  for (const LongName& one : table_of(kind)) {
    if (one.name == name) return one.words;
  }
  return {};
}

}  // namespace barchan
