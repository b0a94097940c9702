#include "src/grains/clumps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <limits>
#include <numbers>

#include "kernels/grains/sphere.hpp"
#include "kernels/math/random.hpp"
#include "src/base/enum_names.hpp"
#include "src/grains/grain_kinds.hpp"
#include "src/grains/inertia_in_contacts.hpp"
#include "src/grains/kinds.hpp"
#include "src/grains/named_clumps.hpp"
#include "src/parallel/launch.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

namespace {

constexpr Real kPi = std::numbers::pi_v<Real>;
constexpr std::uint64_t kPurpose = 74;  // of the random numbers of orientations

/// Shape of a kind, of volume pi/6, with its inertia in the contacts of each sphere.
struct KnownShape {
  std::vector<ClumpSphere> given;
  ClumpShape shape;
  std::vector<InertiaInContacts> in_contacts;
  std::string problem = {};
};

/// Shape of a kind, found once. One with a problem, as check_shapes tells, is taken as a sphere.
const KnownShape& known_shape(const ShapeConfig& shape) {
  static const KnownShape sphere{{},
                                 {.spheres = {{{}, 0.5}},
                                  .shares = {1},
                                  .inertia = {0.1, 0.1, 0.1},
                                  .bounding_radius = 0.5,
                                  .surface = kPi,
                                  .projected_areas = {kPi / 4, kPi / 4, kPi / 4}},
                                 {{}}};
  static std::deque<KnownShape> known;
  const std::vector<ClumpSphere> spheres = spheres_of(shape);
  if (!is_clump(shape) || spheres.size() > kMostSpheres) return sphere;
  for (const KnownShape& one : known)
    if (one.given == spheres) return one;
  const auto [made, problem] = make_clump(spheres);
  if (!problem.empty())
    return known.emplace_back(KnownShape{spheres, sphere.shape, sphere.in_contacts, problem});
  return known.emplace_back(KnownShape{spheres, made, inertia_in_contacts(made)});
}

const ClumpShape& shape_of(const ShapeConfig& shape) { return known_shape(shape).shape; }

/// Tells if every sphere of a clump of diameter 1 is one of another, to 1e-6 of the diameter.
bool among(const std::vector<ClumpSphere>& some, const std::vector<ClumpSphere>& all) {
  constexpr Real near = 1e-6;
  return std::ranges::all_of(some, [&](const ClumpSphere& a) {
    return std::ranges::any_of(all, [&](const ClumpSphere& b) {
      return norm(a.centre - b.centre) < near && std::abs(a.radius - b.radius) < near;
    });
  });
}

bool same_shape(const ShapeConfig& a, const ShapeConfig& b) {
  if (!is_clump(a) || !is_clump(b)) return is_clump(a) == is_clump(b);
  const std::size_t count = spheres_of(a).size();
  if (count != spheres_of(b).size() || count > kMostSpheres) return spheres_of(a) == spheres_of(b);
  const auto &one = shape_of(a).spheres, &other = shape_of(b).spheres;
  return among(one, other) && among(other, one);
}

/// Name of a shape for messages.
std::string words_of(const ShapeConfig& shape) {
  if (!is_clump(shape)) return "spheres";
  for (std::size_t n = 0; n < kNamedClumps.size(); ++n) {
    const ShapeConfig named{.shape = GrainShape::clump, .clump = static_cast<NamedClump>(n)};
    if (same_shape(shape, named)) return fmt::format("clumps \"{}\"", kNamedClumps[n]);
  }
  return fmt::format("clumps of {} spheres", spheres_of(shape).size());
}

/// Key that says the shape of a kind.
std::string key_of_shape(const GrainConfig& grains, std::size_t kind) {
  const ShapeConfig shape = all_kinds(grains)[kind].shape;
  const char* key = !is_clump(shape) ? "shape" : shape.clump ? "clump" : "spheres";
  return fmt::format("{}.{}", section_of_kind(grains, kind), key);
}

/// Random rotation, all of them alike: Shoemake, Graphics Gems III, 124 (1992).
Quaternion random_orientation(std::uint64_t seed, std::int64_t number) {
  const auto count = 3 * static_cast<std::uint64_t>(number);
  const auto uniform = [&](std::uint64_t n) { return uniform_number(seed, kPurpose, count + n); };
  const Real u = uniform(0), a = 2 * kPi * uniform(1), b = 2 * kPi * uniform(2);
  const Real r = std::sqrt(1 - u), s = std::sqrt(u);
  return {s * std::cos(b), r * std::sin(a), r * std::cos(a), s * std::sin(b)};
}

template <class Value>
Kokkos::View<const Value*> on_device(const char* name, const std::vector<Value>& values) {
  const Kokkos::View<Value*> there(name, values.size());
  const auto host = mirror(there);
  std::ranges::copy(values, host.data());
  Kokkos::deep_copy(there, host);
  return there;
}

/// Takes the entries of the first spheres of clumps; an array that is not there stays empty.
template <class T>
void take_of_heads(const ClumpsOfGrains& clumps, const Kokkos::View<T*>& from,
                   Kokkos::View<T*>& to) {
  if (from.size() == 0) return;
  to = Kokkos::View<T*>(from.label(), static_cast<std::size_t>(std::max(clumps.members.n, 1)));
  const auto of_heads = to;
  Kokkos::parallel_for(
      "clumps: entries of heads", items(clumps.members.n),
      KOKKOS_LAMBDA(int c) { of_heads(c) = from(clumps.head(c)); });
}

}  // namespace

std::vector<ClumpSphere> spheres_of(const ShapeConfig& shape) {
  if (!shape.spheres.empty() || !shape.clump) return shape.spheres;
  return named_clump(kEnumNames<NamedClump>[static_cast<std::size_t>(*shape.clump)]);
}

bool is_clump(const ShapeConfig& shape) {
  return shape.shape == GrainShape::clump && spheres_of(shape).size() > 1;
}

std::string problem_of(const ShapeConfig& shape) {
  return is_clump(shape) ? known_shape(shape).problem : make_clump(spheres_of(shape)).problem;
}

bool has_clumps(const GrainConfig& grains) {
  return std::ranges::any_of(all_kinds(grains),
                             [](const KindConfig& kind) { return is_clump(kind.shape); });
}

int sphere_count(const ShapeConfig& shape) {
  return is_clump(shape) ? static_cast<int>(spheres_of(shape).size()) : 1;
}

std::string unlike_shape(const GrainConfig& grains, int kind, const ShapeConfig& theirs) {
  const KindConfig ours = all_kinds(grains)[static_cast<std::size_t>(kind)];
  if (same_shape(ours.shape, theirs)) return {};
  const std::string of = ours.name.empty() ? "" : fmt::format(" of the kind \"{}\"", ours.name);
  const std::string held = words_of(theirs), said = words_of(ours.shape);
  return fmt::format("hold {}{}, as {} says; it holds {}", said, of,
                     key_of_shape(grains, static_cast<std::size_t>(kind)),
                     held == said ? "others" : held);
}

double width_of(const ShapeConfig& shape) { return 2 * shape_of(shape).bounding_radius; }

Widths widths_of(const GrainConfig& grains, const std::vector<SizeClass>& sizes) {
  const std::vector<KindConfig> kinds = all_kinds(grains);
  Widths all{.least = std::numeric_limits<double>::infinity()};
  for (const SizeClass& size : sizes) {
    const double width = size.diameter * width_of(kinds[static_cast<std::size_t>(size.kind)].shape);
    all = {.least = std::min(all.least, width), .most = std::max(all.most, width)};
  }
  return all;
}

double least_radius(const ShapeConfig& shape) {
  return std::ranges::min(shape_of(shape).spheres, {}, &ClumpSphere::radius).radius;
}

LongestArm longest_arm(const GrainConfig& grains, Real r_max) {
  LongestArm longest;
  const std::vector<KindConfig> kinds = all_kinds(grains);
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const auto& spheres = shape_of(kinds[k].shape).spheres;
    const Real largest = std::ranges::max(spheres, {}, &ClumpSphere::radius).radius;
    for (const ClumpSphere& sphere : spheres) {
      const Real length = r_max * norm(sphere.centre) / largest;
      if (length > longest.length) longest = {length, key_of_shape(grains, k)};
    }
  }
  return longest;
}

InertiaInContacts inertia_of(const ShapeConfig& shape) {
  return std::ranges::min(known_shape(shape).in_contacts, {}, &InertiaInContacts::spin);
}

ClumpShapes clump_shapes(const GrainConfig& grains) {
  ClumpShapes shapes;
  std::vector<Vec4> spheres;
  std::vector<Real> shares;
  std::vector<InertiaInContacts> in_contacts;
  int k = 0;
  for (const KindConfig& kind : all_kinds(grains)) {
    const ClumpShape& shape = shape_of(kind.shape);
    shapes.inertia[k] = shape.inertia;
    shapes.shadows[k] = shape.projected_areas;
    shapes.sphericity[k] = shape.sphericity();
    const Real largest = std::ranges::max(shape.spheres, {}, &ClumpSphere::radius).radius;
    shapes.over_largest_sphere = std::max(shapes.over_largest_sphere, 1 / (2 * largest));
    std::ranges::copy(known_shape(kind.shape).in_contacts, std::back_inserter(in_contacts));
    for (const auto& [c, radius] : shape.spheres) spheres.emplace_back(c.x, c.y, c.z, radius);
    shares.insert(shares.end(), shape.shares.begin(), shape.shares.end());
    shapes.first[++k] = static_cast<int>(spheres.size());
  }
  shapes.sphere = on_device("spheres of clumps", spheres);
  shapes.share = on_device("shares of spheres", shares);
  shapes.in_contacts = on_device("inertia in contacts", in_contacts);
  return shapes;
}

InitialGrains as_spheres(const InitialGrains& grains, const GrainConfig& config,
                         std::uint64_t seed) {
  if (!has_clumps(config)) return grains;
  const std::vector<KindConfig> kinds = all_kinds(config);
  const std::vector<Real> densities = densities_of(config);
  InitialGrains spheres;
  spheres.kind_names = grains.kind_names, spheres.heap_names = grains.heap_names;
  spheres.last_id = grains.last_id;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    const auto k = static_cast<std::size_t>(grains.kind_of(g));
    const ClumpShape& shape = shape_of(kinds[k].shape);
    const Real d = grains.diameter[g], m = densities[k] * sphere_volume(d / 2);
    const Quaternion q = grains.q.empty() ? random_orientation(seed, grains.id[g]) : grains.q[g];
    const ClumpMotion motion{
        .x = grains.x[g],
        .d = d,
        .q = q,
        .u = grains.u[g],
        .m = m,
        .j = angular_momentum(q, (m * d * d) * shape.inertia, grains.omega[g])};
    int member = 0;
    for (const auto& [centre, radius] : shape.spheres) {
      const Vec3 arm = d * rotate(q, centre);
      spheres.add(id_of_member(grains.id[g], member++), 2 * radius * d, grains.x[g] + arm,
                  grains.u[g] + cross(grains.omega[g], arm), grains.omega[g]);
      spheres.clump.push_back(motion);
      if (!grains.kind.empty()) spheres.kind.push_back(grains.kind[g]);
      if (!grains.heap.empty()) spheres.heap.push_back(grains.heap[g]);
    }
  }
  return spheres;
}

GrainState whole_grains(const GrainState& grains) {
  if (grains.clump.size() == 0) return grains;
  const int n = grains.members.n;
  const ClumpsOfGrains clumps = clumps_of(grains);
  GrainState whole = make_grain_entries(n, grains.ranks);
  whole.clump = Kokkos::View<ClumpMotion*>("clump", whole.id.extent(0));
  whole.shapes = grains.shapes;
  whole.kind_names = grains.kind_names, whole.heap_names = grains.heap_names;
  whole.fluid.has_fluid = grains.fluid.has_fluid, whole.window_edge = grains.window_edge;
  whole.last_id = grains.last_id, whole.feed = grains.feed;
  const auto kin = whole.kin;
  const auto clump = whole.clump;
  const auto force = whole.contact_force, torque = whole.contact_torque;
  const auto force_of = grains.contact_force, torque_of = grains.contact_torque;
  Kokkos::parallel_for(
      "clumps: whole grains", items(n), KOKKOS_LAMBDA(int c) {
        const int e = clumps.head(c), k = clumps.kind_of(e);
        const ClumpMotion motion = clumps.motion(e);
        const ClumpForce sum = clumps.sum(c, motion, k, force_of, torque_of);
        clump(c) = motion;
        kin(c) = GrainKinematics{.x = motion.x,
                                 .r = motion.d / 2,
                                 .u = motion.u,
                                 .m = motion.m,
                                 .omega = clumps.spin(motion, k)};
        force(c) = sum.force, torque(c) = sum.torque;
      });
  take_of_heads(clumps, grains.id, whole.id);
  take_of_heads(clumps, grains.kind, whole.kind);
  take_of_heads(clumps, grains.heap, whole.heap);
  take_of_heads(clumps, grains.fluid.explicit_force, whole.fluid.explicit_force);
  take_of_heads(clumps, grains.fluid.u_start, whole.fluid.u_start);
  return whole;
}

Kokkos::View<const Vec3*> sum_over_spheres(const GrainState& grains,
                                           const Kokkos::View<const Vec3*>& of_spheres) {
  if (grains.clump.size() == 0 || of_spheres.size() == 0) return of_spheres;
  const ClumpsOfGrains clumps = clumps_of(grains);
  const Kokkos::View<Vec3*> sums("sum over spheres",
                                 static_cast<std::size_t>(std::max(grains.members.n, 1)));
  Kokkos::parallel_for(
      "clumps: sum over spheres", items(grains.members.n), KOKKOS_LAMBDA(int c) {
        const int kind = clumps.kind_of(clumps.head(c));
        for (int k = 0; k < clumps.shapes.count(kind); ++k)
          sums(c) += of_spheres(clumps.members.entry(clumps.members.first(c) + k));
      });
  return sums;
}

}  // namespace barchan
