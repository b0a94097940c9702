// Every way a run can go wrong is noticed after the step, with its place and a remedy.
#include "src/coupling/state_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "src/base/errors.hpp"
#include "tests/support/coupled_run.hpp"
#include "tests/support/grain_cases.hpp"

namespace barchan {
namespace {

using test::add_grain;
using test::CoupledRun;

constexpr Real d = 2e-4;

/// A box of 6 x 4 x 5 cells of a millimetre.
Config box() { return test::water_box({6, 4, 5}, {0.006, 0.004, 0.005}); }

CoupledRun run_of_two(const Config& c, const Vec3& first, const Vec3& second) {
  InitialGrains grains;
  add_grain(grains, d, first);
  add_grain(grains, d, second);
  return {c, grains};
}

/// Two grains apart, one of them on the floor.
CoupledRun sound_run(int max_iterations = 200) {
  Config c = box();
  c.solver.max_iterations = max_iterations;
  return run_of_two(c, {0.001, 0.5 * d, 0.001}, {0.003, 0.002, 0.0025});
}

std::string complaint(const CoupledRun& run) {
  try {
    StateChecks(run.config, MPI_COMM_SELF).check(run.state, run.step);
  } catch (const StateError& problem) {
    EXPECT_TRUE(problem.on_all_ranks);
    return problem.what();
  }
  return "none";
}

template <class Change>
void change_grain(const CoupledRun& run, std::int64_t id, const Change& change) {
  const GrainState& s = *run.state.grains;
  const auto kin = host_copy(s.kin);
  const auto ids = host_copy(s.id);
  for (int g = 0; g < s.n; ++g) {
    if (ids(g) == id) change(kin(g));
  }
  Kokkos::deep_copy(s.kin, kin);
}

void set_cell(const Field& field, int i, int j, int k, Real value) {
  const auto host = host_copy(field.storage);
  host(i + 1, j + 1, k + 1) = value;
  Kokkos::deep_copy(field.storage, host);
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << text;
}

TEST(StateChecks, SaysNothingOfASoundState) {
  CoupledRun run = sound_run();
  EXPECT_EQ(complaint(run), "none");
  run.advance(3);
  EXPECT_EQ(complaint(run), "none");
}

TEST(StateChecks, OverlapOfAPairBeyondATenth) {
  for (const Real overlap : {0.09, 0.11}) {
    const CoupledRun run =
        run_of_two(box(), {0.003, 0.002, 0.0025}, {0.003 + (1 - overlap) * d, 0.002, 0.0025});
    if (overlap < run.config.grains->max_overlap) {
      EXPECT_EQ(complaint(run), "none");
      continue;
    }
    expect_words(complaint(run), {"grain 1 at (0.003, 0.002, 0.0025) m", "grain 2", "11.0 %",
                                  "grains.youngs_modulus"});
    EXPECT_THROW(
        StateChecks(run.config, MPI_COMM_SELF).check_start(run.state, run.step, "heap.csv"),
        InputError);
  }
}

TEST(StateChecks, OverlapAcrossThePeriodicSide) {
  expect_words(
      complaint(run_of_two(box(), {0.006 - 0.4 * d, 0.002, 0.0025}, {0.4 * d, 0.002, 0.0025})),
      {"20.0 %", "overlap"});
}

TEST(StateChecks, AGrainPressedIntoTheFloorAndOneThroughIt) {
  const CoupledRun run = sound_run();
  change_grain(run, 1, [](GrainKinematics& g) { g.x.y = 0.38 * d; });
  expect_words(complaint(run), {"grain 1 at (0.001, 7.6e-05, 0.001) m", "12.0 %", "the floor"});
  change_grain(run, 1, [](GrainKinematics& g) { g.x.y = -0.1 * d; });
  expect_words(complaint(run), {"grain 1", "has gone through the floor", "time.grain_step"});
  change_grain(run, 1, [](GrainKinematics& g) { g.x.y = 0.0041; });
  expect_words(complaint(run), {"has gone through the top"});
}

TEST(StateChecks, GrainsTooFastOrNotFinite) {
  const CoupledRun run = sound_run();
  // half a radius of 0.1 mm in a grain step of 25 us: 2 m/s, the rim's speed included
  change_grain(run, 2, [](GrainKinematics& g) { g.u = {0, 1.9, 0}; });
  EXPECT_EQ(complaint(run), "none");
  change_grain(run, 2, [](GrainKinematics& g) { g.omega = {0, 0, 0.2 / (d / 2)}; });
  expect_words(complaint(run), {"grain 2 at", "0.53 of its radius", "time.grain_step"});
  for (const Real bad : {Real(NAN), Real(INFINITY)}) {
    change_grain(run, 2, [&](GrainKinematics& g) { g.u = {0, bad, 0}, g.omega = {0, 0, 0}; });
    expect_words(complaint(run), {"grain 2 at", "not finite"});
    change_grain(run, 2, [&](GrainKinematics& g) { g.u = {}, g.omega = {0, 0, bad}; });
    expect_words(complaint(run), {"grain 2 at", "not finite"});
  }
  change_grain(run, 2, [](GrainKinematics& g) { g.omega = {}, g.x.z = NAN; });
  expect_words(complaint(run), {"grain 2 at", "not finite"});
}

TEST(StateChecks, FluidFractionOutOfBounds) {
  for (const Real alpha : {Real(0), Real(-0.02), Real(1.001), Real(NAN)}) {
    const CoupledRun run = sound_run();
    set_cell(run.state.fluid->alpha_f, 4, 2, 3, alpha);
    expect_words(complaint(run), {"alpha_f is outside 0 to 1",
                                  "cell (4, 2, 3) at (0.0045, 0.0025, 0.0035) m", "fluid.cells"});
  }
}

/// Complaint about the flow alone, after a step from velocity u everywhere along x but `odd` in one
/// face along z [m/s].
std::string complaint_of_flow(Real u, Real odd) {
  Config c = box();
  c.grains.reset();
  CoupledRun run(c, {.fluid = make_fluid_state(make_grid(c)), .grains = {}});
  Kokkos::deep_copy(run.state.fluid->u.x.storage, u);
  set_cell(run.state.fluid->u.z, 2, 1, 3, odd);
  run.fill_ghosts();
  run.advance();
  return complaint(run);
}

TEST(StateChecks, CourantNumberBeyondStability) {  // dt / dx = 0.25 s/m
  EXPECT_EQ(complaint_of_flow(3.9, 0), "none");
  expect_words(complaint_of_flow(4.2, 0), {"CFL = 1.05", "cell (", ") m", "below 1.19e-04 s"});
}

TEST(StateChecks, AFlowThatIsNotFinite) {
  expect_words(complaint_of_flow(0.1, NAN), {"no longer finite", "cell (", "time.fluid_step"});
}

TEST(StateChecks, APressureThatWasNotSolved) {
  CoupledRun run = sound_run(1);
  change_grain(run, 2, [](GrainKinematics& g) { g.u = {0.3, -0.2, 0.1}; });
  run.advance(2);
  ASSERT_GT(run.step.fluid_report().pressure_residual, run.config.solver.pressure_tolerance);
  expect_words(complaint(run),
               {"pressure equation", "after 1 iterations", "solver.max_iterations"});
}

TEST(StateChecks, FrozenGrainsMayLieAsTheyLike) {
  Config c = box();
  c.grains->frozen = true;
  EXPECT_EQ(complaint(run_of_two(c, {0.003, 0.002, 0.0025}, {0.0031, 0.002, 0.0025})), "none");
}

}  // namespace
}  // namespace barchan
