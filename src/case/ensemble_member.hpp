// Members of an ensemble: the same case from another packing and another turbulent flow.
#pragma once

#include "src/case/load.hpp"

namespace barchan {

/// Case that others start from, in a realisation (1: as it stands): with other random numbers
/// (initial.realisation). A later moment of one flow would not do: slow and fast stretches across a
/// small box live for several turnovers. A case that draws none stays as it is.
Case ensemble_member(const Case& the_case, int realisation);

}  // namespace barchan
