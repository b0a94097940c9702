#include "src/io/seal.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <charconv>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <vector>

#include "src/base/atomic_file.hpp"

namespace barchan {

namespace {

constexpr std::string_view kMark =
    "sealed by barchan, length and CRC-32 of what follows 512 bytes: ";

/// Length and CRC-32 of all from the byte `begin` on.
std::string content_from(std::size_t begin, std::ifstream& in, const std::filesystem::path& file) {
  std::vector<char> block(std::size_t{1} << 20);
  std::uint64_t length = 0;
  uLong crc = 0;
  in.clear();
  in.seekg(static_cast<std::streamoff>(begin));
  while (in) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    const auto got = static_cast<std::size_t>(in.gcount());
    crc = crc32_z(crc, reinterpret_cast<const Bytef*>(block.data()), got);
    length += got;
  }
  if (in.bad()) cannot("read", file);
  return fmt::format("{} {:08x}", length, crc);
}

/// The seal of all behind its room: a line of text, with zeros up to the room.
std::string seal_of(std::ifstream& in, const std::filesystem::path& file) {
  std::string text = fmt::format("{}{}\n", kMark, content_from(kSealBytes, in, file));
  text.resize(kSealBytes, '\0');
  return text;
}

/// The first bytes of a file, at most n.
std::string start_of(std::ifstream& in, std::size_t n) {
  std::string text(n, '\0');
  in.read(text.data(), static_cast<std::streamsize>(n));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

}  // namespace

void seal(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) cannot("read", file);
  const std::string text = seal_of(in, file);
  std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) cannot("write", file);
}

bool has_seal(const std::filesystem::path& file) {
  if (!not_a_file(file).empty()) return false;  // a pipe would be waited for
  std::ifstream in(file, std::ios::binary);
  return start_of(in, kMark.size()) == kMark;
}

std::string broken_seal(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) cannot("read", file);
  const std::string text = start_of(in, kSealBytes);
  if (text == seal_of(in, file)) return {};
  std::uint64_t length = 0;  // that was sealed
  std::from_chars(text.data() + kMark.size(), text.data() + text.size(), length);
  if (const auto size = std::filesystem::file_size(file); size < kSealBytes + length) {
    return fmt::format("it is cut short: {} bytes, of {} that were written", size,
                       kSealBytes + length);
  }
  return "it is damaged: its checksum is not that of what was written";
}

std::string content_key(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) cannot("read", file);
  const std::string start = start_of(in, kSealBytes);
  if (!start.starts_with(kMark)) return content_from(0, in, file);
  return start.substr(kMark.size(), start.find('\n') - kMark.size());
}

}  // namespace barchan
