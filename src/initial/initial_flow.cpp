#include "src/initial/initial_flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "src/case/derived.hpp"
#include "src/fluid/flow_schedule.hpp"
#include "src/parallel/mirror.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

namespace {

using std::numbers::pi;
using HostArray = Kokkos::View<Real***, Kokkos::LayoutLeft, Kokkos::HostSpace>;
using HostRow = Kokkos::View<Real*, Kokkos::HostSpace>;

constexpr double kPerturbationRms = 0.1;  // over the bulk velocity
constexpr int kNVortexModes = 6;
constexpr int kNWaveModes = 32;

/// Fourier mode of a vector potential: strength * cos(kx x + a) * cos(kz z + b) per component.
struct Mode {
  int mx = 0, mz = 0;
  std::array<double, 3> strength{}, phase_x{}, phase_z{};
};

/// Walls, and the distance that the perturbation reaches from them.
struct Profile {
  double height = 0;  // [m]
  double delta = 0;   // [m], 0 without walls
  bool bottom = true, top = false;

  /// Amplitude of the potential: zero on both boundaries, where it must be constant, with its peak
  /// 0.2 delta from a wall.
  double envelope(double y) const {
    const double edges = std::sin(pi * std::clamp(y / height, 0.0, 1.0));
    if (delta == 0) return edges;
    const auto near = [&](double distance) {
      const double eta = distance / (0.2 * delta);
      return eta * std::exp(1 - eta);
    };
    double sum = 0;
    if (bottom) sum += near(y);
    if (top) sum += near(height - y);
    return sum * (1 - std::pow(1 - edges, 4));
  }
};

std::vector<Mode> draw_modes(const Grid& grid, const Profile& profile, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  // Random numbers are drawn by hand: the standard distributions differ between libraries.
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  const auto whole = [&](int low, int high) {
    return low + std::min(static_cast<int>(uniform() * (high - low + 1)), high - low);
  };
  const double scale = profile.delta > 0 ? profile.delta : profile.height;
  // Shortest waves: a delta along the flow and half of that across, but at least four cells.
  const auto most = [](double length, double wave, int cells) {
    return std::max(1, std::min(static_cast<int>(length / wave), cells / 4));
  };
  const double lx = grid.lx, lz = grid.lz;
  const int max_x = most(lx, scale, grid.nx_all), max_z = most(lz, 0.5 * scale, grid.nz_all);
  std::vector<Mode> modes;
  for (int m = 0; m < kNVortexModes + kNWaveModes; ++m) {
    const bool vortex = m < kNVortexModes;
    Mode mode;
    mode.mx = vortex ? 0 : whole(1, max_x);
    mode.mz = vortex ? whole(std::max(1, max_z / 3), max_z) : whole(0, max_z);
    const double k = 2 * pi * std::hypot(mode.mx / lx, mode.mz / lz);
    for (std::size_t c = 0; c < 3; ++c) {
      const double weight = vortex ? (c == 0 ? 2.0 : 0.0) : 1.0;
      mode.strength[c] = weight * (2 * uniform() - 1) / k;
      mode.phase_x[c] = 2 * pi * uniform();
      mode.phase_z[c] = 2 * pi * uniform();
    }
    modes.push_back(mode);
  }
  return modes;
}

/// Component c of the potential on its edges: between faces along c, on faces across it.
HostArray potential(std::size_t c, const Grid& grid, const HostGrid& rows, const Profile& profile,
                    const std::vector<Mode>& modes) {
  const int nx = grid.nx + 1, ny = grid.ny + 1, nz = grid.nz + 1;
  HostArray psi("host: potential", nx, ny, nz);
  const HostRow along_x("host: potential along x", nx), envelope("host: potential's envelope", ny);
  for (int j = 0; j < ny; ++j) {
    envelope(j) = profile.envelope(c == 1 ? rows.y_centre(j) : rows.y_face(j));
  }
  for (const Mode& mode : modes) {
    for (int i = 0; i < nx; ++i) {
      const double x = (grid.i_begin + i + (c == 0 ? 0.5 : 0)) / grid.nx_all;
      along_x(i) = mode.strength[c] * std::cos(2 * pi * mode.mx * x + mode.phase_x[c]);
    }
    for (int k = 0; k < nz; ++k) {
      const double z = (grid.k_begin + k + (c == 2 ? 0.5 : 0)) / grid.nz_all;
      const double along_z = std::cos(2 * pi * mode.mz * z + mode.phase_z[c]);
      for (int j = 0; j < ny; ++j) {
        const double factor = along_z * envelope(j);
        for (int i = 0; i < nx; ++i) psi(i, j, k) += factor * along_x(i);
      }
    }
  }
  return psi;
}

/// Discrete curl of the potential at faces; its discrete divergence vanishes to round-off.
struct Curl {
  HostGrid grid;
  HostArray x, y, z;
  double u(int i, int j, int k) const {
    return (z(i, j + 1, k) - z(i, j, k)) / grid.dy(j) - (y(i, j, k + 1) - y(i, j, k)) / grid.dz;
  }
  double v(int i, int j, int k) const {
    return (x(i, j, k + 1) - x(i, j, k)) / grid.dz - (z(i + 1, j, k) - z(i, j, k)) / grid.dx;
  }
  double w(int i, int j, int k) const {
    return (y(i + 1, j, k) - y(i, j, k)) / grid.dx - (x(i, j + 1, k) - x(i, j, k)) / grid.dy(j);
  }
};

/// Reichardt (1951): U+ = ln(1 + k y+) / k + 7.8 (1 - exp(-y+/11) - (y+/11) exp(-0.33 y+)), k =
/// 0.41.
double reichardt_profile(double y_plus) {
  const double buffer = 1 - std::exp(-y_plus / 11) - y_plus / 11 * std::exp(-0.33 * y_plus);
  return std::log(1 + 0.41 * y_plus) / 0.41 + 7.8 * buffer;
}

/// Mean flow at t = 0.
struct MeanFlow {
  PlaneVelocity bulk;                                                  // [m/s]
  double speed = 0;                                                    // |bulk| [m/s]
  double u_star = 0;                                                   // [m/s] expected
  bool across() const { return std::abs(bulk.z) > std::abs(bulk.x); }  // more than along x
};

MeanFlow mean_flow(const FluidCase& flow, const FluidNumbers& numbers) {
  const std::vector<FlowTarget>& schedule = flow.schedule;
  if (schedule.empty()) return {numbers.bulk_velocity, numbers.bulk_velocity, numbers.u_star};
  const PlaneVelocity bulk = velocity_at_start(schedule);
  const double speed = std::hypot(bulk.x, bulk.z);
  return {bulk, speed, friction_velocity(speed, numbers.delta, flow.fluid.kinematic_viscosity)};
}

/// Grid with x and z exchanged.
template <class AnyGrid>
AnyGrid turned(AnyGrid grid) {
  std::swap(grid.nx, grid.nz);
  std::swap(grid.nx_all, grid.nz_all);
  std::swap(grid.dx, grid.dz);
  std::swap(grid.i_begin, grid.k_begin);
  std::swap(grid.lx, grid.lz);
  return grid;
}

/// Mean speed of every row [m/s], with the bulk velocity exact on the grid.
HostRow mean_profile(const MeanFlow& start, const Profile& profile, const HostGrid& rows,
                     double viscosity) {
  const HostRow mean("host: mean profile", rows.ny);
  double flow = 0;
  for (int j = 0; j < rows.ny; ++j) {
    const double y = rows.y_centre(j);
    double distance = profile.bottom ? y : profile.height - y;
    if (profile.bottom && profile.top) distance = std::min(y, profile.height - y);
    mean(j) = profile.delta > 0 ? reichardt_profile(distance * start.u_star / viscosity) : 1;
    flow += mean(j) * rows.dy(j);
  }
  const double scale = start.speed * profile.height / flow;
  for (int j = 0; j < rows.ny; ++j) mean(j) *= scale;
  return mean;
}

template <class Action>
void for_each_owned(const Grid& grid, const Action& action) {
  for (int k = 0; k < grid.nz; ++k) {
    for (int j = 0; j < grid.ny; ++j) {
      for (int i = 0; i < grid.nx; ++i) action(i, j, k);
    }
  }
}

template <class Value>
void set_owned(Field& f, const Grid& grid, const Value& value) {
  const auto host = mirror(f.storage);
  for_each_owned(grid, [&](int i, int j, int k) { host(i + 1, j + 1, k + 1) = value(i, j, k); });
  Kokkos::deep_copy(f.storage, host);
}

}  // namespace

void set_flow(TurbulentFlow, const SettledCase& the_case, FluidState& fluid) {
  const Grid& grid = fluid.grid;
  const FluidConfig& setup = the_case.fluid().fluid;
  const FluidNumbers& numbers = the_case.numbers.fluid.value();
  const MeanFlow start = mean_flow(the_case.fluid(), numbers);
  const Profile profile{.height = grid.ly,
                        .delta = numbers.delta,
                        .bottom = setup.bottom == WallFlow::no_slip,
                        .top = setup.top == WallFlow::no_slip};
  // Perturbations are made along x. For a flow across, x and z are exchanged.
  const bool across = start.across();
  const Grid drawn = across ? turned(grid) : grid;
  const HostGrid rows = drawn.on_host();
  const InitialConfig& initial = the_case.config.initial;
  const auto seed = initial.seed + static_cast<std::uint64_t>(initial.realisation - 1);
  const std::vector<Mode> modes = draw_modes(drawn, profile, seed);
  const auto psi = [&](std::size_t c) { return potential(c, drawn, rows, profile, modes); };
  const Curl curl{rows, psi(0), psi(1), psi(2)};
  double sum = 0;
  for_each_owned(drawn, [&](int i, int j, int k) {
    const double u = curl.u(i, j, k), v = curl.v(i, j, k), w = curl.w(i, j, k);
    sum += (u * u + v * v + w * w) * rows.dy(j);
  });
  const double rms = std::sqrt(sum_over(ranks_of(grid), sum) / grid.height_of_all_columns());
  const double scale = rms > 0 ? kPerturbationRms * start.speed / rms : 0;
  const HostRow mean = mean_profile(start, profile, rows, setup.kinematic_viscosity);
  const double cosine = start.bulk.x / start.speed, sine = start.bulk.z / start.speed;
  set_owned(fluid.u.x, grid, [&](int i, int j, int k) {
    return cosine * mean(j) + scale * (across ? curl.w(k, j, i) : curl.u(i, j, k));
  });
  set_owned(fluid.u.y, grid, [&](int i, int j, int k) {
    return j > 0 ? scale * (across ? curl.v(k, j, i) : curl.v(i, j, k)) : 0;
  });
  set_owned(fluid.u.z, grid, [&](int i, int j, int k) {
    return sine * mean(j) + scale * (across ? curl.u(k, j, i) : curl.w(i, j, k));
  });
}

void set_flow(UniformFlow, const SettledCase& the_case, FluidState& fluid) {
  const PlaneVelocity bulk = velocity_at_start(the_case.fluid().schedule);
  Kokkos::deep_copy(fluid.u.x.storage, bulk.x);
  Kokkos::deep_copy(fluid.u.z.storage, bulk.z);
}

}  // namespace barchan
