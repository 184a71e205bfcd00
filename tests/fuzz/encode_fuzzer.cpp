// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: what an encoder does with heights, a texture and options from a stranger, and
// whether it keeps what it promises. The bytes are a program that paints a small terrain, so that
// mutants stay terrains: ramps, levels, raw samples, lines that repeat, holes. No seeds are needed.
#include <fuzzer/FuzzedDataProvider.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "base/samples.hpp"
#include "tests/awkward/promises.hpp"
#include "tests/awkward/shared_samples.hpp"

namespace {

using tetrakis::samples::Raster;
using tetrakis::test::AwkwardCase;

constexpr uint32_t kMostSide = 48, kMostStrokes = 12;

/// The columns and rows of one stroke.
struct Rectangle {
  uint32_t left, top, right, bottom;
};

Rectangle rectangleOf(FuzzedDataProvider& bytes, const Raster& raster) {
  const auto left = bytes.ConsumeIntegralInRange<uint32_t>(0, raster.width - 1);
  const auto top = bytes.ConsumeIntegralInRange<uint32_t>(0, raster.height - 1);
  return {left, top, bytes.ConsumeIntegralInRange<uint32_t>(left, raster.width - 1),
          bytes.ConsumeIntegralInRange<uint32_t>(top, raster.height - 1)};
}

/// Paints samples of one type. Integers wrap; floats that are no numbers are voids.
template <class T>
class Painter {
 public:
  Painter(FuzzedDataProvider& bytes, Raster& raster, size_t channel)
      : bytes_(bytes), raster_(raster), channel_(channel) {}

  void stroke() {
    const auto kind = bytes_.ConsumeIntegralInRange<int>(0, 5);
    const Rectangle r = rectangleOf(bytes_, raster_);
    const T first = value(), along = value(), down = value();
    const auto period = bytes_.ConsumeIntegralInRange<uint32_t>(1, 9);
    for (uint32_t y = r.top; y <= r.bottom; ++y) {
      for (uint32_t x = r.left; x <= r.right; ++x) {
        if (kind == 0) set(x, y, first);
        if (kind == 1) set(x, y, ramp(first, along, down, x - r.left, y - r.top));
        if (kind == 2) set(x, y, value());
        if (kind == 3) set(x, y, at(x - x % period, y - y % period));
        if (kind == 4 && (x + y) % period == 0) set(x, y, first);
        if (kind == 5) set(x, y, ramp(at(x, y), along, down, x / period, y / period));
      }
    }
  }

 private:
  T value() {
    T sample;
    std::array<uint8_t, sizeof(T)> raw{};
    bytes_.ConsumeData(raw.data(), raw.size());
    std::memcpy(&sample, raw.data(), sizeof sample);
    // Infinite heights are refused.
    if constexpr (std::is_floating_point_v<T>) return std::isinf(sample) ? T{0} : sample;
    return sample;
  }

  static T ramp(T first, T along, T down, uint32_t x, uint32_t y) {
    if constexpr (std::is_floating_point_v<T>) {
      const T sum = first + along * static_cast<T>(x) + down * static_cast<T>(y);
      return std::isinf(sum) ? first : sum;
    } else {
      return static_cast<T>(uint64_t(first) + uint64_t(along) * x + uint64_t(down) * y);
    }
  }

  T at(uint32_t x, uint32_t y) const {
    T sample;
    std::memcpy(&sample, raster_.data.data() + place(x, y), sizeof sample);
    return sample;
  }
  void set(uint32_t x, uint32_t y, T sample) {
    std::memcpy(raster_.data.data() + place(x, y), &sample, sizeof sample);
  }
  size_t place(uint32_t x, uint32_t y) const {
    return ((size_t{y} * raster_.width + x) * raster_.channels + channel_) * sizeof(T);
  }

  FuzzedDataProvider& bytes_;
  Raster& raster_;
  size_t channel_;
};

void paint(FuzzedDataProvider& bytes, Raster& raster) {
  raster.data.resize(size_t{raster.width} * raster.height * raster.channels *
                     tks_sample_bytes(raster.sample));
  tetrakis::withSampleType(raster.sample, [&]<class T>(T) {
    const auto strokes = bytes.ConsumeIntegralInRange<uint32_t>(0, kMostStrokes);
    for (uint32_t i = 0; i < strokes; ++i) {
      const auto channel = bytes.ConsumeIntegralInRange<size_t>(0, raster.channels - 1);
      Painter<T>(bytes, raster, channel).stroke();
    }
  });
}

void aim(FuzzedDataProvider& bytes, tks_encode_options& options) {
  options.size = sizeof options;
  switch (bytes.ConsumeIntegralInRange<int>(0, 3)) {
    case 0:
      options.lossless = 1;
      break;
    case 1:
      options.bytes = bytes.ConsumeIntegralInRange<uint64_t>(60, 20000);
      break;
    case 2:
      options.psnr = bytes.ConsumeFloatingPointInRange<double>(1, 140);
      break;
    default:
      options.max_error = std::exp2(bytes.ConsumeFloatingPointInRange<double>(-30, 30));
  }
  options.regions = bytes.PickValueInArray({0u, 1u, 16u, 32u});
  options.index = bytes.ConsumeIntegralInRange<int>(0, options.lossless ? 2 : 1);
  options.triangles = bytes.ConsumeBool() ? bytes.ConsumeIntegralInRange<uint32_t>(1, 500) : 0;
  options.weights = bytes.ConsumeBool() ? TKS_WEIGHTS_VISUAL : TKS_WEIGHTS_PSNR;
}

/// Up to four patches, glued as the bytes say where they say it of both sides.
void becomeForest(FuzzedDataProvider& bytes, AwkwardCase& c) {
  c.domain = TKS_DOMAIN_FOREST;
  c.sides.assign(4 * bytes.ConsumeIntegralInRange<size_t>(1, 4), TKS_BORDER);
  for (uint32_t side = 0; side < c.sides.size(); ++side) {
    const auto last = static_cast<uint32_t>(c.sides.size()) - 1;
    const auto other = bytes.ConsumeIntegralInRange<uint32_t>(0, last);
    if (other == side || c.sides[side] != TKS_BORDER || c.sides[other] != TKS_BORDER) continue;
    c.sides[side] = other;
    c.sides[other] = side;
  }
  c.options.triangles = 0;
  c.nodata.reset();
  const auto patches = static_cast<uint32_t>(c.sides.size() / 4);
  const auto fit = [&](Raster& raster, uint32_t& depth) {
    depth = bytes.ConsumeIntegralInRange<uint32_t>(1, 5);
    raster.width = (1u << depth) + 1;
    raster.height = patches * raster.width;
  };
  fit(c.heights, c.depth);
  if (c.texture) fit(*c.texture, c.texture_depth);
}

/// Of a forest, once they are painted.
void shareSamples(AwkwardCase& c) {
  if (c.sides.empty()) return;
  using tetrakis::test::SharedSamples;
  SharedSamples(c.depth, c.sides).share(c.heights.data, tks_sample_bytes(c.heights.sample));
  if (!c.texture) return;
  SharedSamples(c.texture_depth, c.sides)
      .share(c.texture->data, c.texture->channels * tks_sample_bytes(c.texture->sample));
}

AwkwardCase caseOf(FuzzedDataProvider& bytes) {
  AwkwardCase c;
  aim(bytes, c.options);
  c.heights.width = bytes.ConsumeIntegralInRange<uint32_t>(1, kMostSide);
  c.heights.height = bytes.ConsumeIntegralInRange<uint32_t>(1, kMostSide);
  c.heights.sample = static_cast<tks_sample>(bytes.ConsumeIntegralInRange<int>(TKS_U8, TKS_F32));
  if (bytes.ConsumeBool()) c.nodata = bytes.ConsumeIntegralInRange<int>(-33000, 66000);
  if (bytes.ConsumeBool()) {
    c.texture.emplace();
    c.texture->width = bytes.ConsumeIntegralInRange<uint32_t>(1, kMostSide);
    c.texture->height = bytes.ConsumeIntegralInRange<uint32_t>(1, kMostSide);
    c.texture->channels = bytes.ConsumeIntegralInRange<uint32_t>(1, 4);
    c.texture->sample = bytes.ConsumeBool() ? TKS_U16 : TKS_U8;
    c.texture->opaque = bytes.ConsumeBool();
  }
  const auto domain = bytes.ConsumeIntegralInRange<int>(0, 3);
  if (domain == 1) c.domain = TKS_DOMAIN_CYLINDER;
  if (domain == 2) becomeForest(bytes, c);
  paint(bytes, c.heights);
  if (c.texture) paint(bytes, *c.texture);
  shareSamples(c);
  return c;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  FuzzedDataProvider bytes(data, size);
  const std::string broken = tetrakis::test::brokenPromise(caseOf(bytes));
  if (broken.empty()) return 0;
  std::fprintf(stderr, "%s\n", broken.c_str());
  std::abort();
}
