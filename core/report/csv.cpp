#include "report/csv.h"

#include "base/check.h"

#include <array>
#include <charconv>

namespace sward::report {
namespace {

void appendLine(const std::vector<std::string>& fields, std::size_t columns, std::string& out) {
  for (std::size_t i = 0; i < columns; ++i) {
    if (i > 0) out += ',';
    if (i < fields.size()) out += csvField(fields[i]);
  }
  out += '\n';
}

}  // namespace

std::string csvNumber(double value) {
  std::array<char, 32> text{};  // 24 at most: sign, 17 digits, point, exponent
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string csvField(std::string_view text) {
  const bool blankEnds = !text.empty() && (text.front() == ' ' || text.back() == ' ');
  if (!blankEnds && text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + "\"";
}

std::string csvText(const Table& table) {
  std::string out;
  appendLine(table.columns, table.columns.size(), out);
  for (const auto& row : table.rows) {
    SWARD_CHECK_LE(row.size(), table.columns.size());
    appendLine(row, table.columns.size(), out);
  }
  return out;
}

}  // namespace sward::report
