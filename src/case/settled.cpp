#include "src/case/settled.hpp"

#include "src/case/heaps.hpp"

namespace barchan {

SettledCase::SettledCase(const Config& the_config, const std::vector<SizeClass>& the_sizes,
                         double top)
    : config(the_config),
      sizes(the_sizes),
      coupled(config),
      heaps(poured_heaps(config)),
      numbers(derive(config, sizes, top)) {}

const Bodies& SettledCase::bodies() const {
  return coupled.fluid ? coupled.fluid->bodies : grains().bodies;
}

}  // namespace barchan
