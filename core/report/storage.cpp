#include "report/storage.h"

#include "base/bytes.h"
#include "lpt/layer_stack.h"

#include <array>
#include <string>

namespace sward::report {
namespace {

/// A size of the paper's storage table with its figures, in MB: PTM and LPT coefficients.
struct PaperSize {
  int side, layers;
  const char *ptm, *lpt;
};
constexpr std::array<PaperSize, 3> kSizes{
    {{256, 8, "4.89", "2.93"}, {256, 16, "9.64", "2.93"}, {512, 16, "41.8", "11.73"}}};

/// A stack of this shape; what its coefficients are changes no byte count.
lpt::LayerStack makeStack(const PaperSize& size, lpt::Basis basis, int bits, int channels, const JobContext& job) {
  lpt::LayerStackInput in;
  in.basis = basis;
  in.width = in.height = size.side;
  in.layers = size.layers;
  in.channels = channels;
  const std::size_t columns = static_cast<std::size_t>(size.side) * static_cast<std::size_t>(size.side);
  const std::size_t texels = columns * static_cast<std::size_t>(size.layers);
  in.coefficients.resize((basis == lpt::Basis::Lpt ? columns : texels) *
                         static_cast<std::size_t>(lpt::stackCoefficients(basis) * channels));
  for (std::size_t i = 0; i < in.coefficients.size(); ++i) {
    in.coefficients[i] = static_cast<float>(i % 1021) / 1021.0f - 0.5f;
  }
  in.coverage.assign(texels, 1.0f);
  in.reflectance.assign(texels, glm::vec3(0.2f, 0.3f, 0.1f));
  if (channels == 2) in.transmittance.assign(texels, glm::vec3(0.2f, 0.3f, 0.05f));
  in.sky.assign(texels, glm::vec2(0.5f, 0.2f));
  lpt::FitOptions options;
  options.bits = bits;
  return lpt::quantise(in, options, true, job);
}

/// Coefficients as four-channel images: both channels of a column share them, ten bytes take three, twenty take five.
std::uint64_t textureBytes(const lpt::LayerStack& stack) {
  const auto perPlace = static_cast<std::uint64_t>(stack.perColumn() * stack.channels);
  const std::uint64_t places = stack.itemCount();
  return (perPlace + 3) / 4 * 4 * places * static_cast<std::uint64_t>(stack.bits / 8);
}

std::uint64_t fileBytes(const lpt::LayerStack& stack) {
  base::ByteWriter out;
  lpt::save(out, stack);
  return out.take().size();
}

Row storageRow(const PaperSize& size, const lpt::LayerStack& stack) {
  const bool lpt = stack.basis == lpt::Basis::Lpt;
  Row row;
  row.method = "storage";
  row.numbersAndNames = {
      {"basis", lpt ? "\"lpt\"" : "\"ptm\""},           {"size", std::to_string(size.side)},
      {"layers", std::to_string(size.layers)},          {"bits", std::to_string(stack.bits)},
      {"channels", std::to_string(stack.channels)},     {"texture_bytes", std::to_string(textureBytes(stack))},
      {"file_bytes", std::to_string(fileBytes(stack))}, {"paper_mb", lpt ? size.lpt : size.ptm}};
  row.bytes = stack.lightingBytes();
  row.bytesTotal = stack.totalBytes();
  row.reference = "the paper's table of coefficient megabytes (paper_mb)";
  row.notes = stack.channels == 1 ? "One channel, as the paper: reflected light alone."
                                  : "Two channels: reflected and transmitted light.";
  row.notes +=
      " texture_bytes: coefficients in four-channel images, spare ones counted. file_bytes: the saved payload with "
      "colour, coverage, sky and ranges.";
  return row;
}

}  // namespace

std::vector<Row> storageRows(const JobContext& job) {
  JobContext silent = job;
  silent.onProgress = nullptr;
  std::vector<Row> rows;
  for (const PaperSize& size : kSizes) {
    for (const int channels : {1, 2}) {
      for (const int bits : {8, 16}) {
        if (job.cancelled()) return rows;
        const lpt::LayerStack ptm = makeStack(size, lpt::Basis::Ptm, bits, channels, silent);
        const lpt::LayerStack lpt = makeStack(size, lpt::Basis::Lpt, bits, channels, silent);
        rows.push_back(storageRow(size, ptm));
        rows.push_back(storageRow(size, lpt));
        rows.back().ratio = static_cast<double>(lpt.lightingBytes()) / static_cast<double>(ptm.lightingBytes());
        rows.back().against = "PTM coefficients of the same size, bits and channels; bytes over bytes";
      }
    }
  }
  return rows;
}

}  // namespace sward::report
