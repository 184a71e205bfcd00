// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/height_samples.hpp"

#include <algorithm>
#include <bit>

#include "conformance/reference_decoder/samples.hpp"
#include "conformance/reference_decoder/units.hpp"

namespace tetrakis::reference {

namespace {

constexpr int kSampleBytes[] = {1, 1, 2, 2, 4, 4, 4};

/// FORMAT 8, "Samples".
std::vector<uint32_t> multiplesOf(const GeometryHeader& header, const Surface& surface) {
  std::vector<uint32_t> samples;
  for (const int32_t v : surface.plane.values)
    samples.push_back(heightSampleOf(header, stepOf(v, surface.f)));
  return samples;
}

/// FORMAT 8.1, "Table of values": the samples that whole steps count.
std::vector<uint32_t> valuesOf(const GeometryHeader& header, const std::vector<uint32_t>& table,
                               const Surface& surface) {
  const auto last = static_cast<int64_t>(table.size()) - 1;
  std::vector<uint32_t> samples;
  for (const int32_t v : surface.plane.values) {
    const int64_t i = int64_t{stepOf(v, surface.f)} + static_cast<int64_t>(table.size() / 2);
    const uint32_t word = table[static_cast<size_t>(std::clamp<int64_t>(i, 0, last))];
    samples.push_back(orderOf(header, narrow(header, word)));
  }
  return samples;
}

/// FORMAT 8.1, "Table of values": the v of a sample of the table.
int32_t valueOf(const GeometryHeader& header, uint32_t bits) {
  const bool nan = header.sample == kF32 && (bits & 0x7FFFFFFF) > 0x7F800000;
  return nan ? 0 : static_cast<int32_t>(stepsOf(header, bits, 4));
}

/// FORMAT 8.1, "Voids": whether samples equal the nodata value V.
bool equalsNodata(const GeometryHeader& header, double nodata, uint32_t bits) {
  switch (header.sample) {
    case kF32:
      return std::bit_cast<float>(bits) == static_cast<float>(nodata);
    case kU8:
    case kU16:
    case kU32:
      return bits == nodata;
    default:
      return static_cast<int32_t>(bits) == nodata;
  }
}

/// FORMAT 8.1, "Voids": the sample beside V.
uint32_t besides(const GeometryHeader& header, double nodata) {
  constexpr uint32_t kLargest[] = {255, 127, 65535, 32767, 0xFFFFFFFF, 0x7FFFFFFF, 0x7F7FFFFF};
  constexpr uint32_t kInfinity = 0x7F800000;
  const uint32_t v = sampleOf(header, nodata);
  if (header.sample == kF32 && static_cast<float>(nodata) == 0) return 1;
  if (header.sample == kF32 && v == kInfinity) return kLargest[kF32];
  return orderOf(header, orderOf(header, v) + (v == kLargest[header.sample] ? 0xFFFFFFFF : 1));
}

/// FORMAT 8.2: of the samples at the places of a level.
std::vector<uint32_t> storedSamples(const GeometryHeader& header, std::span<const uint8_t> bytes,
                                    const std::vector<uint8_t>& valid, int level) {
  const int width = kSampleBytes[header.sample];
  const size_t count = valid.empty() ? static_cast<size_t>(header.width) * header.height
                                     : std::count(valid.begin(), valid.end(), 1);
  std::vector<uint32_t> samples;
  size_t number = 0;
  for (int y = 0; y < header.height; ++y) {
    for (int x = 0; x < header.width; ++x) {
      const bool exists = valid.empty() || valid[static_cast<size_t>(y) * header.width + x];
      uint32_t order = 0;
      bool missing = false;
      for (int i = 0; i < width; ++i) {
        const size_t at = i * count + number;
        const bool there = exists && at < bytes.size();
        order = order << 8 | (there ? bytes[at] : missing ? 0 : 0x80);
        missing |= !there;
      }
      const bool known = exists && number < bytes.size();
      if (header.wavelet.domain.forest.shows(level, x, y))
        samples.push_back(known ? orderOf(header, narrow(header, order))
                                : heightSampleOf(header, 0));
      number += exists;
    }
  }
  return samples;
}

}  // namespace

MadeSamples samplesOf(const GeometryHeader& header, const std::vector<uint32_t>& table,
                      const Surface& surface) {
  MadeSamples samples{
      table.empty() ? multiplesOf(header, surface) : valuesOf(header, table, surface), {}};
  for (size_t i = 0; i < samples.bits.size(); ++i) {
    const int32_t q = table.empty() ? stepOf(surface.plane.values[i], surface.f)
                                    : stepOf(valueOf(header, samples.bits[i]), 4);
    samples.near.push_back(sampleNear(header, q));
  }
  return samples;
}

void standIn(const Layers& layers, Surface& surface) {
  constexpr int64_t kMost = 1 << 29;
  const std::vector<TableKnot>& knots = layers.tableKnots;
  const int64_t one = int64_t{1} << surface.f;
  for (size_t i = 0; i < surface.plane.values.size(); ++i) {
    int32_t& v = surface.plane.values[i];
    const int64_t place = v + layers.tableValues / 2 * one;
    size_t next = 0;
    while (next < knots.size() && knots[next].place * one <= place) ++next;
    int64_t rise = knots[next == 0 ? 0 : next - 1].rise;
    if (next > 0 && next < knots.size()) {
      const TableKnot &a = knots[next - 1], &b = knots[next];
      const int64_t up = (b.rise - a.rise) * (place - a.place * one);
      const int64_t run = (b.place - a.place) * one;
      rise += (up - ((up % run) + run) % run) / run;
    }
    const int64_t line = (int64_t{v} * 16) >> surface.f;
    v = static_cast<int32_t>(std::clamp(line, -kMost, kMost) + rise);
  }
  surface.f = 4;
}

void putVoids(const GeometryHeader& header, const Layers& layers, const Plane& plane,
              std::vector<uint32_t>& samples) {
  constexpr uint32_t kQuietNan = 0x7FC00000;
  const uint32_t hole = layers.hasNodata ? sampleOf(header, layers.nodata) : kQuietNan;
  for (size_t i = 0; i < samples.size(); ++i) {
    if (!plane.valid.empty() && !plane.valid[i]) {
      samples[i] = hole;
    } else if (layers.hasNodata && equalsNodata(header, layers.nodata, samples[i])) {
      samples[i] = besides(header, layers.nodata);
    }
  }
}

std::vector<uint8_t> bytesOf(const GeometryHeader& header, const std::vector<uint32_t>& samples) {
  std::vector<uint8_t> bytes;
  for (const uint32_t sample : samples) {
    for (int i = 0; i < kSampleBytes[header.sample]; ++i)
      bytes.push_back(static_cast<uint8_t>(sample >> (8 * i)));
  }
  return bytes;
}

std::vector<uint8_t> decodeStored(const GeometryHeader& header, const Layers& layers,
                                  std::span<const uint8_t> bytes, const std::vector<uint8_t>& valid,
                                  int level) {
  std::vector<uint32_t> samples = storedSamples(header, bytes, valid, level);
  Plane plane;
  for (size_t i = 0; i < valid.size(); ++i) {
    const auto x = static_cast<int>(i % header.width), y = static_cast<int>(i / header.width);
    if (header.wavelet.domain.forest.shows(level, x, y)) plane.valid.push_back(valid[i]);
  }
  putVoids(header, layers, plane, samples);
  return bytesOf(header, samples);
}

}  // namespace tetrakis::reference
