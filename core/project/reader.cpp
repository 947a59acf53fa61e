#include "project/reader.h"

#include <algorithm>
#include <cmath>

namespace sward::project {
namespace {

/// Keys of a hostile file may be megabytes long.
std::string shortened(std::string_view text) {
  constexpr std::size_t kLimit = 64;
  return text.size() <= kLimit ? std::string(text) : std::string(text.substr(0, kLimit)) + "...";
}

}  // namespace

std::string typeName(const Json& json) {
  switch (json.type()) {
    case Json::value_t::null:
      return "null";
    case Json::value_t::boolean:
      return "true or false";
    case Json::value_t::string:
      return "text";
    case Json::value_t::object:
      return "an object";
    case Json::value_t::array:
      return "a list";
    default:
      return "a number";
  }
}

std::string childPath(const std::string& parent, std::string_view name) {
  return parent.empty() ? std::string(name) : parent + "." + std::string(name);
}

Reader::Reader(const Json& object, std::string path, std::string file, std::optional<Error>& error)
    : m_object(object), m_path(std::move(path)), m_file(std::move(file)), m_error(error) {
  if (!m_object.is_object()) wrongType(m_object, m_path, "an object");
}

void Reader::version(int newest) {
  m_known.emplace_back("version");
  const Json* json = find("version");
  if (json == nullptr) return;
  int number = 0;
  read(*json, childPath(m_path, "version"), number, {});
  if (m_error) return;
  if (number > newest) {
    fail("version",
         "the file has format version " + std::to_string(number) + "; this program reads up to " +
             std::to_string(newest),
         "Use a newer version of sward.");
  } else if (number < 1) {
    fail("version", "there is no format version " + std::to_string(number), "Use " + std::to_string(newest) + ".");
  }
}

const Json* Reader::find(const char* name) const {
  if (m_error || !m_object.is_object()) return nullptr;
  const auto found = m_object.find(name);
  return found == m_object.end() ? nullptr : &*found;
}

void Reader::finish() {
  if (m_error || !m_object.is_object()) return;
  for (auto item = m_object.begin(); item != m_object.end(); ++item) {
    if (std::find(m_known.begin(), m_known.end(), item.key()) != m_known.end()) continue;
    const std::string nearest = nearestName(item.key(), m_known);
    std::string remedy;
    if (!nearest.empty()) {
      remedy = "Did you mean \"" + nearest + "\"?";
    } else {
      for (const std::string& name : m_known) remedy += (remedy.empty() ? "Known here: " : ", ") + name;
      remedy += '.';
    }
    return fail(childPath(m_path, shortened(item.key())), "this key is not known", remedy);
  }
}

void Reader::fail(const std::string& path, const std::string& what, const std::string& remedy) {
  if (m_error) return;
  const std::string file = m_file.empty() || path.empty() ? m_file : m_file + ": ";
  m_error = Error::badInput(what, file + path, remedy);
}

void Reader::wrongType(const Json& json, const std::string& path, const std::string& expected) {
  fail(path, "expected " + expected + ", found " + typeName(json), "");
}

void Reader::read(const Json& json, const std::string& path, bool& value, const Spec&) {
  if (!json.is_boolean()) return wrongType(json, path, "true or false");
  value = json.get<bool>();
}

void Reader::read(const Json& json, const std::string& path, int& value, const Spec&) {
  if (!json.is_number()) return wrongType(json, path, "a whole number");
  const auto number = json.get<double>();
  if (std::floor(number) != number || std::abs(number) > 2147483647.0) {
    return fail(path, "expected a whole number of at most 2147483647, found " + json.dump(), "");
  }
  value = static_cast<int>(number);
}

void Reader::read(const Json& json, const std::string& path, std::uint64_t& value, const Spec&) {
  if (!json.is_number_unsigned()) return wrongType(json, path, "a whole number from 0 to 18446744073709551615");
  value = json.get<std::uint64_t>();
}

void Reader::read(const Json& json, const std::string& path, double& value, const Spec&) {
  if (!json.is_number()) return wrongType(json, path, "a number");
  value = json.get<double>();
}

void Reader::read(const Json& json, const std::string& path, std::string& value, const Spec&) {
  if (!json.is_string()) return wrongType(json, path, "text");
  value = json.get<std::string>();
  // File names and view names go to interfaces that end text at a zero.
  if (value.find('\0') != std::string::npos) fail(path, "the text holds a zero character", "Remove it.");
}

void Reader::read(const Json& json, const std::string& path, glm::dvec3& value, const Spec& spec) {
  if (!json.is_array() || json.size() != 3) return wrongType(json, path, "a list of three numbers");
  for (int i = 0; i < 3; ++i) {
    read(json[static_cast<std::size_t>(i)], path + "[" + std::to_string(i) + "]", value[i], spec);
  }
}

void Reader::read(const Json& json, const std::string& path, base::Curve& value, const Spec& spec) {
  constexpr std::size_t kMaxPoints = 256;
  if (!json.is_array()) return wrongType(json, path, "a list of points [x, y]");
  if (json.size() > kMaxPoints) return fail(path, "the curve has too many points", "At most 256 are allowed.");
  std::vector<base::CurvePoint> points;
  for (std::size_t i = 0; i < json.size() && !m_error; ++i) {
    const std::string place = path + "[" + std::to_string(i) + "]";
    if (!json[i].is_array() || json[i].size() != 2) return wrongType(json[i], place, "a point [x, y]");
    read(json[i][0], place + "[0]", points.emplace_back().x, spec);
    read(json[i][1], place + "[1]", points.back().y, spec);
  }
  if (m_error) return;
  auto curve = base::Curve::fromPoints(std::move(points));
  if (!curve.ok()) return fail(path, curve.error().where + ": " + curve.error().what, curve.error().remedy);
  value = std::move(curve).value();
}

}  // namespace sward::project
