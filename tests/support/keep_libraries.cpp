// Linked into every program of the debug preset, so that the leak sanitizer can say whose leak a
// leak is, and tests/hygiene/leaks.supp tell those of Open MPI and PMIx from ours.
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

extern "C" {

/// Libraries stay loaded: the plug-ins of these two leak, and would be gone before the sanitizer
/// looks.
int dlclose(void*) noexcept { return 0; }

/// Asprintf as distributions compile it into libraries. The C library's own takes the memory from
/// inside, beyond which the sanitizer does not see without frame pointers.
[[gnu::format(printf, 3, 0)]] int __vasprintf_chk(char** text, int, const char* format,
                                                  std::va_list arguments) noexcept {
  std::va_list again;
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, again);
  va_end(again);
  if (length < 0) return length;
  *text = static_cast<char*>(std::malloc(static_cast<std::size_t>(length) + 1));
  if (*text == nullptr) return -1;
  return std::vsnprintf(*text, static_cast<std::size_t>(length) + 1, format, arguments);
}

[[gnu::format(printf, 3, 4)]] int __asprintf_chk(char** text, int flag, const char* format,
                                                 ...) noexcept {
  std::va_list arguments;
  va_start(arguments, format);
  const int length = __vasprintf_chk(text, flag, format, arguments);
  va_end(arguments);
  return length;
}
}
