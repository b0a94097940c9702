#include "src/base/input_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace barchan {

std::string not_a_file(const std::filesystem::path& path) {
  if (path.empty()) return "no name was given";
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    return std::generic_category().message(ENOENT);
  if (error) return error.message();
  if (std::filesystem::is_directory(status)) return "it is a folder";
  if (!std::filesystem::is_regular_file(status)) return "it is not a file but a device or a pipe";
  return ::access(path.c_str(), R_OK) == 0 ? std::string() : std::generic_category().message(errno);
}

}  // namespace barchan
