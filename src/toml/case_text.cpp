#include "src/toml/case_text.hpp"

#include <fmt/format.h>

#include "src/base/atomic_file.hpp"
#include "src/base/words.hpp"

namespace barchan {
namespace fs = std::filesystem;

std::optional<std::string> case_text(const fs::path& file, std::vector<Problem>& problems) {
  // Longest text of a case [bytes]: far more than any case has, far less than results that are
  // given for one by mistake.
  constexpr std::uintmax_t longest = 10'000'000;
  std::string why = not_a_file(file);
  if (why.empty() && fs::file_size(file) > longest) {
    why = fmt::format("it is {} MB long, and a case is a few kB of TOML",
                      fs::file_size(file) / 1'000'000);
  }
  if (!why.empty()) {
    std::error_code ignored;
    const bool absent = !file.empty() && !fs::exists(file, ignored);
    problems.push_back({{file.empty() ? "CASE" : file.string(), 0},
                        "cannot be read: " + why + (absent ? nearest_file(file) : "")});
    return {};
  }
  return read_text(file);
}

}  // namespace barchan
