// The three-dimensional Taylor-Green vortex at Re = 1600: transition and decay of turbulence.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "kernels/fluid/wale.hpp"
#include "src/fluid/fluid_solver.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/flow_errors.hpp"
#include "tests/support/saved_results.hpp"

namespace barchan {
namespace {

using std::numbers::pi;

/// One time of the spectral reference or of a run; volume means, V0 = L = 1.
struct Record {
  double t = 0, energy = 0, dissipation = 0;  // of a run: resolved and subgrid together
  double resolved = 0;                        // of a run: 2 nu S:S alone
};

/// t, E, -dE/dt of the spectral 512^3 simulation.
std::vector<Record> reference() {
  std::ifstream file(BARCHAN_SOURCE_DIR "/tests/reference/tgv3d_re1600_spectral512.csv");
  std::vector<Record> rows;
  for (std::string line; std::getline(file, line);) {
    Record r;
    char comma;
    if (std::istringstream in(line); in >> r.t >> comma >> r.energy >> comma >> r.dissipation)
      rows.push_back(r);
  }
  return rows;
}

/// -dE/dt of the reference, linear between its rows (0.05 apart).
double reference_dissipation(const std::vector<Record>& rows, double t) {
  for (std::size_t n = 1; n < rows.size(); ++n) {
    if (rows[n].t >= t) {
      const double share = (t - rows[n - 1].t) / (rows[n].t - rows[n - 1].t);
      return rows[n - 1].dissipation + share * (rows[n].dissipation - rows[n - 1].dissipation);
    }
  }
  return 0;
}

/// 2 (nu + nu_t) S:S with every component of S where the grid has it: summed over a box without
/// shear on its walls, the work of the stress by parts.
struct Dissipation {
  StressDivergence stress, twice_strain;  // the second with unit viscosity
  KOKKOS_FUNCTION Real operator()(int i, int j, int k) const {
    const StressDivergence &a = stress, &b = twice_strain;
    return Real(0.5) * (a.xx(i, j, k) * b.xx(i, j, k) + a.yy(i, j, k) * b.yy(i, j, k) +
                        a.zz(i, j, k) * b.zz(i, j, k)) +
           a.xy(i, j, k) * b.xy(i, j, k) + a.xz(i, j, k) * b.xz(i, j, k) +
           a.yz(i, j, k) * b.yz(i, j, k);
  }
};

struct InitialVortex {
  double u(std::size_t axis, double x, double y, double z) const {
    if (axis == 0) return std::sin(x) * std::cos(y) * std::cos(z);
    if (axis == 1) return -std::cos(x) * std::sin(y) * std::cos(z);
    return 0;
  }
};

/// n cells per 2 pi. y = 0 and y = pi are planes of symmetry: free-slip walls there halve the box.
class TaylorGreen {
 public:
  explicit TaylorGreen(int n)
      : config_(make_config(n)),
        grid_(make_grid(config_)),
        fluid_(make_fluid_state(grid_)),
        solver_(config_, grid_),
        nu_t_("nu_t", grid_),
        none_("none", grid_),
        c_w_delta_("width", grid_.ny) {
    Kokkos::parallel_for("test", grid_.ny,
                         FilterWidth{grid_, config_.fluid->wale_constant, c_w_delta_});
    test::set_velocity(fluid_, InitialVortex{});
    solver_.fill_ghosts(fluid_);
  }

  /// Records 0.05 apart up to `end`.
  std::vector<Record> run(double end, int steps_per_record) {
    const double dt = 0.05 / steps_per_record;
    std::vector<Record> records{record(0)};
    start(dt);
    for (int n = 1; n * 0.05 <= end + 1e-9; ++n) {
      for (int s = n == 1 ? 1 : 0; s < steps_per_record; ++s) advance(dt);
      records.push_back(record(n * 0.05));
    }
    return records;
  }
  double courant() const { return courant_; }

 private:
  static Config make_config(int n) {
    Config config = test::flow_config({n, n / 2, n}, {2 * pi, pi, 2 * pi}, 0);
    config.fluid->density = 1;
    config.fluid->kinematic_viscosity = 1.0 / 1600;
    config.fluid->bottom = config.fluid->top = WallFlow::free_slip;
    return config;
  }
  void advance(double dt) {
    courant_ = std::max(courant_, solver_.advance(fluid_, nullptr, dt).courant);
  }
  /// The first dt in parts of 1/32, 1/32, 1/16 ... 1/2: the first step is Euler's, which feeds in
  /// energy of dt^2 |du/dt|^2 / 2, for a whole dt 2 % of what viscosity takes by the first record.
  void start(double dt) {
    advance(dt / 32);
    for (int parts = 32; parts > 1; parts /= 2) advance(dt / parts);
  }
  Record record(double t) {
    for_each_cell("test", grid_, UpdateEddyViscosity{grid_, fluid_.u, nu_t_, c_w_delta_.data()});
    solver_.boundary().fill(nu_t_, FieldKind::eddy_viscosity);
    const double nu = solver_.viscosity();
    const StressDivergence unit{grid_, fluid_.u, none_, 1};
    const auto mean = [&](const Field& nu_t) {
      return sum_each_cell("test", grid_, Dissipation{{grid_, fluid_.u, nu_t, nu}, unit}) /
             (double(grid_.nx) * grid_.ny * grid_.nz);
    };
    return {t, solver_.kinetic_energy(fluid_) / (4 * pi * pi * pi), mean(nu_t_), mean(none_)};
  }

  Config config_;
  Grid grid_;
  FluidState fluid_;
  FluidSolver solver_;
  Field nu_t_, none_;
  Kokkos::View<Real*> c_w_delta_;
  double courant_ = 0;
};

struct Outcome {
  double peak = 0, peak_time = 0;  // of -dE/dt
  double reference_peak = 0, reference_peak_time = 0;
  double error = 0;   // RMS over time of -dE/dt against the reference, over the reference's peak
  double energy = 0;  // largest |E - E reference| / E reference
  double budget = 0;  // largest |dE/dt + dissipation| / dissipation
};

Outcome compare(const std::vector<Record>& run, const std::vector<Record>& exact) {
  Outcome o;
  for (const Record& r : exact) {
    if (r.dissipation > o.reference_peak) {
      o.reference_peak = r.dissipation;
      o.reference_peak_time = r.t;
    }
  }
  double sum = 0;
  for (std::size_t n = 1; n + 1 < run.size(); ++n) {
    const double rate = (run[n - 1].energy - run[n + 1].energy) / (run[n + 1].t - run[n - 1].t);
    // Simpson's mean over the same interval.
    const double dissipation =
        (run[n - 1].dissipation + 4 * run[n].dissipation + run[n + 1].dissipation) / 6;
    o.budget = std::max(o.budget, std::abs(rate / dissipation - 1));
    if (rate > o.peak) {
      o.peak = rate;
      o.peak_time = run[n].t;
    }
    sum += std::pow(rate - reference_dissipation(exact, run[n].t), 2);
  }
  o.error = std::sqrt(sum / static_cast<double>(run.size() - 2)) / o.reference_peak;
  for (const Record& r : run) {
    for (const Record& e : exact) {
      if (std::abs(r.t - e.t) < 1e-6)
        o.energy = std::max(o.energy, std::abs(r.energy / e.energy - 1));
    }
  }
  return o;
}

Outcome taylor_green(int n, double end) {
  TaylorGreen flow(n);
  const std::vector<Record> run = flow.run(end, n / 16);
  const Outcome o = compare(run, reference());
  double subgrid = 0;
  for (const Record& r : run) {
    subgrid = std::max(subgrid, 1 - r.resolved / r.dissipation);
    test::save_result(
        "taylor_green_3d_" + std::to_string(n),
        {{"t", r.t}, {"E", r.energy}, {"dissipation", r.dissipation}, {"resolved", r.resolved}});
  }
  std::printf(
      "[ measured ] Taylor-Green Re 1600, %d^3: peak dissipation %.5f at t = %.2f (reference %.5f "
      "at "
      "%.2f); RMS error of -dE/dt %.2f %% of the peak; E off by %.2f %% at most; budget open by "
      "%.3f "
      "%%; subgrid share at most %.1f %%; Courant number %.2f\n",
      n, o.peak, o.peak_time, o.reference_peak, o.reference_peak_time, 100 * o.error,
      100 * o.energy, 100 * o.budget, 100 * subgrid, flow.courant());
  return o;
}

/// What 128 cells must reach (peak within 10 %, its time within 0.5) is asked twofold here: the
/// dissipative scales are not resolved on either mesh (a good part of the dissipation is subgrid),
/// so errors need not yet fall by the full factor of four per halving of the cells.
TEST(FluidTaylorGreen3d, CoarseMeshClosesTheBudgetAndFollowsTheDecay) {
  const Outcome o = taylor_green(64, 10);
  EXPECT_LT(o.budget, 0.01);
  EXPECT_NEAR(o.peak, o.reference_peak, 0.2 * o.reference_peak);
  EXPECT_NEAR(o.peak_time, o.reference_peak_time, 1.0);
}

TEST(FluidTaylorGreen3d, NightlyFineMeshIsCloser) {
  const Outcome coarse = taylor_green(64, 10), fine = taylor_green(128, 10);
  EXPECT_LT(fine.budget, 0.01);
  EXPECT_NEAR(fine.peak, fine.reference_peak, 0.1 * fine.reference_peak);
  EXPECT_NEAR(fine.peak_time, fine.reference_peak_time, 0.5);
  EXPECT_LT(fine.error, coarse.error);
  EXPECT_LT(fine.energy, coarse.energy);
}

}  // namespace
}  // namespace barchan
