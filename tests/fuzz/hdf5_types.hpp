// Types of numbers, texts and records that a file of somebody else may hold.
#pragma once

#include "src/io/hdf5_handle.hpp"
#include "tests/fuzz/tape.hpp"

namespace barchan::fuzz {

hdf5::Handle any_type(Tape& tape);

}  // namespace barchan::fuzz
