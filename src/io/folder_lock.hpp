// One writer for a folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace barchan {

/// Throws InputError: results cannot go to `folder`, and why.
[[noreturn]] void refuse_folder(const std::filesystem::path& folder, const std::string& why);

/// Keeps a folder to this process while it lives: flock on DIR/.barchan.lock, in which host,
/// process and time stand for others to read. The kernel lets it go when the process ends, however
/// it ends, so it is never stale. On file systems without locks it says so (`enforced`).
class FolderLock {
 public:
  /// Makes the folder if there is none. Empty if another process has it. Throws InputError naming
  /// the folder and the reason when nothing can be written there.
  static std::optional<FolderLock> take(const std::filesystem::path& folder);

  static std::filesystem::path file_in(const std::filesystem::path& folder);
  /// Who has it, in words: "process 123 on host since 2026-11-25 10:00:00".
  static std::string holder_of(const std::filesystem::path& folder);

  /// Removes the file, and folders that this made if nothing was put there.
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  FolderLock& operator=(FolderLock&&) = delete;

  /// False where the file system knows no locks: then nothing keeps a second writer out.
  bool enforced() const { return enforced_; }

 private:
  FolderLock(std::filesystem::path file, int descriptor, bool enforced,
             std::vector<std::filesystem::path> made);

  std::filesystem::path file_;
  int descriptor_ = -1;
  bool enforced_ = false;
  std::vector<std::filesystem::path> made_;  // folders, the deepest first
};

}  // namespace barchan
