// A valid file, edited: the first byte says which file, the others what is done to it.
#include <fstream>
#include <iterator>
#include <string>

#include "src/io/seal.hpp"
#include "tests/fuzz/hdf5_files.hpp"

namespace {

using namespace barchan;

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto file = fuzz::input_file("input.h5");
  static const std::string restart = content(fuzz::write_restart(file.parent_path()));
  static const std::string frames = content(fuzz::write_frames(file.parent_path()));
  fuzz::Tape tape({data, size});
  const std::string& valid = tape.pick(2) == 0 ? restart : frames;
  fuzz::write_input(file, valid.data(), valid.size());
  fuzz::edit(file, tape);
  if (&valid == &restart) seal(file);  // as a file that was made so, not one that was damaged
  fuzz::read_as_everything(file);
  return 0;
}
