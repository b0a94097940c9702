// Restart files: named scalars and arrays, kept bit for bit.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "kernels/math/vec3.hpp"
#include "src/io/hdf5_file.hpp"
#include "src/parallel/mirror.hpp"

namespace barchan {

namespace checkpoint_detail {

/// Integers are stored as 64-bit integers; everything else as the doubles it consists of
/// (Vec3: 3, GrainKinematics: 12), whose bits are never changed.
template <class T>
struct Stored {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert(std::is_integral_v<T> || sizeof(T) % sizeof(double) == 0);
  static constexpr bool integer = std::is_integral_v<T>;
  using type = std::conditional_t<integer, std::int64_t, double>;  // in the file
  using element = std::conditional_t<integer, T, double>;          // in memory
  // NOLINTNEXTLINE(bugprone-sizeof-expression): T may be double itself
  static constexpr std::size_t count = integer ? 1 : sizeof(T) / sizeof(double);
};

/// Extents in the file: the first index of a view runs fastest, whatever the backend's layout.
template <class View>
Extents file_extents(const View& view) {
  Extents extents;
  for (std::size_t r = View::rank(); r > 0; --r) extents.push_back(view.extent(r - 1));
  constexpr std::size_t count = Stored<typename View::non_const_value_type>::count;
  if (count > 1) extents.push_back(count);
  return extents;
}

/// Contiguous array of the same extents, first index fastest, in the view's memory space.
template <class View>
auto dense_like(const View& view) {
  using Dense = Kokkos::View<typename View::non_const_data_type, Kokkos::LayoutLeft,
                             typename View::memory_space>;
  Kokkos::LayoutLeft layout;
  for (std::size_t r = 0; r < View::rank(); ++r) layout.dimension[r] = view.extent(r);
  return Dense(Kokkos::view_alloc(Kokkos::WithoutInitializing, "checkpoint: dense copy"), layout);
}

/// Numbers of a view (host or device, any layout) in file order.
template <class View>
auto to_numbers(const View& view) {
  using Number = Stored<typename View::non_const_value_type>;
  const auto dense = dense_like(view);
  Kokkos::deep_copy(dense, view);
  const auto host = host_copy(dense);
  const auto* elements = reinterpret_cast<const typename Number::element*>(host.data());
  return std::vector<typename Number::type>(elements, elements + host.size() * Number::count);
}

/// The reverse; the view has the extents that file_extents() gave.
template <class View, class Number>
void from_numbers(const std::vector<Number>& numbers, const View& view) {
  using Element = typename Stored<typename View::non_const_value_type>::element;
  const auto dense = dense_like(view);
  const auto host = mirror(dense);
  std::transform(numbers.begin(), numbers.end(), reinterpret_cast<Element*>(host.data()),
                 [](Number number) { return static_cast<Element>(number); });
  Kokkos::deep_copy(dense, host);
  Kokkos::deep_copy(view, dense);
}

}  // namespace checkpoint_detail

/// Writes restart_<step>.h5 beside and renames it: the file is there whole, or not at all.
/// Names are paths ("fluid/u_x", "grains/kin"). Collective over the communicator.
/// Every member throws std::runtime_error naming the file and the reason.
class CheckpointWriter {
 public:
  CheckpointWriter(const std::filesystem::path& folder, std::int64_t step,
                   const Provenance& provenance, MPI_Comm communicator = MPI_COMM_SELF);
  /// Without commit() the half-written file is removed.
  ~CheckpointWriter();
  CheckpointWriter(const CheckpointWriter&) = delete;
  CheckpointWriter& operator=(const CheckpointWriter&) = delete;

  /// T is double, std::int64_t or std::string.
  template <class T>
  void scalar(const std::string& name, T value);

  /// `extents` slowest first; empty: one row of values. `slab`: see Hdf5File.
  void array(const std::string& name, std::span<const double> values, const Extents& extents = {},
             const Hyperslab& slab = {});
  void array(const std::string& name, std::span<const std::int64_t> values,
             const Extents& extents = {}, const Hyperslab& slab = {});

  /// A host or device view of rank 1 to 3 of numbers, Vec3 or plain structs of doubles. Where only
  /// the first n rows count, pass a subview.
  template <class View>
  requires Kokkos::is_view_v<View>
  void array(const std::string& name, const View& view) {
    const auto numbers = checkpoint_detail::to_numbers(view);
    array(name, std::span(numbers), checkpoint_detail::file_extents(view));
  }

  /// Brings the file to the disk, renames it into place and removes older restart files until
  /// `keep` are left (at least 1), and those of later steps: they belong to a run that was left for
  /// this one.
  std::filesystem::path commit(int keep);

 private:
  std::int64_t step_;
  std::filesystem::path target_;
  Hdf5File file_;
  MPI_Comm communicator_;
  bool committed_ = false;
};

/// Reads a restart file, after its seal has been checked. Every member throws InputError or
/// Hdf5Error with a sentence for the user. Files that others made without a seal are taken as they
/// are.
class CheckpointReader {
 public:
  explicit CheckpointReader(const std::filesystem::path& file,
                            MPI_Comm communicator = MPI_COMM_SELF);

  /// Step the file was written at.
  std::int64_t step() const;
  Provenance provenance() const { return read_provenance(file_); }

  bool has(const std::string& name) const;
  double real(const std::string& name) const;
  std::int64_t integer(const std::string& name) const;
  std::string text(const std::string& name) const;

  /// Extents of a stored array, slowest first: "grains/id" has extents(...)[0] grains.
  Extents extents(const std::string& name) const;
  /// An array of the extents `whole`, empty: any; or the block of it that begins at `first`. T is
  /// double or std::int64_t.
  template <class T>
  std::vector<T> array(const std::string& name, const Extents& whole = {},
                       const Extents& first = {}, const Extents& size = {}) const;

  /// Into a host or device view of the extents it was written with.
  template <class View>
  requires Kokkos::is_view_v<View>
  void array(const std::string& name, const View& view) const {
    using Number = typename checkpoint_detail::Stored<typename View::non_const_value_type>::type;
    checkpoint_detail::from_numbers(array<Number>(name, checkpoint_detail::file_extents(view)),
                                    view);
  }

  const std::filesystem::path& path() const { return file_.path(); }
  /// Throws InputError: "cannot restart from <file>: <what>".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  /// fail() for what is not there, and whether the version that wrote the file is why.
  [[noreturn]] void lacks(const std::string& name) const;
  template <class T>
  T scalar(const std::string& path) const;

  bool sealed_ = false;
  Hdf5File file_;
};

/// True for "restart_0000012000.h5" and the like.
bool is_checkpoint_name(const std::filesystem::path& name);

/// Restart files of a folder by step; none where the folder does not exist.
std::map<std::int64_t, std::filesystem::path> list_checkpoints(const std::filesystem::path& folder);

/// The restart file of the highest step in a folder, if there is one.
std::optional<std::filesystem::path> latest_checkpoint(const std::filesystem::path& folder);

}  // namespace barchan
