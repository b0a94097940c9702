#include "src/initial/grain_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <unordered_set>

#include "kernels/grains/law_table.hpp"
#include "src/base/atomic_file.hpp"
#include "src/base/words.hpp"
#include "src/case/derived.hpp"
#include "src/case/load.hpp"
#include "src/grains/grain_state.hpp"
#include "src/grains/kinds.hpp"
#include "src/initial/grain_table.hpp"
#include "src/io/frame_file.hpp"
#include "src/io/seal.hpp"
#include "src/restart/checkpoint.hpp"

namespace barchan {

namespace {

std::vector<Vec3> to_vectors(const std::vector<double>& numbers) {
  std::vector<Vec3> vectors(numbers.size() / 3);
  for (std::size_t p = 0; p < vectors.size(); ++p) {
    vectors[p] = {numbers[3 * p], numbers[3 * p + 1], numbers[3 * p + 2]};
  }
  return vectors;
}

std::vector<std::uint8_t> as_heaps(const std::vector<std::int64_t>& numbers,
                                   const std::filesystem::path& file) {
  std::vector<std::uint8_t> heaps;
  for (const std::int64_t heap : numbers) {
    if (heap < -1 || heap > kNoHeap)  // -1 in frames is kNoHeap in restart files
      throw std::runtime_error(fmt::format("{}: it holds a heap {}", file.string(), heap));
    heaps.push_back(static_cast<std::uint8_t>(heap));
  }
  return heaps;
}

/// Tells if all orientations are rotations.
bool are_rotations(const std::vector<Quaternion>& all) {
  return std::ranges::all_of(all, [](const Quaternion& q) {
    return std::abs(q.w * q.w + dot(q.vec(), q.vec()) - 1) < 1e-6;
  });
}

/// Checks grains of a file that somebody else may have made, as the rows of a table are.
void check_grains(const InitialGrains& grains, const std::filesystem::path& file) {
  const auto finite = [](const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  if (!are_rotations(grains.q))
    throw std::runtime_error(file.string() + ": an orientation is no unit quaternion");
  std::unordered_set<std::int64_t> ids;
  ids.reserve(grains.size());
  for (std::size_t g = 0; g < grains.size(); ++g) {
    std::string problem;
    if (!(grains.diameter[g] > 0 && std::isfinite(grains.diameter[g]))) {
      problem = fmt::format("has a diameter of {} m: it must be above 0", grains.diameter[g]);
    } else if (!finite(grains.x[g]) || !finite(grains.u[g]) || !finite(grains.omega[g])) {
      problem = "has a position or velocity that is not finite";
    } else if (!ids.insert(grains.id[g]).second) {
      problem = "is in it twice";
    } else {
      continue;
    }
    throw std::runtime_error(fmt::format("{}: grain {} {}", file.string(), grains.id[g], problem));
  }
}

std::uint8_t as_kind(std::int64_t kind, const std::filesystem::path& file) {
  if (kind >= 0 && kind < kMaxKinds) return static_cast<std::uint8_t>(kind);
  throw std::runtime_error(fmt::format("{}: it holds a kind of grains {}, of at most {}",
                                       file.string(), kind, kMaxKinds - 1));
}

/// Takes what the case says that wrote grains: their shapes, and where a side is periodic that may
/// be none here: grains beyond it are wrapped.
void take_origin(InitialGrains& grains, const Provenance& origin,
                 const std::filesystem::path& file) {
  if (origin.config.empty()) return;
  const Config written = config_as_written(origin.config, file);
  if (!written.grains) return;
  wrap(grains, written);
  for (const KindConfig& kind : all_kinds(*written.grains)) grains.shapes.push_back(kind.shape);
}

/// Reads the shapes of kinds from the spheres of their clumps.
std::vector<ShapeConfig> read_shapes(const Hdf5File& file) {
  if (!file.exists("spheres")) return {};
  const auto kinds = file.read<std::int64_t>("spheres/kind");
  const std::uint64_t n = kinds.size();
  const std::vector<Vec3> centres = to_vectors(file.read<double>("spheres/centre", {n, 3}));
  const auto radii = file.read<double>("spheres/radius", {n});
  std::vector<ShapeConfig> shapes;
  for (std::size_t s = 0; s < n; ++s) {
    const std::size_t kind = as_kind(kinds[s], file.path());
    if (shapes.size() <= kind) shapes.resize(kind + 1, {.shape = GrainShape::clump});
    shapes[kind].spheres.push_back({centres[s], radii[s]});
  }
  return shapes;
}

InitialGrains read_last_frame(const Hdf5File& file) {
  const auto frames = list_frames(file);
  if (frames.empty()) {
    throw std::runtime_error(file.path().string() +
                             " holds no frames of grains: give a grains.h5 or a restart file");
  }
  const std::string group = frames.back().name + "/";
  InitialGrains grains;
  grains.id = file.read<std::int64_t>(group + "id");
  const std::uint64_t n = grains.id.size();
  grains.diameter = file.read<double>(group + "d", {n});
  grains.x = to_vectors(file.read<double>(group + "x", {n, 3}));
  grains.u = to_vectors(file.read<double>(group + "u", {n, 3}));
  grains.omega = to_vectors(file.read<double>(group + "omega", {n, 3}));
  if (file.exists(group + "orientation")) {
    const auto q = file.read<double>(group + "orientation", {n, 4});
    for (std::size_t g = 0; g < n; ++g)
      grains.q.push_back({q[4 * g], q[4 * g + 1], q[4 * g + 2], q[4 * g + 3]});
  }
  const std::string kind = group + "kind", heap = group + "heap";
  if (file.exists(kind)) {
    for (const std::int64_t k : file.read<std::int64_t>(kind, {n}))
      grains.kind.push_back(as_kind(k, file.path()));
    grains.kind_names = lines_of(file.attribute<std::string>(kind, "names"));
  }
  if (file.exists(heap)) {
    grains.heap = as_heaps(file.read<std::int64_t>(heap, {n}), file.path());
    grains.heap_names = lines_of(file.attribute<std::string>(heap, "names"));
  }
  if (file.has_attribute(frames.back().name, "last_id"))
    grains.last_id = file.attribute<std::int64_t>(frames.back().name, "last_id");
  take_origin(grains, read_provenance(file), file.path());
  if (grains.shapes.empty()) grains.shapes = read_shapes(file);
  return grains;
}

/// Takes whole clumps in place of their spheres.
void take_clumps(const CheckpointReader& file, InitialGrains& grains) {
  constexpr std::uint64_t width = checkpoint_detail::Stored<ClumpMotion>::count;
  const auto numbers = file.array<double>("grains/clump", {grains.size(), width});
  std::vector<bool> heads;
  for (std::size_t g = 0; g < grains.size(); ++g) {
    ClumpMotion c;
    std::memcpy(static_cast<void*>(&c), numbers.data() + g * width, sizeof(c));
    grains.diameter[g] = c.d, grains.x[g] = c.x, grains.u[g] = c.u;
    grains.q.push_back(c.q);
    heads.push_back(member_of_id(grains.id[g]) == 0);
  }
  grains.keep(heads);
}

InitialGrains read_restart(const std::filesystem::path& path) {
  const CheckpointReader file(path);
  InitialGrains grains;
  if (file.has("grains/last_id")) grains.last_id = file.integer("grains/last_id");
  const auto id = file.array<std::int64_t>("grains/id");
  const std::size_t n = id.size();
  constexpr std::uint64_t width = checkpoint_detail::Stored<GrainKinematics>::count;
  const auto numbers = file.array<double>("grains/kin", {n, width});  // Kokkos may not run yet
  for (std::size_t g = 0; g < n; ++g) {
    GrainKinematics kin;
    std::memcpy(static_cast<void*>(&kin), numbers.data() + g * width, sizeof(kin));
    grains.add(id[g], 2.0 * kin.r, kin.x, kin.u, kin.omega);
  }
  if (file.has("grains/kind")) {
    for (const std::int64_t kind : file.array<std::int64_t>("grains/kind", {n}))
      grains.kind.push_back(as_kind(kind, path));
    const Config written = config_as_written(file.provenance().config, path);
    if (written.grains) grains.kind_names = names_of_kinds(*written.grains);
  }
  if (file.has("grains/heap")) {
    grains.heap = as_heaps(file.array<std::int64_t>("grains/heap", {n}), path);
    grains.heap_names = lines_of(file.text("grains/heap_names"));
  }
  if (file.has("grains/clump")) take_clumps(file, grains);
  take_origin(grains, file.provenance(), path);
  return grains;
}

InitialGrains read_hdf5(const std::filesystem::path& path) {
  if (has_seal(path)) return read_restart(path);  // the seal is checked before anything is opened
  const Hdf5File file(path, Hdf5File::Mode::read);
  return file.has_attribute("/", "kind") ? read_restart(path) : read_last_frame(file);
}

}  // namespace

void wrap(InitialGrains& grains, const Config& config) {
  const auto into = [](double& x, double length) {
    if (x < 0 && x >= -length) x += length;
    if (x > length && x <= 2 * length) x -= length;
  };
  for (Vec3& x : grains.x) {
    if (is_periodic_x(config)) into(x.x, config.size[0]);
    if (config.grains->boundary_z == GrainBoundaryZ::periodic) into(x.z, config.size[2]);
  }
}

InitialGrains read_grains(const std::filesystem::path& file) {
  if (file.extension() == ".csv") return parse_grains_csv(read_text(file), file.string());
  if (file.extension() != ".h5") {
    throw std::runtime_error("cannot read grains from " + file.string() +
                             ": the name must end with .csv or .h5");
  }
  InitialGrains grains = read_hdf5(file);
  check_grains(grains, file);
  return grains;
}

}  // namespace barchan
