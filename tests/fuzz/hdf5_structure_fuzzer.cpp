// A valid file, edited: the first byte says which file, the others what is done to it.
#include <string>

#include "src/base/atomic_file.hpp"
#include "src/io/seal.hpp"
#include "tests/fuzz/hdf5_files.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace barchan;
  static const auto file = fuzz::input_file("input.h5");
  static const std::string restart = read_text(fuzz::write_restart(file.parent_path()));
  static const std::string frames = read_text(fuzz::write_frames(file.parent_path()));
  fuzz::Tape tape({data, size});
  const std::string& valid = tape.pick(2) == 0 ? restart : frames;
  fuzz::write_input(file, valid.data(), valid.size());
  fuzz::edit(file, tape);
  if (&valid == &restart) seal(file);  // as a file that was made so, not one that was damaged
  fuzz::read_as_everything(file);
  return 0;
}
