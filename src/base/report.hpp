// Messages to the user: lines on the terminal and in log.txt, and one live line while a run goes
// on.
#pragma once

#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace barchan {

namespace report {

/// Amount of messages on the terminal: warnings and errors; also what goes on; also every detail.
enum class Shown { problems, progress, details };

/// Sets the terminal output from now on; ranks other than 0 are silent. Until called: progress,
/// rank 0.
void start(Shown shown, int rank = 0);
/// Copies every line, also those that the terminal does not show, to a file. `append` keeps its
/// content. Throws std::runtime_error naming the file.
void log_to(const std::filesystem::path& file, bool append);
/// Ends log_to(): all messages so far are in the file.
void stop_log();

/// Prints a line. `mark` is the beginning of a warning or an error; empty: information.
void line(std::string_view mark, std::string_view text);
/// Prints lines to log.txt, and to a terminal that shows details.
void details(std::string_view text);

template <class... Args>
void info(fmt::format_string<Args...> format, Args&&... args) {
  line("", fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void warn(fmt::format_string<Args...> format, Args&&... args) {
  line("warning: ", fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void error(fmt::format_string<Args...> format, Args&&... args) {
  line("error: ", fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace report

/// Numbers of a line of progress. Those that a run does not have stay at their defaults.
struct Progress {
  double t = 0, t_start = 0, t_end = 0;  // simulated time: now, at the start of this run, end [s]
  double grain_steps_per_second = 0;     // 0: no grains
  double list_rebuilds = 0;              // per fluid step
  double cell_steps_per_second = 0;      // 0: no fluid
  double cfl = 0;
  double pressure_iterations = 0;  // mean over the last interval
  std::int64_t n_grains = 0;
  std::optional<double> dune_width{}, dune_length{};  // [m]
};

/// Line of progress, of at most 79 characters. eta_seconds < 0: not known yet.
std::string format_progress(const Progress& progress, double eta_seconds);
/// Line of progress for log.txt: with the rates, neighbour lists a step and pressure iterations.
std::string format_details(const Progress& progress, double eta_seconds);
/// Duration in words: "42 s", "3 min 05 s", "2 h 07 min", "4 d 03 h".
std::string format_duration(double seconds);

/// Progress of a run: a line that is written over on a terminal; elsewhere (and in log.txt) a plain
/// line about every ten seconds of wall time. The time to go is estimated from the pace since
/// construction.
class ProgressLine {
 public:
  explicit ProgressLine(std::chrono::milliseconds plain_interval = std::chrono::seconds(10));
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows the progress if a line is due; cheap enough for every fluid step.
  void update(const Progress& progress);
  /// Leaves the last state on the screen and ends the line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  Clock::duration plain_interval_;
  Clock::time_point start_ = Clock::now(), last_live_ = start_, last_plain_ = start_;
  bool terminal_;
};

}  // namespace barchan
