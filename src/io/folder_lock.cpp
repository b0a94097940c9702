#include "src/io/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <ctime>
#include <fstream>

#include "src/base/errors.hpp"

namespace barchan {

namespace fs = std::filesystem;

namespace {

/// True if `file` still names what is open: a holder that ends removes the file, and whoever waited
/// for that one has then locked a file that nobody else finds.
bool names_open_file(const fs::path& file, int descriptor) {
  struct stat open_file {
  }, named{};
  return ::fstat(descriptor, &open_file) == 0 && ::lstat(file.c_str(), &named) == 0 &&
         open_file.st_ino == named.st_ino && open_file.st_dev == named.st_dev;
}

std::string about_this_process() {
  char host[256] = "an unknown host";
  ::gethostname(host, sizeof host - 1);
  const std::time_t now = std::time(nullptr);
  return fmt::format("process {} on {} since {:%Y-%m-%d %H:%M:%S}\n", ::getpid(), host,
                     fmt::localtime(now));
}

/// For others to read. A full disk must not keep a run from being refused or told.
void write_holder(int descriptor) {
  const std::string text = about_this_process();
  if (::ftruncate(descriptor, 0) == 0) {
    [[maybe_unused]] const auto written = ::pwrite(descriptor, text.data(), text.size(), 0);
  }
}

}  // namespace

void refuse_folder(const fs::path& folder, const std::string& why) {
  throw InputError(
      fmt::format("cannot write results to {}: {}; take another --out", folder.string(), why));
}

std::optional<FolderLock> FolderLock::take(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> made;
  for (fs::path at = fs::absolute(folder).lexically_normal(); !fs::exists(at, error);
       at = at.parent_path())
    if (at.has_filename()) made.push_back(at);
  fs::create_directories(folder, error);
  if (error) refuse_folder(folder, error.message());
  const fs::path file = file_in(folder);
  for (;;) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor < 0) refuse_folder(folder, std::generic_category().message(errno));
    const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    if (!locked && errno == EWOULDBLOCK) {
      ::close(descriptor);
      return std::nullopt;
    }
    if (locked && !names_open_file(file, descriptor)) {
      ::close(descriptor);
      continue;
    }
    write_holder(descriptor);
    return FolderLock(file, descriptor, locked, std::move(made));
  }
}

fs::path FolderLock::file_in(const fs::path& folder) { return folder / ".barchan.lock"; }

std::string FolderLock::holder_of(const fs::path& folder) {
  std::string words;
  std::ifstream in(file_in(folder));
  std::getline(in, words);
  return words.empty() ? "another process" : words;
}

FolderLock::FolderLock(fs::path file, int descriptor, bool enforced, std::vector<fs::path> made)
    : file_(std::move(file)),
      descriptor_(descriptor),
      enforced_(enforced),
      made_(std::move(made)) {}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : file_(std::move(other.file_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      enforced_(other.enforced_),
      made_(std::move(other.made_)) {}

FolderLock::~FolderLock() {
  if (descriptor_ < 0) return;
  if (names_open_file(file_, descriptor_)) ::unlink(file_.c_str());
  for (const fs::path& folder : made_) ::rmdir(folder.c_str());  // fails if anything is in it
  ::close(descriptor_);
}

}  // namespace barchan
