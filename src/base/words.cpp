#include "src/base/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace barchan {
namespace {

/// Damerau-Levenshtein distance (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), above_row(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) above_row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = above_row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({change, above_row[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    before = above_row;
    above_row = row;
  }
  return above_row[b.size()];
}

bool same_but_for_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

unsigned char byte(char c) { return static_cast<unsigned char>(c); }

/// Length of the UTF-8 character at the start of `text`; 0 if there is none. Overlong forms and
/// surrogates do not matter here: a terminal shows a mark for them.
std::size_t character_length(std::string_view text) {
  const unsigned char lead = byte(text.front());
  const std::size_t length = lead < 0x80                    ? 1
                             : lead >= 0xc2 && lead < 0xe0  ? 2
                             : lead >= 0xe0 && lead < 0xf0  ? 3
                             : lead >= 0xf0 && lead <= 0xf4 ? 4
                                                            : 0;
  if (length == 0 || length > text.size()) return 0;
  const auto continues = [](char c) { return (byte(c) & 0xc0) == 0x80; };
  const auto rest = text.substr(1, length - 1);
  return std::all_of(rest.begin(), rest.end(), continues) ? length : 0;
}

/// C1 control characters, U+0080 to U+009F, are two bytes in UTF-8.
bool is_control(std::string_view character) {
  const unsigned char lead = byte(character.front());
  if (character.size() == 2) return lead == 0xc2 && byte(character[1]) < 0xa0;
  return character.size() == 1 && (lead < 0x20 || lead == 0x7f);
}

}  // namespace

std::string nearest(std::string_view typed, std::span<const std::string> candidates) {
  std::string best;
  const std::size_t most = typed.size() < 4 ? 1 : std::max<std::size_t>(2, typed.size() / 3);
  std::size_t least = most + 1;
  for (const std::string& candidate : candidates) {
    if (same_but_for_case(typed, candidate)) return candidate;
    const std::size_t distance = edit_distance(typed, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view close) {
  return close.empty() ? std::string() : fmt::format(" (did you mean \"{}\"?)", close);
}

std::string nearest_file(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  constexpr int kMost = 10000;  // in a folder of other things
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  const fs::path as_case = path.has_extension() ? path : fs::path(path).concat(".toml");
  for (const fs::path& meant : {as_case, "configs" / as_case}) {
    if (meant != path && fs::is_regular_file(meant, error))
      return fmt::format(" (did you mean {}?)", meant.string());
  }
  std::vector<std::string> stems;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (stems.size() >= kMost) break;
    if (at->path().filename() == path.filename()) continue;  // a link that leads nowhere
    if (at->path().extension() == path.extension()) stems.push_back(at->path().stem().string());
  }
  std::ranges::sort(stems);  // not in the order of the disk
  const std::string close = nearest(path.stem().string(), stems);
  if (close.empty()) return {};
  const fs::path meant = path.parent_path() / fs::path(close).concat(path.extension().string());
  return fmt::format(" (did you mean {}?)", meant.string());
}

std::filesystem::path case_name(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  const fs::path whole = fs::absolute(file).lexically_normal(), stem = whole.stem();
  fs::path below;  // path below the last folder called configs
  bool found = false;
  for (const fs::path& part : whole.parent_path()) {
    if (part == "configs") {
      below.clear();
      found = true;
    } else if (found) {
      below /= part;
    }
  }
  return below / (stem == "." || stem == ".." ? whole.filename() : stem);
}

std::filesystem::path folder_of_runs(const std::filesystem::path& file,
                                     const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const fs::path whole = fs::absolute(folder);
  const fs::path beside = (whole.has_filename() ? whole : whole.parent_path()).parent_path();
  fs::path root = beside, above = case_name(file).parent_path();
  for (; !above.empty(); above = above.parent_path(), root = root.parent_path()) {
    if (root.filename() != above.filename()) return beside;
  }
  return root;
}

std::string printable(std::string_view text, std::size_t longest) {
  std::string shown;
  while (!text.empty()) {
    if (shown.size() >= longest) return shown + "...";
    const std::size_t length = character_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
    if (length > 0 && !is_control(character)) {
      shown += character;
    } else if (const auto letter = std::string_view("\n\t\r").find(character); letter < 3) {
      shown += {'\\', "ntr"[letter]};
    } else {
      for (const char c : character) shown += fmt::format("\\x{:02x}", byte(c));
    }
    text.remove_prefix(character.size());
  }
  return shown;
}

std::string printable_lines(std::string_view text) {
  std::string shown;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    shown += printable(text.substr(begin, end - begin));
    if (end < text.size()) shown += '\n';
    begin = end + 1;
  }
  return shown;
}

std::string as_lines(std::span<const std::string> names) {
  std::string text;
  for (const std::string& name : names) text += name + "\n";
  return text;
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  for (std::size_t end = text.find('\n'); end != text.npos; end = text.find('\n')) {
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return lines;
}

}  // namespace barchan
