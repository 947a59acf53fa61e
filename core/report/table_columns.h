#pragma once

#include "report/row_table.h"

#include <vector>

namespace sward::report {

/// Fills the table's columns, what is alike, and notes from these rows, of which there is at least one.
void fillTable(const std::vector<const Row*>& rows, RowTable& table);

}  // namespace sward::report
