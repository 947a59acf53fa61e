#pragma once

#include "base/job.h"
#include "base/result.h"
#include "report/report.h"
#include "report/section.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sward::report {

/// Whether a report can be written to this folder, which need not exist yet: nothing but a folder stands there, and it
/// (or the nearest folder above that exists) may be written. Asked before minutes of measuring.
Result<void> checkReportFolder(const std::filesystem::path& folder);

struct WrittenReport {
  std::filesystem::path page;
  std::size_t files = 0;
  std::uint64_t bytes = 0;
};

/// A report on its way to its folder:
///   report.html, report.json, plots/NAME.svg, pictures/NAME.png and .exr, tables/NAME.csv and .npy,
///   files.txt (all of these, one a line).
/// stage() writes everything into a hidden folder inside, commit() moves the files to their places one by one, each
/// whole, data before the page; files that the report before it listed and this one has not are removed, all others
/// are left alone. Without commit nothing is changed, and the hidden folder goes with the object.
class StagedReport {
 public:
  /// Errors: names of pictures, plots, tables or arrays that are empty, hold anything but letters, digits, _ and -, or
  /// stand twice; what base::writeFileAtomically says; Error::cancelled(), asked between files.
  static Result<StagedReport> stage(const std::filesystem::path& folder, const ReportHead& head,
                                    const std::vector<Section>& sections, const JobContext& job = {});
  /// Errors: a folder or a write-protected file where one of the report's belongs, found before anything is moved.
  Result<WrittenReport> commit();

  ~StagedReport();
  StagedReport(StagedReport&& other) noexcept;
  StagedReport& operator=(StagedReport&&) = delete;

 private:
  explicit StagedReport(std::filesystem::path folder) : m_folder(std::move(folder)) {}
  Result<void> makeFolders();
  Result<void> write(const std::string& name, const std::string& text);
  Result<void> write(const std::string& name, const std::vector<std::byte>& bytes);
  Result<void> writeMeasured(const Section& section);
  Result<void> checkTargets() const;

  std::filesystem::path m_folder;
  std::filesystem::path m_staging;            ///< empty: nothing to remove
  std::vector<std::filesystem::path> m_made;  ///< folders made here, outermost first; kept once committed
  std::vector<std::string> m_files;           ///< relative to the folder, in the order of moving
};

/// A name for a picture, plot, table or array, from any text: what may not stand in it becomes '_'.
std::string fileNameFrom(std::string_view text);

}  // namespace sward::report
