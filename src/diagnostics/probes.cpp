#include "src/diagnostics/probes.hpp"

#include <fmt/format.h>

#include "src/base/errors.hpp"
#include "src/parallel/decomposition.hpp"
#include "src/parallel/exchange.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

std::vector<Vec3> points_of(const ProbeConfig& probe) {
  const auto vec = [](const std::array<double, 3>& x) { return Vec3{x[0], x[1], x[2]}; };
  if (probe.at) return {vec(*probe.at)};
  const Vec3 from = vec(probe.from.value()), to = vec(probe.to.value());
  std::vector<Vec3> points;
  for (int n = 0; n < probe.points; ++n) {
    const Real share = static_cast<Real>(n) / (probe.points - 1);
    points.push_back((1 - share) * from + share * to);
  }
  return points;
}

void check_probes(const SettledCase& the_case) {
  const Config& config = the_case.config;
  if (config.bodies.empty()) return;
  for (const ProbeConfig& probe : config.output.probes) {
    for (const Vec3& x : points_of(probe)) {
      const Bodies::Nearest nearest = the_case.bodies().nearest(x);
      if (nearest.surface.distance >= 0) continue;
      throw InputError(fmt::format(
          "{}: [[output.probe]] \"{}\": the point [{:.6g}, {:.6g}, {:.6g}] m is inside the body "
          "\"{}\", where no water flows",
          config.file.string(), probe.name, x.x, x.y, x.z,
          config.bodies[static_cast<std::size_t>(nearest.body)].name));
    }
  }
}

Probes::Probes(const Config& config) {
  const FluidConfig& fluid = config.fluid.value();
  if (fluid.bottom == WallFlow::no_slip)
    wall_viscosity_ = fluid.density * fluid.kinematic_viscosity;
  for (const ProbeConfig& probe : config.output.probes) {
    const std::vector<Vec3> points = points_of(probe);
    const Kokkos::View<FlowAtPoint*> values("probes: flow", points.size());
    Probe made{.points = to_device("probes: points", points),
               .values = values,
               .on_host = mirror(values),
               .rows = std::vector<ProbeRecord>(points.size())};
    for (std::size_t n = 0; n < points.size(); ++n) {
      made.rows[n].probe = static_cast<std::int64_t>(probes_.size());
      made.rows[n].point = static_cast<std::int64_t>(n);
      made.rows[n].x = points[n].x, made.rows[n].y = points[n].y, made.rows[n].z = points[n].z;
    }
    probes_.push_back(std::move(made));
  }
}

std::span<const ProbeRecord> Probes::sample(std::size_t n, const FluidState& fluid, double t) {
  Probe& probe = probes_[n];
  Kokkos::parallel_for("probes: flow", probe.rows.size(),
                       ReadFlowAtPoints{.grid = fluid.grid,
                                        .u = fluid.u,
                                        .p = fluid.p,
                                        .wall_viscosity = wall_viscosity_,
                                        .points = probe.points,
                                        .values = probe.values});
  Kokkos::deep_copy(probe.on_host, probe.values);
  static_assert(sizeof(FlowAtPoint) == FlowAtPoint::n_numbers * sizeof(Real));
  const std::span<Real> numbers(&probe.on_host.data()->u.x,
                                probe.rows.size() * FlowAtPoint::n_numbers);
  all_reduce(ranks_of(fluid.grid), numbers, MPI_SUM);
  for (std::size_t i = 0; i < probe.rows.size(); ++i) {
    const FlowAtPoint& here = probe.on_host(i);
    ProbeRecord& row = probe.rows[i];
    row.t = t;
    row.u = here.u.x, row.v = here.u.y, row.w = here.u.z;
    row.p = here.p;
    row.wall_shear_x = here.wall_shear.x, row.wall_shear_z = here.wall_shear.z;
  }
  return probe.rows;
}

}  // namespace barchan
