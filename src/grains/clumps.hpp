// Grains that are clumps of spheres: their shapes, and the way from grains to spheres and back.
#pragma once

#include <string>
#include <vector>

#include "kernels/grains/clump_motion.hpp"
#include "kernels/grains/step_limit.hpp"
#include "src/grains/clump_members.hpp"
#include "src/grains/clump_shape.hpp"
#include "src/grains/grain_state.hpp"
#include "src/grains/grains_case.hpp"
#include "src/grains/initial_grains.hpp"

namespace barchan {

/// Spheres of the clump that a case names or gives.
std::vector<ClumpSphere> spheres_of(const ShapeConfig& shape);
/// Tells if grains of this shape are clumps; a clump of one sphere is a sphere.
bool is_clump(const ShapeConfig& shape);
/// What is wrong with the spheres of a clump, as a sentence; empty if nothing.
std::string problem_of(const ShapeConfig& shape);
bool has_clumps(const GrainConfig& grains);
/// Number of spheres of a grain.
int sphere_count(const ShapeConfig& shape);

/// Fault of grains that come with the shape `theirs` for a kind of the case, in words that follow
/// "must"; empty if it is the kind's. A clump by its name and one by a table, in any unit and
/// order, are the same if their spheres are, to 1e-6 of the diameter.
std::string unlike_shape(const GrainConfig& grains, int kind, const ShapeConfig& theirs);

/// Diameter of the sphere around the grains of a kind, over that of the sphere of their volume.
double width_of(const ShapeConfig& shape);
/// Smallest and largest diameter of the spheres around grains of these sizes [m]; not empty.
struct Widths {
  double least = 0, most = 0;
};
Widths widths_of(const GrainConfig& grains, const std::vector<SizeClass>& sizes);
/// Radius of the smallest sphere of a grain, over the diameter of the sphere of its volume.
double least_radius(const ShapeConfig& shape);
/// Longest distance from the centre of a grain to that of one of its spheres [m], if the largest
/// sphere of each kind has the radius `r_max` [m].
LongestArm longest_arm(const GrainConfig& grains, Real r_max);

/// Inertia of grains of this shape in contacts of the sphere that turns them most easily.
InertiaInContacts inertia_of(const ShapeConfig& shape);

/// Shapes of all kinds for kernels.
ClumpShapes clump_shapes(const GrainConfig& grains);

/// Spheres of the grains of a case with clumps. Clumps that come without an orientation get a
/// random one by `seed` and their numbers. Grains of other cases stay as they are.
InitialGrains as_spheres(const InitialGrains& grains, const GrainConfig& config,
                         std::uint64_t seed);

/// Clumps of a state with clumps, for kernels.
inline ClumpsOfGrains clumps_of(const GrainState& grains) {
  return {grains.shapes, grains.members, grains.clump, grains.kind};
}

/// Whole grains: one entry for each clump, with its centre, velocity and spin and the diameter of
/// the sphere of its volume; forces and torques are those on the clump, those of the fluid too. The
/// same state where there are no clumps.
GrainState whole_grains(const GrainState& grains);
/// Sum over the spheres of each clump, in the order of whole_grains(); empty stays empty.
Kokkos::View<const Vec3*> sum_over_spheres(const GrainState& grains,
                                           const Kokkos::View<const Vec3*>& of_spheres);

}  // namespace barchan
