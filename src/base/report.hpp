// What the user sees: lines on the terminal and in log.txt, and one live line while a run goes on.
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

/// How much the terminal shows: warnings and errors; also what goes on; also every detail.
enum class Shown { problems, progress, details };

/// Terminal output from now on; ranks other than 0 are silent. Until called: progress, rank 0.
void start(Shown shown, int rank = 0);
/// Copies every line, also those that the terminal does not show, to a file. `append` keeps its
/// content. Throws std::runtime_error naming the file.
void log_to(const std::filesystem::path& file, bool append);
/// Ends log_to(): what was said is in the file.
void stop_log();

/// `mark`: what a warning or an error begins with; empty: information.
void line(std::string_view mark, std::string_view text);
/// Lines for log.txt, and for a terminal that shows details.
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

/// What a line of progress shows. Leave out what a run does not have.
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

/// One line of progress, of at most 79 characters. eta_seconds < 0: not known yet.
std::string format_progress(const Progress& progress, double eta_seconds);
/// The line for log.txt: with the rates, neighbour lists a step and pressure iterations.
std::string format_details(const Progress& progress, double eta_seconds);
/// "42 s", "3 min 05 s", "2 h 07 min", "4 d 03 h".
std::string format_duration(double seconds);

/// One line that is written over on a terminal; elsewhere (and in log.txt) a plain line about every
/// ten seconds of wall time. The time to go is estimated from the pace since construction.
class ProgressLine {
 public:
  explicit ProgressLine(std::chrono::milliseconds plain_interval = std::chrono::seconds(10));
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Cheap enough for every fluid step; draws only when a line is due.
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
