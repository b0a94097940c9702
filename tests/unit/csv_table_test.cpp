// Tables whose columns are listed once.
#include "src/results/csv_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/base/atomic_file.hpp"
#include "src/diagnostics/flow_average.hpp"
#include "src/results/grain_outputs.hpp"
#include "src/run/tables.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

struct Weather {
  double t = 0, rain = 0;
  std::int64_t frogs = 0;
};
constexpr auto kWeatherColumns = std::to_array<Column<Weather>>({
    {"t", "s", &Weather::t, "time", 10},
    {"rain", "m/s", &Weather::rain, "how fast it falls", 3},
    {"frogs", "-", &Weather::frogs, "that fall with it"},
});
constexpr CsvTable<Weather> kWeather{"weather.csv", kWeatherColumns};

// A column is one line above: header, line, page and cut at a restart know it.
TEST(CsvTable, AColumnIsOneLine) {
  EXPECT_EQ(kWeather.header(), "t,rain,frogs");
  EXPECT_EQ(kWeather.line({.t = 1.0 / 3, .rain = M_PI, .frogs = 123456789012}),
            "0.3333333333,3.14,123456789012\n");
  EXPECT_EQ(kWeather.line({.t = std::nan("")}), "nan,0,0\n");
  EXPECT_EQ(page_of(kWeather.outputs(), "column"),
            "| column | unit | meaning |\n|---|---|---|\n| `t` | s | time |\n"
            "| `rain` | m/s | how fast it falls |\n| `frogs` | - | that fall with it |\n");
  const TemporaryFolder folder;
  const auto file = folder / kWeather.file;
  write_atomically(file, kWeather.header() + "\n" + kWeather.line({.t = 1}) +
                             kWeather.line({.t = 2}) + "2.5,1\n");
  cut_table(file, kWeather.header(), 1.5);
  EXPECT_EQ(read_text(file), kWeather.header() + "\n" + kWeather.line({.t = 1}));
}

/// Lines after the time of a restart go, however short the steps are; rounded times stay.
TEST(CsvTable, IsCutToTheStep) {
  const TemporaryFolder folder;
  const auto file = folder / kWeather.file;
  for (const double step : {1e-10, 1e-15, 1.0 / 3, 1e3 / 3}) {
    std::string text = kWeather.header() + "\n";
    for (int n = 0; n < 20; ++n) text += kWeather.line({.t = n * step});
    write_atomically(file, text);
    cut_table(file, kWeather.header(), 10 * step);
    const std::string kept = read_text(file);
    EXPECT_EQ(std::ranges::count(kept, '\n'), 1 + 11) << step << ": 0 to 10";
  }
}

// docs/files.md lists what each file holds, with the words of the program.
TEST(Outputs, ThePageHasThoseOfTheProgram) {
  const std::string page = read_text(BARCHAN_SOURCE_DIR "/docs/files.md");
  const auto expect_in_page = [&](const std::vector<Output>& outputs, const char* heading) {
    const std::string columns = page_of(outputs, heading);
    EXPECT_NE(page.find("\n" + columns + "\n"), std::string::npos) << "docs/files.md must have:\n"
                                                                   << columns;
  };
  for_each_table([&](const auto& table) { expect_in_page(table.outputs(), "column"); });
  expect_in_page(grain_outputs(), "array");
  expect_in_page(clump_shape_outputs(), "array");
  expect_in_page(flow_moment_outputs(), "array");
}

// Beside the tables of a run stands what their columns are, for all that read them.
TEST(Outputs, ColumnsHaveTheirUnitsInAFile) {
  const auto columns = nlohmann::json::parse(columns_text());
  EXPECT_EQ(columns.size(), 8u);
  EXPECT_EQ(columns.at("dune.csv").at("W").at("unit"), "m");
  EXPECT_EQ(columns.at("dune.csv").at("W").at("meaning"), "width");
  EXPECT_EQ(columns.at("history.csv").at("step").at("unit"), "1") << "not -";
  EXPECT_EQ(columns_text().find("]("), std::string::npos) << "links are for the page";
  for_each_table([&](const auto& table) {
    EXPECT_EQ(columns.at(table.file).size(), table.columns.size()) << table.file;
  });
}

}  // namespace
}  // namespace barchan
