#include "src/diagnostics/flow_average.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "src/parallel/launch.hpp"
#include "src/restart/state_file.hpp"
#include "src/results/flow_outputs.hpp"

namespace barchan {

namespace {

/// The moments in their order, of which the first six are the means of fields.h5.
const std::vector<Output>& moments() {
  static const std::vector<Output> all = flow_moment_outputs();
  return all;
}

template <std::size_t n>
void make(std::array<Field, n>& fields, const Grid& grid) {
  for (Field& field : fields) field = Field("flow average", grid);
}

}  // namespace

std::vector<Output> flow_moment_outputs() {
  const std::vector<Output> fields = flow_outputs();
  std::vector<Output> all;
  for (const char* name : {"u", "v", "w", "p", "alpha_f", "nu_t"})
    all.push_back(*std::ranges::find(fields, name, &Output::name));
  for (const std::string pair : {"uu", "vv", "ww", "uv", "uw", "vw"})
    all.push_back({pair, "m^2/s^2", fmt::format("mean of {}'{}'", pair[0], pair[1])});
  return all;
}

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
  for (std::size_t q = 0; q < result_.size(); ++q) named.push_back({moments()[q], &result_[q]});
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
    for (std::size_t q = 0; q < fields.size(); ++q) f(prefix + moments()[q].name, fields[q]);
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
