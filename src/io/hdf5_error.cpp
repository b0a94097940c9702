#include <array>

#include "src/io/hdf5_handle.hpp"

namespace barchan::hdf5 {

namespace {

herr_t take_first(unsigned, const H5E_error2_t* entry, void* reason) {
  auto& text = *static_cast<std::string*>(reason);
  if (text.empty() && entry->desc != nullptr) text = entry->desc;
  return 0;
}

}  // namespace

void start_library() {
  static const bool started = [] {
    H5open();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return true;
  }();
  static_cast<void>(started);
}

std::string last_reason() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &text);
  struct Plain {
    const char *theirs, *ours;
  };
  static constexpr std::array<Plain, 3> plain{
      {{"file signature not found", "it is not an HDF5 file"},
       {"truncated file", "it is cut short (an incomplete copy, or a run that was killed)"},
       {"object doesn't exist", "it has no such entry"}}};
  for (const auto& [theirs, ours] : plain) {
    if (text.find(theirs) != std::string::npos) return ours;
  }
  return text.empty() ? "unknown HDF5 error" : text;
}

}  // namespace barchan::hdf5
