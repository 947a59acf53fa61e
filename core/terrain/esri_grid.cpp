#include "terrain/heightmap.h"
#include "terrain/map_size.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

namespace sward::terrain {
namespace {

constexpr double kDefaultNoData = -9999.0;
/// No grid of a terrain has cells of under a centimetre, but many have some of an arc second (0.00028 degrees).
constexpr double kLargestDegreeCell = 0.01;

/// Words of a text, with their lines.
class Words {
 public:
  explicit Words(std::string_view text) : m_text(text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (m_text.starts_with(kByteOrderMark)) m_at = kByteOrderMark.size();
  }
  /// The next word; empty at the end.
  std::string_view next() {
    skipSpace();
    const std::size_t start = m_at;
    while (m_at < m_text.size() && !isSpace(m_text[m_at])) ++m_at;
    return m_text.substr(start, m_at - start);
  }
  /// Whether the next word begins with a letter that no number begins with ("nan" and "inf" are numbers).
  bool keyFollows() {
    skipSpace();
    const Words before = *this;
    const std::string_view word = next();
    *this = before;
    float value = 0.0f;
    return !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) != 0 &&
           std::from_chars(word.data(), word.data() + word.size(), value).ec == std::errc::invalid_argument;
  }
  int line() const { return m_line; }

 private:
  static bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  void skipSpace() {
    for (; m_at < m_text.size() && isSpace(m_text[m_at]); ++m_at) m_line += m_text[m_at] == '\n' ? 1 : 0;
  }
  std::string_view m_text;
  std::size_t m_at = 0;
  int m_line = 1;
};

/// The number that a word spells, all of it; infinities where it has no place in a double.
std::optional<double> numberOf(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range && end == word.data() + word.size()) {
    // Too small is 0, too large an infinity; only the latter has an exponent above 0.
    return word.find("e-") != word.npos || word.find("E-") != word.npos ? 0.0 : HUGE_VAL;
  }
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

struct Header {
  std::map<std::string, double> values;
  std::map<std::string, int> lines;
  bool has(const std::string& key) const { return values.contains(key); }
  double value(const std::string& key, double otherwise) const { return has(key) ? values.at(key) : otherwise; }
  std::string place(const std::string& name, const std::string& key) const {
    return has(key) ? name + ":" + std::to_string(lines.at(key)) : name;
  }
};

Result<Header> readHeader(Words& words, const std::string& name) {
  static const char* const kKeys[] = {"ncols",     "nrows",    "xllcorner", "xllcenter", "yllcorner",
                                      "yllcenter", "cellsize", "dx",        "dy",        "nodata_value"};
  Header header;
  while (words.keyFollows()) {
    const std::string_view word = words.next();
    const std::string place = name + ":" + std::to_string(words.line());
    std::string key(word.substr(0, 40));
    std::transform(key.begin(), key.end(), key.begin(), [](unsigned char c) { return std::tolower(c); });
    if (std::find(std::begin(kKeys), std::end(kKeys), key) == std::end(kKeys))
      return Error::badInput("\"" + key + "\" is no line of an ESRI ASCII grid's header", place,
                             "The header has ncols, nrows, xllcorner, yllcorner, cellsize and NODATA_value.");
    if (header.has(key)) return Error::badInput("the header names " + key + " twice", place, "Remove one of them.");
    const std::string_view text = words.next();
    const auto value = numberOf(text);
    if (!value)
      return Error::badInput("the value of " + key + " is no number: \"" + std::string(text.substr(0, 40)) + "\"",
                             place, "Write a number with a decimal point.");
    header.values[key] = *value;
    header.lines[key] = words.line();
  }
  return header;
}

Result<void> checkHeader(const Header& header, const std::string& name) {
  for (const char* key : {"ncols", "nrows"}) {
    if (!header.has(key))
      return Error::badInput(std::string("the header has no ") + key, name,
                             "An ESRI ASCII grid begins with ncols, nrows, xllcorner, yllcorner and cellsize.");
    const double value = header.value(key, 0.0);
    if (!(value >= 1.0) || value != std::floor(value))
      return Error::badInput(std::string(key) + " is not a whole number above 0", header.place(name, key),
                             "Give the number of values of a row (ncols) and of rows (nrows).");
  }
  for (const char* key : {"cellsize", "dx", "dy"}) {
    if (header.has(key) && !(header.value(key, 0.0) > 0.0 && std::isfinite(header.value(key, 0.0))))
      return Error::badInput(std::string("the cell size (") + key + ") is not above 0", header.place(name, key),
                             "Give the distance between neighbouring values.");
  }
  return checkMapSize(header.value("ncols", 0.0), header.value("nrows", 0.0), header.place(name, "ncols"));
}

/// Cell size, and whether it is one of degrees.
void placeCells(const Header& header, RawHeights& raw) {
  const double cell = header.value("cellsize", 0.0);
  raw.cell = {header.value("dx", cell), header.value("dy", cell)};
  const double west = header.value("xllcorner", header.value("xllcenter", 0.0));
  const double south = header.value("yllcorner", header.value("yllcenter", 0.0));
  raw.latitudeDeg = south + 0.5 * raw.rows * raw.cell.y;
  raw.degrees = raw.cell.x > 0.0 && raw.cell.x <= kLargestDegreeCell && std::abs(west) <= 360.0 &&
                std::abs(south) <= 90.0 && std::abs(raw.latitudeDeg) < 89.0;
}

/// A value's word, judged.
struct Value {
  float height = 0.0f;
  bool known = true;
};

template <typename Place>
Result<Value> valueOf(std::string_view word, const Header& header, const Place& place) {
  const auto value = numberOf(word);
  if (!value)
    return Error::badInput("\"" + std::string(word.substr(0, 40)) + "\" is no number", place(),
                           "Heights are numbers with a decimal point, separated by spaces.");
  const double noData = header.value("nodata_value", kDefaultNoData);
  if (std::isnan(*value)) {
    if (header.has("nodata_value")) return Value{0.0f, false};
    return Error::badInput("a height is not a number (nan)", place(),
                           "Write a NODATA_value line and its value in place of missing heights.");
  }
  if (*value == noData || static_cast<float>(*value) == static_cast<float>(noData)) return Value{0.0f, false};
  if (!std::isfinite(static_cast<float>(*value)))
    return Error::badInput("a height is infinite", place(), "Put the NODATA_value in its place.");
  return Value{static_cast<float>(*value), true};
}

Result<void> readRows(Words& words, const Header& header, const std::string& name, RawHeights& raw) {
  const auto width = static_cast<std::size_t>(raw.columns), height = static_cast<std::size_t>(raw.rows);
  const std::size_t count = width * height;
  raw.values.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view word = words.next();
    const auto place = [&] { return name + ":" + std::to_string(words.line()); };
    if (word.empty())
      return Error::badInput("the grid ends after " + std::to_string(i) + " of " + std::to_string(count) + " values",
                             place(), "The file is cut short, or ncols and nrows are wrong.");
    const Result<Value> read = valueOf(word, header, place);
    if (!read) return read.error();
    const std::size_t at = (height - 1 - i / width) * width + i % width;
    raw.values[at] = read->height;
    if (read->known) continue;
    if (raw.known.empty()) raw.known.assign(count, 1.0f);
    raw.known[at] = 0.0f;
    ++raw.missing;
  }
  if (!words.next().empty())
    return Error::badInput("the grid has more than " + std::to_string(count) + " values",
                           name + ":" + std::to_string(words.line()), "ncols or nrows is wrong.");
  return {};
}

}  // namespace

Result<RawHeights> readEsriGrid(std::string_view text, const std::string& name) {
  Words words(text);
  SWARD_ASSIGN(const Header header, readHeader(words, name));
  SWARD_TRY(checkHeader(header, name));
  RawHeights raw;
  raw.columns = static_cast<int>(header.value("ncols", 0.0));
  raw.rows = static_cast<int>(header.value("nrows", 0.0));
  placeCells(header, raw);
  // A value takes two bytes at least: a header that promises more is refused before anything is allocated for it.
  const auto count = static_cast<std::size_t>(raw.columns) * static_cast<std::size_t>(raw.rows);
  if (text.size() < 2 * count - 1)
    return Error::badInput("the file is too short for " + std::to_string(count) + " values", name,
                           "It is cut short, or ncols and nrows are wrong.");
  SWARD_TRY(readRows(words, header, name, raw));
  SWARD_TRY(checkKnown(raw, name));
  return raw;
}

}  // namespace sward::terrain
