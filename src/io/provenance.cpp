#include "src/io/provenance.hpp"

#include <array>
#include <utility>

namespace barchan {

namespace {

using Member = std::string Provenance::*;
constexpr std::array<std::pair<const char*, Member>, 5> attributes{
    {{"title", &Provenance::title},
     {"config", &Provenance::config},
     {"version", &Provenance::version},
     {"git_hash", &Provenance::git_hash},
     {"backend", &Provenance::backend}}};

}  // namespace

void write_provenance(Hdf5File& file, const Provenance& provenance) {
  for (const auto& [name, member] : attributes) file.set_attribute("/", name, provenance.*member);
}

Provenance read_provenance(const Hdf5File& file) {
  Provenance provenance;
  for (const auto& [name, member] : attributes) {
    if (file.has_attribute("/", name)) provenance.*member = file.text_attribute("/", name);
  }
  return provenance;
}

}  // namespace barchan
