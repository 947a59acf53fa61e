#include "lpt/layer_stack.h"

#include <algorithm>
#include <cmath>

namespace sward::lpt {
namespace {

/// Every size follows from the shape; limits keep the products below 2^64.
bool consistent(const LayerStack& stack) {
  constexpr int kLargestSide = 1 << 16;
  const auto within = [](int value, int low, int high) { return value >= low && value <= high; };
  if (stackCoefficients(stack.basis) == 0 || (stack.bits != 8 && stack.bits != 16)) return false;
  if (!within(stack.width, 0, kLargestSide) || !within(stack.height, 0, kLargestSide)) return false;
  if (!within(stack.images, 0, kLargestSide) || !within(stack.layers, 1, 256) || !within(stack.channels, 1, 16)) {
    return false;
  }
  const std::size_t values = static_cast<std::size_t>(stack.channels) * static_cast<std::size_t>(stack.perColumn());
  const std::size_t sets = stack.itemCount();
  const std::size_t bytes = stack.bits == 8 ? 1 : 2;
  const std::size_t texels = stack.texelCount();
  return stack.ranges.size() == values && stack.coefficients.size() == sets * values * bytes &&
         stack.surface.size() == texels * 4 && stack.sky.size() == texels * 2 &&
         (stack.common.empty() || (stack.basis == Basis::Lpt && stack.common.fits(stack.layers, stack.channels))) &&
         (stack.transmission.empty() || stack.transmission.size() == texels * 4) &&
         std::all_of(stack.ranges.begin(), stack.ranges.end(), [](const CoefficientRange& range) {
           return std::isfinite(range.scale) && range.scale >= 0.0f && std::isfinite(range.base);
         });
}

}  // namespace

void save(base::ByteWriter& out, const LayerStack& stack) {
  out.value(stack.basis);
  out.value(stack.width);
  out.value(stack.height);
  out.value(stack.images);
  out.value(stack.layers);
  out.value(stack.channels);
  out.value(stack.bits);
  out.array(stack.ranges);
  out.array(stack.coefficients);
  out.array(stack.surface);
  out.array(stack.transmission);
  out.array(stack.sky);
  save(out, stack.common);
}

bool load(base::ByteReader& in, LayerStack& stack) {
  LayerStack read;
  in.value(read.basis);
  in.value(read.width);
  in.value(read.height);
  in.value(read.images);
  in.value(read.layers);
  in.value(read.channels);
  in.value(read.bits);
  in.array(read.ranges);
  in.array(read.coefficients);
  in.array(read.surface);
  in.array(read.transmission);
  in.array(read.sky);
  if (!load(in, read.common) || !in.ok() || !consistent(read)) return false;
  stack = std::move(read);
  return true;
}

}  // namespace sward::lpt
