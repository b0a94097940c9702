// The bodies of a case, as the kernels know them.
#pragma once

#include "kernels/bodies/body.hpp"
#include "src/config/config.hpp"

namespace barchan {

Bodies make_bodies(const Config& config);

}  // namespace barchan
