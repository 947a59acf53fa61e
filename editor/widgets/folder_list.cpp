#include "widgets/folder_list.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <ctime>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

std::string lowered(std::string_view text) {
  std::string copy(text);
  std::transform(copy.begin(), copy.end(), copy.begin(), lower);
  return copy;
}

/// The digits from `at` on without leading zeros; `at` moves behind them.
std::string_view takeNumber(std::string_view text, std::size_t& at) {
  while (at < text.size() && text[at] == '0') ++at;
  const std::size_t first = at;
  while (at < text.size() && digit(text[at])) ++at;
  return text.substr(first, at - first);
}

}  // namespace

bool FileFilter::matches(std::string_view fileName) const {
  if (extensions.empty()) return true;
  const std::string low = lowered(fileName);
  return std::any_of(extensions.begin(), extensions.end(),
                     [&low](const std::string& end) { return low.size() > end.size() && low.ends_with(end); });
}

Result<std::vector<FolderEntry>> listFolder(const fs::path& folder, const FileFilter& filter, bool hidden) {
  std::error_code code;
  fs::directory_iterator entry(folder, code);
  if (code)
    return Error::failed("the folder cannot be read: " + code.message(), folder.string(), "Choose another one.");
  std::vector<FolderEntry> entries;
  for (const fs::directory_iterator end; entry != end; entry.increment(code)) {
    if (code) break;
    FolderEntry found;
    found.name = entry->path().filename().string();
    if (!hidden && found.name.starts_with('.')) continue;
    std::error_code trouble;
    const fs::file_status status = entry->status(trouble);
    if (trouble || !fs::exists(status)) continue;
    found.folder = fs::is_directory(status);
    if (!found.folder && !filter.matches(found.name)) continue;
    if (!found.folder) found.bytes = entry->file_size(trouble);
    if (trouble) found.bytes = 0;
    const auto written = entry->last_write_time(trouble);
    if (!trouble) {
      const auto time = std::chrono::file_clock::to_sys(written);
      found.modifiedS = std::chrono::duration_cast<std::chrono::seconds>(time.time_since_epoch()).count();
    }
    entries.push_back(std::move(found));
  }
  return entries;
}

bool naturalLess(std::string_view a, std::string_view b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      const std::string_view x = takeNumber(a, i), y = takeNumber(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
      continue;
    }
    const char x = lower(a[i++]), y = lower(b[j++]);
    if (x != y) return static_cast<unsigned char>(x) < static_cast<unsigned char>(y);
  }
  const std::size_t restA = a.size() - i, restB = b.size() - j;
  return restA != restB ? restA < restB : a < b;
}

void sortEntries(std::vector<FolderEntry>& entries, FolderSort by, bool descending) {
  std::sort(entries.begin(), entries.end(), [by, descending](const FolderEntry& first, const FolderEntry& second) {
    if (first.folder != second.folder) return first.folder;
    const FolderEntry& a = descending ? second : first;
    const FolderEntry& b = descending ? first : second;
    if (by == FolderSort::Modified && a.modifiedS != b.modifiedS) return a.modifiedS < b.modifiedS;
    if (by == FolderSort::Size && a.bytes != b.bytes) return a.bytes < b.bytes;
    return naturalLess(a.name, b.name);
  });
}

std::optional<std::size_t> findTyped(const std::vector<FolderEntry>& entries, std::string_view typed,
                                     std::size_t from) {
  const std::string wanted = lowered(typed);
  for (std::size_t step = 0; step < entries.size(); ++step) {
    const std::size_t i = (from + step) % entries.size();
    if (lowered(entries[i].name).starts_with(wanted)) return i;
  }
  return std::nullopt;
}

std::string fileSizeText(std::uintmax_t bytes) {
  constexpr std::array kUnits{"B", "kB", "MB", "GB", "TB"};
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (value >= 999.5 && unit + 1 < kUnits.size()) {
    value /= 1000.0;
    ++unit;
  }
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), unit == 0 || value >= 99.5 ? "%.0f %s" : "%.1f %s", value, kUnits[unit]);
  return text.data();
}

std::string timeText(std::int64_t secondsSince1970) {
  if (secondsSince1970 == 0) return {};
  const std::time_t time = static_cast<std::time_t>(secondsSince1970);
  std::tm local{};
  if (localtime_r(&time, &local) == nullptr) return {};
  std::array<char, 40> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M", &local);
  return text.data();
}

std::string nameProblem(std::string_view name) {
  if (name.empty()) return "Give it a name.";
  if (name == "." || name == "..") return "This name means a folder.";
  if (name.find('/') != std::string_view::npos) return "A name holds no slash.";
  if (name.find('\0') != std::string_view::npos) return "A name holds no zero character.";
  if (name.size() > 255) return "The name is longer than 255 bytes.";
  return {};
}

}  // namespace sward::editor
