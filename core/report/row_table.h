#pragma once

#include "report/row.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sward::report {

/// A cell of a table for people. Texts are plain: whoever writes them out escapes them.
struct TableCell {
  std::string text;                ///< empty: not measured
  std::string hint;                ///< shown when pointed at
  std::optional<double> number;    ///< what numeric columns sort by
  std::vector<std::size_t> notes;  ///< of RowTable::notes
};

struct TableColumn {
  std::string name, unit, hint;  ///< unit empty: none
  bool numeric = false;          ///< numbers in one unit: right-aligned, all with as many decimals as the range allows
  bool wide = false;             ///< long text
  bool quiet = false;            ///< beside the point: smaller
  std::vector<TableCell> cells;  ///< one a row
};

/// Rows that can be compared: columns for what some row has, everything that all have alike stated once.
struct RowTable {
  std::string title;                                       ///< empty: none
  std::vector<std::pair<std::string, std::string>> alike;  ///< name and value
  std::vector<TableColumn> columns;                        ///< the first is the method
  std::vector<std::string> notes;
};

/// Rows as tables, in their order. Rows that were measured alike (half of the names of their parameters and figures in
/// common) share a table; those of which there are only one or two come together in the first, with their parameters in
/// one column. Parameters are JSON values as Row has them.
std::vector<RowTable> rowTables(const std::vector<Row>& rows);

/// What a parameter's or an error's name says of its unit: "sparse_ms" is "sparse" in "ms". Underscores become spaces.
std::pair<std::string, std::string> nameAndUnit(const std::string& name);

}  // namespace sward::report
