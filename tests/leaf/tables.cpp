#include "leaf/tables.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace sward::leaf {
namespace {

std::vector<double> numbersOf(std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream words(line);
  std::vector<double> numbers;
  for (double number; words >> number;) numbers.push_back(number);
  return numbers;
}

}  // namespace

std::filesystem::path spectraFolder() {
  return std::filesystem::path(SWARD_SHARED_DIR) / "assets" / "spectra";
}

std::vector<std::vector<double>> numberRows(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    std::vector<double> numbers = numbersOf(line);
    if (!numbers.empty()) rows.push_back(std::move(numbers));
  }
  return rows;
}

double valueAt(const Samples& samples, double nm) {
  const auto after = std::lower_bound(samples.begin(), samples.end(), nm,
                                      [](const auto& sample, double at) { return sample.first < at; });
  if (after == samples.begin()) return samples.front().second;
  if (after == samples.end()) return samples.back().second;
  const auto before = after - 1;
  const double t = (nm - before->first) / (after->first - before->first);
  return before->second + t * (after->second - before->second);
}

std::map<std::string, Samples> spectralLibrary(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::map<std::string, Samples> library;
  std::string label;
  for (std::string line; std::getline(in, line);) {
    const std::size_t start = line.find("label=\"");
    if (start != std::string::npos) {
      label = line.substr(start + 7, line.find('"', start + 7) - start - 7);
      library[label].clear();
      continue;
    }
    const std::vector<double> numbers = numbersOf(line);
    if (numbers.size() == 2 && !label.empty()) library[label].emplace_back(numbers[0], numbers[1]);
  }
  return library;
}

}  // namespace sward::leaf
