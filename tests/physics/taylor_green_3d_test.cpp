// The three-dimensional Taylor-Green vortex at Re = 1600: transition and decay of turbulence.
#include <numbers>

#include "kernels/fluid/wale.hpp"
#include "src/parallel/reduce.hpp"
#include "tests/support/flow_errors.hpp"
#include "tests/support/flow_run.hpp"
#include "tests/support/measured.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/saved_results.hpp"

namespace barchan {
namespace {

using namespace testing;
using std::numbers::pi;

/// One time of the spectral reference or of a run; volume means, V0 = L = 1.
struct Record {
  double t = 0, energy = 0, dissipation = 0;  // of a run: resolved and subgrid together
  double resolved = 0;                        // of a run: 2 nu S:S alone
};

/// t, E, -dE/dt of the spectral 512^3 simulation.
std::vector<Record> reference() {
  std::vector<Record> rows;
  for (const auto& row : test::reference_table("tgv3d_re1600_spectral512.csv")) {
    rows.push_back({test::number(row, "t"), test::number(row, "E"), test::number(row, "eps"), 0});
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
class TaylorGreen : test::FlowRun {
 public:
  explicit TaylorGreen(int n)
      : FlowRun(make_config(n)),
        nu_t_("nu_t", grid),
        none_("none", grid),
        c_w_delta_("width", grid.ny) {
    Kokkos::parallel_for("test", grid.ny,
                         FilterWidth{grid, config.fluid->wale_constant, c_w_delta_});
    test::set_velocity(fluid, InitialVortex{});
    solver.fill_ghosts(fluid);
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
    Config config = test::smooth_flow_config({n, n / 2, n}, {2 * pi, pi, 2 * pi}, 0, 1.0 / 1600);
    config.fluid->turbulence = Turbulence::wale;
    config.fluid->density = 1;
    return config;
  }
  void advance(double dt) { courant_ = std::max(courant_, FlowRun::advance(dt).courant); }
  /// The first dt in parts of 1/32, 1/32, 1/16 ... 1/2: the first step is Euler's, which feeds in
  /// energy of dt^2 |du/dt|^2 / 2, for a whole dt 2 % of what viscosity takes by the first record.
  void start(double dt) {
    advance(dt / 32);
    for (int parts = 32; parts > 1; parts /= 2) advance(dt / parts);
  }
  Record record(double t) {
    for_each_cell("test", grid, UpdateEddyViscosity{grid, fluid.u, nu_t_, c_w_delta_.data()});
    solver.boundary().fill(nu_t_, FieldKind::eddy_viscosity);
    const double nu = solver.viscosity();
    const StressDivergence unit{grid, fluid.u, none_, 1};
    const auto mean = [&](const Field& nu_t) {
      return sum_each_cell("test", grid, Dissipation{{grid, fluid.u, nu_t, nu}, unit}) /
             (double(grid.nx) * grid.ny * grid.nz);
    };
    return {t, solver.kinetic_energy(fluid) / (4 * pi * pi * pi), mean(nu_t_), mean(none_)};
  }

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

/// At n cells; a peak within `tolerance` of the reference's, its time within 5 times that.
Outcome expect_decay(int n, double tolerance) {
  TaylorGreen flow(n);
  const std::vector<Record> run = flow.run(10, n / 16);
  const Outcome o = compare(run, reference());
  double subgrid = 0;
  for (const Record& r : run) {
    subgrid = std::max(subgrid, 1 - r.resolved / r.dissipation);
    test::save_result(
        "taylor_green_3d_" + std::to_string(n),
        {{"t", r.t}, {"E", r.energy}, {"dissipation", r.dissipation}, {"resolved", r.resolved}});
  }
  const std::string what = "Taylor-Green Re 1600, " + std::to_string(n) + "^3, ";
  expect_relative(what + "peak dissipation", o.peak, o.reference_peak, tolerance);
  expect_absolute(what + "its time", o.peak_time, o.reference_peak_time, 5 * tolerance);
  expect_below(what + "open budget", o.budget, 0.01);
  print_measured(what + "RMS error of -dE/dt over its peak", o.error, 0, 1);
  print_measured(what + "largest error of E", o.energy, 0, 1);
  print_measured(what + "largest subgrid share", subgrid, 0, 1);
  print_measured(what + "Courant number", flow.courant(), 0, 1);
  return o;
}

/// What 128 cells must reach (peak within 10 %, its time within 0.5) is asked twofold here: the
/// dissipative scales are not resolved on either mesh (a good part of the dissipation is subgrid),
/// so errors need not yet fall by the full factor of four per halving of the cells.
TEST(FluidTaylorGreen3d, CoarseMeshClosesTheBudgetAndFollowsTheDecay) { expect_decay(64, 0.2); }

TEST(FluidTaylorGreen3d, NightlyFineMeshIsCloser) {
  const Outcome coarse = expect_decay(64, 0.2), fine = expect_decay(128, 0.1);
  EXPECT_LT(fine.error, coarse.error);
  EXPECT_LT(fine.energy, coarse.energy);
}

}  // namespace
}  // namespace barchan
