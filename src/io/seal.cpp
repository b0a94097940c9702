#include "src/io/seal.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include "src/base/input_file.hpp"

namespace barchan {

namespace {

constexpr std::string_view mark =
    "sealed by barchan, length and CRC-32 of what follows 512 bytes: ";

[[noreturn]] void fail(const char* verb, const std::filesystem::path& file) {
  throw std::runtime_error(
      fmt::format("cannot {} {}: {}", verb, file.string(), std::generic_category().message(errno)));
}

struct Content {
  std::uint64_t length = 0;
  std::uint32_t crc = 0;
  bool operator==(const Content&) const = default;
};

/// Of all behind the room of the seal.
Content content_of(std::ifstream& in, const std::filesystem::path& file) {
  std::vector<char> block(std::size_t{1} << 20);
  Content content;
  in.clear();
  in.seekg(static_cast<std::streamoff>(seal_bytes));
  while (in) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    const auto got = static_cast<std::size_t>(in.gcount());
    content.crc = static_cast<std::uint32_t>(
        crc32_z(content.crc, reinterpret_cast<const Bytef*>(block.data()), got));
    content.length += got;
  }
  if (in.bad()) fail("read", file);
  return content;
}

/// What a seal says; false if the text is not one.
bool parse(std::string_view text, Content& said) {
  if (!text.starts_with(mark)) return false;
  const char* const end = text.data() + text.size();
  const auto length = std::from_chars(text.data() + mark.size(), end, said.length);
  if (length.ec != std::errc() || length.ptr == end || *length.ptr != ' ') return false;
  const auto crc = std::from_chars(length.ptr + 1, end, said.crc, 16);
  if (crc.ec != std::errc() || crc.ptr == end || *crc.ptr != '\n') return false;
  return std::all_of(crc.ptr + 1, end, [](char c) { return c == '\0'; });
}

}  // namespace

void seal(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) fail("read", file);
  const Content content = content_of(in, file);
  std::string text = fmt::format("{}{} {:08x}\n", mark, content.length, content.crc);
  text.resize(seal_bytes, '\0');
  std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) fail("write", file);
}

bool has_seal(const std::filesystem::path& file) {
  if (!not_a_file(file).empty()) return false;  // a pipe would be waited for
  std::ifstream in(file, std::ios::binary);
  std::string text(mark.size(), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text == mark;
}

SealCheck check_seal(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) fail("read", file);
  std::string text(seal_bytes, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!std::string_view(text).starts_with(mark)) return {};
  Content said;
  if (!parse(text, said)) return {Seal::broken, "it is damaged: its seal cannot be read"};
  const Content found = content_of(in, file);
  if (found == said) return {Seal::whole, {}};
  if (found.length != said.length) {
    return {Seal::broken, fmt::format("it is {}: {} bytes, of {} that were written",
                                      found.length < said.length ? "cut short" : "damaged",
                                      found.length + seal_bytes, said.length + seal_bytes)};
  }
  return {Seal::broken, "it is damaged: its checksum is not that of what was written"};
}

}  // namespace barchan
