// All tables of a run in CSV, and their columns in columns.json.
#pragma once

#include <string>

#include "src/diagnostics/bed_load.hpp"
#include "src/diagnostics/body_table.hpp"
#include "src/diagnostics/dune_table.hpp"
#include "src/diagnostics/flow_statistics.hpp"
#include "src/diagnostics/force_map.hpp"
#include "src/diagnostics/heap_shares.hpp"
#include "src/diagnostics/probe_table.hpp"
#include "src/run/history_table.hpp"

namespace barchan {

/// Calls action(table) for each.
template <class Action>
void for_each_table(const Action& action) {
  action(kHistoryTable);
  action(kDuneTable);
  action(kHeapTable);
  action(kBodyTable);
  action(kProbeTable);
  action(kStatisticsTable);
  action(kForceMapTable);
  action(kBedLoadTable);
}

inline constexpr const char* kColumnsFile = "columns.json";

/// The text of columns.json: {file: {column: {"unit": ..., "meaning": ...}}}. A number without a
/// dimension has the unit "1".
std::string columns_text();

}  // namespace barchan
