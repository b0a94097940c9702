// Limits of the machine, checked before MPI begins, which would end the program with words of its
// own.
#pragma once

namespace barchan {

/// Throws InputError with the first limit of this process that is too low for MPI and a run.
void check_machine_limits();

}  // namespace barchan
