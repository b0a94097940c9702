// Every way in which a case may exchange momentum, for tests that go through all of them.
#pragma once

#include <array>

#include "src/case/config.hpp"

namespace barchan::test {

struct Scheme {
  const char* name;
  CouplingScheme scheme;
  VoidFraction void_fraction = VoidFraction::divided;  // of those that may choose
  bool cfdem_smooths = false;

  bool keeps_volume() const { return scheme != CouplingScheme::cfdem; }
  void choose(CouplingConfig& c) const {
    c.scheme = scheme;
    if (scheme == CouplingScheme::centred) c.centred.void_fraction = void_fraction;
    if (scheme == CouplingScheme::smoothed) c.smoothed.void_fraction = void_fraction;
    c.cfdem.smooth_exchange = cfdem_smooths;
  }
};

inline constexpr std::array<Scheme, 7> kSchemes{
    {{"layered", CouplingScheme::layered},
     {"centred", CouplingScheme::centred},
     {"centred, by centres", CouplingScheme::centred, VoidFraction::centre},
     {"smoothed", CouplingScheme::smoothed},
     {"smoothed, by centres", CouplingScheme::smoothed, VoidFraction::centre},
     {"cfdem", CouplingScheme::cfdem},
     {"cfdem, smoothed", CouplingScheme::cfdem, VoidFraction::divided, true}}};

}  // namespace barchan::test
