// Program with the library: a case is read and its numbers are printed.
#include <barchan/src/case/derived.hpp>
#include <barchan/src/case/load.hpp>
#include <cstdio>

int main(int, char** argv) {
  const barchan::Case a = barchan::load_case(argv[1]);
  std::printf("%s", barchan::to_text(barchan::derive(a.config, a.sizes)).c_str());
}
