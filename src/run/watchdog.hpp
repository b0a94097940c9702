// Watchdog: an end for runs whose ranks wait for one that will never come.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>

namespace barchan {

/// Report of a rank that waited too long.
struct LongWait {
  int rank = 0;
  std::string host;
  double seconds = 0;              // without a heartbeat
  std::string doing = "starting";  // since then
  std::int64_t step = 0;           // fluid step at that time, 0: none yet
  double time = 0;                 // simulated time at the beginning of the step [s]
  std::string restart;             // the last good restart file, empty: none
};

/// Line for the user, with its end.
std::string to_text(const LongWait& wait);

/// A rank that hangs, or dies unseen by MPI (a stuck disk, a lost network, a deadlock), leaves the
/// others waiting for ever in a collective call. While this object lives, a thread of each rank
/// looks for heartbeats of its main thread; when none came for `patience`, it says so and ends all
/// ranks with exit code 1. One rank, or no patience: nothing is started.
class Watchdog {
 public:
  /// Starts the watchdog. `patience` in seconds of wall time, longer than anything between two
  /// heartbeats; 0: for ever.
  Watchdog(int patience, MPI_Comm communicator);

  /// Tells that the main thread goes on: `doing` completes "while". Cheap enough for every fluid
  /// step. `step`, `time` [s]: see LongWait. As with signals, there is one pulse a program.
  static void heartbeat(const char* doing, std::int64_t step = 0, double time = 0);

  /// Refers the user to this restart file from now on; empty: to none.
  static void last_good_restart(const std::filesystem::path& file);

 private:
  std::jthread thread_;  // stopped and joined by its own destructor
};

}  // namespace barchan
