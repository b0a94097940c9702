// Order of accuracy of the volume-averaged equations from manufactured solutions.
#include "tests/support/manufactured_flow.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <span>

#include "src/fluid/fluid_solver.hpp"
#include "tests/support/flow_errors.hpp"
#include "tests/support/saved_results.hpp"

namespace barchan {
namespace {

using test::FlowErrors;
using test::HostGrid;
using test::ManufacturedFlow;

/// The flow at one time, in the form the error norms ask for.
struct AtTime {
  const ManufacturedFlow& flow;
  double t;
  double u(std::size_t axis, double x, double y, double z) const {
    return flow.u(axis, x, y, z, t);
  }
  double p(double x, double y, double z) const { return flow.p(x, y, z, t); }
};

/// The solver with the manufactured body force on n x (2/3) n x (2/3) n cells, rows stretched so
/// that the last is 2.5 times the first.
class Run {
 public:
  Run(const ManufacturedFlow& flow, int n)
      : flow_(flow),
        config_(make_config(flow, n)),
        grid_(make_grid(config_)),
        h_(grid_),
        fluid_(make_fluid_state(grid_)),
        force_{test::make_faces(grid_), test::make_faces(grid_)},
        solver_(config_, grid_) {
    test::set_velocity(fluid_, AtTime{flow_, 0});
    solver_.fill_ghosts(fluid_);
    project();
  }

  void advance_to(double end, int steps) {
    const double dt = end / steps;
    for (int s = 0; s < steps; ++s) {
      // Convection and stress are extrapolated to the middle of the step (Adams-Bashforth) and the
      // pressure solved for is that of the middle: so the force belongs there, too.
      if (s == 0 || !flow_.steady || flow_.wave_speed != 0) set_impulse((s + 0.5) * dt, dt);
      set_alpha(fluid_.alpha_f_previous, s * dt);
      set_alpha(fluid_.alpha_f, (s + 1) * dt);
      const FluidStepReport report = solver_.advance(fluid_, &force_, dt);
      ASSERT_LT(report.courant, 1);
      ASSERT_LT(report.pressure_residual, 1e-9);
    }
    end_ = end;
    dt_ = dt;
  }

  FlowErrors errors() const {
    return test::flow_errors(fluid_, AtTime{flow_, end_}, AtTime{flow_, end_ - 0.5 * dt_});
  }
  const FluidState& fluid() const { return fluid_; }

 private:
  static Config make_config(const ManufacturedFlow& flow, int n) {
    const int rows = 2 * n / 3;
    Config config =
        test::flow_config({n, rows, rows}, flow.size, test::first_row(flow.size[1], rows, 2.5));
    config.fluid->kinematic_viscosity = flow.nu;
    config.fluid->density = flow.rho;
    config.fluid->turbulence = Turbulence::none;
    config.fluid->bottom = flow.bottom;
    config.fluid->top = flow.top;
    config.solver.pressure_tolerance = 1e-9;
    return config;
  }
  /// Makes the sampled velocity satisfy the discrete continuity equation by a step that is too
  /// short for anything else, and forgets it: otherwise the first rate belongs to another velocity,
  /// which shows as an error of h^2 dt.
  void project() {
    const double instant = 1e-9;
    set_alpha(fluid_.alpha_f_previous, -instant);
    set_alpha(fluid_.alpha_f, 0);
    solver_.advance(fluid_, &force_, instant);
    fluid_.has_history = false;
    fluid_.time = 0;
    for (const Field& p : {fluid_.p, fluid_.p_previous}) Kokkos::deep_copy(p.storage, Real(0));
  }
  void set_alpha(const Field& alpha, double t) const {
    test::set_field(alpha, grid_,
                    [&](int i, int j, int k) { return flow_.alpha(h_.x(i), h_.y(j), h_.z(k), t); });
  }
  void set_impulse(double t, double dt) const {
    const double scale = flow_.rho * dt;
    test::set_field(force_.impulse.x, grid_, [&](int i, int j, int k) {
      return scale * flow_.force(0, h_.x_face(i), h_.y(j), h_.z(k), t);
    });
    test::set_field(force_.impulse.y, grid_, [&](int i, int j, int k) {
      return scale * flow_.force(1, h_.x(i), h_.y_face(j), h_.z(k), t);
    });
    test::set_field(force_.impulse.z, grid_, [&](int i, int j, int k) {
      return scale * flow_.force(2, h_.x(i), h_.y(j), h_.z_face(k), t);
    });
  }

  const ManufacturedFlow flow_;
  Config config_;
  Grid grid_;
  HostGrid h_;
  FluidState fluid_;
  ExchangeOnFaces force_;
  FluidSolver solver_;
  double end_ = 0, dt_ = 0;
};

const char* name(WallFlow wall) { return wall == WallFlow::no_slip ? "no slip" : "free slip"; }

struct Walls {
  WallFlow bottom, top;
};
constexpr Walls kWalls[] = {{WallFlow::no_slip, WallFlow::no_slip},
                            {WallFlow::no_slip, WallFlow::free_slip},
                            {WallFlow::free_slip, WallFlow::free_slip}};

constexpr double kEnd = 0.4;  // [s], some cells are crossed at speeds of order 1 m/s

/// Steps on the mesh of n cells, dt ~ h^power: 4 nu dt sum(1/h^2) is about 0.5 on 48 cells.
int steps_for(int n, int power) {
  return static_cast<int>(std::lround(kEnd / 2.5e-3 * std::pow(n / 48.0, power)));
}

void save(const std::string& table, const char* what, const ManufacturedFlow& flow, int n,
          const FlowErrors& e) {
  test::save_result(table, {{"fraction", std::string(what)},
                            {"walls", std::string(name(flow.bottom)) + " / " + name(flow.top)},
                            {"cells", n},
                            {"u", e.u},
                            {"u_max", e.u_max},
                            {"p", e.p / flow.rho},
                            {"p_max", e.p_max / flow.rho}});
}

/// Two meshes of ratio 2, each with the given pairs of walls.
void expect_second_order_in_space(ManufacturedFlow flow, std::span<const Walls> pairs, int coarse_n,
                                  int power, const char* what) {
  for (const Walls walls : pairs) {
    flow.bottom = walls.bottom;
    flow.top = walls.top;
    std::array<FlowErrors, 2> e;
    for (std::size_t level = 0; level < 2; ++level) {
      const int n = coarse_n << level;
      Run run(flow, n);
      run.advance_to(kEnd, steps_for(n, power));
      e[level] = run.errors();
      std::printf("[ measured ] %s, %d cells: u L2 %.3e max %.3e m/s, p L2 %.3e max %.3e Pa\n",
                  what, n, e[level].u, e[level].u_max, e[level].p, e[level].p_max);
      save("manufactured_" + std::to_string(coarse_n), what, flow, n, e[level]);
    }
    const double u = std::log2(e[0].u / e[1].u), p = std::log2(e[0].p / e[1].p);
    std::printf(
        "[ measured ] order in space, %s, %s / %s: u %.3f, p %.3f, in the maximum u %.3f, p %.3f "
        "(reference 2, tolerance 0.15)\n",
        what, name(flow.bottom), name(flow.top), u, p, std::log2(e[0].u_max / e[1].u_max),
        std::log2(e[0].p_max / e[1].p_max));
    EXPECT_NEAR(u, 2, 0.15) << what << " " << name(flow.bottom) << " " << name(flow.top);
    EXPECT_NEAR(p, 2, 0.15) << what << " " << name(flow.bottom) << " " << name(flow.top);
  }
}

ManufacturedFlow moving_fraction() {
  ManufacturedFlow flow;
  flow.wave_speed = 0.7;
  flow.steady = false;
  return flow;
}

/// The manufactured fields must satisfy continuity, or the orders below mean nothing.
TEST(FluidManufactured, FieldsConserveMassAndStayInRange) {
  for (const Walls walls : kWalls) {
    ManufacturedFlow flow = moving_fraction();
    flow.bottom = walls.bottom;
    flow.top = walls.top;
    for (int n = 0; n < 200; ++n) {
      const double x = 0.0137 * n, y = std::fmod(0.0619 * n, 1), z = 0.0277 * n, t = 0.01 * n;
      EXPECT_NEAR(flow.mass_residual(x, y, z, t), 0, 1e-13);
      EXPECT_GT(flow.alpha(x, y, z, t), 0.4);
      EXPECT_LT(flow.alpha(x, y, z, t), 1);
      for (const std::size_t axis : {0u, 1u, 2u}) {
        if (axis == 1 || walls.bottom == WallFlow::no_slip) {
          EXPECT_NEAR(flow.u(axis, x, 0, z, t), 0, 1e-15);
        }
      }
      EXPECT_NEAR(flow.u(1, x, 1, z, t), 0, 1e-15);
    }
  }
}

TEST(FluidManufactured, FixedFractionIsSecondOrderInSpaceForEveryWall) {
  expect_second_order_in_space(ManufacturedFlow{}, kWalls, 18, 1, "fixed fraction");
}

/// First order in time here (the fraction is taken at the end of the step): dt ~ h^2.
TEST(FluidManufactured, MovingFractionIsSecondOrderInSpaceInHalfAChannel) {
  expect_second_order_in_space(moving_fraction(), std::span(kWalls).subspan(1, 1), 15, 2,
                               "moving fraction");
}

TEST(FluidManufactured, NightlyFinerMeshesShowTheSameOrderForEveryWall) {
  expect_second_order_in_space(ManufacturedFlow{}, kWalls, 24, 1, "fixed fraction");
  expect_second_order_in_space(moving_fraction(), kWalls, 24, 2, "moving fraction");
}

/// RMS difference of two runs on one mesh: what changes with the time step alone.
double difference(const FluidState& a, const FluidState& b) {
  const Grid& grid = a.grid;
  double sum = 0;
  const auto add = [&](const Field& f, const Field& g) {
    const auto p = test::to_host(f), q = test::to_host(g);
    for (int k = 0; k < grid.nz; ++k)
      for (int j = 0; j < grid.ny; ++j)
        for (int i = 0; i < grid.nx; ++i) sum += std::pow(p(i, j, k) - q(i, j, k), 2);
  };
  add(a.u.x, b.u.x);
  add(a.u.y, b.u.y);
  add(a.u.z, b.u.z);
  return std::sqrt(sum / (grid.nx * grid.ny * grid.nz));
}

double order_in_time(const ManufacturedFlow& flow) {
  std::array<std::unique_ptr<Run>, 3> runs;
  for (std::size_t n = 0; n < 3; ++n) {
    runs[n] = std::make_unique<Run>(flow, 12);
    runs[n]->advance_to(kEnd, 40 << n);
  }
  const double coarse = difference(runs[0]->fluid(), runs[1]->fluid());
  const double fine = difference(runs[1]->fluid(), runs[2]->fluid());
  return std::log2(coarse / fine);
}

TEST(FluidManufactured, OrderInTimeIsTwoForAFixedFractionAndOneForAMovingOne) {
  ManufacturedFlow fixed_fraction;
  fixed_fraction.steady = false;
  const double fixed = order_in_time(fixed_fraction), moving = order_in_time(moving_fraction());
  std::printf("[ measured ] order in time, fixed fraction: %.3f (reference 2, tolerance 0.15)\n",
              fixed);
  std::printf("[ measured ] order in time, moving fraction: %.3f (reference 1, tolerance 0.15)\n",
              moving);
  EXPECT_NEAR(fixed, 2, 0.15);
  EXPECT_NEAR(moving, 1, 0.15);
}

}  // namespace
}  // namespace barchan
