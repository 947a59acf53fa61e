#include "report/row_table.h"

#include "report/markup.h"
#include "report/table_columns.h"

#include <algorithm>
#include <set>

namespace sward::report {
namespace {

constexpr std::size_t kOwnTable = 3;  ///< rows that fill a table of their own

/// Names of all that a row has.
std::set<std::string> signature(const Row& row) {
  std::set<std::string> names;
  for (const auto& [name, value] : row.numbersAndNames) names.insert(name);
  for (const auto& [name, value] : row.error) names.insert("error " + name);
  if (row.timeMs) names.insert("time");
  if (row.rate) names.insert("rate in " + row.rateUnit);
  if (row.bytes) names.insert("bytes");
  return names;
}

bool alike(const std::set<std::string>& a, const std::set<std::string>& b) {
  std::vector<std::string> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  return 2 * common.size() >= a.size() + b.size() - common.size();
}

using RowList = std::vector<const Row*>;

std::vector<RowList> groups(const std::vector<Row>& rows) {
  std::vector<RowList> found;
  for (const Row& row : rows) {
    const auto own = signature(row);
    const auto group = std::find_if(found.begin(), found.end(),
                                    [&](const RowList& list) { return alike(own, signature(*list.front())); });
    if (group == found.end()) {
      found.push_back({&row});
    } else {
      group->push_back(&row);
    }
  }
  if (found.size() == 1) return found;
  RowList few;
  for (const RowList& list : found) {
    if (list.size() < kOwnTable) few.insert(few.end(), list.begin(), list.end());
  }
  std::vector<RowList> result;
  if (!few.empty()) result.push_back(few);
  for (const RowList& list : found) {
    if (list.size() >= kOwnTable) result.push_back(list);
  }
  return result;
}

/// The method that all have, or the words that all methods start with.
std::string titleOf(const RowList& rows) {
  std::string common = rows.front()->method;
  for (const Row* row : rows) {
    while (!common.empty() && row->method != common && !row->method.starts_with(common + "_")) {
      const std::size_t cut = common.find_last_of('_');
      common.erase(cut == std::string::npos ? 0 : cut);
    }
  }
  std::string words = nameAndUnit(common).first;
  if (!words.empty() && words.front() >= 'a' && words.front() <= 'z')
    words.front() = static_cast<char>(words.front() - 'a' + 'A');
  return words;
}

}  // namespace

std::pair<std::string, std::string> nameAndUnit(const std::string& name) {
  static const std::vector<std::pair<std::string, std::string>> kUnits{
      {"_ms", "ms"},       {"_s", "s"},       {"_db", "dB"}, {"_deg", "°"}, {"_m", "m"},
      {"_bytes", "bytes"}, {"_percent", "%"}, {"_px", "px"}, {"_mb", "MB"}};
  std::string words = name, unit;
  for (const auto& [ending, meaning] : kUnits) {
    if (words.size() > ending.size() && words.ends_with(ending)) {
      words.erase(words.size() - ending.size());
      unit = meaning;
      break;
    }
  }
  std::replace(words.begin(), words.end(), '_', ' ');
  return {words, unit};
}

std::vector<RowTable> rowTables(const std::vector<Row>& rows) {
  std::vector<RowTable> tables;
  const std::vector<RowList> lists = groups(rows);
  for (const RowList& list : lists) {
    RowTable table;
    if (lists.size() > 1) table.title = titleOf(list);
    fillTable(list, table);
    tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace sward::report
