// What the machine must allow before MPI begins, which would end the program with words of its own.
#pragma once

namespace barchan {

/// Throws InputError with the first limit of this process that MPI and a run cannot do with.
void check_machine_limits();

}  // namespace barchan
