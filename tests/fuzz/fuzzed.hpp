// Common part of the fuzz targets: what a reader of foreign input may do with bytes it does not
// like.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <span>
#include <stdexcept>
#include <string_view>
#include <unordered_set>

#include "src/grains/initial_grains.hpp"

/// The entry that libFuzzer and replay.cpp call.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
/// Called once before; a target may have its own.
extern "C" __attribute__((weak)) int LLVMFuzzerInitialize(int* argc, char*** argv);

namespace barchan::fuzz {

using Bytes = std::span<const std::uint8_t>;

inline std::string_view as_text(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Ends the program as a finding.
[[noreturn]] inline void violated(std::string_view property, std::string_view detail = {}) {
  std::cerr << "property violated: " << property << ' ' << detail << '\n' << std::flush;
  std::abort();
}

inline void demand(bool holds, std::string_view property, std::string_view detail = {}) {
  if (!holds) violated(property, detail);
}

/// True if the call returns. It may refuse by a `Refusal` with a sentence for the user; any other
/// exception (an allocation that failed, an index out of range) means that something was believed
/// unchecked.
template <class Refusal = std::runtime_error, class Call>
bool accepts(const Call& call) {
  try {
    call();
    return true;
  } catch (const Refusal& problem) {
    demand(!std::string_view(problem.what()).empty(), "a refusal says why");
  } catch (const std::exception& problem) {
    violated("refusals are sentences for the user, not:", problem.what());
  } catch (...) {
    violated("nothing but a std::exception is thrown");
  }
  return false;
}

/// Bytes read as decisions: the same bytes give the same ones; zeros when they are used up.
class Tape {
 public:
  explicit Tape(Bytes bytes) : rest_(bytes) {}

  bool empty() const { return rest_.empty(); }

  std::uint8_t byte() {
    if (rest_.empty()) return 0;
    const auto first = rest_.front();
    rest_ = rest_.subspan(1);
    return first;
  }

  /// Picks one of n choices.
  std::size_t pick(std::size_t n) { return byte() % n; }
  template <class T, std::size_t N>
  T one_of(const std::array<T, N>& values) {
    return values[pick(N)];
  }

  /// Numbers that readers trip over.
  double number() {
    using Limits = std::numeric_limits<double>;
    return one_of(std::array{0.0, 1.0, -1.0, 0.5, 1e-300, 1e300, -1e300, 9.3e18, Limits::max(),
                             Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(),
                             Limits::denorm_min(), -0.0, 3e9, 2e-4});
  }
  std::int64_t integer() {
    using Limits = std::numeric_limits<std::int64_t>;
    return one_of(std::array<std::int64_t, 12>{0, 1, 2, 3, -1, 255, 1 << 20, std::int64_t{1} << 31,
                                               std::int64_t{1} << 32, Limits::max(), Limits::min(),
                                               5});
  }
  std::uint64_t extent() {
    return one_of(std::array<std::uint64_t, 16>{0, 1, 2, 3, 4, 12, 6, 100, 1000, 30000, 1 << 20,
                                                std::uint64_t{1} << 31, std::uint64_t{1} << 32,
                                                std::uint64_t{1} << 40, std::uint64_t{1} << 61,
                                                (std::uint64_t{1} << 62) + 1});
  }

 private:
  Bytes rest_;
};

/// Checks that grains a reader has accepted are such as a run relies on.
inline void demand_sound(const InitialGrains& grains) {
  const auto finite = [](const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  const std::size_t n = grains.size();
  demand(grains.diameter.size() == n && grains.x.size() == n && grains.u.size() == n &&
             grains.omega.size() == n && grains.id.size() == n,
         "every grain has all its numbers");
  std::unordered_set<std::int64_t> ids;
  for (std::size_t g = 0; g < n; ++g) {
    demand(grains.diameter[g] > 0 && std::isfinite(grains.diameter[g]), "diameters are positive");
    demand(finite(grains.x[g]) && finite(grains.u[g]) && finite(grains.omega[g]),
           "positions and velocities are finite");
    demand(ids.insert(grains.id[g]).second, "ids are unique");
  }
}

}  // namespace barchan::fuzz
