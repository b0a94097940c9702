// The HDF5 library behind one class and one checker of return codes.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace barchan {

/// Every failure of a file: "cannot write runs/x/fields.h5: <reason given by HDF5>".
struct Hdf5Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Extents of an array, slowest first; ranks 1 to 4.
using Extents = std::vector<std::uint64_t>;

/// "62 x 30 x 25".
std::string to_string(const Extents& extents);

enum class ElementType { float32, float64, int32, int64, other };

struct ArrayInfo {
  ElementType type = ElementType::other;
  Extents extents;
};

/// Where this rank's slab of an array lies: the whole array, and the first element of the slab.
/// Default: the slab is the whole.
struct Hyperslab {
  Extents whole, first;
};

/// This rank's n rows among those of all ranks, one rank after the other; the default on one rank.
Hyperslab slab_of_entries(std::uint64_t n, MPI_Comm ranks);

/// The slab of an array of `extents`, one of which is that of the rows.
Hyperslab slab_of(const Hyperslab& rows, const Extents& extents, std::size_t dimension);

/// One open HDF5 file. With a communicator of more than one rank it is opened in parallel; every
/// call is then collective, with equal arguments except the values and the shares.
/// Object names are paths ("grid/x_face"); groups on the way to an array are made as needed.
/// Every member throws Hdf5Error naming the file and the reason.
class Hdf5File {
 public:
  /// create replaces what is there; create_sealable leaves room for a seal in front
  /// (src/io/seal.hpp).
  enum class Mode { read, modify, create, create_sealable };

  Hdf5File(const std::filesystem::path& path, Mode mode, MPI_Comm communicator = MPI_COMM_SELF);
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  /// Closes without a complaint: call close() where a full disk must be noticed. While an exception
  /// is on its way a file of several ranks stays open: the others, if they go on, would never come
  /// to close it with this one, and nobody would hear of the exception.
  ~Hdf5File();

  void close();

  bool exists(const std::string& name) const;
  bool is_group(const std::string& name) const;
  /// Names directly below a group, in alphabetical order.
  std::vector<std::string> children(const std::string& group = "/") const;
  /// Copies a group or an array, with all below it.
  void copy_from(const Hdf5File& source, const std::string& name, const std::string& as);
  /// Makes a group and those on the way, where missing; `room`: for so many names from the start.
  void make_group(const std::string& name, unsigned room = 0);

  /// Names of frames that fit into a group made by publish_group(). In the root there is room for
  /// as many, and for a thousand groups. For more a table would have to grow in place, and a kill
  /// at that moment would cost all that is in it.
  static constexpr unsigned kGroupLinks = 250;
  /// True for a file whose root has this room; those of version 0.2.0 have other tables.
  bool has_room() const;

  /// Makes a group that nothing leads to yet, which is filled through the names below `as`.
  void begin_hidden_group(const std::string& as);
  /// Makes it visible as `as`, "name" or "group/name", after all its content is on the disk, and
  /// closes the file. A kill at any moment leaves a valid file, with this group or without it.
  void publish_group();

  /// T is float, double, std::int32_t or std::int64_t. `extents` are those of `values`. Without a
  /// slab, what rank 0 has is written. The attribute "checksum" tells a reader that the values are
  /// those that were written; a file that is sealed needs none.
  template <class T>
  void write(const std::string& name, std::span<const T> values, const Extents& extents,
             std::string_view units, const Hyperslab& slab = {});

  /// Type and extents of an array; extents are checked against the file's size before they are
  /// believed.
  ArrayInfo info(const std::string& name) const;
  /// An array of the extents `whole`, empty: any; or the block of it that begins at `first`, which
  /// may be another one on each rank. Converted to T where the file holds another number type. Of a
  /// whole array the checksum is looked at, if it has one.
  template <class T>
  std::vector<T> read(const std::string& name, const Extents& whole = {}, const Extents& first = {},
                      const Extents& size = {}) const;

  /// Attributes of a group or an array; "/" is the file.
  void set_attribute(const std::string& object, const std::string& name, double value);
  void set_attribute(const std::string& object, const std::string& name, std::int64_t value);
  void set_attribute(const std::string& object, const std::string& name, std::string_view value);
  bool has_attribute(const std::string& object, const std::string& name) const;
  /// T is double, std::int64_t or std::string.
  template <class T>
  T attribute(const std::string& object, const std::string& name) const;

  const std::filesystem::path& path() const { return path_; }

 private:
  using Id = std::int64_t;  // hid_t, kept out of the header

  /// A name as a path from an open object: nothing leads to a hidden group from the root yet.
  struct Location {
    Id base;
    std::string path;
  };
  Location locate(const std::string& name) const;
  [[noreturn]] void fail(const std::string& reason, const std::string& object) const;
  /// Returns what an HDF5 function returned, or throws with the library's reason.
  template <class Code>
  Code check(Code code, const std::string& object = {}) const;
  /// Takes the room on the disk that a file of several ranks still needs. Throws where there is
  /// none: when the library then could not write its tables on one rank, the others would wait
  /// within it for ever.
  void take_room() const;
  /// Throws if the serial driver noted a failure.
  void check_writes() const;
  template <class T>
  void put_checksum(const std::string& name, std::span<const T> values, const Extents& extents,
                    const Hyperslab& slab);
  /// Reads, as read() does, an array whose shape is known.
  template <class T>
  std::vector<T> read_as(const std::string& name, const ArrayInfo& found, const Extents& first,
                         const Extents& size) const;
  void put_attribute(const std::string& object, const std::string& name, Id type,
                     const void* value);
  void link(std::uint64_t address, const std::string& as);

  std::filesystem::path path_;
  Mode mode_;
  MPI_Comm communicator_;
  bool parallel_ = false, is_root_ = true;
  std::unique_ptr<std::string> failure_;  // noted by the serial driver; empty: none
  Id file_ = -1;
  Id hidden_ = -1;
  std::string hidden_name_;
};

/// Where a file came from: written into every result and restart file.
struct Provenance {
  std::string title{};    // of the case
  std::string config{};   // resolved TOML text
  std::string version{};  // of Barchan
  std::string git_hash{};
  std::string backend{};  // Kokkos backend and device
  std::string inputs{};   // what the run began from (src/run/case_inputs.hpp); empty: no files
};

/// Writes the provenance as attributes of the file's root. Throws Hdf5Error.
void write_provenance(Hdf5File& file, const Provenance& provenance);
/// Provenance that a file states; empty where it states none.
Provenance read_provenance(const Hdf5File& file);

}  // namespace barchan
