#include "src/base/report.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "src/base/atomic_file.hpp"

namespace barchan {

namespace {

/// State of the terminal. It has at most one live line; log lines go above it.
struct State {
  report::Shown shown = report::Shown::progress;
  bool silent = false;
  bool live = false;  // a live line is on the screen, its end not yet written
  std::ofstream log;
};

State& state() {
  static State the_state;
  return the_state;
}

constexpr const char* kClearLine = "\r\033[K";

/// Writes to a stream whose reader may go away (`| head`); that must not cost the run.
void put(std::FILE* stream, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stream);
  std::fflush(stream);
}

void print(std::FILE* stream, std::string_view text) {
  if (state().live) std::fputs(kClearLine, stdout);
  state().live = false;
  std::fflush(stdout);  // keeps the two streams in order
  put(stream, fmt::format("{}\n", text));
}

/// Adds a line to log.txt. A full disk is reported by the results themselves; the log must not stop
/// or clutter the run.
void log(std::string_view text) {
  std::ofstream& file = state().log;
  file.clear();
  if (file.is_open()) file << text << '\n' << std::flush;
}

/// Shows the live line, cut to the width of the terminal: a wrapped line could not be written over.
void show_live(std::string_view text) {
  winsize window{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 1) {
    text = text.substr(0, window.ws_col - 1U);
  }
  put(stdout, fmt::format("{}{}", kClearLine, text));
  state().live = true;
}

std::string si_rate(double rate) {
  if (rate >= 1e9) return fmt::format("{:.2f} G", rate / 1e9);
  if (rate >= 1e6) return fmt::format("{:.2f} M", rate / 1e6);
  return fmt::format("{:.1f} k", rate / 1e3);
}

constexpr auto kLiveInterval = std::chrono::milliseconds(250);

}  // namespace

namespace report {

void start(Shown shown, int rank) {
  state().shown = shown;
  state().silent = rank != 0;
}

void log_to(const std::filesystem::path& file, bool append) {
  if (state().silent) return;
  stop_log();
  // A link that somebody put there would lead our lines elsewhere.
  if (std::filesystem::is_symlink(file)) remove_name(file);
  state().log.open(file, std::ios::binary | (append ? std::ios::app : std::ios::trunc));
  if (!state().log.is_open()) cannot("write", file);
}

void stop_log() {
  state().log.clear();
  if (state().log.is_open()) state().log.close();
}

void line(std::string_view mark, std::string_view text) {
  if (state().silent) return;
  const std::string marked = fmt::format("{}{}", mark, text);
  if (!mark.empty()) {
    print(stderr, marked);
  } else if (state().shown >= Shown::progress) {
    print(stdout, marked);
  }
  log(marked);
}

void details(std::string_view text) {
  if (state().silent) return;
  if (state().shown >= Shown::details) print(stdout, text);
  log(text);
}

}  // namespace report

std::string format_duration(double seconds) {
  if (!(seconds >= 0) || seconds > 1e9) return "?";
  const auto s = static_cast<std::int64_t>(std::llround(seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  if (s < 86400) return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
  return fmt::format("{} d {:02} h", s / 86400, s % 86400 / 3600);
}

std::string format_progress(const Progress& p, double eta_seconds) {
  const double percent = p.t_end > 0 ? 100.0 * p.t / p.t_end : 0.0;
  std::string text = fmt::format("{:.0f} %", percent);
  if (eta_seconds >= 0) text += "  left " + format_duration(eta_seconds);
  text += fmt::format("  t {:.4g} s", p.t);
  if (p.dune_width && p.dune_length) {
    text += fmt::format("  W {:.1f} mm  L {:.1f} mm", 1e3 * *p.dune_width, 1e3 * *p.dune_length);
  } else if (p.n_grains > 0) {
    text += fmt::format("  grains {}", p.n_grains);
  }
  if (p.cell_steps_per_second > 0) text += fmt::format("  CFL {:.2g}", p.cfl);
  return text;
}

std::string format_details(const Progress& p, double eta_seconds) {
  std::string text = format_progress(p, eta_seconds);
  if (p.dune_width && p.n_grains > 0) text += fmt::format("  grains {}", p.n_grains);
  if (p.grain_steps_per_second > 0) {
    text += fmt::format("  {} grain-steps/s  {:.2g} lists/step", si_rate(p.grain_steps_per_second),
                        p.list_rebuilds);
  }
  if (p.cell_steps_per_second > 0) {
    text += fmt::format("  {} cell-steps/s  p-it {:.1f}", si_rate(p.cell_steps_per_second),
                        p.pressure_iterations);
  }
  return text;
}

ProgressLine::ProgressLine(std::chrono::milliseconds plain_interval)
    : plain_interval_(plain_interval), terminal_(isatty(STDOUT_FILENO) != 0) {}

ProgressLine::~ProgressLine() { finish(); }

void ProgressLine::update(const Progress& progress) {
  const auto now = Clock::now();
  const bool plain = now - last_plain_ >= plain_interval_;
  const bool shown = state().shown >= report::Shown::progress;
  const bool live = terminal_ && shown && now - last_live_ >= kLiveInterval;
  if (state().silent || !(plain || live)) return;
  const double wall = std::chrono::duration<double>(now - start_).count();
  const double done = progress.t - progress.t_start;
  const double eta = done > 0 ? wall * std::max(0.0, progress.t_end - progress.t) / done : -1.0;
  const std::string details = format_details(progress, eta);
  const std::string text =
      state().shown == report::Shown::details ? details : format_progress(progress, eta);
  if (plain) {
    last_plain_ = now;
    if (!terminal_ && shown) print(stdout, text);
    log(details);
  }
  if (live) {
    last_live_ = now;
    show_live(text);
  }
}

void ProgressLine::finish() {
  if (!state().live) return;
  put(stdout, "\n");
  state().live = false;
}

}  // namespace barchan
