// Initial state of a run.
#pragma once

#include <filesystem>

#include "src/case/settled.hpp"
#include "src/coupling/system_state.hpp"
#include "src/grains/initial_grains.hpp"

namespace barchan {

/// Files that the initial state comes from, once every .toml has become a restart file.
struct InitialFiles {
  std::filesystem::path fluid, grains;  // empty: not from a file
  std::string record{};                 // record of their content (src/run/case_inputs.hpp)
};

/// Gives the grains that come from `source` the kinds of the case; `source` has them in an order of
/// its own. Throws InputError if the case does not have them all, with the shapes that they have.
void take_kinds(InitialGrains& grains, const GrainConfig& config, const std::string& source);

/// Refuses grains of sizes that do not suit the steps or the domain: InputError, which says that
/// they came from `source`.
void check_sizes(const std::vector<SizeClass>& sizes, const Config& config,
                 const std::string& source);

/// Refuses numbers of grains so large that those of [grains.feed] would find none behind them.
/// `last`: the largest. Throws InputError, which says that they came from `source`.
void check_free_ids(const Config& config, std::int64_t last, const std::string& source);

/// Source of a case's grains, for messages: the key that pours them, or the `file`.
std::string source_of_grains(const Config& config, const std::filesystem::path& file);

/// Grains that a case starts with: poured, or read from a .csv or .h5 `file`. Throws InputError if
/// the case does not suit them, and whatever the readers throw.
InitialGrains checked_grains(const SettledCase& the_case, const std::filesystem::path& file);

/// Spheres of these grains as a case starts with them; clumps without an orientation get one by
/// chance, that of the case's seed and realisation.
InitialGrains spheres_at_start(const InitialGrains& grains, const Config& config);

/// Makes the initial state: a flow at rest, uniform, turbulent or from a file; grains poured or
/// from a file. The grains' list and the fluid fraction come with CoupledStep::start. Among
/// `ranks`, the flow on `pencils`. Throws InputError if a file does not fit, and whatever the
/// readers throw.
SystemState make_initial_state(const SettledCase& the_case, const InitialFiles& files,
                               MPI_Comm ranks = MPI_COMM_SELF,
                               const Decomposition* pencils = nullptr);

}  // namespace barchan
