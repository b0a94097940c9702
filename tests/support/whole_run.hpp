// A run of a case from its start, or a restart file, to its end.
#pragma once

#include <filesystem>
#include <optional>

#include <gtest/gtest.h>

#include "src/base/report.hpp"
#include "src/run/simulation.hpp"

namespace barchan::test {

/// Runs `config` in `folder` to its end; returns the last restart file.
inline std::filesystem::path run_to_end(const Config& config, const std::filesystem::path& folder,
                                        const std::optional<std::filesystem::path>& restart = {}) {
  report::start(report::Shown::problems);
  Simulation simulation(config, {.folder = folder, .restart = restart}, {});
  EXPECT_EQ(simulation.run(), Outcome::done);
  report::stop_log();
  return *simulation.last_restart();
}

}  // namespace barchan::test
