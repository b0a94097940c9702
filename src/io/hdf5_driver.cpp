// How HDF5 reaches the disk in a serial run. The library cannot close a file whose writes fail: it
// keeps it, and crashes at the end of the program. This driver therefore takes note of the first
// failed write, writes nothing more, and lets the library go on undisturbed; Hdf5File looks at the
// note. The file is then as if the program had been killed at that write.
// It also takes no locks: a viewer that has the file open must not be able to stop a run.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <utility>

#include "src/io/hdf5_handle.hpp"
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

namespace barchan::hdf5 {

namespace {

struct OpenFile {
  H5FD_t library_part;  // must come first: the library sees this only
  int descriptor;
  int* error;  // errno of the first failure, owned by the Hdf5File
  haddr_t end_of_allocation, end_of_file;
  dev_t device;
  ino_t inode;
};

OpenFile& own(H5FD_t* file) { return *reinterpret_cast<OpenFile*>(file); }
const OpenFile& own(const H5FD_t* file) { return *reinterpret_cast<const OpenFile*>(file); }

H5FD_t* open_file(const char* name, unsigned flags, hid_t access, haddr_t) {
  const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(access));
  if (info == nullptr) return nullptr;  // a link to another file, which nobody asked for
  int mode = (flags & H5F_ACC_RDWR) != 0 ? O_RDWR : O_RDONLY;
  if ((flags & H5F_ACC_TRUNC) != 0) mode |= O_TRUNC;
  if ((flags & H5F_ACC_CREAT) != 0) mode |= O_CREAT;
  if ((flags & H5F_ACC_EXCL) != 0) mode |= O_EXCL;
  const int descriptor = ::open(name, mode | O_CLOEXEC, 0666);
  struct stat status {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0) {
    *info->error = errno;
    if (descriptor >= 0) ::close(descriptor);
    return nullptr;
  }
  *info->error = 0;  // the library may have tried other flags before
  auto* file = new OpenFile{};
  file->descriptor = descriptor;
  file->error = info->error;
  file->end_of_file = static_cast<haddr_t>(status.st_size);
  file->device = status.st_dev;
  file->inode = status.st_ino;
  return &file->library_part;
}

herr_t close_file(H5FD_t* file) {
  OpenFile& f = own(file);
  // Network file systems may report a full disk only here.
  if (::close(f.descriptor) != 0 && *f.error == 0) *f.error = errno;
  delete &f;
  return 0;
}

int compare(const H5FD_t* a, const H5FD_t* b) {
  const OpenFile &f = own(a), &g = own(b);
  const std::pair first(f.device, f.inode), second(g.device, g.inode);
  return first < second ? -1 : first > second ? 1 : 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t end_of_allocation(const H5FD_t* file, H5FD_mem_t) { return own(file).end_of_allocation; }
haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) { return own(file).end_of_file; }
herr_t set_end_of_allocation(H5FD_t* file, H5FD_mem_t, haddr_t address) {
  own(file).end_of_allocation = address;
  return 0;
}

herr_t read_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size,
                  void* buffer) {
  const OpenFile& f = own(file);
  auto* bytes = static_cast<char*>(buffer);
  while (size > 0) {
    const auto got = ::pread(f.descriptor, bytes, size, static_cast<off_t>(address));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      if (*f.error == 0) *f.error = errno;
      return -1;
    }
    if (got == 0) {  // beyond the end: allocated, not written yet
      std::memset(bytes, 0, size);
      return 0;
    }
    const auto n = static_cast<std::size_t>(got);
    bytes += n;
    address += n;
    size -= n;
  }
  return 0;
}

herr_t write_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size,
                   const void* buffer) {
  OpenFile& f = own(file);
  const auto* bytes = static_cast<const char*>(buffer);
  const haddr_t end = address + size;
  while (size > 0 && *f.error == 0) {
    const auto put = ::pwrite(f.descriptor, bytes, size, static_cast<off_t>(address));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) {
      *f.error = errno;
      break;
    }
    const auto n = static_cast<std::size_t>(put);
    bytes += n;
    address += n;
    size -= n;
  }
  f.end_of_file = std::max(f.end_of_file, end);
  return 0;
}

herr_t truncate_file(H5FD_t* file, hid_t, hbool_t) {
  OpenFile& f = own(file);
  if (f.end_of_allocation == f.end_of_file) return 0;
  if (*f.error == 0 && ::ftruncate(f.descriptor, static_cast<off_t>(f.end_of_allocation)) != 0) {
    *f.error = errno;
  }
  f.end_of_file = f.end_of_allocation;
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
  c.cmp = compare;
  c.query = query;
  c.get_eoa = end_of_allocation;
  c.set_eoa = set_end_of_allocation;
  c.get_eof = end_of_file;
  c.read = read_bytes;
  c.write = write_bytes;
  c.truncate = truncate_file;
  constexpr H5FD_mem_t free_lists[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(free_lists), std::end(free_lists), c.fl_map);
  return c;
}

}  // namespace

hid_t file_driver() {
  static const H5FD_class_t the_class = driver_class();  // the library keeps a reference
  static const hid_t id = H5FDregister(&the_class);
  return id;
}

}  // namespace barchan::hdf5
