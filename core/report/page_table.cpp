#include "report/page_table.h"

#include "report/markup.h"

#include <algorithm>
#include <cstdio>

namespace sward::report {
namespace {

using PictureLink = std::function<std::string(const std::string&)>;

std::string hintAttribute(const std::string& hint) {
  return hint.empty() ? std::string() : " title=\"" + escaped(hint) + "\"";
}

/// Every digit: the value that is sorted by, not the one that is shown.
std::string exactNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

/// Figures line up on the right, also those that carry their own units.
bool alignsRight(const TableColumn& column) {
  return std::all_of(column.cells.begin(), column.cells.end(),
                     [](const TableCell& cell) { return cell.text.empty() || cell.number.has_value(); });
}

std::string styleOf(const TableColumn& column) {
  return std::string(alignsRight(column) ? "number" : column.wide ? "wide" : "text") + (column.quiet ? " quiet" : "");
}

std::string headerHtml(const TableColumn& column) {
  std::string name = escaped(column.name);
  if (!column.unit.empty()) name += " <span class=\"unit\">" + escaped(column.unit) + "</span>";
  return "<th scope=\"col\" class=\"" + styleOf(column) + "\"" + hintAttribute(column.hint) + ">" + name + "</th>";
}

std::string noteMarks(const TableCell& cell, const RowTable& table, const std::string& anchor) {
  std::string out;
  for (const std::size_t note : cell.notes) {
    if (!out.empty()) out += "<sup>, </sup>";
    const std::string number = std::to_string(note + 1);
    out += "<sup><a href=\"#" + anchor + "-note-" + number + "\"" + hintAttribute(table.notes[note]) + ">" + number +
           "</a></sup>";
  }
  return out;
}

std::string cellHtml(const TableColumn& column, const TableCell& cell, bool first, const RowTable& table,
                     const std::string& anchor, const PictureLink& pictureLink) {
  const std::string tag = first ? "th scope=\"row\"" : "td";
  const std::string end = first ? "</th>" : "</td>";
  const std::string style = styleOf(column);
  if (cell.text.empty()) return "<" + tag + " class=\"none " + style + "\" data-none>–" + end;
  const std::string value = cell.number ? " data-value=\"" + exactNumber(*cell.number) + "\"" : "";
  std::string text = escaped(cell.text);
  const bool picture = column.name == "picture" || column.name == "reference picture";
  const std::string link = picture ? pictureLink(cell.text) : std::string();
  if (!link.empty()) text = "<a href=\"" + escaped(link) + "\">" + text + "</a>";
  text += noteMarks(cell, table, anchor);
  return "<" + tag + " class=\"" + style + "\"" + value + hintAttribute(cell.hint) + ">" + text + end;
}

std::string alikeHtml(const RowTable& table) {
  if (table.alike.empty()) return {};
  std::string out = "<p class=\"alike\">All rows: ";
  for (std::size_t i = 0; i < table.alike.size(); ++i) {
    out += (i > 0 ? "; " : "") + escaped(table.alike[i].first) + " <b>" + escaped(table.alike[i].second) + "</b>";
  }
  return out + ".</p>\n";
}

std::string notesHtml(const RowTable& table, const std::string& anchor) {
  if (table.notes.empty()) return {};
  std::string out = "<ol class=\"notes\">\n";
  for (std::size_t i = 0; i < table.notes.size(); ++i) {
    out += "<li id=\"" + anchor + "-note-" + std::to_string(i + 1) + "\">" + escaped(table.notes[i]) + "</li>\n";
  }
  return out + "</ol>\n";
}

}  // namespace

std::string tableHtml(const RowTable& table, const std::string& anchor, const PictureLink& pictureLink) {
  std::string out;
  if (!table.title.empty()) out += "<h3>" + escaped(table.title) + "</h3>\n";
  out += alikeHtml(table) + "<div class=\"scroll\"><table class=\"sortable\">\n<thead><tr>";
  for (const TableColumn& column : table.columns) out += headerHtml(column);
  out += "</tr></thead>\n<tbody>\n";
  const std::size_t rows = table.columns.empty() ? 0 : table.columns.front().cells.size();
  for (std::size_t row = 0; row < rows; ++row) {
    out += "<tr>";
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      out += cellHtml(table.columns[c], table.columns[c].cells[row], c == 0, table, anchor, pictureLink);
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n" + notesHtml(table, anchor);
}

}  // namespace sward::report
