// Exceptions by whose fault a problem is, which decides the exit code.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace barchan {

/// Input of the user that cannot be used: one sentence naming the file and the place in it. Leads
/// to exit code 2; nothing has been written when it is thrown.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// All problems of a case. `lines`: one per problem, by line of the file, then "N problems; nothing
/// was run."; what() is the same as one text. Leads to exit code 2.
class ConfigError : public InputError {
 public:
  explicit ConfigError(std::vector<std::string> lines)
      : InputError(in_one(lines)), lines_(std::move(lines)) {}
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  static std::string in_one(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
    return text;
  }
  std::vector<std::string> lines_;
};

/// Tells if the problem is what Kokkos and the language throw when there is no memory left: no
/// input is at fault, and another input of the same size would not help.
inline bool is_out_of_memory(const std::exception& problem) {
  const std::string_view what = problem.what();
  return what.find("failed to allocate") != what.npos || what.find("bad_alloc") != what.npos;
}

/// Returns the result of read(); every exception that it throws becomes an InputError.
template <class Read>
auto as_input(const Read& read) {
  try {
    return read();
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& problem) {
    if (is_out_of_memory(problem)) throw;
    throw InputError(problem.what());
  }
}

/// Error of a run whose state can no longer be right: where, the likely cause and a remedy. Leads
/// to exit code 1 after the state was written for a look at it.
struct StateError : std::runtime_error {
  /// Makes the error. `together`: all ranks throw it, so they can still do something together.
  StateError(const std::string& message, bool together)
      : std::runtime_error(message), on_all_ranks(together) {}
  bool on_all_ranks;
};

}  // namespace barchan
