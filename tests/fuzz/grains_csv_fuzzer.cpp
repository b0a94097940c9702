// Bytes as the table of initial.grains.
#include "src/initial/grain_table.hpp"
#include "tests/fuzz/fuzzed.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barchan;
  fuzz::accepts([&] {
    const auto grains = parse_grains_csv(fuzz::as_text({data, size}), "heap.csv");
    fuzz::demand(grains.size() > 0, "a table without grains is refused");
    fuzz::demand_sound(grains);
  });
  return 0;
}
