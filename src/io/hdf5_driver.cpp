// Driver by which HDF5 reaches the disk in a serial run: its own POSIX driver behind one of ours.
// The library cannot close a file whose writes fail: it keeps it, and crashes at the end of the
// program. This driver therefore takes note of the first failure, writes nothing more, and lets the
// library go on undisturbed; Hdf5File looks at the note. The file is then as if the program had
// been killed at that write. Contents of a file when it was opened stay readable at every moment:
// of a block that is written anew only the words that differ are written, the last one first. A new
// link thus lies complete behind the end of the list of links before its first word makes it part
// of the list. It also takes no locks: a viewer that has the file open must not be able to stop a
// run.
#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <vector>

#include "src/io/hdf5_handle.hpp"
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

namespace barchan::hdf5 {

namespace {

struct OpenFile {
  H5FD_t library_part;  // must come first: the library sees this only
  H5FD_t* posix;
  std::string* failure;  // the first one, owned by the Hdf5File
  haddr_t size_before;   // of the file when it was opened
};

OpenFile& own(H5FD_t* file) { return *reinterpret_cast<OpenFile*>(file); }
H5FD_t* posix(const H5FD_t* file) { return reinterpret_cast<const OpenFile*>(file)->posix; }
/// Functions of the POSIX driver, called directly: those of the library's interface clear the stack
/// of errors.
const H5FD_class_t& calls(const H5FD_t* file) { return *posix(file)->cls; }

/// Notes a failure that the POSIX driver returned.
herr_t note(std::string& failure, herr_t result) {
  if (result < 0 && failure.empty()) failure = last_reason();
  return result;
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t access, haddr_t last_address) {
  const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(access));
  if (info == nullptr) return nullptr;  // a link to another file, which nobody asked for
  static const hid_t plain = [] {
    const hid_t list = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fapl_sec2(list);
    return list;
  }();
  info->failure->clear();  // the library may have tried other flags before
  H5FD_t* const opened = H5FDopen(name, flags, plain, last_address);
  if (note(*info->failure, opened == nullptr ? -1 : 0) < 0) return nullptr;
  const haddr_t size = opened->cls->get_eof(opened, H5FD_MEM_DEFAULT);
  return &(new OpenFile{{}, opened, info->failure, size})->library_part;
}

herr_t close_file(H5FD_t* file) {
  const hid_t errors = H5Eget_current_stack();  // why the file could not be opened
  // Network file systems may report a full disk only here.
  note(*own(file).failure, H5FDclose(posix(file)));
  H5Eset_current_stack(errors);
  delete &own(file);
  return 0;
}

herr_t read_bytes(H5FD_t* file, H5FD_mem_t type, hid_t transfer, haddr_t address, std::size_t size,
                  void* buffer) {
  return note(*own(file).failure,
              calls(file).read(posix(file), type, transfer, address, size, buffer));
}

/// Writes a block over the old one, as the first lines of this file say. A word that begins at a
/// multiple of its size lies in one page, of which the system writes all or nothing.
herr_t write_in_place(H5FD_t* file, H5FD_mem_t type, hid_t transfer, haddr_t address,
                      std::size_t size, const char* bytes) {
  constexpr std::size_t word = 8;
  std::vector<char> old(size);
  if (calls(file).read(posix(file), type, transfer, address, size, old.data()) < 0) return -1;
  for (std::size_t end = size; end > 0;) {
    const std::size_t over = (address + end) % word;
    const std::size_t n = std::min(end, over == 0 ? word : over);
    end -= n;
    if (std::memcmp(old.data() + end, bytes + end, n) == 0) continue;
    if (calls(file).write(posix(file), type, transfer, address + end, n, bytes + end) < 0)
      return -1;
  }
  return 0;
}

herr_t write_bytes(H5FD_t* file, H5FD_mem_t type, hid_t transfer, haddr_t address, std::size_t size,
                   const void* buffer) {
  std::string& failure = *own(file).failure;
  const auto* bytes = static_cast<const char*>(buffer);
  const haddr_t before = own(file).size_before;
  const std::size_t old = address < before ? std::min<haddr_t>(size, before - address) : 0;
  if (failure.empty() && old < size)
    note(failure,
         calls(file).write(posix(file), type, transfer, address + old, size - old, bytes + old));
  if (failure.empty() && old > 0)
    note(failure, write_in_place(file, type, transfer, address, old, bytes));
  return 0;
}

herr_t truncate_file(H5FD_t* file, hid_t transfer, hbool_t closing) {
  std::string& failure = *own(file).failure;
  if (failure.empty()) note(failure, calls(file).truncate(posix(file), transfer, closing));
  return 0;
}

H5FD_class_t driver_class() {
  H5FD_class_t c{};
#if H5_VERSION_GE(1, 13, 0)
  c.version = H5FD_CLASS_VERSION;
  c.value = static_cast<H5FD_class_value_t>(512);  // first of the range for drivers under test
#endif
  c.name = "barchan";
  c.maxaddr = (haddr_t{1} << (8 * sizeof(off_t) - 1)) - 1;
  c.fc_degree = H5F_CLOSE_STRONG;
  c.fapl_size = sizeof(DriverInfo);
  c.open = open_file;
  c.close = close_file;
  c.cmp = [](const H5FD_t* a, const H5FD_t* b) { return calls(a).cmp(posix(a), posix(b)); };
  c.query = [](const H5FD_t*, unsigned long* flags) -> herr_t {
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
  };
  c.get_eoa = [](const H5FD_t* file, H5FD_mem_t type) {
    return calls(file).get_eoa(posix(file), type);
  };
  c.set_eoa = [](H5FD_t* file, H5FD_mem_t type, haddr_t address) {
    return calls(file).set_eoa(posix(file), type, address);
  };
  c.get_eof = [](const H5FD_t* file, H5FD_mem_t type) {
    return calls(file).get_eof(posix(file), type);
  };
  c.read = read_bytes;
  c.write = write_bytes;
  c.truncate = truncate_file;
  constexpr H5FD_mem_t free_lists[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(free_lists), std::end(free_lists), c.fl_map);
  return c;
}

herr_t take_first(unsigned, const H5E_error2_t* entry, void* reason) {
  auto& text = *static_cast<std::string*>(reason);
  if (text.empty() && entry->desc != nullptr) text = entry->desc;
  return 0;
}

}  // namespace

hid_t file_driver() {
  static const H5FD_class_t the_class = driver_class();  // the library keeps a reference
  static const hid_t id = H5FDregister(&the_class);
  return id;
}

void start_library() {
  static const bool started = [] {
    H5open();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return true;
  }();
  static_cast<void>(started);
}

std::string last_reason() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &text);
  H5Eclear2(H5E_DEFAULT);
  constexpr std::string_view mark = "error message = '";  // before what the system said
  if (const auto at = text.rfind(mark); at != std::string::npos) {
    const auto begin = at + mark.size();
    return text.substr(begin, text.find('\'', begin) - begin);
  }
  static constexpr std::array<std::array<const char*, 2>, 3> plain{
      {{"file signature not found", "it is not an HDF5 file"},
       {"truncated file",
        "it is cut short (an incomplete copy, or a run that was killed or is writing it)"},
       {"object doesn't exist", "it has no such entry"}}};
  for (const auto& [theirs, ours] : plain) {
    if (text.find(theirs) != std::string::npos) return ours;
  }
  return text.empty() ? "unknown HDF5 error" : text;
}

}  // namespace barchan::hdf5
