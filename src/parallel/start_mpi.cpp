#include "src/parallel/start_mpi.hpp"

#include <mpi.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>
#include <utility>

namespace barchan {
namespace {

/// Tells a process of mpirun, srun or another launcher by what these put into its environment.
bool is_launched() {
  for (char** setting = environ; *setting != nullptr; ++setting) {
    const std::string_view name(*setting);
    if (name.starts_with("PMI") || name.starts_with("OMPI_COMM_WORLD_")) return true;
  }
  return false;
}

}  // namespace

void start_mpi(int* argc, char*** argv) {
  if (!is_launched()) {
    for (const auto& [name, value] : {std::pair{"OMPI_MCA_ess_singleton_isolated", "1"},
                                      {"OMPI_MCA_orte_create_session_dirs", "0"},
                                      {"OMPI_MCA_pml", "ob1"},
                                      {"OMPI_MCA_btl", "self"},
                                      {"OMPI_MCA_osc", "^ucx"}}) {
      constexpr int kKeepTheUsers = 0;
      ::setenv(name, value, kKeepTheUsers);  // NOLINT(concurrency-mt-unsafe): no other threads yet
    }
  }
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(argc, argv, MPI_THREAD_SERIALIZED, &provided);
}

}  // namespace barchan
