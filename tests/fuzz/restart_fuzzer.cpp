// A restart file of a small dune, edited and sealed, as --restart reads it. It needs all of the
// program, so there is no libFuzzer of it: the inputs of the corpus, and "restart_fuzzer --random
// SECONDS".
#include <mpi.h>

#include <Kokkos_Core.hpp>
#include <cstdlib>
#include <string>

#include "src/base/atomic_file.hpp"
#include "src/base/errors.hpp"
#include "src/base/report.hpp"
#include "src/case/load.hpp"
#include "src/io/seal.hpp"
#include "src/parallel/start_mpi.hpp"
#include "src/restart/checkpoint.hpp"
#include "src/run/simulation.hpp"
#include "tests/fuzz/hdf5_files.hpp"

namespace {

using namespace barchan;

constexpr const char* small_case = R"(
[time]
end = 5e-4
fluid_step = 2.5e-4
grain_step = 5e-6
[domain]
size = [0.004, 0.003, 0.003]
[fluid]
cells = [4, 4, 4]
mean_velocity = 0.1
[grains]
youngs_modulus = 1.25e6
rolling_friction = 0.1
sizes = [[2e-4, 8]]
[initial]
grains = { pour = { centre = [0.002, 0.0015], radius = 6e-4, drop_height = 0.0 } }
[statistics]
start = 0.0
interval = 2.5e-4
fields = true
grain_forces = true
bed_load = true
)";

Simulation simulation(const std::optional<std::filesystem::path>& restart) {
  static const auto folder = fuzz::input_file("run");
  const Config config = load_config_text(small_case, "case.toml");
  return as_input([&] { return Simulation(config, {.folder = folder, .restart = restart}, {}); });
}

/// A restart file after two steps.
std::string valid_restart() {
  simulation({}).run();
  return read_text(latest_checkpoint(fuzz::input_file("run")).value());
}

}  // namespace

int LLVMFuzzerInitialize(int* argc, char*** argv) {
  start_mpi(argc, argv);
  Kokkos::initialize(Kokkos::InitializationSettings().set_num_threads(1));
  std::atexit([] {
    Kokkos::finalize();
    MPI_Finalize();
  });
  report::start(report::Shown::problems);
  return 0;
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto file = fuzz::input_file("restart_0000000002.h5");
  static const std::string valid = valid_restart();
  fuzz::write_input(file, valid.data(), valid.size());
  fuzz::edit(file, fuzz::Tape({data, size}));
  seal(file);
  fuzz::accepts<InputError>([&] { simulation(file); });
  return 0;
}
