// Whole files: read if they can be, and written so that there is never half of one.
#pragma once

#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>

namespace barchan {

/// Throws std::runtime_error: "cannot <verb> <path>: <what the system says of `error`>".
[[noreturn]] void cannot(const char* verb, const std::filesystem::path& path, int error = errno);

/// Removes the name of a file or of a link, if it is there, so that a new file can be made under it
/// (with O_EXCL or the like): a link that somebody put there is then not written through.
void remove_name(const std::filesystem::path& path);

/// Writes `text` beside `path` and renames it into place: a reader, or a kill at any moment, sees
/// the old content or the new one. Throws std::runtime_error naming the file and the reason.
void write_atomically(const std::filesystem::path& path, std::string_view text);

/// Brings `from` to the disk and renames it to `to`, also when the machine stops right after.
/// Throws std::runtime_error naming the file and the reason.
void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to);

/// Adds `text` to the end of `path`, which must be no link; it is on its way to the disk when the
/// call returns. Throws std::runtime_error naming the file and the reason.
void append_text(const std::filesystem::path& path, std::string_view text);

/// Reason why `path` is not a file to read, "No such file or directory" or the like; empty if it is
/// one. Devices and pipes count as none: reading them may never end.
std::string not_a_file(const std::filesystem::path& path);

/// Content of a text file. Throws std::runtime_error naming the file and the reason.
std::string read_text(const std::filesystem::path& path);

}  // namespace barchan
