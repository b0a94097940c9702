// Members of an ensemble: the same case from another packing, or from a later moment of the flow.
#pragma once

#include "src/case/load.hpp"

namespace barchan {

/// Case that others start from, in a realisation (1: as it stands). A turbulent flow without grains
/// goes on for one turnover, depth over friction velocity, per realisation: the same run at another
/// time. Other cases take other random numbers (initial.realisation). A case that draws none stays
/// as it is.
Case ensemble_member(const Case& the_case, int realisation);

}  // namespace barchan
