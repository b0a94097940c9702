#include "src/restart/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "barchan_version.hpp"
#include "src/base/atomic_file.hpp"
#include "src/base/errors.hpp"
#include "src/io/seal.hpp"
#include "src/parallel/communicator.hpp"

namespace barchan {

namespace {

constexpr std::string_view kPrefix = "restart_";
constexpr std::string_view kEnding = ".h5";
// Raised when the meaning of stored names changes, so that old files are refused with a sentence.
// 5: contacts by the ids of their grains; 6: sealed.
constexpr std::int64_t kFormatVersion = 6, kFirstSealedFormat = 6, kOldestFormat = 5;

std::filesystem::path temporary_of(const std::filesystem::path& target) {
  return std::filesystem::path(target).concat(".tmp");
}

/// Step of a restart file's name; -1 for any other name.
std::int64_t step_of(const std::string& name) {
  std::int64_t step = -1;
  if (!name.starts_with(kPrefix) || !name.ends_with(kEnding)) return -1;
  const char* end = name.data() + name.size() - kEnding.size();
  const auto [stop, error] = std::from_chars(name.data() + kPrefix.size(), end, step);
  return error == std::errc() && stop == end ? step : -1;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw InputError("cannot restart from " + file.string() + ": " + what);
}

/// The restart file that may serve in place of a damaged one.
std::string instead_of(const std::filesystem::path& file) {
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  std::filesystem::path other;
  for (const auto& [step, path] : list_checkpoints(folder)) {
    if (path.filename() != file.filename()) other = path;
  }
  if (other.empty()) return "; copy it again if it was copied, or start anew";
  return "; another one is " + other.string();
}

/// Rank 0 reads the file through before the HDF5 library looks at it: what is damaged can make the
/// library itself fail. False without a seal, as in files of others and of earlier versions.
bool is_sealed(const std::filesystem::path& file, MPI_Comm communicator) {
  const bool sealed = broadcast(has_seal(file), communicator);
  std::string problem;
  if (sealed && rank_of(communicator) == 0) problem = broken_seal(file);
  // Rank 0 tells why; the others end with it.
  if (broadcast(!problem.empty(), communicator)) refuse(file, problem + instead_of(file));
  return sealed;
}

/// A scalar is an attribute of a group: the names of both.
std::pair<std::string, std::string> split(const std::string& path) {
  const auto slash = path.rfind('/');
  if (slash == std::string::npos) return {"scalars", path};
  return {"scalars/" + path.substr(0, slash), path.substr(slash + 1)};
}

}  // namespace

bool is_checkpoint_name(const std::filesystem::path& name) { return step_of(name.string()) >= 0; }

std::map<std::int64_t, std::filesystem::path> list_checkpoints(
    const std::filesystem::path& folder) {
  std::map<std::int64_t, std::filesystem::path> files;
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (const auto step = step_of(entry.path().filename().string()); step >= 0) {
      files[step] = entry.path();
    }
  }
  return files;
}

std::optional<std::filesystem::path> latest_checkpoint(const std::filesystem::path& folder) {
  const auto files = list_checkpoints(folder);
  return files.empty() ? std::nullopt : std::optional(files.rbegin()->second);
}

CheckpointWriter::CheckpointWriter(const std::filesystem::path& folder, std::int64_t step,
                                   const Provenance& provenance, MPI_Comm communicator)
    : step_(step),
      target_(folder / fmt::format("{}{:010}{}", kPrefix, step, kEnding)),
      file_(temporary_of(target_), Hdf5File::Mode::create_sealable, communicator),
      communicator_(communicator) {
  write_provenance(file_, provenance);
  file_.set_attribute("/", "kind", "restart");
  file_.set_attribute("/", "format", kFormatVersion);
  file_.set_attribute("/", "step", step);
}

CheckpointWriter::~CheckpointWriter() {
  std::error_code ignored;
  if (!committed_) std::filesystem::remove(temporary_of(target_), ignored);
}

template <class T>
void CheckpointWriter::scalar(const std::string& path, T value) {
  const auto [group, name] = split(path);
  file_.make_group(group);
  file_.set_attribute(group, name, value);
}
template void CheckpointWriter::scalar(const std::string&, double);
template void CheckpointWriter::scalar(const std::string&, std::int64_t);
template void CheckpointWriter::scalar(const std::string&, std::string);

void CheckpointWriter::array(const std::string& name, std::span<const double> values,
                             const Extents& extents, const Hyperslab& slab) {
  file_.write(name, values, extents.empty() ? Extents{values.size()} : extents, "SI", slab);
}

void CheckpointWriter::array(const std::string& name, std::span<const std::int64_t> values,
                             const Extents& extents, const Hyperslab& slab) {
  file_.write(name, values, extents.empty() ? Extents{values.size()} : extents, "1", slab);
}

std::filesystem::path CheckpointWriter::commit(int keep) {
  file_.close();
  if (rank_of(communicator_) == 0) {
    seal(temporary_of(target_));
    rename_durably(temporary_of(target_), target_);
    auto files = list_checkpoints(target_.parent_path());
    auto last = files.upper_bound(step_);
    for (auto later = last; later != files.end(); ++later) std::filesystem::remove(later->second);
    auto surplus = std::distance(files.begin(), last) - std::max(keep, 1);
    for (auto old = files.begin(); surplus > 0; ++old, --surplus) {
      std::filesystem::remove(old->second);
    }
  }
  committed_ = true;
  synchronise(communicator_);  // the file is there for every rank that returns
  return target_;
}

CheckpointReader::CheckpointReader(const std::filesystem::path& file, MPI_Comm communicator)
    : sealed_(is_sealed(file, communicator)), file_(file, Hdf5File::Mode::read, communicator) {
  if (!file_.has_attribute("/", "kind") || file_.attribute<std::string>("/", "kind") != "restart") {
    fail("it is not a restart file");
  }
  const auto format = file_.attribute<std::int64_t>("/", "format");
  const bool newer = format > kFormatVersion;
  if (newer || format < kOldestFormat) {
    fail(fmt::format("it was written in format {} by {} {}; this version reads {} to {}{}", format,
                     newer ? "a newer version," : "version", provenance().version, kOldestFormat,
                     kFormatVersion, newer ? ": take that version" : ""));
  }
  if (format >= kFirstSealedFormat && !sealed_)
    fail("it is damaged: its seal is gone" + instead_of(path()));
}

void CheckpointReader::fail(const std::string& what) const { refuse(path(), what); }

void CheckpointReader::lacks(const std::string& name) const {
  const std::string writer = provenance().version;
  std::string why = "it holds no \"" + name + "\", which this run needs";
  if (!writer.empty() && writer != BARCHAN_VERSION) {
    why +=
        fmt::format("; version {} wrote it, and this is version {}: start anew, or go on with {}",
                    writer, BARCHAN_VERSION, writer);
  }
  fail(why);
}

std::int64_t CheckpointReader::step() const { return file_.attribute<std::int64_t>("/", "step"); }

bool CheckpointReader::has(const std::string& name) const {
  const auto [group, attribute] = split(name);
  return file_.exists(name) || (file_.exists(group) && file_.has_attribute(group, attribute));
}

template <class T>
T CheckpointReader::scalar(const std::string& path) const {
  const auto [group, name] = split(path);
  if (!file_.exists(group) || !file_.has_attribute(group, name)) lacks(path);
  return file_.attribute<T>(group, name);
}

double CheckpointReader::real(const std::string& name) const { return scalar<double>(name); }

std::int64_t CheckpointReader::integer(const std::string& name) const {
  return scalar<std::int64_t>(name);
}

std::string CheckpointReader::text(const std::string& name) const {
  return scalar<std::string>(name);
}

Extents CheckpointReader::extents(const std::string& name) const {
  if (!file_.exists(name)) lacks(name);
  return file_.info(name).extents;
}

template <class T>
std::vector<T> CheckpointReader::array(const std::string& name, const Extents& whole,
                                       const Extents& first, const Extents& size) const {
  const Extents found = extents(name);
  if (!whole.empty() && found != whole) {
    fail(fmt::format("{} is {} there and {} in this run (another mesh, or other grains)", name,
                     to_string(found), to_string(whole)));
  }
  const auto type = std::is_integral_v<T> ? ElementType::int64 : ElementType::float64;
  if (file_.info(name).type != type) fail(name + " holds numbers of another type");
  return file_.read<T>(name, whole, first, size);  // bit for bit
}
template std::vector<double> CheckpointReader::array(const std::string&, const Extents&,
                                                     const Extents&, const Extents&) const;
template std::vector<std::int64_t> CheckpointReader::array(const std::string&, const Extents&,
                                                           const Extents&, const Extents&) const;

}  // namespace barchan
