// Lengths as a case may write them: a number of metres, or a text such as "0.2 mm" or "3 d".
#pragma once

#include "src/toml/values.hpp"

namespace barchan {

/// Number rounded to so many significant decimal digits.
double rounded(double x, int digits);

/// Tells if a value, or one in its list, is a text in mean grain diameters.
bool is_in_diameters(const Node& value);

/// Turns the texts in a value into numbers of metres. `diameter`: the d of the case [m].
Mismatch make_metres(Node& value, double diameter = 0);

}  // namespace barchan
