// Where results cannot go is told before anything is computed, and nothing that is needed is
// removed.
#include "src/run/out_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "src/config/load.hpp"
#include "src/config/resolved.hpp"
#include "tests/support/config_problems.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

class OutFolder : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text = "mine\n") {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
  std::string refused(const std::string& name) {
    return message_of([&] { check_out_folder(folder_ / name); });
  }
  std::string lost(const Config& config, const std::string& name) {
    return message_of([&] { check_nothing_is_lost(config, folder_ / name); });
  }
  TemporaryFolder folder_;
};

TEST_F(OutFolder, IsAFolderOrCanBecomeOne) {
  write("file");
  std::filesystem::create_directories(folder_ / "here/grains.h5");
  std::filesystem::create_symlink("nowhere", folder_ / "link");
  EXPECT_EQ(refused("new/and/deep"), "");
  EXPECT_EQ(refused("."), "");
  EXPECT_NE(refused("file").find("file is a file, not a folder; take another --out"),
            std::string::npos);
  EXPECT_NE(refused("file/run").find("file is a file, not a folder"), std::string::npos);
  EXPECT_NE(refused("link").find("a link that leads nowhere"), std::string::npos);
  EXPECT_NE(refused("here").find("grains.h5 in it is a folder"), std::string::npos);
  EXPECT_NE(refused(std::string(300, 'a')).find("too long"), std::string::npos);
  EXPECT_NE(message_of([] { check_out_folder({}); }).find("must name a folder"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "new"));
}

TEST_F(OutFolder, DoesNotHoldWhatTheCaseStartsFrom) {
  Config config = load_config_text(test::grain_case(), folder_ / "case.toml");
  EXPECT_EQ(lost(config, "out"), "");
  config.initial.grains = folder_ / "out/grains.h5";
  EXPECT_NE(lost(config, "out").find("it is in the run folder"), std::string::npos);
  EXPECT_EQ(lost(config, "other"), "");
  config.initial.grains = folder_ / "out/heap.csv";  // no result: it stays
  EXPECT_EQ(lost(config, "out"), "");
  config.initial.grains = folder_ / "elsewhere/out.toml";  // its results go to out as well
  EXPECT_NE(lost(config, "out").find("go to the folder of this one"), std::string::npos);
}

TEST_F(OutFolder, DoesNotHoldTheCaseItself) {
  const std::string text = test::grain_case();
  write("out/config.toml", text);
  const Config config = load_config_text(text, folder_ / "out/config.toml");
  EXPECT_NE(lost(config, "out").find("over this case"), std::string::npos);
  EXPECT_EQ(lost(config, "other"), "");
  write("out/config.toml", to_toml(config));  // the same again: a run repeated from its own words
  EXPECT_EQ(lost(config, "out"), "");
}

TEST_F(OutFolder, HoldsTablesAndFramesThatARestartGoesOnWith) {
  const auto refused_to_go_on = [&] {
    return message_of([&] { check_results_go_on(folder_.path()); });
  };
  EXPECT_EQ(refused_to_go_on(), "");
  write("dune.csv", "t,other\n");
  EXPECT_NE(refused_to_go_on().find("its columns are not"), std::string::npos);
  std::filesystem::remove(folder_ / "dune.csv");
  write("grains.h5");
  EXPECT_NE(refused_to_go_on().find("it is not an HDF5 file"), std::string::npos);
}

}  // namespace
}  // namespace barchan
