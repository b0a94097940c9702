#include "src/base/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace barchan {

namespace {

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags)
      : fd_(::open(path.c_str(), flags, 0666)) {
    if (fd_ < 0) cannot("write", path);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { ::close(fd_); }
  int get() const { return fd_; }

  /// Writes all of `text`; `path` is for the complaint.
  void write(std::string_view text, const std::filesystem::path& path) const {
    while (!text.empty()) {
      const auto written = ::write(fd_, text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) cannot("write", path);
      text.remove_prefix(static_cast<std::size_t>(written));
    }
  }

 private:
  int fd_;
};

}  // namespace

void cannot(const char* verb, const std::filesystem::path& path, int error) {
  throw std::runtime_error(std::string("cannot ") + verb + " " + path.string() + ": " +
                           std::generic_category().message(error));
}

void remove_name(const std::filesystem::path& path) { ::unlink(path.c_str()); }

void write_atomically(const std::filesystem::path& path, std::string_view text) {
  const auto beside = std::filesystem::path(path).concat(".tmp");
  remove_name(beside);
  try {
    Descriptor(beside, O_WRONLY | O_CREAT | O_EXCL).write(text, path);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    throw;
  }
  if (std::rename(beside.c_str(), path.c_str()) != 0) cannot("write", path);
}

void append_text(const std::filesystem::path& path, std::string_view text) {
  Descriptor(path, O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW).write(text, path);
}

void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (const Descriptor file(from, O_RDWR); ::fsync(file.get()) != 0) cannot("write", from);
  if (std::rename(from.c_str(), to.c_str()) != 0) cannot("write", to);
  // Syncs the folder, because the new name is an entry of it. Some file systems cannot sync
  // folders: no harm done.
  const Descriptor folder(to.has_parent_path() ? to.parent_path() : ".", O_RDONLY | O_DIRECTORY);
  static_cast<void>(::fsync(folder.get()));
}

std::string not_a_file(const std::filesystem::path& path) {
  if (path.empty()) return "no name was given";
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  std::error_code ignored;
  if (!std::filesystem::exists(status) && std::filesystem::is_symlink(path, ignored))
    return "it is a link that leads nowhere";
  if (status.type() == std::filesystem::file_type::not_found)
    return std::generic_category().message(ENOENT);
  if (error) return error.message();
  if (std::filesystem::is_directory(status)) return "it is a folder";
  if (!std::filesystem::is_regular_file(status)) return "it is not a file but a device or a pipe";
  return ::access(path.c_str(), R_OK) == 0 ? std::string() : std::generic_category().message(errno);
}

std::string read_text(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) cannot("read", path, EISDIR);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) cannot("read", path);
  std::string text;
  std::error_code unknown;
  if (const auto size = std::filesystem::file_size(path, unknown); !unknown) text.reserve(size);
  text.assign(std::istreambuf_iterator<char>(stream), {});
  if (stream.bad()) cannot("read", path);
  return text;
}

}  // namespace barchan
