// Seals: one wrong bit of a sealed file is found, wherever it is.
#include "src/io/seal.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "src/base/atomic_file.hpp"
#include "src/restart/checkpoint.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

void write(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST(Seal, KnowsTheChecksumOfTheStandard) {
  const TemporaryFolder folder;
  write(folder / "f",
        std::string(kSealBytes, ' ').append("123456789"));  // CRC-32 check value: cbf43926
  seal(folder / "f");
  EXPECT_TRUE(contains(read_text(folder / "f"), ": 9 cbf43926\n"));
  EXPECT_EQ(broken_seal(folder / "f"), "");
}

TEST(Seal, AFileWithoutOneIsNotABrokenOne) {
  const TemporaryFolder folder;
  for (const std::string& text : {std::string(), std::string("abc"), std::string(2000, 'x')}) {
    write(folder / "f", text);
    EXPECT_FALSE(has_seal(folder / "f"));
  }
}

class SealedRestart : public testing::Test {
 protected:
  void SetUp() override {
    CheckpointWriter writer(folder_.path(), 7, {.config = "[case]\n"});
    writer.array("a", std::span<const double>(numbers_));
    file_ = writer.commit(1);
    bytes_ = read_text(file_);
  }
  /// Empty if the file is taken.
  std::string refusal(const std::string& bytes) {
    write(folder_ / "other.h5", bytes);
    return message_of([&] { CheckpointReader(folder_ / "other.h5"); });
  }
  TemporaryFolder folder_;
  std::vector<double> numbers_ = std::vector<double>(300, 0.5);
  std::filesystem::path file_;
  std::string bytes_;
};

TEST_F(SealedRestart, IsReadWhole) {
  EXPECT_EQ(refusal(bytes_), "");
  EXPECT_EQ(CheckpointReader(file_).array<double>("a"), numbers_);
}

TEST_F(SealedRestart, EveryFlippedBitIsFound) {
  std::mt19937 random(1);
  for (int n = 0; n < 300; ++n) {
    std::string damaged = bytes_;
    const std::size_t at = kSealBytes + random() % (damaged.size() - kSealBytes);
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
    EXPECT_TRUE(contains(refusal(damaged), "damaged")) << at;
  }
  for (std::size_t at = 0; at < kSealBytes; ++at) {  // the seal itself, and what fills it up
    std::string damaged = bytes_;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    EXPECT_NE(refusal(damaged), "") << at;
  }
}

TEST_F(SealedRestart, EveryCutIsFound) {
  for (std::size_t length = 0; length < bytes_.size(); length += 97) {
    EXPECT_NE(refusal(bytes_.substr(0, length)), "") << length;
  }
  EXPECT_TRUE(contains(refusal(bytes_.substr(0, bytes_.size() - 100)), "cut short"));
  EXPECT_TRUE(contains(refusal(bytes_ + "more"), "damaged"));
}

}  // namespace
}  // namespace barchan
