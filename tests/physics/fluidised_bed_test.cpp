// A bed of grains on a plate, free to move, is lifted by the fluid that comes through the plate.
#include "tests/support/lattice.hpp"
#include "tests/support/packing.hpp"

namespace barchan {
namespace {

using test::CoupledRun;
using Places = std::vector<Vec3>;

constexpr double kDiameter = 2e-4, kWeightDensity = 1500 * 9.81;  // of solid under water [N/m^3]
constexpr double kPacked = 0.8, kFluidised = 1.5;                 // flows, over the onset by Ergun

double height_of_centre(const Places& x) {
  double sum = 0;
  for (const Vec3& centre : x) sum += centre.x;
  return sum / static_cast<double>(x.size());
}

/// Superficial velocity at which Ergun's drop carries a bed of this solid fraction [m/s].
double ergun_onset(double solid) {
  return test::root(
      [&](double u) {
        return test::ergun_gradient(1 - solid, u, kDiameter) - solid * kWeightDensity;
      },
      1e-6, 0.1);
}

Places places(const CoupledRun& run) {
  Places x;
  const auto rows = run.rows();  // ids count from 1
  for (std::size_t id = 1; id < rows.size(); ++id) x.push_back(rows[id].x);
  return x;
}

/// The lattice that collapses into a bed, in grains and diameters, and the cells on each side.
struct Lattice {
  int across, high;
  double pitch;
  int columns;
};

/// Bed of balls that rest on a plate at x = 0 under gravity along -x, z periodic. It has no
/// friction, so that the side walls carry no weight. Springs are linear: Hertz's give so much at
/// low loads that the fluid takes long to follow their rebound through the pores. Cells are several
/// grains wide: where every pore has its own the fluid finds the loose ones, while Ergun's law is
/// for mean fractions.
class FreeBed {
 public:
  explicit FreeBed(const Lattice& lattice)
      : lattice_(lattice), edge_(lattice.pitch * lattice.across * kDiameter) {
    settle();
  }
  const Places& settled() const { return settled_.x; }
  double area() const { return edge_ * edge_; }
  double solid_volume() const {
    return static_cast<double>(settled_.size()) * test::volume_of(kDiameter);
  }
  double weight() const { return solid_volume() * kWeightDensity / area(); }  // submerged [Pa]
  double length() const { return cells() * kCell; }

  /// Height of a bed: twice that of its centre of mass.
  static double height(const Places& x) { return 2 * height_of_centre(x); }
  double mean_fraction(const Places& x) const { return solid_volume() / (area() * height(x)); }

  /// A run in which the flow rises from rest to a superficial velocity within 10 ms. A point of a
  /// grain that crosses a cell face asks a column as narrow as this for several times the flow of
  /// the onset within that step. In a bed at rest, and for the forces on one that moves evenly, the
  /// fraction's rate of change does not matter: it is left out.
  CoupledRun under_flow(double superficial) const {
    Config c = base();
    c.fluid->mean_velocity = superficial / (1 - solid_volume() / (area() * length()));
    c.fluid->ramp_time = 0.01;
    c.coupling.alpha_time_derivative = false;
    return {c, settled_};
  }

 private:
  static constexpr double kCell = 1.5 * kDiameter;

  int cells() const { return static_cast<int>(lattice_.high * kDiameter / kCell) + 14; }
  Config base() const {
    const int n = lattice_.columns;
    Config c = test::water_box({cells(), n, n}, {length(), edge_, edge_});
    c.grains->gravity = {-9.81, 0, 0};
    c.grains->boundary_x = GrainBoundaryX::wall;
    c.grains->skin = 2e-5;
    c.grains->contact_model = ContactModel::of<LinearSpring>();
    c.grains->linear_stiffness = 20;
    for (Material* m : {&c.grains->material, &c.grains->wall}) {
      m->sliding_friction = 0;
      m->restitution = 0.1;
    }
    c.time.grain_step = 5e-6;
    return c;
  }
  /// A disturbed lattice collapses in vacuum.
  void settle() {
    const int n = lattice_.across;
    settled_ = test::cubic_lattice({lattice_.high, n, n}, lattice_.pitch * kDiameter, kDiameter);
    std::mt19937 engine(3);
    const double most = 0.4 * (lattice_.pitch - 1) * kDiameter;
    std::uniform_real_distribution<double> shift(-most, most);
    for (Vec3& x : settled_.x) x += Vec3{shift(engine), shift(engine), shift(engine)};
    Config c = base();
    c.fluid.reset();
    CoupledRun run(c, settled_);
    run.advance(static_cast<int>((0.07 + 4e-4 * lattice_.high) / c.time.fluid_step));
    settled_.x = places(run);
  }

  Lattice lattice_;
  double edge_;
  InitialGrains settled_;
};

/// Measurements under a steady flow: means over 10 ms, and the bed after them.
struct Reading {
  double superficial = 0, drop = 0;  // [m/s], over the whole bed [Pa]
  double plate = 0;                  // what the plate still carries [Pa]
  Places bed;
};

Reading read(const FreeBed& bed, double superficial, double time) {
  CoupledRun run = bed.under_flow(superficial);
  const int steps = static_cast<int>(time / run.config.time.fluid_step), samples = 40;
  run.advance(steps - samples);
  Reading out;
  for (int n = 0; n < samples; ++n) {
    run.advance();
    const FluidState& f = *run.state.fluid;
    // The fluid above the bed is clear: its velocity is the superficial one.
    out.superficial += test::mean_of_columns(f.u.x, f.grid, f.grid.nx - 2, f.grid.nx) / samples;
    out.drop += 1000 * f.drive.x * bed.length() / samples;
    for (const Vec3& force : test::HostGrains(*run.state.grains).wall_forces()) {
      out.plate += force.x / bed.area() / samples;
    }
  }
  out.bed = places(run);
  return out;
}

/// A bed under a flow that leaves it packed and under one that lifts it.
struct Readings {
  Reading packed, fluidised;

  /// Onset of fluidisation as in the laboratory: where the line of the packed bed meets the
  /// plateau.
  double onset() const { return packed.superficial * fluidised.drop / packed.drop; }
};

Readings read_both(const FreeBed& bed, double time) {
  const double guess = ergun_onset(bed.mean_fraction(bed.settled()));
  Readings r{read(bed, kPacked * guess, time), read(bed, kFluidised * guess, time)};
  const Places& x = r.packed.bed;
  EXPECT_LT(r.packed.drop, 0.9 * bed.weight());
  EXPECT_GT(FreeBed::height(r.fluidised.bed), FreeBed::height(x) + 0.1 * kDiameter);
  test::expect_relative("onset of fluidisation [m/s]", r.onset(), ergun_onset(bed.mean_fraction(x)),
                        0.05);
  return r;
}

/// A layer of grains stays on the plate, because its cells are half in clear fluid. The bed is so
/// high that one layer is less than the tolerance.
TEST(FluidisedBed, NightlyLiftsOffAtErgunsVelocityAndThenCarriesItsWeight) {
  const FreeBed bed({.across = 6, .high = 115, .pitch = 1.05, .columns = 2});
  const Readings r = read_both(bed, 0.22);
  test::expect_relative("drop of the fluidised bed, submerged weight [Pa]", r.fluidised.drop,
                        bed.weight(), 0.01);
}

/// A lower bed, with the load that the plate still carries.
TEST(FluidisedBed, ColumnLiftsOffAtErgunsVelocityAndWaterAndPlateCarryIt) {
  const FreeBed bed({.across = 4, .high = 60, .pitch = 1.03, .columns = 1});
  const Readings r = read_both(bed, 0.08);
  for (const Reading& q : {r.packed, r.fluidised}) {
    test::expect_relative("drop and support by the plate, submerged weight [Pa]", q.drop + q.plate,
                          bed.weight(), 0.01);
  }
}

}  // namespace
}  // namespace barchan
