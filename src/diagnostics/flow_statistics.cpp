#include "src/diagnostics/flow_statistics.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "src/base/atomic_file.hpp"
#include "src/parallel/exchange.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

FlowStatistics::FlowStatistics(const FluidConfig& config, const Grid& grid)
    : grid_(grid),
      viscosity_(config.kinematic_viscosity),
      sample_("statistics: plane sums", static_cast<std::size_t>(grid.ny) + 1),
      sums_("host: sums of all samples", static_cast<std::size_t>(grid.ny) + 1) {}

void FlowStatistics::sample(const FluidState& fluid) {
  Kokkos::deep_copy(sample_, PlaneSums{});
  const StressDivergence stress{grid_, fluid.u, fluid.nu_t, viscosity_};
  Kokkos::parallel_for("statistics: plane sums", Kokkos::TeamPolicy<>(grid_.ny + 1, Kokkos::AUTO),
                       AddPlaneMeans{grid_, fluid.u, fluid.p, fluid.nu_t, stress, sample_});
  // Sum over ranks before adding: a restart then goes on with the same bits.
  static_assert(sizeof(PlaneSums) == PlaneSums::n_quantities * sizeof(Real));
  const auto row = host_copy(sample_);
  const std::span<Real> numbers(row.data()->value, row.size() * PlaneSums::n_quantities);
  all_reduce(ranks_of(grid_), numbers, MPI_SUM);
  for (std::size_t j = 0; j < row.size(); ++j) sums_(j) += row(j);
  ++n_samples_;
}

FlowStatisticsTable FlowStatistics::table() const {
  using Q = PlaneSums;
  const auto faces = host_copy(grid_.y_face_);
  const double per_sample =
      1 / (static_cast<double>(n_samples_) * grid_.nx_all * static_cast<double>(grid_.nz_all));
  const auto mean = [&](int j, Q::Quantity q) {
    return sums_(static_cast<std::size_t>(j)).value[q] * per_sample;
  };
  const auto at_centre = [&](int j, Q::Quantity q) { return (mean(j, q) + mean(j + 1, q)) / 2; };
  FlowStatisticsTable table;
  table.u_star = std::sqrt(std::abs(mean(0, Q::stress)));
  for (int j = 0; j < grid_.ny; ++j) {
    const double u = mean(j, Q::u), w = mean(j, Q::w);
    const auto below = static_cast<std::size_t>(j) + 1;  // the first entry is a ghost face
    StatisticsRecord row;
    row.y = (faces(below) + faces(below + 1)) / 2;
    row.u = u;
    row.y_plus = row.y * table.u_star / viscosity_;
    row.u_plus = table.u_star > 0 ? u / table.u_star : 0.0;
    row.uu = mean(j, Q::uu) - u * u;
    row.ww = mean(j, Q::ww) - w * w;
    row.vv = at_centre(j, Q::vv);
    row.uv = at_centre(j, Q::uv);  // the mean of v is zero: nothing passes the floor
    row.k = (row.uu + row.vv + row.ww) / 2;
    row.viscous = at_centre(j, Q::viscous);
    row.subgrid = at_centre(j, Q::stress) - row.viscous;
    row.total = at_centre(j, Q::stress) - row.uv;
    row.p = mean(j, Q::p);
    row.nu_t = mean(j, Q::nu_t);
    row.n_samples = n_samples_;
    table.lines.push_back(row);
  }
  return table;
}

void FlowStatistics::write(const std::filesystem::path& file) const {
  if (n_samples_ == 0) return;
  std::string text = kStatisticsTable.header() + "\n";
  for (const StatisticsRecord& line : table().lines) text += kStatisticsTable.line(line);
  if (rank_of(grid_) == 0) write_atomically(file, text);
}

void FlowStatistics::save(CheckpointWriter& file) const {
  file.array("statistics/sums", sums_);
  file.scalar("statistics/n_samples", n_samples_);
}

void FlowStatistics::load(const CheckpointReader& file) {
  if (!file.has("statistics/n_samples")) return;
  file.array("statistics/sums", sums_);
  n_samples_ = file.integer("statistics/n_samples");
}

}  // namespace barchan
