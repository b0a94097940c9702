#include "src/run/body_sums.hpp"

#include <algorithm>

namespace barchan {

namespace {

constexpr const char* kName = "since_row_of_bodies";
constexpr std::size_t kNumbers = 6;  // numbers of a load

void add_to(BodyLoad& sum, const BodyLoad& load) {
  sum.force += load.force;
  sum.torque += load.torque;
}

BodyLoad mean(const BodyLoad& sum, double steps) {
  return {.force = (1 / steps) * sum.force, .torque = (1 / steps) * sum.torque};
}

void append(std::vector<double>& numbers, const BodyLoad& load) {
  const auto& [force, torque] = load;
  numbers.insert(numbers.end(), {force.x, force.y, force.z, torque.x, torque.y, torque.z});
}

BodyLoad load_at(const double* numbers) {
  return {.force = {numbers[0], numbers[1], numbers[2]},
          .torque = {numbers[3], numbers[4], numbers[5]}};
}

}  // namespace

void BodySums::add(const CoupledStep& step) {
  if (!any()) return;
  ++steps_;
  if (step.fluid_solver() != nullptr) {
    const std::vector<BodyLoad>& loads = step.fluid_solver()->body_loads();
    for (std::size_t b = 0; b < water_.size(); ++b) add_to(water_[b], loads[b]);
  }
  if (step.grain_solver() == nullptr) return;
  const std::vector<GrainsOnBody> loads = step.grain_solver()->body_loads();
  for (std::size_t b = 0; b < loads.size(); ++b) add_to(grains_[b], loads[b].load);
}

std::vector<BodyRecord> BodySums::take(double t, const CoupledStep& step) {
  const auto* solver = step.grain_solver();
  const auto on_bodies = solver == nullptr ? std::vector<GrainsOnBody>{} : solver->body_loads();
  const double steps = std::max(1.0, static_cast<double>(steps_));
  std::vector<BodyRecord> rows;
  for (std::size_t b = 0; b < water_.size(); ++b) {
    rows.push_back(body_record(t, static_cast<int>(b), mean(water_[b], steps),
                               mean(grains_[b], steps),
                               b < on_bodies.size() ? on_bodies[b].contacts : 0));
    water_[b] = grains_[b] = {};
  }
  steps_ = 0;
  return rows;
}

void BodySums::save(CheckpointWriter& file) const {
  if (!any()) return;
  std::vector<double> numbers{static_cast<double>(steps_)};
  for (const auto* loads : {&water_, &grains_})
    for (const BodyLoad& load : *loads) append(numbers, load);
  file.array(kName, std::span<const double>(numbers));
}

void BodySums::load(const CheckpointReader& file) {
  if (!any() || !file.has(kName)) return;
  const auto numbers = file.array<double>(kName, {1 + 2 * kNumbers * water_.size()});
  steps_ = static_cast<std::int64_t>(numbers[0]);
  const double* at = numbers.data() + 1;
  for (auto* loads : {&water_, &grains_})
    for (BodyLoad& load : *loads) load = load_at(at), at += kNumbers;
}

}  // namespace barchan
