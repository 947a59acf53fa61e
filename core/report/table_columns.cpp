#include "report/table_columns.h"

#include "report/markup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include <nlohmann/json.hpp>

namespace sward::report {
namespace {

using Json = nlohmann::ordered_json;
using RowList = std::vector<const Row*>;

constexpr std::size_t kLongText = 34;  ///< characters of a parameter that a column still shows

struct Known {
  const char *key, *name, *unit, *hint;
};
/// Figures of Row::error that every reader of design.md knows; others keep their own name.
constexpr std::array kErrors{
    Known{"rmse", "RMSE", "", "Root of the mean square error; smaller is better"},
    Known{"psnr_db", "PSNR", "dB", "Peak signal-to-noise ratio; larger is better"},
    Known{"ssim", "SSIM", "", "Structural similarity, 1 where equal; larger is better"},
    Known{"flip", "FLIP", "", "Difference that a person sees who alternates between the two; smaller is better"},
    Known{"bias", "bias", "", "Mean error: above 0 is too bright; nearer to 0 is better"},
    Known{"max", "max error", "", "Largest error of a single value; smaller is better"}};

/// A parameter's value as people write it: text without its quotes, numbers with few digits, lists in short.
std::string parameterText(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_integer() || value.is_number_unsigned()) return value.dump();
  if (value.is_number()) return figureText(value.get<double>(), 4);
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Decimals that give three quarters of the values three digits at least, as long as the largest keeps to six.
int commonDecimals(const TableColumn& column) {
  std::vector<double> sizes;
  bool whole = true;
  for (const TableCell& cell : column.cells) {
    if (!cell.number || !std::isfinite(*cell.number)) continue;
    const double size = std::abs(*cell.number);
    whole = whole && *cell.number == std::round(*cell.number);
    if (size > 0.0) sizes.push_back(size);
  }
  if (whole || sizes.empty()) return 0;
  std::sort(sizes.begin(), sizes.end());
  const int wanted = 2 - static_cast<int>(std::floor(std::log10(sizes[sizes.size() / 4])));
  const int room = 4 - static_cast<int>(std::floor(std::log10(sizes.back())));
  return std::clamp(std::min(wanted, room), 0, 7);
}

/// Texts of a numeric column; a value too small for the column's decimals is written on its own.
void writeNumbers(TableColumn& column) {
  const int decimals = commonDecimals(column);
  for (TableCell& cell : column.cells) {
    if (!cell.number) continue;
    cell.text = fixedText(*cell.number, decimals);
    const bool vanished = *cell.number != 0.0 && std::stod(cell.text) == 0.0;
    if (vanished || !std::isfinite(*cell.number) || cell.text.size() > 12) cell.text = figureText(*cell.number);
  }
}

/// Divides a column by the largest unit that leaves most of its values above 1.
void scaleColumn(TableColumn& column, const std::vector<std::pair<double, const char*>>& units) {
  std::vector<double> sizes;
  for (const TableCell& cell : column.cells) {
    if (cell.number && *cell.number != 0.0) sizes.push_back(std::abs(*cell.number));
  }
  std::sort(sizes.begin(), sizes.end());
  const double middle = sizes.empty() ? 0.0 : sizes[sizes.size() / 2];
  auto chosen = units.front();
  for (const auto& unit : units) {
    if (middle >= unit.first) chosen = unit;
  }
  column.unit = chosen.second;
  for (TableCell& cell : column.cells) {
    if (cell.number) *cell.number /= chosen.first;
  }
}

const std::vector<std::pair<double, const char*>> kByteUnits{{1.0, "bytes"}, {1024.0, "KiB"}, {1048576.0, "MiB"}};

class Filler {
 public:
  Filler(const RowList& rows, RowTable& table) : m_rows(rows), m_table(table) {}

  void fill() {
    methods();
    parameters();
    times();
    rates();
    ratios();
    numbers("bake", "s", "Time that baking took", [](const Row& row) { return row.bakeSeconds; });
    bytes("light data", "Bytes of lighting data alone", [](const Row& row) { return row.bytes; });
    bytes("total", "Bytes with albedo, coverage and sky", [](const Row& row) { return row.bytesTotal; });
    errors();
    references();
  }

 private:
  std::size_t note(const std::string& text) {
    auto& notes = m_table.notes;
    const auto found = std::find(notes.begin(), notes.end(), text);
    if (found != notes.end()) return static_cast<std::size_t>(found - notes.begin());
    notes.push_back(text);
    return notes.size() - 1;
  }
  void noteCell(TableCell& cell, const std::string& text) {
    if (!text.empty()) cell.notes.push_back(note(text));
  }
  TableColumn column(const std::string& name, const std::string& unit, const std::string& hint, bool numeric) const {
    TableColumn made{name, unit, hint, numeric, false, false, {}};
    made.cells.resize(m_rows.size());
    return made;
  }
  /// Adds it when some row has a value.
  void add(TableColumn column) {
    const bool any = std::any_of(column.cells.begin(), column.cells.end(),
                                 [](const TableCell& cell) { return cell.number.has_value() || !cell.text.empty(); });
    if (!any) return;
    if (column.numeric) writeNumbers(column);
    m_table.columns.push_back(std::move(column));
  }

  void methods() {
    TableColumn made = column("method", "", "", false);
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
      made.cells[i].text = m_rows[i]->method;
      noteCell(made.cells[i], m_rows[i]->notes);
    }
    m_table.columns.push_back(std::move(made));
  }

  void parameters();
  void parameterColumn(const std::string& name);
  void numbers(const char* name, const char* unit, const char* hint,
               const std::function<std::optional<double>(const Row&)>& value) {
    TableColumn made = column(name, unit, hint, true);
    for (std::size_t i = 0; i < m_rows.size(); ++i) made.cells[i].number = value(*m_rows[i]);
    add(std::move(made));
  }
  void bytes(const char* name, const char* hint, const std::function<std::optional<std::uint64_t>(const Row&)>& value) {
    TableColumn made = column(name, "", hint, true);
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
      const auto size = value(*m_rows[i]);
      if (!size) continue;
      made.cells[i].number = static_cast<double>(*size);
      made.cells[i].hint = std::to_string(*size) + " bytes";
    }
    scaleColumn(made, kByteUnits);
    add(std::move(made));
  }
  void times();
  void rates();
  void ratios();
  void errors();
  void references();

  const RowList& m_rows;
  RowTable& m_table;
};

/// Parameters that all rows have alike are stated once; those that most have are columns; the rest share one.
void Filler::parameters() {
  std::map<std::string, std::size_t> counts;
  for (const Row* row : m_rows)
    for (const auto& [name, value] : row->numbersAndNames) ++counts[name];
  std::set<std::string> shared;
  for (const auto& [name, count] : counts) {
    const auto same = [&, key = name](const Row* row) {
      return row->numbersAndNames.at(key) == m_rows.front()->numbersAndNames.at(key);
    };
    const auto longest = [&, key = name](const Row* row) {
      const auto found = row->numbersAndNames.find(key);
      return found != row->numbersAndNames.end() && codePoints(found->second) > kLongText;
    };
    if (count == m_rows.size() && m_rows.size() > 1 && std::all_of(m_rows.begin(), m_rows.end(), same)) {
      const auto [words, unit] = nameAndUnit(name);
      const std::string value = parameterText(Json::parse(m_rows.front()->numbersAndNames.at(name)));
      m_table.alike.emplace_back(words, value + (unit.empty() ? "" : " " + unit));
    } else if (2 * count > m_rows.size() && std::none_of(m_rows.begin(), m_rows.end(), longest)) {
      parameterColumn(name);
    } else {
      shared.insert(name);
    }
  }
  TableColumn rest = column("parameters", "", "", false);
  for (std::size_t i = 0; i < m_rows.size(); ++i) {
    for (const auto& [name, value] : m_rows[i]->numbersAndNames) {
      if (!shared.contains(name)) continue;
      const auto [words, unit] = nameAndUnit(name);
      std::string& text = rest.cells[i].text;
      text += (text.empty() ? "" : ", ") + words + " " + parameterText(Json::parse(value));
      if (!unit.empty()) text += " " + unit;
    }
    rest.wide = rest.wide || codePoints(rest.cells[i].text) > kLongText;
  }
  add(std::move(rest));
}

void Filler::parameterColumn(const std::string& name) {
  const auto [words, unit] = nameAndUnit(name);
  TableColumn made = column(words, unit, "", true);
  for (std::size_t i = 0; i < m_rows.size(); ++i) {
    const auto found = m_rows[i]->numbersAndNames.find(name);
    if (found == m_rows[i]->numbersAndNames.end()) continue;
    const Json value = Json::parse(found->second);
    made.cells[i].text = parameterText(value);
    if (value.is_number()) made.cells[i].number = value.get<double>();
    made.numeric = made.numeric && value.is_number();
  }
  if (made.numeric && made.unit == "bytes") scaleColumn(made, kByteUnits);
  add(std::move(made));
}

void Filler::times() {
  TableColumn made = column("time", "", "Median of repeated runs", true);
  TableColumn spread = column("spread", "", "Fastest and slowest run; sorts by their distance over the median", false);
  spread.quiet = true;
  for (std::size_t i = 0; i < m_rows.size(); ++i) {
    if (m_rows[i]->timeMs) made.cells[i].number = m_rows[i]->timeMs->median;
  }
  scaleColumn(made, {{1e-3, "µs"}, {1.0, "ms"}, {1e3, "s"}});
  const double unit = made.unit == "s" ? 1e3 : made.unit == "ms" ? 1.0 : 1e-3;
  for (std::size_t i = 0; i < m_rows.size(); ++i) {
    const auto& time = m_rows[i]->timeMs;
    if (!time) continue;
    made.cells[i].hint = std::to_string(time->runs) + (time->runs == 1 ? " run" : " runs");
    if (time->runs < 2) continue;
    spread.cells[i].text = figureText(time->min / unit) + " – " + figureText(time->max / unit);
    spread.cells[i].number = (time->max - time->min) / time->median;
    spread.cells[i].hint = made.cells[i].hint;
  }
  add(std::move(made));
  add(std::move(spread));
}

void Filler::rates() {
  std::set<std::string> units;
  for (const Row* row : m_rows) {
    if (row->rate) units.insert(row->rateUnit);
  }
  const bool one = units.size() == 1 && !units.begin()->empty();
  TableColumn made = column("rate", one ? *units.begin() + "/s" : "", "More is better", false);
  for (std::size_t i = 0; i < m_rows.size(); ++i) {
    const Row& row = *m_rows[i];
    if (!row.rate) continue;
    std::string text = prefixedText(*row.rate);
    if (!one && !row.rateUnit.empty()) text += (text.back() == ' ' ? "" : " ") + row.rateUnit + "/s";
    made.cells[i].text = text;
    made.cells[i].number = row.rate;
  }
  if (one) made.numeric = true;
  if (one && std::none_of(made.cells.begin(), made.cells.end(),
                          [](const TableCell& cell) { return cell.number.value_or(0.0) >= 1e5; })) {
    return add(std::move(made));
  }
  made.numeric = false;
  add(std::move(made));
}

void Filler::ratios() {
  std::set<std::string> against;
  for (const Row* row : m_rows) {
    if (row->ratio) against.insert(row->against);
  }
  TableColumn made =
      column("ratio", "", "Over what the note says, in the same run; above 1 is better unless it says otherwise", true);
  for (std::size_t i = 0; i < m_rows.size(); ++i) {
    if (!m_rows[i]->ratio) continue;
    made.cells[i].number = m_rows[i]->ratio;
    if (against.size() > 1 && !m_rows[i]->against.empty())
      noteCell(made.cells[i], "Ratio against " + m_rows[i]->against);
  }
  if (against.size() == 1 && !against.begin()->empty()) m_table.alike.emplace_back("ratio against", *against.begin());
  add(std::move(made));
}

void Filler::errors() {
  std::set<std::string> others;
  for (const Row* row : m_rows)
    for (const auto& [name, value] : row->error) others.insert(name);
  const auto figure = [](const std::string& key) {
    return [key](const Row& row) -> std::optional<double> {
      const auto found = row.error.find(key);
      return found == row.error.end() || !std::isfinite(found->second) ? std::nullopt : std::optional(found->second);
    };
  };
  for (const Known& known : kErrors) {
    numbers(known.name, known.unit, known.hint, figure(known.key));
    others.erase(known.key);
  }
  for (const std::string& name : others) {
    const auto [words, unit] = nameAndUnit(name);
    numbers(words.c_str(), unit.c_str(), "", figure(name));
  }
}

/// What the errors are against: once for all rows, else a note of each.
void Filler::references() {
  std::set<std::string> references;
  for (const Row* row : m_rows) references.insert(row->reference);
  if (references.size() == 1) {
    if (!references.begin()->empty()) m_table.alike.emplace_back("reference", *references.begin());
    return;
  }
  for (std::size_t i = 0; i < m_rows.size(); ++i) {
    if (m_rows[i]->reference.empty()) continue;
    noteCell(m_table.columns.front().cells[i], "Reference: " + m_rows[i]->reference);
  }
}

}  // namespace

void fillTable(const std::vector<const Row*>& rows, RowTable& table) {
  Filler(rows, table).fill();
}

}  // namespace sward::report
