#include "src/run/run_identity.hpp"

#include <Kokkos_Core.hpp>

#include "barchan_version.hpp"
#include "src/config/resolved.hpp"

namespace barchan {

std::string device_name() {
  return std::string(Kokkos::DefaultExecutionSpace::name()) + ", " +
         std::to_string(Kokkos::DefaultExecutionSpace().concurrency()) + " threads";
}

Provenance make_provenance(const Config& config) {
  return {.title = config.title,
          .config = to_toml(config),
          .version = BARCHAN_VERSION,
          .git_hash = BARCHAN_GIT_HASH,
          .backend = device_name()};
}

}  // namespace barchan
