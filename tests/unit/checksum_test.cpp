// Checksums of arrays: the same over any shares, another one after any change of a value.
#include "src/io/checksum.hpp"
#include "src/initial/grain_files.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <random>

#include "src/grains/grain_state.hpp"
#include "src/io/hdf5_handle.hpp"
#include "src/results/output_files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

template <class T>
std::uint64_t whole(const std::vector<T>& values) {
  return checksum<T>(values, {values.size()}, {values.size()}, {0});
}

TEST(Checksum, IsTheSumOfTheHeader) {
  const auto r = [](std::uint64_t s) { return s ^ (s / 0x100000000); };
  const auto h = [&](std::uint64_t s) { return r(0xd6e8feb86659fd93 * r(s)); };
  const std::uint64_t g = 0x9e3779b97f4a7c15;
  EXPECT_EQ(whole<std::int64_t>({5, -1}), h(5 + g) + h(2 * g - 1));
  EXPECT_EQ(whole<float>({1.0F}), h(0x3f800000 + g));  // bits of IEEE 754
  EXPECT_EQ(whole<double>({-2.0}), h(0xc000000000000000 + g));
  EXPECT_EQ(whole<std::int32_t>({-1}), h(0xffffffff + g));
  EXPECT_EQ(whole<double>({}), 0u);
}

TEST(Checksum, SharesAddUpToTheWhole) {
  const Extents size{4, 3, 5};
  std::vector<double> values(60);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1.0 / static_cast<double>(i + 1);
  const auto share = [&](const Extents& first, const Extents& part) {
    std::vector<double> mine;
    for (std::size_t i = first[0]; i < first[0] + part[0]; ++i) {
      for (std::size_t j = first[1]; j < first[1] + part[1]; ++j) {
        for (std::size_t k = first[2]; k < first[2] + part[2]; ++k) {
          mine.push_back(values[(i * 3 + j) * 5 + k]);
        }
      }
    }
    return checksum<double>(mine, part, size, first);
  };
  const std::uint64_t all = whole(values);
  EXPECT_EQ(share({0, 0, 0}, size), all);
  EXPECT_EQ(share({0, 0, 0}, {1, 3, 5}) + share({1, 0, 0}, {3, 3, 5}), all);
  EXPECT_EQ(share({0, 0, 0}, {4, 3, 2}) + share({0, 0, 2}, {4, 3, 3}), all);
  EXPECT_EQ(share({0, 0, 0}, {2, 3, 2}) + share({0, 0, 2}, {2, 3, 3}) +
                share({2, 0, 0}, {2, 3, 2}) + share({2, 0, 2}, {2, 3, 3}),
            all);
  EXPECT_EQ(share({0, 0, 0}, {4, 1, 5}) + share({0, 1, 0}, {4, 0, 5}) + share({0, 1, 0}, {4, 2, 5}),
            all);
}

TEST(Checksum, ChangesWithEveryBitAndEveryPlace) {
  std::vector<float> values{0.0F, 1.0F, 1.0F, -3.5F, 0.0F};
  const std::uint64_t before = whole(values);
  for (float& value : values) {
    for (unsigned bit = 0; bit < 32; ++bit) {
      const float kept = value;
      std::uint32_t bits = 0;
      std::memcpy(&bits, &value, sizeof(bits));
      bits ^= 1U << bit;
      std::memcpy(&value, &bits, sizeof(bits));
      EXPECT_NE(whole(values), before) << bit;
      value = kept;
    }
  }
  EXPECT_NE(whole<float>({1.0F, 0.0F, 1.0F, -3.5F, 0.0F}), before);
  EXPECT_NE(whole<float>({0.0F, 1.0F, 1.0F, -3.5F}), before);
  EXPECT_NE(whole<float>({0.0F, 1.0F, 1.0F, 3.5F, -0.0F}), before);  // two signs
}

/// A grains.h5 of three frames, of which a start takes the last.
class DamagedFrames : public testing::Test {
 protected:
  void SetUp() override {
    OutputFiles output(folder_.path(), {});
    for (int k = 0; k < 3; ++k) {
      InitialGrains grains;
      for (int g = 0; g < 50; ++g) {
        const Real v = 0.01 * (g + 1) + k;
        grains.add(g + 7, 2e-4, {v, 2 * v, 3 * v}, {4 * v, 5 * v, 6 * v}, {7 * v, 8 * v, 9 * v});
      }
      output.write_grains(make_grain_state(grains, 2500), k, k);
    }
    good_ = read_grains(file_);
  }

  struct Place {
    std::size_t begin, bytes;
  };
  Place place_of(const std::string& name) const {
    hdf5::start_library();
    const hdf5::Handle file(H5Fopen(file_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    const hdf5::Handle array(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    return {H5Dget_offset(array.get()), H5Dget_storage_size(array.get())};
  }

  /// Message of a start after a bit was wrong; the bit is then put right again.
  std::string after_a_wrong_bit(std::size_t at, int bit) {
    flip(at, bit);
    const std::string said =
        message_of([&] { EXPECT_EQ(numbers(read_grains(file_)), numbers(good_)); });
    flip(at, bit);
    return said;
  }

  void flip(std::size_t at, int bit) {
    std::fstream stream(file_, std::ios::binary | std::ios::in | std::ios::out);
    const auto place = static_cast<std::streamoff>(at);
    const int byte = stream.seekg(place).get();
    stream.seekp(place).put(static_cast<char>(byte ^ (1 << bit)));
  }

  static std::vector<double> numbers(const InitialGrains& grains) {
    std::vector<double> all(grains.diameter);
    for (std::size_t g = 0; g < grains.size(); ++g) {
      all.push_back(static_cast<double>(grains.id[g]));
      for (const Vec3& v : {grains.x[g], grains.u[g], grains.omega[g]}) {
        all.insert(all.end(), {v.x, v.y, v.z});
      }
    }
    return all;
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "grains.h5";
  InitialGrains good_;
  std::mt19937 random_{1};
};

TEST_F(DamagedFrames, EveryWrongBitOfTheUsedFrameIsFound) {
  for (const std::string name : {"id", "d", "x", "u", "omega"}) {
    const Place place = place_of("frame_000002/" + name);
    ASSERT_GE(place.bytes, 400u);
    for (int n = 0; n < 40; ++n) {
      const std::size_t at = place.begin + random_() % place.bytes;
      const std::string said = after_a_wrong_bit(at, static_cast<int>(random_() % 8));
      EXPECT_TRUE(contains(said, "grains.h5: it is damaged: its checksum")) << name << said;
      EXPECT_TRUE(contains(said, "(frame_000002/" + name + ")")) << said;
    }
  }
  EXPECT_EQ(numbers(read_grains(file_)), numbers(good_));  // as it was
}

TEST_F(DamagedFrames, OtherFramesMayBeDamaged) {
  for (const std::string name : {"frame_000000/x", "frame_000001/omega"}) {
    EXPECT_EQ(after_a_wrong_bit(place_of(name).begin + 5, 3), "");
  }
}

TEST_F(DamagedFrames, AWrongBitInANameDoesNotHideTheLastFrame) {
  const std::string bytes = [&] {
    std::ifstream stream(file_, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  }();
  const std::string name = "frame_000002";
  const std::size_t begin = bytes.find(name);
  ASSERT_NE(begin, std::string::npos);
  ASSERT_EQ(bytes.find(name, begin + 1), std::string::npos);
  for (std::size_t at = begin; at < begin + name.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) after_a_wrong_bit(at, bit);  // refused, or the same grains
  }
  EXPECT_TRUE(contains(after_a_wrong_bit(begin, 0), "\"grame_000002\" is not the name of a frame"));
}

TEST_F(DamagedFrames, FilesWithoutChecksumsAreTaken) {
  hdf5::start_library();
  {
    const hdf5::Handle file(H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    for (const char* name : {"id", "d", "x", "u", "omega"}) {
      const std::string array = std::string("frame_000002/") + name;
      ASSERT_GE(H5Adelete_by_name(file.get(), array.c_str(), "checksum", H5P_DEFAULT), 0);
    }
  }
  EXPECT_EQ(numbers(read_grains(file_)), numbers(good_));
  flip(place_of("frame_000002/x").begin, 0);
  EXPECT_NE(numbers(read_grains(file_)), numbers(good_));
}

}  // namespace
}  // namespace barchan
