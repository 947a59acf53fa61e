#pragma once

#include "report/section.h"

#include <string>
#include <string_view>

namespace sward::report {

/// A number as a field: the shortest text that reads back as the same double.
std::string csvNumber(double value);

/// A field of RFC 4180: quoted where it holds a comma, a quote or a line break, or starts or ends with a blank.
std::string csvField(std::string_view text);

/// The table with its header, lines ended by "\n". Rows that are shorter than the header end in empty fields; a longer
/// one is a broken contract.
std::string csvText(const Table& table);

}  // namespace sward::report
