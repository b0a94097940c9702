// Bytes as an HDF5 file.
#include "tests/fuzz/hdf5_files.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barchan;
  static const auto file = fuzz::input_file("input.h5");
  fuzz::write_input(file, data, size);
  fuzz::read_as_everything(file);
  return 0;
}
