#include "src/diagnostics/flow_average.hpp"

#include "src/parallel/launch.hpp"
#include "src/restart/state_file.hpp"

namespace barchan {

namespace {

struct Quantity {
  const char *name, *units;
};
constexpr Quantity kQuantities[n_flow_moments] = {
    {"u", "m/s"},      {"v", "m/s"},      {"w", "m/s"},      {"p", "Pa"},
    {"alpha_f", "1"},  {"nu_t", "m^2/s"}, {"uu", "m^2/s^2"}, {"vv", "m^2/s^2"},
    {"ww", "m^2/s^2"}, {"uv", "m^2/s^2"}, {"uw", "m^2/s^2"}, {"vw", "m^2/s^2"}};

template <std::size_t n>
void make(std::array<Field, n>& fields, const Grid& grid) {
  for (Field& field : fields) field = Field("flow average", grid);
}

}  // namespace

FlowAverage::FlowAverage(const Grid& grid) : grid_(grid) {
  make(sum_, grid);
  make(first_, grid);
}

FlowSums FlowAverage::refs(std::array<Field, n_flow_moments>& fields) {
  FlowSums refs;
  for (int q = 0; q < n_flow_moments; ++q) refs[q] = FieldRef(fields[static_cast<std::size_t>(q)]);
  return refs;
}

void FlowAverage::sample(const FluidState& fluid, double t) {
  if (n_samples_ == 0) {
    start_ = t;
    for_each_cell("statistics: first velocity", grid_,
                  CentreVelocity{fluid.u, first_[0], first_[1], first_[2]});
  }
  for_each_cell("statistics: flow moments", grid_,
                AddFlowMoments{.u = fluid.u,
                               .p = fluid.p,
                               .alpha_f = fluid.alpha_f,
                               .nu_t = fluid.nu_t,
                               .sum = refs(sum_),
                               .first_u = first_[0],
                               .first_v = first_[1],
                               .first_w = first_[2]});
  ++n_samples_;
}

std::vector<NamedField> FlowAverage::means() {
  std::vector<NamedField> named;
  if (n_samples_ == 0) return named;
  if (result_[0].origin == nullptr) make(result_, grid_);
  for_each_cell("statistics: flow means", grid_,
                FlowMeans{.sum = refs(sum_),
                          .result = refs(result_),
                          .first_u = first_[0],
                          .first_v = first_[1],
                          .first_w = first_[2],
                          .per_sample = 1 / static_cast<double>(n_samples_)});
  for (std::size_t q = 0; q < std::size(kQuantities); ++q) {
    named.push_back({kQuantities[q].name, kQuantities[q].units, &result_[q]});
  }
  return named;
}

void FlowAverage::write(const OutputFiles& output, double t, std::int64_t step) {
  if (n_samples_ == 0) return;
  output.write_average(grid_, t, step, means(),
                       {{"window_start", start_}, {"n_samples", static_cast<double>(n_samples_)}});
}

/// Calls f(name, field) for every field of a restart file.
template <class F>
void FlowAverage::for_each_saved(const F& f) const {
  const auto each = [&](const std::string& prefix, const auto& fields) {
    for (std::size_t q = 0; q < fields.size(); ++q) f(prefix + kQuantities[q].name, fields[q]);
  };
  each("statistics/sum_", sum_);
  each("statistics/first_", first_);
}

void FlowAverage::save(CheckpointWriter& file) const {
  for_each_saved(
      [&](const std::string& name, const Field& f) { save_field(file, name, grid_, f); });
  file.scalar("statistics/n_field_samples", n_samples_);
  file.scalar("statistics/window_start", start_);
}

void FlowAverage::load(const CheckpointReader& file) {
  if (!file.has("statistics/n_field_samples")) return;
  for_each_saved(
      [&](const std::string& name, const Field& f) { load_field(file, name, grid_, f); });
  n_samples_ = file.integer("statistics/n_field_samples");
  start_ = file.real("statistics/window_start");
}

}  // namespace barchan
