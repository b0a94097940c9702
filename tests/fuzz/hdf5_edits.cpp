// A little program that edits an HDF5 file through the library.
#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "src/io/hdf5_handle.hpp"
#include "tests/fuzz/hdf5_files.hpp"

namespace barchan::fuzz {

using hdf5::Handle;

namespace {

Handle copy_of(hid_t type) { return {H5Tcopy(type), H5Tclose}; }

Handle text(std::size_t size) {
  Handle string = copy_of(H5T_C_S1);
  H5Tset_size(string.get(), size);
  return string;
}

/// Types of numbers, texts and structures that a file of somebody else may hold.
Handle any_type(Tape& tape) {
  const std::array plain{H5T_IEEE_F64LE, H5T_STD_I64LE, H5T_IEEE_F32LE, H5T_IEEE_F64BE,
                         H5T_STD_U64LE,  H5T_STD_I8LE,  H5T_STD_I64BE,  H5T_NATIVE_LDOUBLE};
  const std::size_t kind = tape.pick(20);
  if (kind < plain.size()) return copy_of(plain[kind]);
  if (kind == 8) return text(H5T_VARIABLE);
  if (kind == 9) return text(1 + tape.byte());
  if (kind == 10) return text(std::size_t{1} << tape.pick(28));
  if (kind == 11) return {H5Tcreate(H5T_OPAQUE, 1 + tape.byte()), H5Tclose};
  if (kind == 12) {
    Handle pair(H5Tcreate(H5T_COMPOUND, 16), H5Tclose);
    H5Tinsert(pair.get(), "a", 0, H5T_IEEE_F64LE);
    H5Tinsert(pair.get(), "b", 8, H5T_STD_I64LE);
    return pair;
  }
  if (kind == 13) {
    const hsize_t many = tape.extent() % 100000 + 1;
    return {H5Tarray_create2(H5T_IEEE_F64LE, 1, &many), H5Tclose};
  }
  if (kind == 14) return {H5Tvlen_create(H5T_IEEE_F64LE), H5Tclose};
  if (kind == 15) return copy_of(H5T_STD_REF_OBJ);
  if (kind == 16) {
    Handle names_of_numbers(H5Tenum_create(H5T_STD_I64LE), H5Tclose);
    const std::int64_t one = 1;
    H5Tenum_insert(names_of_numbers.get(), "one", &one);
    return names_of_numbers;
  }
  if (kind == 17) return copy_of(H5T_STD_B64LE);
  if (kind == 18) {  // a real number of odd size
    Handle real = copy_of(H5T_IEEE_F64LE);
    H5Tset_precision(real.get(), 40);
    H5Tset_fields(real.get(), 39, 28, 11, 0, 28);
    H5Tset_size(real.get(), 5);
    return real;
  }
  return copy_of(H5T_UNIX_D64LE);
}

std::vector<std::string> split(const std::string& words) {
  std::istringstream in(words);
  return {std::istream_iterator<std::string>(in), {}};
}

/// Names that mean something to the readers, and some that do not. Their order is what the bytes of
/// the inputs kept in corpus/ mean: add at the end.
const std::vector<std::string> names = split(
    "/ grains contacts fluid scalars scalars/grains scalars/fluid statistics "
    "scalars/statistics grains/id grains/kin grains/x_reference grains/contact_force "
    "grains/stress_force grains/wall_touching grains/wall_xi_t grains/of_rank contacts/first "
    "contacts/second contacts/xi_t contacts/rolling contacts/of_rank dunes fluid/u_x "
    "fluid/p fluid/alpha_f statistics/sums statistics/force_map grid frame_000000 "
    "frame_000001 frame_000002 frame_999999 frame_000001/id frame_000001/d frame_000001/x "
    "frame_000001/u frame_000001/omega frame_000000/id grid/x grid/y new new/new grains/new "
    "frame_000001/new frame_1 frame_-1 frame_4294967296 .");
const std::vector<std::string> attribute_names = split(
    "kind format step time title config version git_hash backend units r_max r_min "
    "sauter_diameter n_initial n_left t has_history dt_previous drive n_samples new");

class Editor {
 public:
  Editor(hid_t file, Tape& tape, const std::filesystem::path& folder)
      : file_(file), tape_(tape), other_file_(folder / "other_file") {
    H5Pset_create_intermediate_group(links_.get(), 1);
  }

  void one_edit() {
    constexpr std::array edits{
        &Editor::remove,        &Editor::rename,        &Editor::put_array,
        &Editor::put_attribute, &Editor::change_value,  &Editor::remove_attribute,
        &Editor::put_group,     &Editor::put_soft_link, &Editor::put_external_link,
        &Editor::put_hard_link, &Editor::put_type,      &Editor::resize,
        &Editor::nest,          &Editor::crowd};
    (this->*edits[tape_.pick(edits.size())])();
  }

 private:
  const char* name() { return names[tape_.pick(names.size())].c_str(); }

  /// A name under which there is nothing any more.
  const char* free_name() {
    const char* at = name();
    H5Ldelete(file_, at, H5P_DEFAULT);
    return at;
  }

  void remove() { free_name(); }

  void rename() {
    const char* from = name();
    const char* to = free_name();
    H5Lmove(file_, from, file_, to, links_.get(), H5P_DEFAULT);
  }

  std::vector<hsize_t> extents(std::size_t rank) {
    std::vector<hsize_t> of(rank);
    for (auto& extent : of) extent = tape_.extent();
    return of;
  }

  static Handle space_of(const std::vector<hsize_t>& extents, bool grows) {
    const std::vector<hsize_t> most(extents.size(), H5S_UNLIMITED);
    return {H5Screate_simple(static_cast<int>(extents.size()), extents.data(),
                             grows ? most.data() : nullptr),
            H5Sclose};
  }

  /// Fill values only, so that an array of any extents takes little room.
  void put_array() {
    const char* at = free_name();
    const Handle of_type = any_type(tape_);
    const auto whole = extents(tape_.pick(5));
    const Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    // compact, contiguous, chunks that may grow or not, in another file, made of another array
    const std::size_t layout = tape_.pick(6);
    const bool grows = layout == 2;
    if (layout < 2) {
      H5Pset_layout(list.get(), layout == 0 ? H5D_COMPACT : H5D_CONTIGUOUS);
    } else if (layout < 4) {
      H5Pset_chunk(list.get(), static_cast<int>(whole.size()), extents(whole.size()).data());
      if (tape_.pick(2) == 1) H5Pset_deflate(list.get(), 1);
    } else if (layout == 4) {
      H5Pset_external(list.get(), other_file_.c_str(), 0, H5F_UNLIMITED);
    } else {
      const Handle all = space_of(whole, false);
      H5Pset_virtual(list.get(), all.get(), tape_.pick(2) == 0 ? "." : "other.h5", name(),
                     all.get());
    }
    const bool pieces = H5Pget_layout(list.get()) == H5D_CHUNKED;
    H5Pset_alloc_time(list.get(), pieces ? H5D_ALLOC_TIME_INCR : H5D_ALLOC_TIME_LATE);
    const double fill = tape_.number();
    H5Pset_fill_value(list.get(), H5T_NATIVE_DOUBLE, &fill);
    const bool nothing = whole.empty() && tape_.pick(2) == 1;
    const Handle space = nothing ? Handle(H5Screate(H5S_NULL), H5Sclose) : space_of(whole, grows);
    const Handle array(
        H5Dcreate2(file_, at, of_type.get(), space.get(), links_.get(), list.get(), H5P_DEFAULT),
        H5Dclose);
    write_first(array.get());
  }

  /// Writes one element into an array, where the tape says so.
  void write_first(hid_t array) {
    if (array < 0 || tape_.pick(2) == 0) return;
    const Handle space(H5Dget_space(array), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.get());
    if (rank > 0) {
      const std::vector<hsize_t> zero(static_cast<std::size_t>(rank), 0),
          one(static_cast<std::size_t>(rank), 1);
      H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, zero.data(), nullptr, one.data(), nullptr);
    }
    const Handle memory(H5Screate(H5S_SCALAR), H5Sclose);
    // Skip arrays that the tape could make so large that the file is as large, and those that may
    // lead to themselves.
    const Handle list(H5Dget_create_plist(array), H5Pclose), of_type(H5Dget_type(array), H5Tclose);
    if (H5Pget_layout(list.get()) == H5D_VIRTUAL) return;
    std::array<hsize_t, H5S_MAX_RANK> piece{};
    int n = H5Pget_chunk(list.get(), H5S_MAX_RANK, piece.data());
    if (n < 0) n = H5Sget_simple_extent_dims(space.get(), piece.data(), nullptr);
    auto bytes = static_cast<double>(H5Tget_size(of_type.get()));
    for (int d = 0; d < n; ++d) bytes *= static_cast<double>(piece[static_cast<std::size_t>(d)]);
    std::array<hsize_t, H5S_MAX_RANK> extent{};
    H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
    double elements = 1;  // the library crashes as it writes into an array of more than 2^64
    for (const hsize_t e : extent) elements *= std::max(1.0, static_cast<double>(e));
    if (bytes > 1e6 || elements > 1e18) return;
    const double value = tape_.number();
    H5Dwrite(array, H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT, &value);
  }

  void put_attribute() {
    const char* at = name();
    const char* called = attribute_names[tape_.pick(attribute_names.size())].c_str();
    const Handle of_type = any_type(tape_);
    const auto whole = extents(tape_.pick(5));
    if (whole.size() > 2) return;
    const Handle space =
        tape_.pick(8) == 7 ? Handle(H5Screate(H5S_NULL), H5Sclose) : space_of(whole, false);
    H5Adelete_by_name(file_, at, called, H5P_DEFAULT);
    const Handle attribute(H5Acreate_by_name(file_, at, called, of_type.get(), space.get(),
                                             H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    if (attribute.get() < 0 || tape_.pick(4) == 0) return;
    const auto n = H5Sget_simple_extent_npoints(space.get());
    if (n < 1 || n > 1000) return;
    if (H5Tis_variable_str(of_type.get()) > 0) {
      const std::array<std::string, 4> words{"restart", "", std::string(3000, 'x'), "\xff\xfe\n"};
      const std::string& word = words[tape_.pick(4)];
      const std::vector<const char*> all(static_cast<std::size_t>(n), word.c_str());
      H5Awrite(attribute.get(), of_type.get(), static_cast<const void*>(all.data()));
    } else if (H5Tget_class(of_type.get()) == H5T_FLOAT) {
      const std::vector<double> all(static_cast<std::size_t>(n), tape_.number());
      H5Awrite(attribute.get(), H5T_NATIVE_DOUBLE, all.data());
    } else if (H5Tget_class(of_type.get()) == H5T_INTEGER) {
      const std::vector<std::int64_t> all(static_cast<std::size_t>(n), tape_.integer());
      H5Awrite(attribute.get(), H5T_NATIVE_INT64, all.data());
    }
  }

  void remove_attribute() {
    const char* at = name();
    H5Adelete_by_name(file_, at, attribute_names[tape_.pick(attribute_names.size())].c_str(),
                      H5P_DEFAULT);
  }

  void change_value() {
    const char* at = name();
    const auto where = static_cast<hsize_t>(tape_.byte());
    const double real = tape_.number();
    const std::int64_t whole = tape_.integer();
    const Handle array(H5Dopen2(file_, at, H5P_DEFAULT), H5Dclose);
    if (array.get() < 0) return;
    const Handle list(H5Dget_create_plist(array.get()), H5Pclose);
    if (H5Pget_layout(list.get()) == H5D_VIRTUAL) return;
    const Handle space(H5Dget_space(array.get()), H5Sclose),
        of_type(H5Dget_type(array.get()), H5Tclose);
    std::array<hsize_t, H5S_MAX_RANK> extent{}, start{};
    const int rank = H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
    if (rank < 1 || H5Sget_simple_extent_npoints(space.get()) > 1000) return;
    auto rest = where;
    for (auto d = static_cast<std::size_t>(rank); d-- > 0;) {
      if (extent[d] == 0) return;
      start[d] = rest % extent[d];
      rest /= extent[d];
    }
    H5Sselect_elements(space.get(), H5S_SELECT_SET, 1, start.data());
    const Handle memory(H5Screate(H5S_SCALAR), H5Sclose);
    const bool integers = H5Tget_class(of_type.get()) == H5T_INTEGER;
    const void* value = integers ? static_cast<const void*>(&whole) : &real;
    H5Dwrite(array.get(), integers ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE, memory.get(),
             space.get(), H5P_DEFAULT, value);
  }

  void put_group() {
    const char* at = free_name();
    const Handle group(H5Gcreate2(file_, at, links_.get(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  }

  void put_soft_link() {
    const char* at = free_name();
    const char* to = name();
    H5Lcreate_soft(to, file_, at, links_.get(), H5P_DEFAULT);
  }

  void put_external_link() {
    const char* at = free_name();
    const char* to = name();
    const std::array<const char*, 4> files{"input.h5", "missing.h5", "/dev/null", "."};
    H5Lcreate_external(tape_.one_of(files), to, file_, at, links_.get(), H5P_DEFAULT);
  }

  void put_hard_link() {
    const char* at = free_name();
    const char* to = name();
    H5Lcreate_hard(file_, to, file_, at, links_.get(), H5P_DEFAULT);
  }

  void put_type() {
    const char* at = free_name();
    const Handle of_type = any_type(tape_);
    H5Tcommit2(file_, at, of_type.get(), links_.get(), H5P_DEFAULT, H5P_DEFAULT);
  }

  void resize() {
    const Handle array(H5Dopen2(file_, name(), H5P_DEFAULT), H5Dclose);
    if (array.get() < 0) return;
    const Handle list(H5Dget_create_plist(array.get()), H5Pclose);
    if (H5Pget_layout(list.get()) != H5D_CHUNKED) return;
    std::array<hsize_t, H5S_MAX_RANK> extent{};
    for (std::size_t d = 0; d < 4; ++d) extent[d] = tape_.extent();
    H5Dset_extent(array.get(), extent.data());
  }

  /// Groups inside each other.
  void nest() {
    std::string path = name();
    for (std::size_t n = std::size_t{1} << tape_.pick(10); n > 0; --n) path += "/a";
    const Handle group(H5Gcreate2(file_, path.c_str(), links_.get(), H5P_DEFAULT, H5P_DEFAULT),
                       H5Gclose);
  }

  /// Many groups beside each other.
  void crowd() {
    const std::string at = name();
    for (std::size_t n = std::size_t{1} << tape_.pick(8); n > 0; --n) {
      const Handle group(H5Gcreate2(file_, (at + "/frame_" + std::to_string(n)).c_str(),
                                    links_.get(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Gclose);
    }
  }

  hid_t file_;
  Tape& tape_;
  std::filesystem::path other_file_;
  Handle links_{H5Pcreate(H5P_LINK_CREATE), H5Pclose};
};

}  // namespace

void edit(const std::filesystem::path& file, Tape tape) {
  hdf5::start_library();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  const Handle open(H5Fopen(file.c_str(), H5F_ACC_RDWR, access.get()), H5Fclose);
  demand(open.get() >= 0, "the valid file opens");
  Editor editor(open.get(), tape, file.parent_path());
  for (int n = 0; n < 40 && !tape.empty(); ++n) editor.one_edit();
}

}  // namespace barchan::fuzz
