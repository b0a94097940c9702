#include "src/run/watchdog.hpp"

#include <gtest/gtest.h>

namespace barchan {
namespace {

TEST(Watchdog, SaysWhoWaitedWhereAndWhatToDo) {
  EXPECT_EQ(to_text({.rank = 3,
                     .host = "node7",
                     .seconds = 602.25,
                     .doing = "computing",
                     .step = 1234,
                     .time = 0.30825,
                     .restart = "runs/a/restart_0000001200.h5"}),
            "error: rank 3 on node7 has waited 602 s while computing (fluid step 1234, t = 0.30825 "
            "s): another rank, the network or a disk hangs, or --patience is too short; go on with "
            "the last good restart, runs/a/restart_0000001200.h5\n");
}

TEST(Watchdog, BeforeTheFirstStepThereIsNothingToGoOnFrom) {
  LongWait wait;
  wait.host = "node1";
  wait.seconds = 20;
  wait.doing = "setting up";
  EXPECT_EQ(to_text(wait),
            "error: rank 0 on node1 has waited 20 s while setting up: another rank, the network or "
            "a disk hangs, or --patience is too short\n");
}

}  // namespace
}  // namespace barchan
