#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sward::leaf {

/// The folder of published and measured spectra; may not exist.
std::filesystem::path spectraFolder();

/// Rows of numbers, whatever parts them; lines that begin with no number are left out.
std::vector<std::vector<double>> numberRows(const std::filesystem::path& file);

using Samples = std::vector<std::pair<double, double>>;  ///< wavelength in nm, value; wavelengths rise
/// Linear between samples; the nearest end outside.
double valueAt(const Samples& samples, double nm);

/// Every labelled block of an XML library of spectra; of a label that occurs twice, the last.
std::map<std::string, Samples> spectralLibrary(const std::filesystem::path& file);

}  // namespace sward::leaf
