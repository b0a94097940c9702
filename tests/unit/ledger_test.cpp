// Exchange between grains and flow adds up, or the run ends.
#include "src/coupling/ledger.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace barchan {
namespace {

TEST(Ledger, AStepThatDoesNotCloseEndsTheRun) {
  const GrainState none = make_grain_state({}, 2500);
  const ExchangeLedger closed{.grain_volume = 1e-9,
                              .deposited_volume = 1e-9 * (1 + 1e-12),
                              .given_to_grains = {2e-9, 0, 0},
                              .taken_from_fluid = {2e-9, 1e-21, 0},
                              .largest_exchange = 3e-9,
                              .flow_on_solid = {},
                              .flow_on_grains = {}};
  const auto throws = [&none](const ExchangeLedger& step) {
    try {
      Ledger().close_step(step, none);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(throws(closed), "");
  ExchangeLedger off = closed;
  off.taken_from_fluid.y = 1e-17;
  EXPECT_NE(
      throws(off).find("momentum that the water gives to the grains is off by 1e-17 of 3e-09"),
      std::string::npos);
  off = closed;
  off.deposited_volume *= 1 + 1e-8;
  EXPECT_NE(throws(off).find("volume of the grains"), std::string::npos);
  off.keeps_volume = false;
  EXPECT_EQ(throws(off), "");
}

}  // namespace
}  // namespace barchan
