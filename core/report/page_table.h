#pragma once

#include "report/row_table.h"

#include <functional>
#include <string>

namespace sward::report {

/// A table of rows as HTML: sortable by the page's script, readable without it. `anchor` starts the names of its notes'
/// anchors: letters, digits, _ and -. `pictureLink` gives the address of a picture that a cell of the columns "picture"
/// and "reference picture" names, or nothing.
std::string tableHtml(const RowTable& table, const std::string& anchor,
                      const std::function<std::string(const std::string& name)>& pictureLink);

}  // namespace sward::report
