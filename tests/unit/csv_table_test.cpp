// Tables whose columns are listed once.
#include "src/results/csv_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "src/base/atomic_file.hpp"
#include "src/diagnostics/body_table.hpp"
#include "src/diagnostics/dune_table.hpp"
#include "src/diagnostics/flow_statistics.hpp"
#include "src/diagnostics/heap_shares.hpp"
#include "src/diagnostics/probe_table.hpp"
#include "src/run/history_table.hpp"
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
  EXPECT_EQ(kWeather.page(),
            "| column | unit | meaning |\n|---|---|---|\n| `t` | s | time |\n"
            "| `rain` | m/s | how fast it falls |\n| `frogs` | - | that fall with it |\n");
  const TemporaryFolder folder;
  const auto file = folder / kWeather.file;
  write_atomically(file, kWeather.header() + "\n" + kWeather.line({.t = 1}) +
                             kWeather.line({.t = 2}) + "2.5,1\n");
  cut_table(file, kWeather.header(), 1.5);
  EXPECT_EQ(read_text(file), kWeather.header() + "\n" + kWeather.line({.t = 1}));
}

/// What follows the time of a restart goes, however short the steps are; what was rounded stays.
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

TEST(CsvTable, ThePageHasTheColumnsOfTheProgram) {
  const std::string page = read_text(BARCHAN_SOURCE_DIR "/docs/files.md");
  for (const std::string& columns :
       {kHistoryTable.page(), kDuneTable.page(), kHeapTable.page(), kBodyTable.page(),
        kProbeTable.page(), kStatisticsTable.page()}) {
    EXPECT_NE(page.find("\n" + columns + "\n"), std::string::npos) << "docs/files.md must have:\n"
                                                                   << columns;
  }
}

}  // namespace
}  // namespace barchan
