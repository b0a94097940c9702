// Flag for a sanitizer in this build: it takes time and memory that are not the program's.
#pragma once

namespace barchan::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace barchan::test
