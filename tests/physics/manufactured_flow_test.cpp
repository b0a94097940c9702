// Order of accuracy of the volume-averaged equations from manufactured solutions.
#include "tests/support/manufactured_flow.hpp"

#include <memory>
#include <span>

#include "tests/support/flow_errors.hpp"
#include "tests/support/flow_run.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/saved_results.hpp"

namespace barchan {
namespace {

using namespace test;
using test::FlowErrors;
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
class Run : public test::FlowRun {
 public:
  Run(const ManufacturedFlow& flow, int n)
      : FlowRun(make_config(flow, n)), flow_(flow), force_{make_faces("test", grid)} {
    test::set_velocity(fluid, AtTime{flow_, 0});
    solver.fill_ghosts(fluid);
    project();
  }

  void advance_to(double end, int steps) {
    const double dt = end / steps;
    for (int s = 0; s < steps; ++s) {
      // Convection and stress are extrapolated to the middle of the step (Adams-Bashforth) and the
      // pressure solved for is that of the middle: so the force belongs there, too.
      if (s == 0 || !flow_.steady || flow_.wave_speed != 0) set_impulse((s + 0.5) * dt, dt);
      set_alpha(fluid.alpha_f_previous, s * dt);
      set_alpha(fluid.alpha_f, (s + 1) * dt);
      advance(dt, &force_);
      ASSERT_LT(report.courant, 1);
      ASSERT_LT(report.pressure_residual, 1e-9);
    }
    end_ = end;
    dt_ = dt;
  }

  FlowErrors errors() const {
    return test::flow_errors(fluid, AtTime{flow_, end_}, AtTime{flow_, end_ - 0.5 * dt_});
  }

 private:
  static Config make_config(const ManufacturedFlow& flow, int n) {
    const int rows = 2 * n / 3;
    Config config = test::smooth_flow_config({n, rows, rows}, flow.size,
                                             test::first_row(flow.size[1], rows, 2.5), flow.nu);
    config.grains.emplace();  // for a flow with exchange
    config.fluid->density = flow.rho;
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
    set_alpha(fluid.alpha_f_previous, -instant);
    set_alpha(fluid.alpha_f, 0);
    advance(instant, &force_);
    fluid.has_history = false;
    fluid.time = 0;
    for (const Field& p : {fluid.p, fluid.p_previous}) Kokkos::deep_copy(p.storage, Real(0));
  }
  void set_alpha(Field& alpha, double t) {
    test::set_field(alpha, grid,
                    [&](int i, int j, int k) { return flow_.alpha(h.x(i), h.y(j), h.z(k), t); });
  }
  void set_impulse(double t, double dt) {
    test::set_faces(force_.impulse, grid, [&](std::size_t axis, double x, double y, double z) {
      return flow_.rho * dt * flow_.force(axis, x, y, z, t);
    });
  }

  const ManufacturedFlow flow_;
  ExchangeOnFaces force_;
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
      save("manufactured_" + std::to_string(coarse_n), what, flow, n, e[level]);
    }
    const std::string claim = std::string(what) + ", " + name(flow.bottom) + " / " + name(flow.top);
    expect_order(claim + ", u", e[0].u, e[1].u, 2, 0.15);
    expect_order(claim + ", p", e[0].p, e[1].p, 2, 0.15);
    print_measured("order, " + claim + ", largest error of p", std::log2(e[0].p_max / e[1].p_max),
                   2, 0.15);
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
  for (const Field FaceVector::*axis : {&FaceVector::x, &FaceVector::y, &FaceVector::z}) {
    const auto p = test::to_host(a.u.*axis), q = test::to_host(b.u.*axis);
    test::for_owned_cells(
        grid, [&](int i, int j, int k) { sum += std::pow(p(i, j, k) - q(i, j, k), 2); });
  }
  return std::sqrt(sum / (grid.nx * grid.ny * grid.nz));
}

void expect_order_in_time(const char* what, const ManufacturedFlow& flow, double order) {
  std::array<std::unique_ptr<Run>, 3> runs;
  for (std::size_t n = 0; n < 3; ++n) {
    runs[n] = std::make_unique<Run>(flow, 12);
    runs[n]->advance_to(kEnd, 40 << n);
  }
  expect_order(what, difference(runs[0]->fluid, runs[1]->fluid),
               difference(runs[1]->fluid, runs[2]->fluid), order, 0.15);
}

TEST(FluidManufactured, OrderInTimeIsTwoForAFixedFractionAndOneForAMovingOne) {
  ManufacturedFlow fixed_fraction;
  fixed_fraction.steady = false;
  expect_order_in_time("in time, fixed fraction", fixed_fraction, 2);
  expect_order_in_time("in time, moving fraction", moving_fraction(), 1);
}

}  // namespace
}  // namespace barchan
