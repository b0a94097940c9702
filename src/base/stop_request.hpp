// A polite end: SIGINT, SIGTERM or the wall-clock limit.
#pragma once

namespace barchan {

/// From now on SIGINT and SIGTERM only leave a note; a second one ends the program at once.
void catch_stop_signals();

/// Number of the signal that came, 0 if none did.
int stop_signal();

}  // namespace barchan
