#include "src/io/hdf5_file.hpp"

#include <fcntl.h>
#include <fmt/ranges.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <system_error>
#include <utility>

#include "src/base/atomic_file.hpp"
#include "src/io/hdf5_handle.hpp"
#include "src/io/seal.hpp"
#include "src/parallel/communicator.hpp"

namespace barchan {

using hdf5::Handle;

namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

// Room in the header of the root, of which 64 kB is the most. Its attributes take some.
constexpr unsigned kRootLinks = 1600, kNameBytes = 12;

Handle access_list(bool parallel, MPI_Comm communicator, std::string* failure) {
  Handle list(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  if (parallel) {
    H5Pset_fapl_mpio(list.get(), communicator, MPI_INFO_NULL);
  } else {
    const hdf5::DriverInfo info{.failure = failure};
    H5Pset_driver(list.get(), hdf5::file_driver(), &info);
  }
  H5Pset_fclose_degree(list.get(), H5F_CLOSE_STRONG);  // nothing outlives the Hdf5File
  return list;
}

/// Groups keep their links in their header; `room`: for so many from the start.
Handle creation_list(hid_t kind, unsigned room) {
  const unsigned compact_links = std::max(room, 64u);
  Handle list(H5Pcreate(kind), H5Pclose);
  H5Pset_link_creation_order(list.get(), H5P_CRT_ORDER_TRACKED);
  H5Pset_link_phase_change(list.get(), compact_links, compact_links / 2);
  if (room > 0) H5Pset_est_link_info(list.get(), room, kNameBytes);
  H5Pset_obj_track_times(list.get(), false);
  return list;
}

Handle file_creation_list(bool sealable) {
  Handle list = creation_list(H5P_FILE_CREATE, sealable ? 0 : kRootLinks);
  if (sealable) H5Pset_userblock(list.get(), kSealBytes);
  return list;
}

}  // namespace

std::string to_string(const Extents& extents) {
  return fmt::format("{}", fmt::join(extents, " x "));
}

void Hdf5File::fail(const std::string& reason, const std::string& object) const {
  std::string text = mode_ == Mode::read ? "cannot read " : "cannot write ";
  // Files on their way to a name are known to the user by that name.
  const bool beside = path_.extension() == ".tmp";
  text += (beside ? std::filesystem::path(path_).replace_extension() : path_).string();
  text += ": " + reason;
  if (!object.empty()) text += " (" + object + ")";
  throw Hdf5Error(text);
}

template <class Code>
Code Hdf5File::check(Code code, const std::string& object) const {
  if (code < 0) fail(failure_->empty() ? hdf5::last_reason() : *failure_, object);
  return code;
}
template int Hdf5File::check(int, const std::string&) const;
template std::int64_t Hdf5File::check(std::int64_t, const std::string&) const;

Hdf5File::Hdf5File(const std::filesystem::path& path, Mode mode, MPI_Comm communicator)
    : path_(path),
      mode_(mode),
      communicator_(communicator),
      parallel_(rank_count(communicator) > 1),
      is_root_(rank_of(communicator) == 0),
      failure_(std::make_unique<std::string>()) {
  hdf5::start_library();
  if (mode == Mode::read) {  // opening a pipe would wait for ever
    if (const std::string why = not_a_file(path); !why.empty()) fail(why, {});
  }
  const Handle access = access_list(parallel_, communicator, failure_.get());
  Id opened = -1;
  if (mode == Mode::create || mode == Mode::create_sealable) {
    const Handle creation = file_creation_list(mode == Mode::create_sealable);
    if (is_root_) remove_name(path);
    if (parallel_) synchronise(communicator);
    opened = H5Fcreate(path.c_str(), H5F_ACC_EXCL, creation.get(), access.get());
  } else {
    const unsigned flags = mode == Mode::read ? H5F_ACC_RDONLY : H5F_ACC_RDWR;
    opened = H5Fopen(path.c_str(), flags, access.get());
  }
  file_ = check(opened);
}

Hdf5File::~Hdf5File() {
  if (parallel_ && std::uncaught_exceptions() > 0) return;
  if (hidden_ >= 0) H5Gclose(hidden_);
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::check_writes() const {
  if (!failure_->empty()) fail(*failure_, {});
}

void Hdf5File::take_room() const {
#ifdef __linux__
  constexpr off_t tables = 1 << 16;  // most that the library puts behind the end at the close
  const int file = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  struct stat status {};
  int error = file < 0 || ::fstat(file, &status) != 0 ? errno : 0;
  const off_t end = status.st_size + tables;
  rlimit limit{};
  if (error == 0 && ::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur < rlim_t(end)) {
    error = EFBIG;
  } else if (error == 0 && ::fallocate(file, FALLOC_FL_KEEP_SIZE, 0, end) != 0) {
    error = errno;
  }
  if (file >= 0) ::close(file);
  const bool cannot_tell = error == EOPNOTSUPP || error == ENOSYS || error == EINTR;
  if (error != 0 && !cannot_tell) fail(std::generic_category().message(error), {});
#endif
}

void Hdf5File::close() {
  if (parallel_ && mode_ != Mode::read && file_ >= 0) take_room();
  if (hidden_ >= 0) check(H5Gclose(std::exchange(hidden_, -1)));
  if (file_ >= 0) check(H5Fclose(std::exchange(file_, -1)));
  check_writes();
}

Hdf5File::Location Hdf5File::locate(const std::string& name) const {
  if (hidden_ >= 0 && name == hidden_name_) return {hidden_, "."};
  if (hidden_ >= 0 && name.starts_with(hidden_name_ + "/")) {
    return {hidden_, name.substr(hidden_name_.size() + 1)};
  }
  return {file_, name};
}

bool Hdf5File::exists(const std::string& name) const {
  const auto [base, path] = locate(name);
  if (path == "." || path == "/") return true;
  // The library wants every group on the way to be asked for on its own.
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    if (check(H5Lexists(base, path.substr(0, end).c_str(), H5P_DEFAULT), name) == 0) return false;
    if (end == std::string::npos) return true;
  }
}

bool Hdf5File::is_group(const std::string& name) const {
  const auto [base, path] = locate(name);
  const Handle object(check(H5Oopen(base, path.c_str(), H5P_DEFAULT), name), H5Oclose);
  return H5Iget_type(object.get()) == H5I_GROUP;
}

std::vector<std::string> Hdf5File::children(const std::string& group) const {
  const auto [base, path] = locate(group);
  const Handle open(check(H5Gopen2(base, path.c_str(), H5P_DEFAULT), group), H5Gclose);
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  check(H5Literate(open.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), group);
  return names;
}

void Hdf5File::copy_from(const Hdf5File& source, const std::string& name, const std::string& as) {
  check(H5Ocopy(source.file_, name.c_str(), file_, as.c_str(), H5P_DEFAULT, H5P_DEFAULT), name);
  check_writes();
}

void Hdf5File::make_group(const std::string& name, unsigned room) {
  if (name.empty() || exists(name)) return;
  if (const auto slash = name.rfind('/'); slash != std::string::npos) {
    make_group(name.substr(0, slash));
  }
  const auto [base, path] = locate(name);
  const Handle creation = creation_list(H5P_GROUP_CREATE, room);
  const Handle group(
      check(H5Gcreate2(base, path.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), name),
      H5Gclose);
}

bool Hdf5File::has_room() const {
  const Handle root(check(H5Gopen2(file_, "/", H5P_DEFAULT)), H5Gclose);
  const Handle creation(check(H5Gget_create_plist(root.get())), H5Pclose);
  unsigned links = 0, name_bytes = 0;
  check(H5Pget_est_link_info(creation.get(), &links, &name_bytes));
  return links >= kRootLinks && name_bytes >= kNameBytes;
}

void Hdf5File::begin_hidden_group(const std::string& as) {
  hidden_ = check(H5Gcreate_anon(file_, creation_list(H5P_GROUP_CREATE, 0).get(), H5P_DEFAULT), as);
  hidden_name_ = as;
}

void Hdf5File::publish_group() {
  // Counted as if something led to it, else closing the file would remove it.
  check(H5Oincr_refcount(hidden_), hidden_name_);
  hobj_ref_t address = 0;
  check(H5Rcreate(&address, hidden_, ".", H5R_OBJECT, -1), hidden_name_);
  // The data are on the disk before the link to them.
  if (!parallel_) {
    check(H5Fflush(file_, H5F_SCOPE_GLOBAL));
    check_writes();
    check(H5Gclose(std::exchange(hidden_, -1)), hidden_name_);
    link(address, hidden_name_);
    return close();
  }
  close();
  synchronise(communicator_);
  if (is_root_) {  // through the serial driver
    Hdf5File serial(path_, Mode::modify);
    serial.link(address, hidden_name_);
    serial.close();
  }
  synchronise(communicator_);
}

/// Gives the group at `address` its name. What was in the file before changes in one place only:
/// the header of the group that gets the name, where the driver writes the link's first word last.
void Hdf5File::link(std::uint64_t address, const std::string& as) {
  const hobj_ref_t reference = address;
  const Handle object(check(H5Rdereference2(file_, H5P_DEFAULT, H5R_OBJECT, &reference), as),
                      H5Oclose);
  const auto slash = as.find('/');
  const std::string group = slash == std::string::npos ? "/" : as.substr(0, slash);
  if (exists(group)) {
    check(H5Olink(object.get(), file_, as.c_str(), H5P_DEFAULT, H5P_DEFAULT), as);
  } else {  // a new group, which is complete before it has a name
    const Handle creation = creation_list(H5P_GROUP_CREATE, kGroupLinks);
    const Handle made(check(H5Gcreate_anon(file_, creation.get(), H5P_DEFAULT), group), H5Gclose);
    check(H5Oincr_refcount(made.get()), group);
    check(H5Olink(object.get(), made.get(), as.c_str() + slash + 1, H5P_DEFAULT, H5P_DEFAULT), as);
    check(H5Fflush(file_, H5F_SCOPE_GLOBAL));
    check(H5Olink(made.get(), file_, group.c_str(), H5P_DEFAULT, H5P_DEFAULT), group);
    check(H5Odecr_refcount(made.get()), group);
  }
  check(H5Odecr_refcount(object.get()), as);
}

}  // namespace barchan
