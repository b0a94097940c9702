#include "src/case/ensemble_member.hpp"

namespace barchan {

Case ensemble_member(const Case& the_case, int realisation) {
  Case other = the_case;
  if (realisation == 1 || !other.random) return other;
  other.config.initial.realisation = realisation;
  other.settle();
  return other;
}

}  // namespace barchan
