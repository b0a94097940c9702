// The cases that ship: each loads, says what it is for, and survives being written out in full.
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "src/app/check_case.hpp"
#include "src/case/load.hpp"
#include "src/case/resolved.hpp"

namespace barchan {
namespace {

/// A study varies a case; tests/scripts/sweep.sh looks at those.
bool is_study(const std::filesystem::path& file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line == "[study]") return true;
  }
  return false;
}

std::vector<std::filesystem::path> shipped() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(BARCHAN_SOURCE_DIR "/configs")) {
    if (entry.path().extension() == ".toml" && !is_study(entry.path()))
      files.push_back(entry.path());
  }
  return files;
}

TEST(ShippedConfigs, AreThere) {
  EXPECT_GE(shipped().size(), 10u);
  EXPECT_TRUE(std::filesystem::exists(BARCHAN_SOURCE_DIR "/configs/quickstart.toml"));
}

TEST(ShippedConfigs, LoadAndComeBack) {
  for (const auto& file : shipped()) {
    try {
      const Config config = load_config(file);
      EXPECT_EQ(load_config_text(to_toml(config), file), config) << file;
      EXPECT_FALSE(config.title.empty()) << file;
    } catch (const ConfigError& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

TEST(ShippedConfigs, OnlyWarnOfWhatIsMeant) {
  bool scour_warned = false;
  for (const auto& file : shipped()) {
    const Case the_case = load_case(file);
    for (const std::string& warning : case_warnings(the_case, the_case.sizes)) {
      const auto folder = file.parent_path().filename();
      const bool scour = file.stem() == "scour-cylinder" && warning.find("Shields") != warning.npos;
      scour_warned = scour_warned || scour;
      const bool published = folder == "paper" || folder == "validation";
      const bool expected = warning.find("Rayleigh") != warning.npos || scour ||
                            (published && warning.find("the lowest row") != warning.npos) ||
                            (published && warning.find("a step in each column") != warning.npos) ||
                            (published && warning.find("diameters narrow") != warning.npos) ||
                            (published && warning.find("cells a diameter") != warning.npos);
      const bool column = file.stem().string().starts_with("column-") &&
                          warning.find("alpha_time_derivative") != warning.npos;
      EXPECT_TRUE(expected || column) << file << ": " << warning;
    }
  }
  EXPECT_TRUE(scour_warned) << "the bed far from the cylinder would move";
}

TEST(ShippedConfigs, OpenWithAComment) {
  for (const auto& file : shipped()) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    EXPECT_EQ(line.rfind("# ", 0), 0u) << file << " opens with: " << line;
  }
}

TEST(Check, PrintsTheCaseItsNumbersAndWarnings) {
  CommandLine line;
  line.command = Command::check;
  line.file = BARCHAN_SOURCE_DIR "/configs/barchan-10k.toml";
  line.overrides = {"time.end=2"};
  line.resolved = true;
  std::ostringstream out;
  EXPECT_EQ(run_check(line, out), 0);
  const std::string text = out.str();
  EXPECT_LT(text.find("Re = 2"), text.find("warning: "));
  EXPECT_LT(text.find("warning: "), text.find("end = 2.0"));
  for (const char* part : {"end = 2.0\n", "skin = 4e-05", "Re = 2 delta U / nu     14000",
                           "26.5 % (smallest)", "warning: [time] grain_step is 26.5 %"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  }
  line.resolved = false;
  std::ostringstream short_out;
  EXPECT_EQ(run_check(line, short_out), 0);
  EXPECT_EQ(short_out.str().find("end = 2.0"), std::string::npos);
  line.overrides = {"time.end=-2"};
  EXPECT_THROW(run_check(line, out), ConfigError);
}

}  // namespace
}  // namespace barchan
