#include "report/markup_check.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <vector>

namespace sward::report::test {
namespace {

bool nameCharacter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == ':';
}

class Checker {
 public:
  Checker(std::string_view text, MarkupKind kind) : m_text(text), m_html(kind == MarkupKind::Html) {}

  std::string run() {
    if (m_html && m_text.starts_with("<!DOCTYPE html>")) m_at = 15;
    while (m_at < m_text.size() && m_problem.empty()) {
      if (m_text[m_at] == '<') {
        tag();
      } else {
        character();
      }
    }
    if (m_problem.empty() && !m_open.empty()) fail("<" + m_open.back() + "> is not closed");
    for (const std::string& target : m_targets) {
      if (m_problem.empty() && !m_ids.contains(target)) fail("#" + target + " leads nowhere");
    }
    return m_problem;
  }

 private:
  void fail(const std::string& what) {
    const std::size_t start = m_at < 40 ? 0 : m_at - 40;
    if (m_problem.empty()) m_problem = what + " near: " + std::string(m_text.substr(start, 80));
  }

  void character() {
    const auto c = static_cast<unsigned char>(m_text[m_at]);
    if (c < 0x20 && c != '\n' && c != '\t' && c != '\r') return fail("a control character");
    if (c == '&') {
      const std::size_t end = m_text.find(';', m_at);
      static const std::set<std::string_view> entities{"amp", "lt", "gt", "quot", "#39"};
      if (end == std::string_view::npos || !entities.contains(m_text.substr(m_at + 1, end - m_at - 1))) {
        return fail("an & that starts no entity");
      }
    }
    if (c >= 0x80) return codePoint(c);
    ++m_at;
  }

  void codePoint(unsigned char first) {
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || m_at + length > m_text.size()) return fail("not UTF-8");
    for (std::size_t i = 1; i < length; ++i) {
      if ((static_cast<unsigned char>(m_text[m_at + i]) & 0xc0) != 0x80) return fail("not UTF-8");
    }
    m_at += length;
  }

  std::string name() {
    const std::size_t start = m_at;
    while (m_at < m_text.size() && nameCharacter(m_text[m_at])) ++m_at;
    return std::string(m_text.substr(start, m_at - start));
  }
  void blanks() {
    while (m_at < m_text.size() && std::isspace(static_cast<unsigned char>(m_text[m_at])) != 0) ++m_at;
  }

  void attribute() {
    const std::string key = name();
    if (key.empty()) return fail("a tag that does not go on");
    if (m_at >= m_text.size() || m_text[m_at] != '=') {
      if (!m_html) fail("an attribute without a value");
      return;
    }
    ++m_at;
    if (m_at >= m_text.size() || m_text[m_at] != '"') return fail("an attribute without quotes");
    const std::size_t start = ++m_at;
    while (m_at < m_text.size() && m_text[m_at] != '"' && m_problem.empty()) {
      if (m_text[m_at] == '<') return fail("< in an attribute");
      character();
    }
    const std::string value(m_text.substr(start, m_at - start));
    ++m_at;
    if (key == "id" && !m_ids.insert(value).second) fail("the id " + value + " stands twice");
    if (key == "href" && value.starts_with('#')) m_targets.insert(value.substr(1));
  }

  void tag() {
    ++m_at;
    const bool end = m_at < m_text.size() && m_text[m_at] == '/';
    if (end) ++m_at;
    const std::string element = name();
    if (element.empty()) return fail("a < that starts no tag");
    if (end) {
      if (m_open.empty() || m_open.back() != element) return fail("</" + element + "> closes what is not open");
      m_open.pop_back();
    } else {
      m_open.push_back(element);
    }
    for (blanks(); m_at < m_text.size() && m_text[m_at] != '>' && m_text[m_at] != '/' && m_problem.empty(); blanks()) {
      attribute();
    }
    static const std::set<std::string> voids{"meta", "img", "br", "wbr", "link", "input", "hr"};
    const bool closed = m_at < m_text.size() && m_text[m_at] == '/';
    if (closed) ++m_at;
    if (m_at >= m_text.size() || m_text[m_at] != '>') return fail("a tag without its end");
    ++m_at;
    if (!end && (closed || (m_html && voids.contains(element)))) m_open.pop_back();
    if (m_html && !end && (element == "script" || element == "style")) skipTo("</" + element);
  }

  void skipTo(const std::string& endTag) { m_at = std::min(m_text.find(endTag, m_at), m_text.size()); }

  std::string_view m_text;
  bool m_html;
  std::size_t m_at = 0;
  std::vector<std::string> m_open;
  std::set<std::string> m_ids, m_targets;
  std::string m_problem;
};

}  // namespace

std::string markupProblem(std::string_view text, MarkupKind kind) {
  return Checker(text, kind).run();
}

}  // namespace sward::report::test
