#include "report/writer.h"

#include "base/file.h"
#include "report/csv.h"
#include "report/embed.h"
#include "report/npy.h"
#include "report/page.h"
#include "report/plot_svg.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>

#include <unistd.h>

namespace sward::report {
namespace {

namespace fs = std::filesystem;

constexpr std::array kSubfolders{"plots", "pictures", "tables"};
constexpr const char* kListing = "files.txt";
constexpr const char* kStaging = ".writing-";  ///< and the process that writes

bool nameCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

Error notWritable(const fs::path& folder, const std::string& why) {
  return Error::failed("the folder cannot be written: " + why, folder.string(),
                       "Choose another with -o, or change its permissions.");
}

/// Every file name once, and each a name that every file system and address holds as it is.
class NameCheck {
 public:
  Result<void> operator()(const std::string& kind, const std::string& name, const std::string& section) {
    if (name.empty() || name.size() > 200 || !std::all_of(name.begin(), name.end(), nameCharacter)) {
      return Error::failed("a " + kind + " has the name \"" + name + "\", which cannot be a file's",
                           "section " + section, "Names are made of letters, digits, _ and -.");
    }
    if (!m_seen.insert(kind + "/" + name).second) {
      return Error::failed("two have the name \"" + name + "\" (" + kind + ")", "section " + section,
                           "Names must differ within a report.");
    }
    return {};
  }

 private:
  std::set<std::string> m_seen;
};

Result<void> checkNames(const std::vector<Section>& sections) {
  NameCheck check;
  for (const Section& section : sections) {
    for (const Plot& plot : section.plots) SWARD_TRY(check("plot", plot.name, section.name));
    for (const Table& table : section.tables) SWARD_TRY(check("table", table.name, section.name));
    for (const Array& array : section.arrays) SWARD_TRY(check("array", array.name, section.name));
    for (const Strip& strip : section.strips)
      for (const Picture& picture : strip.pictures) SWARD_TRY(check("picture", picture.name, section.name));
  }
  return {};
}

/// The files that the report before listed: only those that have a report's own names, whatever the list says.
std::vector<std::string> listedFiles(const fs::path& folder) {
  static const std::regex own("(plots|pictures|tables)/[A-Za-z0-9_-]+\\.(svg|png|exr|csv|npy)");
  std::vector<std::string> files;
  const auto text = base::readTextFile(folder / kListing);
  if (!text.ok()) return files;
  std::istringstream lines(*text);
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, own)) files.push_back(line);
  }
  return files;
}

/// Hidden folders of processes that were killed before they could remove them.
void removeForsaken(const fs::path& folder) {
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(kStaging)) continue;
    const long process = std::strtol(name.c_str() + std::string_view(kStaging).size(), nullptr, 10);
    const bool gone = process > 0 && ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
    if (gone) fs::remove_all(entry.path(), code);
  }
}

}  // namespace

Result<void> checkReportFolder(const fs::path& folder) {
  if (folder.empty()) return Error::badInput("this names no folder", "-o", "Give the name of a folder.");
  std::error_code code;
  fs::path existing = fs::absolute(folder, code);
  while (!fs::exists(existing, code) && existing.has_relative_path()) existing = existing.parent_path();
  if (!fs::is_directory(existing, code)) {
    return Error::badInput("this is not a folder", existing.string(), "Choose another with -o.");
  }
  if (::access(existing.c_str(), W_OK | X_OK) != 0) {
    return notWritable(existing, std::error_code(errno, std::generic_category()).message());
  }
  return {};
}

std::string fileNameFrom(std::string_view text) {
  std::string name(text.substr(0, 100));
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !nameCharacter(c); }, '_');
  return name.empty() ? "_" : name;
}

StagedReport::StagedReport(StagedReport&& other) noexcept
    : m_folder(std::move(other.m_folder)),
      m_staging(std::exchange(other.m_staging, {})),
      m_made(std::exchange(other.m_made, {})),
      m_files(std::move(other.m_files)) {}

StagedReport::~StagedReport() {
  std::error_code code;
  if (!m_staging.empty()) fs::remove_all(m_staging, code);
  // Innermost first; one that is not empty by now is somebody else's too, and stays.
  for (auto folder = m_made.rbegin(); folder != m_made.rend(); ++folder) fs::remove(*folder, code);
}

/// The report's folder with those above it, and the hidden one inside it: on the same disk, so that files can be moved.
Result<void> StagedReport::makeFolders() {
  SWARD_TRY(checkReportFolder(m_folder));
  std::error_code code;
  std::vector<fs::path> missing;
  for (fs::path at = fs::absolute(m_folder, code).lexically_normal(); !fs::exists(at, code) && at.has_relative_path();
       at = at.parent_path()) {
    if (at.has_filename()) missing.push_back(at);
  }
  for (auto folder = missing.rbegin(); folder != missing.rend(); ++folder) {
    if (fs::create_directory(*folder, code)) m_made.push_back(*folder);
    if (code) return notWritable(*folder, code.message());
  }
  removeForsaken(m_folder);
  const fs::path staging = m_folder / (kStaging + std::to_string(::getpid()));
  fs::create_directory(staging, code);
  if (code) return notWritable(m_folder, code.message());
  m_staging = staging;
  for (const char* name : kSubfolders) {
    fs::create_directory(staging / name, code);
    if (code) return notWritable(m_folder, code.message());
  }
  return {};
}

Result<void> StagedReport::write(const std::string& name, const std::string& text) {
  m_files.push_back(name);
  return base::writeFileAtomically(m_staging / name, text);
}

Result<void> StagedReport::write(const std::string& name, const std::vector<std::byte>& bytes) {
  m_files.push_back(name);
  return base::writeFileAtomically(m_staging / name, bytes);
}

Result<void> StagedReport::writeMeasured(const Section& section) {
  for (const Table& table : section.tables) SWARD_TRY(write("tables/" + table.name + ".csv", csvText(table)));
  for (const Array& array : section.arrays) SWARD_TRY(write("tables/" + array.name + ".npy", npyBytes(array)));
  for (const Strip& strip : section.strips) {
    for (const Picture& picture : strip.pictures) {
      m_files.push_back("pictures/" + picture.name + ".png");
      if (!picture.linear.empty()) m_files.push_back("pictures/" + picture.name + ".exr");
    }
  }
  return {};
}

Result<StagedReport> StagedReport::stage(const fs::path& folder, const ReportHead& head,
                                         const std::vector<Section>& sections, const JobContext& job) {
  SWARD_TRY(checkNames(sections));
  StagedReport staged(folder);
  SWARD_TRY(staged.makeFolders());
  SWARD_ASSIGN(const auto pictures, writePictures(staged.m_staging / "pictures", sections, job));
  const SeriesLooks looks(sections);
  for (const Section& section : sections) {
    if (job.cancelled()) return Error::cancelled();
    SWARD_TRY(staged.writeMeasured(section));
    for (const Plot& plot : section.plots) {
      SWARD_TRY(staged.write("plots/" + plot.name + ".svg", plotSvg(plot, looks, true).svg));
    }
  }
  SWARD_TRY(staged.write("report.json", reportJson(head, sections)));
  SWARD_TRY(staged.write("report.html", pageHtml(head, sections, looks, pictures)));
  std::string listing;
  for (const std::string& file : staged.m_files) listing += file + "\n";
  SWARD_TRY(staged.write(kListing, listing));
  if (job.cancelled()) return Error::cancelled();
  return staged;
}

/// Everything that could keep a file from its place, asked before the first is moved.
Result<void> StagedReport::checkTargets() const {
  std::error_code code;
  for (const std::string& name : m_files) {
    const fs::path target = m_folder / name, parent = target.parent_path();
    if (fs::exists(parent, code) && !fs::is_directory(parent, code)) {
      return Error::badInput("this is not a folder", parent.string(),
                             "Move it away, or choose another folder with -o.");
    }
    if (fs::exists(parent, code) && ::access(parent.c_str(), W_OK | X_OK) != 0) {
      return notWritable(parent, std::error_code(errno, std::generic_category()).message());
    }
    if (!fs::exists(target, code)) continue;
    if (fs::is_directory(target, code)) {
      return Error::badInput("a folder stands where a file of the report belongs", target.string(),
                             "Move it away, or choose another folder with -o.");
    }
    if (::access(target.c_str(), W_OK) != 0) {
      return Error::failed("the file is write-protected", target.string(),
                           "Choose another folder with -o, or change its permissions.");
    }
  }
  return {};
}

Result<WrittenReport> StagedReport::commit() {
  SWARD_TRY(checkTargets());
  const std::vector<std::string> before = listedFiles(m_folder);
  std::error_code code;
  WrittenReport written{m_folder / "report.html", m_files.size(), 0};
  for (const std::string& name : m_files) {
    const fs::path target = m_folder / name;
    if (target.parent_path() != m_folder) fs::create_directory(target.parent_path(), code);
    if (!code) written.bytes += fs::file_size(m_staging / name, code);
    if (!code) fs::rename(m_staging / name, target, code);
    if (code) return Error::failed("the file cannot be put in its place: " + code.message(), target.string());
  }
  const std::set<std::string> kept(m_files.begin(), m_files.end());
  for (const std::string& name : before) {
    if (!kept.contains(name)) fs::remove(m_folder / name, code);
  }
  for (const char* name : kSubfolders) fs::remove(m_folder / name, code);  // those that are empty now
  m_made.clear();
  return written;
}

}  // namespace sward::report
