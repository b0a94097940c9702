#include "src/initial/grain_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "src/base/words.hpp"

namespace barchan {

namespace {

constexpr std::array<std::string_view, 13> kColumns{
    "id", "diameter", "x", "y", "z", "vx", "vy", "vz", "wx", "wy", "wz", "kind", "heap"};
constexpr std::size_t kNRequired = 5, kDiameter = 1, kKind = 11, kHeap = 12;

/// Other titles of columns: those of tables that the Python package writes, and of radii.
struct OtherTitle {
  std::string_view title, column;
  double factor = 1;
};
constexpr std::array<OtherTitle, 9> kOtherTitles{{{"d", "diameter"},
                                                  {"radius", "diameter", 2},
                                                  {"r", "diameter", 2},
                                                  {"u", "vx"},
                                                  {"v", "vy"},
                                                  {"w", "vz"},
                                                  {"omega_x", "wx"},
                                                  {"omega_y", "wy"},
                                                  {"omega_z", "wz"}}};

/// Column of the file: its place among the known ones, and the factor of its numbers.
struct TitledColumn {
  std::size_t column = kColumns.size();  // none of them so far
  double factor = 1;
};

/// Tells if a column is a result of a run, not a starting value of a grain.
bool is_result(std::string_view title) { return title == "dune" || title.starts_with("force_"); }

/// Column of a title in its header. Other titles stand for a column that has none of its own.
std::optional<TitledColumn> column_of(std::string_view title,
                                      const std::vector<std::string_view>& header) {
  if (is_result(title)) return TitledColumn{};
  double factor = 1;
  const auto other = std::ranges::find(kOtherTitles, title, &OtherTitle::title);
  if (other != kOtherTitles.end() && std::ranges::count(header, other->column) == 0)
    title = other->column, factor = other->factor;
  const auto found = std::ranges::find(kColumns, title);
  if (found == kColumns.end()) return {};
  return TitledColumn{static_cast<std::size_t>(found - kColumns.begin()), factor};
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Takes the text up to the next separator off `rest`.
std::string_view take(std::string_view& rest, char separator) {
  const auto end = rest.find(separator);
  const auto part = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return part;
}

class CsvReader {
 public:
  CsvReader(std::string_view text, std::string_view file_name) : rest_(text), name_(file_name) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
  }

  InitialGrains read() {
    check_text();
    if (!next_line())
      fail("it is empty; needed is a header, id,diameter,x,y,z, and a line a grain");
    for (bool row = read_header() || next_line(); row; row = next_line()) read_row();
    if (grains_.size() == 0) fail("it has a header but no grains");
    return std::move(grains_);
  }

 private:
  /// Complains about the line read last.
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> what, Args&&... args) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", name_, std::max<std::size_t>(line_number_, 1),
                                         fmt::format(what, std::forward<Args>(args)...)));
  }

  /// Reads the next line that holds something; false at the end.
  bool next_line() {
    while (!rest_.empty()) {
      ++line_number_;
      line_ = trimmed(take(rest_, '\n'));
      if (!line_.empty() && line_.front() != '#') return true;
      if (!line_.empty()) comment_ = trimmed(line_.substr(1));
    }
    return false;
  }

  /// Checks the text before lines are looked for: there may be none.
  void check_text() {
    const std::string_view start = rest_.substr(0, 4096);
    if (start.starts_with("\x89HDF")) fail("it is an HDF5 file; give its name the ending .h5");
    if (start.starts_with("\xFF\xFE") || start.starts_with("\xFE\xFF")) {
      fail("it is UTF-16 text; save it as UTF-8");
    }
    if (start.substr(0, start.find('\n')).find_first_of(std::string_view("\0\1\2\3\4", 5)) !=
        start.npos) {
      fail(
          "it is not text but bytes of another kind; needed is a table with the header "
          "id,diameter,x,y,z");
    }
    if (start.find('\r') != start.npos && start.find('\n') == start.npos) {
      fail("its line ends are carriage returns alone; save it with newlines");
    }
  }

  /// Separator that the values have instead of commas; empty if it is commas.
  std::string other_separator() const {
    for (const auto& [mark, name] :
         {std::pair{';', "semicolons"}, {'\t', "tabs"}, {' ', "spaces"}}) {
      const bool there = std::count(line_.begin(), line_.end(), mark) >= 2;
      if (there && line_.find(',') == line_.npos) return name;
    }
    return {};
  }

  void split_line() { split(line_); }
  void split(std::string_view rest) {
    fields_.clear();
    for (bool more = true; more;) {
      more = rest.find(',') != rest.npos;
      fields_.push_back(trimmed(take(rest, ',')));
    }
  }

  /// Reads the header. True if it stood in a comment, as numpy writes it: the line read last is
  /// then a row.
  bool read_header() {
    constexpr const char* needed =
        "columns are id,diameter,x,y,z and optionally vx,vy,vz,wx,wy,wz,kind,heap";
    if (const std::string marks = other_separator(); !marks.empty()) {
      fail("values are separated by {}; write commas, and decimals with a point", marks);
    }
    if (line_.find_first_of("\"'") != line_.npos) fail("titles stand without quotes");
    const bool any_letter = std::any_of(line_.begin(), line_.end(), [](unsigned char c) {
      return std::isalpha(c) != 0 && c != 'e' && c != 'E';
    });
    split(any_letter ? line_ : comment_);
    if (!any_letter && !std::ranges::all_of(fields_, [&](auto title) {
          return column_of(title, fields_).has_value();
        }))
      fail("the header is missing; {}", needed);
    for (const std::string_view title : fields_) {
      if (title.empty()) fail("column {} has no name", order_.size() + 1);
      const auto found = column_of(title, fields_);
      if (!found) {
        fail("unknown column \"{}\" in the header{}; {}", printable(title, 60), suggestion(title),
             needed);
      }
      if (has(found->column)) fail("column \"{}\" appears twice", kColumns[found->column]);
      order_.push_back(*found);
    }
    for (std::size_t column = 0; column < kNRequired; ++column) {
      if (!has(column))
        fail("column \"{}\" is missing; needed are id,diameter,x,y,z", kColumns[column]);
    }
    return !any_letter;
  }

  bool has(std::size_t column) const {
    return column < kColumns.size() &&
           std::ranges::count(order_, column, &TitledColumn::column) > 0;
  }

  /// Column that a title in capitals, with its unit or misspelt was meant for.
  static std::string suggestion(std::string_view title) {
    const std::vector<std::string> names(kColumns.begin(), kColumns.end());
    const auto word = trimmed(title.substr(0, title.find_first_of(" [(/")));
    std::string close = nearest(word, names);
    if (word == "radius" || word == "r" || word == "d")
      close = word == title ? "diameter" : std::string(word);
    return did_you_mean(close);
  }

  void read_row() {
    std::array<double, kColumns.size()> value{};
    std::int64_t id = 0;
    std::optional<std::int64_t> heap;
    split_line();
    const std::size_t n_fields = fields_.size();
    for (std::size_t f = 0; f < std::min(n_fields, order_.size()); ++f) {
      const auto [column, factor] = order_[f];
      if (column == 0) {
        id = whole_number(fields_[f]);
      } else if (column == kKind) {
        add_kind(fields_[f]);
      } else if (column == kHeap) {
        heap = number<std::int64_t>(fields_[f], column);
        if (*heap < -1 || *heap > 254)
          fail("heap = {}: must be from 0 to 254, or -1: of none", *heap);
      } else if (column < kColumns.size()) {
        value[column] = factor * number<double>(fields_[f], column);
      }
    }
    if (n_fields != order_.size()) {
      const bool twice = n_fields >= 2 * order_.size() - 1;  // ids are whole
      fail("{} values, but the header has {} columns{}", n_fields, order_.size(),
           twice ? "; are there decimal commas? Decimals need a point" : "");
    }
    if (value[kDiameter] <= 0) fail("diameter = {}: must be above 0", value[kDiameter]);
    const auto [earlier, is_new] = line_of_.emplace(id, line_number_);
    if (!is_new) fail("id {} was used before, in line {}", id, earlier->second);
    grains_.add(id, value[kDiameter], {value[2], value[3], value[4]},
                {value[5], value[6], value[7]}, {value[8], value[9], value[10]});
    if (heap) grains_.heap.push_back(static_cast<std::uint8_t>(*heap));  // -1: kNoHeap
  }

  /// Adds the kind of a grain. Kinds are numbered in the order in which they appear.
  void add_kind(std::string_view name) {
    if (name.empty()) fail("kind is empty: it must be a name of [[grains.kind]]");
    auto& names = grains_.kind_names;
    const auto at = std::find(names.begin(), names.end(), name) - names.begin();
    if (at > std::numeric_limits<std::uint8_t>::max())
      fail("kind = \"{}\": there are too many kinds", printable(name, 60));
    if (std::cmp_equal(at, names.size())) names.emplace_back(name);
    grains_.kind.push_back(static_cast<std::uint8_t>(at));
  }

  /// Number of an id; numpy writes 1.000000000000000000e+00.
  std::int64_t whole_number(std::string_view field) const {
    double value = 0;
    const auto [stop, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    const bool real = field.find_first_of(".eE") != field.npos && error == std::errc() &&
                      stop == field.data() + field.size();
    constexpr double exact = 9007199254740992;  // 2^53: larger ones may have been rounded
    if (real && std::abs(value) < exact && value == std::floor(value))
      return static_cast<std::int64_t>(value);
    return number<std::int64_t>(field, 0);
  }

  template <class T>
  T number(std::string_view field, std::size_t column) const {
    T value{};
    if (field.starts_with('+')) field.remove_prefix(1);  // from_chars knows no plus sign
    const auto [stop, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error == std::errc::result_out_of_range && std::is_integral_v<T>) {
      fail("{} = {}: must be at most {}", kColumns[column], printable(field, 60),
           std::numeric_limits<std::int64_t>::max());
    }
    if (error != std::errc() || stop != field.data() + field.size()) {
      fail("{} = \"{}\": must be {}{}", kColumns[column], printable(field, 60),
           std::is_integral_v<T> ? "a whole number" : "a number",
           field.find_first_of("\"'") != field.npos ? ", without quotes" : "");
    }
    if constexpr (!std::is_integral_v<T>) {
      if (!std::isfinite(value)) fail("{} = {}: must be finite", kColumns[column], field);
    }
    return value;
  }

  std::string_view rest_, name_, line_, comment_;  // the last line and comment
  std::size_t line_number_ = 0;
  std::vector<std::string_view> fields_;                   // fields of the line
  std::vector<TitledColumn> order_;                        // column of each field of a row
  std::unordered_map<std::int64_t, std::size_t> line_of_;  // line of each id
  InitialGrains grains_;
};

}  // namespace

InitialGrains parse_grains_csv(std::string_view text, std::string_view file_name) {
  return CsvReader(text, file_name).read();
}

}  // namespace barchan
