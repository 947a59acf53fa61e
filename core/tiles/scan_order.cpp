#include "tiles/scan_order.h"

#include "base/random.h"

#include <cmath>
#include <optional>

namespace sward::tiles {
namespace {

constexpr std::size_t kAny = 4;      ///< no neighbour: one more than the largest colour
constexpr int kMostRows = 6;         ///< that are filled together
constexpr double kMostWays = 300.0;  ///< of states, and of ways to go on from one: together they bound the time
constexpr std::size_t kMostStarts = 3;
constexpr std::uint64_t kAttempts = 12;  ///< at a map that joins itself; what was drawn before may forbid it

using Column = std::array<std::uint8_t, kMostRows>;  ///< the tiles of a strip's column, from the south

/// Fills a map strip by strip. A strip of some rows grows column by column; its state between two columns is the
/// colours of the vertical edges there, one digit a row. To make a strip end in a given state, the states from which
/// that can still be reached are found from its end backward, and each column is drawn among those that keep to them.
class ScanOrder {
 public:
  ScanOrder(const TileSet& set, TileMap& map, std::uint64_t seed)
      : m_set(set), m_map(map), m_seed(seed), m_colours(static_cast<std::size_t>(set.coloursPerAxis)) {
    for (std::size_t tile = 0; tile < set.tiles.size(); ++tile) {
      const auto& edges = set.tiles[tile].edges;
      for (const std::size_t south : {static_cast<std::size_t>(edges[kSouth]), kAny})
        m_matching[south][edges[kWest]].push_back(static_cast<std::uint8_t>(tile));
    }
  }

  /// Fills `rows` rows from row `first`, matching the row below. joinColumns: the last column matches the first one;
  /// joinRows: the last row matches row 0. Returns false, with nothing changed, where no filling does.
  bool fill(int first, int rows, bool joinColumns, bool joinRows) {
    m_first = first;
    m_rows = rows;
    m_joinRows = joinRows;
    m_states = power(m_colours, rows);
    const std::uint64_t bits = base::mix64(m_seed, static_cast<std::uint64_t>(first), 0x7374617274);  // "start"
    const std::size_t offset = static_cast<std::size_t>(bits % m_states);
    findReach(std::nullopt);
    std::size_t tried = 0;
    for (std::size_t i = 0; i < m_states && tried < kMostStarts; ++i) {
      const std::size_t start = (offset + i) % m_states;
      if (m_reach[start] == 0) continue;
      if (joinColumns) {
        ++tried;
        findReach(start);
        if (m_reach[start] == 0) {
          findReach(std::nullopt);
          continue;
        }
      }
      draw(start);
      return true;
    }
    return false;
  }

  /// Whether so many rows can be filled together in reasonable time.
  bool fits(int rows) const {
    const double perPair = static_cast<double>(m_set.tiles.size()) / static_cast<double>(m_colours * m_colours);
    return rows <= kMostRows && std::pow(static_cast<double>(m_colours), rows) <= kMostWays &&
           std::pow(perPair, rows) <= kMostWays;
  }

 private:
  static std::size_t power(std::size_t base, int exponent) {
    std::size_t result = 1;
    for (int i = 0; i < exponent; ++i) result *= base;
    return result;
  }
  std::uint8_t& at(int x, int y) {
    return m_map
        .tiles[static_cast<std::size_t>(y) * static_cast<std::size_t>(m_map.width) + static_cast<std::size_t>(x)];
  }

  /// Calls visit(column, next state) for every column that may stand at x where the state before it is `state`.
  template <typename Visit>
  void visitColumns(int x, std::size_t state, const Visit& visit) {
    const std::size_t south = m_first > 0 ? m_set.tiles[at(x, m_first - 1)].edges[kNorth] : kAny;
    Column column{};
    visitRows(x, 0, south, state, 0, 1, column, visit);
  }
  template <typename Visit>
  void visitRows(int x, int row, std::size_t south, std::size_t state, std::size_t next, std::size_t digit,
                 Column& column, const Visit& visit) {
    if (row == m_rows) {
      if (!m_joinRows || south == m_set.tiles[at(x, 0)].edges[kSouth]) visit(column, next);
      return;
    }
    for (const std::uint8_t tile : m_matching[south][state % m_colours]) {
      column[static_cast<std::size_t>(row)] = tile;
      const auto& edges = m_set.tiles[tile].edges;
      visitRows(x, row + 1, edges[kNorth], state / m_colours, next + digit * edges[kEast], digit * m_colours, column,
                visit);
    }
  }

  /// m_reach[x * states + state]: whether a strip in `state` before column x can end in `end`, or in any state.
  void findReach(std::optional<std::size_t> end) {
    const auto width = static_cast<std::size_t>(m_map.width);
    m_reach.assign((width + 1) * m_states, 0);
    for (std::size_t state = 0; state < m_states; ++state) m_reach[width * m_states + state] = !end || *end == state;
    for (std::size_t x = width; x-- > 0;) {
      for (std::size_t state = 0; state < m_states; ++state) {
        std::uint8_t reach = 0;
        visitColumns(static_cast<int>(x), state,
                     [&](const Column&, std::size_t next) { reach |= m_reach[(x + 1) * m_states + next]; });
        m_reach[x * m_states + state] = reach;
      }
    }
  }

  /// A column at random among those that keep to m_reach, four times less likely for each copy of its tiles near by:
  /// copies side by side are what the eye catches first. All tiles are still used within a tenth equally often, and no
  /// distance is favoured.
  void draw(std::size_t state) {
    for (int x = 0; x < m_map.width; ++x) {
      m_choice.clear();
      double sum = 0.0;
      visitColumns(x, state, [&](const Column& column, std::size_t next) {
        if (m_reach[static_cast<std::size_t>(x + 1) * m_states + next] == 0) return;
        unsigned repeats = 0;
        for (int row = 0; row < m_rows; ++row) repeats += repeatsNear(x, row, column);
        sum += std::ldexp(1.0, -2 * static_cast<int>(repeats));
        m_choice.push_back({column, next, sum});
      });
      const std::uint64_t bits =
          base::mix64(m_seed, static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(m_first));
      const double point = static_cast<double>(bits >> 11) * 0x1p-53 * sum;
      std::size_t chosen = 0;
      while (chosen + 1 < m_choice.size() && m_choice[chosen].weightEnd <= point) ++chosen;
      for (int row = 0; row < m_rows; ++row)
        at(x, m_first + row) = m_choice[chosen].column[static_cast<std::size_t>(row)];
      state = m_choice[chosen].next;
    }
  }

  /// How many of the filled cells within two of a strip's cell, knight's moves included, hold the tile proposed for it.
  unsigned repeatsNear(int x, int row, const Column& column) {
    static constexpr std::array<std::array<int, 2>, 10> kNear{
        {{-1, 0}, {-2, 0}, {0, -1}, {0, -2}, {-1, -1}, {1, -1}, {-2, -1}, {2, -1}, {-1, -2}, {1, -2}}};
    const std::uint8_t tile = column[static_cast<std::size_t>(row)];
    unsigned repeats = 0;
    for (const auto& [dx, dy] : kNear) {
      const int nx = x + dx, ny = m_first + row + dy;
      const bool inStrip = row + dy >= 0;
      if (nx < 0 || ny < 0 || nx >= m_map.width || (inStrip && dx > 0)) continue;
      const std::uint8_t there = inStrip && dx == 0 ? column[static_cast<std::size_t>(row + dy)] : at(nx, ny);
      if (there == tile) ++repeats;
    }
    return repeats;
  }

  struct Way {
    Column column;
    std::size_t next;
    double weightEnd;  ///< running sum
  };

  const TileSet& m_set;
  TileMap& m_map;
  std::uint64_t m_seed;
  std::size_t m_colours;
  std::array<std::array<std::vector<std::uint8_t>, kAny>, kAny + 1> m_matching;  ///< [south][west]
  int m_first = 0, m_rows = 1;
  bool m_joinRows = false;
  std::size_t m_states = 1;
  std::vector<std::uint8_t> m_reach;
  std::vector<Way> m_choice;
};

}  // namespace

TileMap scanOrderMap(const TileSet& set, int width, int height, std::uint64_t seed) {
  TileMap map{width, height, {}};
  map.tiles.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const bool choice = set.tiles.size() >= static_cast<std::size_t>(2 * set.coloursPerAxis * set.coloursPerAxis);
  const std::uint64_t attempts = choice ? kAttempts : 1;
  for (std::uint64_t attempt = 0; attempt < attempts; ++attempt) {
    ScanOrder order(set, map, base::mix64(seed, attempt));
    const auto fillRow = [&](int y) {
      if (!order.fill(y, 1, true, false)) order.fill(y, 1, false, false);
    };
    for (int y = 0; y + 1 < height; ++y) fillRow(y);
    // One row rarely matches both the row below it and row 0: the last few are filled anew together, as few as will do.
    for (int rows = 1; rows < height && order.fits(rows); ++rows)
      if (order.fill(height - rows, rows, true, true)) return map;
    fillRow(height - 1);
  }
  return map;
}

}  // namespace sward::tiles
