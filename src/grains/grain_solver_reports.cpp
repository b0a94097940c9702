// Reports of the grain solver about the contacts of the last grain step.
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "kernels/diagnostics/contact_forces.hpp"
#include "kernels/grains/grain_sums.hpp"
#include "kernels/grains/stable_step.hpp"
#include "src/grains/grain_solver.hpp"
#include "src/parallel/reduce.hpp"

namespace barchan {

/// Upper bound of a contact force on a body [N]: overlap of one diameter, which no run lets happen.
/// Scales the fixed-point sums.
Real GrainSolver::strongest_on_body(Real r_max) const {
  Real strongest = 0;
  with_laws([&](const auto&, const auto& of_walls) {
    for (const auto& stiffness : of_walls.stiffness)
      strongest = std::max(strongest, stiffness(r_max, 1, 2 * r_max).elastic);
  });
  return strongest;
}

void GrainSolver::split_contacts(const GrainState& grains, const Kokkos::View<Vec3*>& normal,
                                 const Kokkos::View<Vec3*>& tangential) const {
  if (!grains.list.has_force()) {
    throw std::logic_error("the forces of pairs were not kept: set output.grain_forces");
  }
  Kokkos::parallel_for("output: split contacts", grains.list.chunks.count(),
                       SplitContacts{.box = list_.box(),
                                     .list = grains.list,
                                     .grains = grains.kin,
                                     .contact_force = grains.contact_force,
                                     .wall_touching = grains.wall_touching,
                                     .walls = walls_,
                                     .body_touching = grains.body_touching,
                                     .bodies = bodies(),
                                     .normal = normal,
                                     .tangential = tangential});
}

Real GrainSolver::stable_step(const GrainState& grains) const {
  Real of_pairs = std::numeric_limits<Real>::infinity(), of_grains = of_pairs;
  const Kokkos::View<Real* [2]> sums("tangential sums", static_cast<std::size_t>(grains.n));
  bool slides = false;
  with_laws([&]<class Laws>(const Laws& pairs, const Laws& walls) {
    for (const Laws* laws : {&pairs, &walls})
      for (const Friction& friction : laws->friction) slides = slides || friction.sliding != 0;
    if (!slides) return;
    Kokkos::parallel_reduce("grains: tangential stiffness of pairs", items(grains.list.n_pairs),
                            TangentialOfPairs<Laws>{.laws = pairs,
                                                    .box = list_.box(),
                                                    .list = grains.list,
                                                    .grains = grains.kin,
                                                    .sums = sums,
                                                    .kind = grains.kind,
                                                    .id = grains.id,
                                                    .shapes = grains.shapes},
                            Kokkos::Min<Real>(of_pairs));
    const StableStepOfGrains<Laws> of_each{.laws = walls,
                                           .walls = walls_,
                                           .bodies = bodies(),
                                           .grains = grains.kin,
                                           .sums = sums,
                                           .kind = grains.kind,
                                           .id = grains.id,
                                           .shapes = grains.shapes};
    if (grains.clump.size() > 0) {
      Kokkos::parallel_reduce(
          "clumps: stable step", items(grains.members.n),
          StableStepOfClumps<Laws>{.spheres = of_each, .members = grains.members},
          Kokkos::Min<Real>(of_grains));
      return;
    }
    Kokkos::parallel_reduce("grains: stable step", items(grains.n), of_each,
                            Kokkos::Min<Real>(of_grains));
  });
  return slides ? -max_over(grains.ranks, -std::min(of_pairs, of_grains)) : of_pairs;
}

ContactSummary GrainSolver::contacts(const GrainState& grains) const {
  ContactSummary summary;
  Kokkos::parallel_reduce(
      "grains: contact summary", grains.list.n_pairs,
      ContactsOfPairs{
          .box = list_.box(), .list = grains.list, .grains = grains.kin, .n_owned = grains.n},
      summary.n_contacts, Kokkos::Max<Real>(summary.max_overlap));
  if (summary.n_contacts == 0)
    summary.max_overlap = 0;  // the maximum over nothing is minus infinity
  return {.n_contacts = sum_over(grains.ranks, summary.n_contacts),
          .max_overlap = max_over(grains.ranks, summary.max_overlap)};
}

}  // namespace barchan
