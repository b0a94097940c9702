// What the fuzz targets share: what a reader of foreign input may do with bytes it does not like.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

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

/// A library that is not instrumented: what it complains of stands for the places it has been to.
inline void mark(std::size_t place) {
#ifdef BARCHAN_LIBFUZZER
  constexpr std::size_t n = 1 << 13;
  __attribute__((used, section("__libfuzzer_extra_counters"))) static std::uint8_t counters[n];
  auto& counter = counters[place % n];
  if (counter < 255) ++counter;
#else
  static_cast<void>(place);
#endif
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

}  // namespace barchan::fuzz
