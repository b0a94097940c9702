// Exchange between fluid and grains: nothing is lost on the way, in either direction.
#include <gtest/gtest.h>

#include "src/parallel/reduce.hpp"
#include "src/run/initial_state.hpp"
#include "tests/support/coupled_case.hpp"
#include "tests/support/coupled_run.hpp"

namespace barchan {
namespace {

using testing::coupled_config;

struct Coupled : test::CoupledRun {
  explicit Coupled(const Config& c) : CoupledRun(c, make_initial_state(c, {})) {}
};

TEST(Coupling, LedgerClosesToRoundOff) {
  Coupled c(coupled_config());
  c.advance(30);
  const auto& entries = c.step.ledger().entries();
  EXPECT_LT(entries.at("largest_volume_mismatch"), 1e-12);
  EXPECT_LT(entries.at("largest_exchange_mismatch"), 1e-10);
  EXPECT_LT(entries.at("largest_carried_mismatch"), 1e-10);
  EXPECT_GT(entries.at("impulse_given_to_grains_x"), 0) << "the flow pushes the grains along";
  EXPECT_NE(entries.at("impulse_implicit_on_fluid_x"), 0);
}

TEST(Coupling, LedgerClosesWithEveryVoidFractionAndDragLaw) {
  for (const VoidFraction v : {VoidFraction::divided, VoidFraction::centre}) {
    for (const DragLaw law : {DragLaw::di_felice, DragLaw::koch_hill, DragLaw::syamlal_obrien,
                              DragLaw::beetstra, DragLaw::paper_repaired}) {
      Config config = coupled_config();
      config.coupling.void_fraction = v;
      config.coupling.drag = law;
      Coupled c(config);
      c.advance(3);
      EXPECT_LT(c.step.ledger().entries().at("largest_exchange_mismatch"), 1e-10);
      EXPECT_LT(c.step.ledger().entries().at("largest_volume_mismatch"), 1e-12);
    }
  }
}

struct SolidFraction {
  GridRef grid;
  ConstFieldRef alpha;
  bool times_volume;
  KOKKOS_FUNCTION Real operator()(int i, int j, int k) const {
    return (1 - alpha(i, j, k)) * (times_volume ? grid.cell_volume(j) : Real(1));
  }
};

TEST(Coupling, FluidFractionIsThatOfTheGrainsAndBounded) {
  Coupled c(coupled_config());
  const Grid grid = c.state.fluid->grid;
  const Field alpha = c.state.fluid->alpha_f;
  const Real solid = sum_each_cell("test: solid", grid, SolidFraction{grid, alpha, true});
  const Real expected =
      20 * sphere_volume(7.5e-5) + 160 * sphere_volume(1e-4) + 20 * sphere_volume(1.25e-4);
  EXPECT_NEAR(solid / expected, 1, 1e-12);
  const Real densest = max_each_cell("test: densest", grid, SolidFraction{grid, alpha, false});
  EXPECT_GT(densest, 0.05);
  EXPECT_LT(densest, 0.75);
}

TEST(Coupling, PressureConvergesAndContinuityHolds) {
  Config config = coupled_config();
  config.solver.pressure_tolerance = 1e-6;
  Coupled c(config);
  for (int s = 0; s < 20; ++s) {
    c.advance(1);
    EXPECT_LE(c.step.fluid_report().pressure_iterations, 20);
    EXPECT_LE(c.step.fluid_report().pressure_residual, 1e-6);
    EXPECT_LT(c.step.fluid_report().continuity_residual, 1e-4);
  }
}

/// Values of all fields of a flow, ghosts that are not kept left out.
std::vector<Real> owned_values(const FluidState& fluid) {
  std::vector<Real> values;
  for (const Field& f : {fluid.u.x, fluid.u.y, fluid.u.z, fluid.p, fluid.p_previous, fluid.nu_t,
                         fluid.rate_previous.x, fluid.rate_previous.y, fluid.rate_previous.z,
                         fluid.du_dt.x, fluid.du_dt.y, fluid.du_dt.z}) {
    const auto host = test::to_host(f);
    test::for_owned_cells(fluid.grid,
                          [&](int i, int j, int k) { values.push_back(host(i, j, k)); });
  }
  return values;
}

TEST(Coupling, TheFlowDoesNotReadWhatOthersLeftInIdleFields) {
  Coupled a(coupled_config()), b(coupled_config());
  a.advance(3), b.advance(3);
  for (const Field& field : b.step.scratch_fields()) {
    Kokkos::deep_copy(field.storage, Kokkos::Experimental::quiet_NaN_v<Real>);
  }
  for (Coupled* c : {&a, &b}) c->step.advance_fluid(c->state);
  EXPECT_EQ(owned_values(*a.state.fluid), owned_values(*b.state.fluid));
}

TEST(Coupling, BulkVelocityIsHeld) {
  Coupled c(coupled_config());
  c.advance(40);
  EXPECT_NEAR(c.step.bulk_velocity(c.state), 0.2, 2e-4);
}

TEST(Coupling, FrozenGrainsStayAndDragTheFlow) {
  Config config = coupled_config();
  config.grains->frozen = true;
  Coupled c(config);
  const auto before = c.rows();
  c.advance(10);
  const auto after = c.rows();
  for (std::size_t id = 1; id < after.size(); ++id) {
    EXPECT_EQ(norm(after[id].x - before[id].x), 0);
  }
  EXPECT_GT(c.step.ledger().entries().at("impulse_taken_from_fluid_x"), 0);
  EXPECT_LT(c.step.ledger().entries().at("largest_exchange_mismatch"), 1e-10);
}

/// Of each grain: contact forces to what the contacts gave, all parts and the weight to the total.
TEST(Coupling, PartsOfTheForceAddUp) {
  for (const Exchange exchange : {Exchange::smoothed, Exchange::by_row}) {
    Config config = coupled_config();
    config.output.grain_forces = true;
    config.coupling.exchange = exchange;
    Coupled c(config);
    c.advance(5);
    const auto forces = c.step.grain_forces(c.state);
    ASSERT_EQ(forces.size(), 7u);
    const auto kin = testing::host_copy(c.state.grains->kin);
    const auto contact = testing::host_copy(c.state.grains->contact_force);
    const auto n = static_cast<std::size_t>(c.state.grains->n);
    std::vector<Vec3> of_contacts(n), of_all(n), total(n);
    for (const NamedForce& f : forces) {
      const auto values = testing::host_copy(f.values);
      for (std::size_t g = 0; g < n; ++g) {
        if (f.name.starts_with("force_contact")) of_contacts[g] += values(g);
        (f.name == "force_total" ? total : of_all)[g] += values(g);
        if (f.name == "force_pressure_gradient" || f.name == "force_stress") {
          EXPECT_GT(norm(values(g)), 0) << f.name;
        }
      }
    }
    for (std::size_t g = 0; g < n; ++g) {
      const double size = norm(contact(g)) + norm(total[g]) + kin(g).m * 9.81;
      const Vec3 weight{0, -9.81 * (kin(g).m - 1000 * sphere_volume(kin(g).r)), 0};
      EXPECT_NEAR(norm(of_contacts[g] - contact(g)), 0, 1e-12 * size);
      EXPECT_NEAR(norm(of_all[g] + weight - total[g]), 0, 1e-12 * size);
    }
  }
}

}  // namespace
}  // namespace barchan
