// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/height_corrections.hpp"

#include <algorithm>

#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/regions.hpp"
#include "conformance/reference_decoder/sample_corrections.hpp"
#include "conformance/reference_decoder/samples.hpp"
#include "conformance/reference_decoder/units.hpp"

namespace tetrakis::reference {

namespace {

/// FORMAT 8.1: hints of corrections of samples.
int openBits(const GeometryHeader& header, uint32_t bits) {
  return std::clamp(Digits(header.step).log2() - spacingOf(header, bits), 0, 15);
}

/// FORMAT 8.1: hints of corrections of steps.
std::vector<int> activityHints(Plane& marks) {
  std::vector<int> hints;
  for (int y = 0; y < marks.height; ++y) {
    for (int x = 0; x < marks.width; ++x) {
      int sum = marks.at(x, y);
      if (x > 0) sum += marks.at(x - 1, y);
      if (x + 1 < marks.width) sum += marks.at(x + 1, y);
      if (y > 0) sum += marks.at(x, y - 1);
      if (y + 1 < marks.height) sum += marks.at(x, y + 1);
      hints.push_back(sum);
    }
  }
  return hints;
}

/// Corrections of steps of a part. marks: of significance.
void correctStepsOf(const Layers& layers, std::span<const uint8_t> codeword, int f, Plane& marks,
                    Plane& plane) {
  if (layers.correctionStep == 1) {
    makeExact(codeword, plane, f);
    return;
  }
  const std::vector<uint32_t> corrections =
      decodeCorrections(codeword, plane, activityHints(marks));
  for (size_t i = 0; i < corrections.size(); ++i) {
    int32_t& v = plane.values[i];
    v = static_cast<int32_t>(static_cast<uint32_t>(v) +
                             corrections[i] * (layers.correctionStep << f));
  }
}

/// FORMAT 8.1, "Of samples". near: the samples that hints come from.
void correctPlainly(const GeometryHeader& header, std::span<const uint8_t> codeword,
                    const Plane& plane, const std::vector<uint32_t>& near,
                    std::vector<uint32_t>& samples) {
  std::vector<int> hints;
  for (const uint32_t bits : near) hints.push_back(openBits(header, bits));
  const std::vector<uint32_t> corrections = decodeCorrections(codeword, plane, hints);
  for (size_t i = 0; i < corrections.size(); ++i) {
    samples[i] = narrow(header, orderOf(header, orderOf(header, samples[i]) + corrections[i]));
  }
}

/// What corrections know of the plane, or of a part of it.
struct Correctable {
  Plane plane, marks;
  std::vector<uint32_t> samples, near;  ///< near: those that hints come from
};

template <class T>
std::vector<T> cut(const std::vector<T>& values, int width, const Region& region) {
  std::vector<T> part;
  for (int64_t y = region.y0; y < region.y1 && !values.empty(); ++y) {
    const auto row = values.begin() + y * width;
    part.insert(part.end(), row + region.x0, row + region.x1);
  }
  return part;
}

template <class T>
void put(const std::vector<T>& part, int width, const Region& region, std::vector<T>& values) {
  auto from = part.begin();
  for (int64_t y = region.y0; y < region.y1 && !part.empty(); ++y) {
    for (int64_t x = region.x0; x < region.x1; ++x) values[y * width + x] = *from++;
  }
}

Correctable partOf(const Correctable& whole, const Region& region) {
  const int width = whole.plane.width;
  const int columns = static_cast<int>(region.x1 - region.x0);
  const int rows = static_cast<int>(region.y1 - region.y0);
  return {{columns, rows, cut(whole.plane.values, width, region),
           cut(whole.plane.valid, width, region)},
          {columns, rows, cut(whole.marks.values, width, region)},
          cut(whole.samples, width, region),
          cut(whole.near, width, region)};
}

/// Corrections of samples of a part, whose plane holds whole steps.
void correctSamplesOf(const GeometryHeader& header, const Layers& layers,
                      std::span<const uint8_t> codeword, Correctable& part) {
  if (layers.corrections == 2)
    correctPlainly(header, codeword, part.plane, part.near, part.samples);
  if (layers.corrections == 3)
    correctFromRelative(header, layers, codeword, part.plane, part.samples);
  if (layers.corrections == 4)
    correctFromFacets(header, layers, codeword, part.plane, part.samples);
}

/// Corrects the plane with one codeword, or each of its parts with its own.
template <class Correct>
void correctParts(const GeometryHeader& header,
                  const std::vector<std::span<const uint8_t>>& codewords, Correctable& whole,
                  const Correct& correct) {
  const auto regions = finestRegionsOf(header.width, header.height, header.regions.log2,
                                       header.wavelet.domain.forest.patches());
  if (regions.empty()) correct(codewords.at(0), whole);
  for (size_t i = 0; i < regions.size(); ++i) {
    Correctable part = partOf(whole, regions[i]);
    correct(codewords.at(i), part);
    put(part.plane.values, header.width, regions[i], whole.plane.values);
    put(part.samples, header.width, regions[i], whole.samples);
  }
}

}  // namespace

void correctSteps(const GeometryHeader& header, const Layers& layers,
                  const std::vector<std::span<const uint8_t>>& codewords, Surface& surface) {
  Correctable whole{surface.plane, significanceOf(surface), {}, {}};
  correctParts(header, codewords, whole, [&](std::span<const uint8_t> codeword, auto& part) {
    correctStepsOf(layers, codeword, surface.f, part.marks, part.plane);
  });
  surface.plane.values = whole.plane.values;
}

void correctSamples(const GeometryHeader& header, const Layers& layers,
                    const std::vector<std::span<const uint8_t>>& codewords, const Surface& surface,
                    MadeSamples& samples) {
  Correctable whole{surface.plane, {header.width, header.height, {}}, samples.bits, samples.near};
  for (int32_t& v : whole.plane.values) v = stepOf(v, surface.f);
  correctParts(header, codewords, whole, [&](std::span<const uint8_t> codeword, auto& part) {
    correctSamplesOf(header, layers, codeword, part);
  });
  samples.bits = whole.samples;
}

}  // namespace tetrakis::reference
