// SPDX-License-Identifier: Apache-2.0
// Reference decoder: heights and the layers beside their coefficients (docs/FORMAT.md, sections 8
// and 8.1).
#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "conformance/reference_decoder/facets.hpp"
#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/regions.hpp"
#include "conformance/reference_decoder/relative.hpp"
#include "conformance/reference_decoder/samples.hpp"
#include "conformance/reference_decoder/stream.hpp"
#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {
namespace {

/// FORMAT 8.1: hints of corrections of samples.
int openBits(const GeometryHeader& header, uint32_t bits) {
  return std::clamp(std::ilogb(header.step) - spacingOf(header, bits), 0, 31);
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

/// FORMAT 8.1: the codewords of the first track. Drawings and stored samples count as coefficients.
struct FirstTrack {
  std::span<const uint8_t> lifted, validity, flat, table, corrections;
  std::vector<uint8_t> coefficients;
};

FirstTrack takeApart(const Layers& layers, std::span<const uint8_t> codeword) {
  FirstTrack track;
  if (layers.lateMask) track.lifted = take(codeword, layers.liftedBytes);
  if (!layers.lateMask) track.validity = take(codeword, layers.validityBytes);
  track.flat = take(codeword, layers.flatBytes);
  uint64_t taken = 0;
  const auto coefficients = [&](uint64_t end) {
    const auto some = take(codeword, end - taken);
    track.coefficients.insert(track.coefficients.end(), some.begin(), some.end());
    taken = end;
  };
  const bool table = layers.tableBytes > 0;
  const bool tableFirst = table && layers.tableAfter < layers.validityAfter;
  const auto takeTable = [&] {
    coefficients(layers.tableAfter);
    track.table = take(codeword, layers.tableBytes);
  };
  if (tableFirst) takeTable();
  if (layers.lateMask) {
    coefficients(layers.validityAfter);
    track.validity = take(codeword, layers.validityBytes);
  }
  if (table && !tableFirst) takeTable();
  coefficients(layers.corrections > 0 ? layers.coefficientBytes : UINT64_MAX);
  track.corrections = codeword;
  return track;
}

/// What is known of the heights before they become samples.
struct Surface {
  std::vector<std::vector<Part>> parts;  ///< by track
  std::vector<std::vector<Band>> bands;  ///< likewise
  int f = 0;
  Plane plane;
};

/// FORMAT 8.1, "Flat areas": held samples have the heights of their areas, at all mip levels.
void putFlat(const Plane& whole, int level, Plane& image) {
  for (int y = 0; y < whole.height; y += 1 << level) {
    for (int x = 0; x < whole.width; x += 1 << level) {
      const uint32_t area = whole.areaOf(x, y);
      if (area > 0) image.at(x >> level, y >> level) = whole.flat.heights.at(area - 1);
    }
  }
}

/// FORMAT 7.1: the samples at the places of a level.
Plane placesOf(const Plane& whole, int level) {
  Plane image{((whole.width - 1) >> level) + 1, ((whole.height - 1) >> level) + 1, {}, {}};
  for (int y = 0; y < whole.height; y += 1 << level) {
    for (int x = 0; x < whole.width; x += 1 << level) {
      const size_t i = static_cast<size_t>(y) * whole.width + x;
      image.values.push_back(whole.values[i]);
      if (!whole.valid.empty()) image.valid.push_back(whole.valid[i]);
    }
  }
  return image;
}

/// lifted: what section 7 takes for valid samples; empty: all.
Surface decodeSurface(const GeometryHeader& header, const std::vector<uint8_t>& lifted,
                      const std::vector<std::span<const uint8_t>>& coefficients, Plane known,
                      int level) {
  Surface surface;
  const std::vector<Subband> subbands = subbandsOf(header.width, header.height);
  surface.plane = std::move(known);
  if (header.drawn) {
    surface.plane.values = decodeDrawnHeights(header, coefficients[0], surface.plane.valid);
    surface.plane = placesOf(surface.plane, level);
    surface.f = 4;
    return surface;
  }
  surface.plane.values.resize(static_cast<size_t>(header.width) * header.height);
  const std::vector<uint8_t> valid = surface.plane.valid;
  surface.plane.valid = lifted;
  const PriorityMap priorities = priorityMapOf(header.priorities, header.width, header.height);
  for (const Region& region : regionsOf(header.width, header.height, header.regions.log2)) {
    const size_t track = surface.parts.size();
    surface.parts.push_back(partsOf(subbands, region));
    std::vector<Band>& bands = surface.bands.emplace_back();
    bands = bandsOf(header.wavelet, surface.parts.back(), 0);
    markAbsent(surface.parts.back(), surface.plane, bands);
    setPriorities(surface.parts.back(), priorities, bands);
    dropFiner(surface.parts.back(), level, bands);
    decodeTrack(coefficients[track], header.planes, bands);
  }
  const Fraction fraction = fractionOf(header.wavelet, header.planes, bytesOf(coefficients), level);
  surface.f = fraction.f;
  for (size_t i = 0; i < surface.parts.size(); ++i) {
    place(surface.bands[i], surface.parts[i], surface.f - header.wavelet.fractionBits,
          surface.plane);
  }
  for (int32_t& height : surface.plane.flat.heights) height = wrap(int64_t{height} << surface.f);
  synthesise(header.wavelet, subbands, level, fraction.rounds, surface.plane);
  surface.plane.valid = valid;
  const Plane whole = surface.plane;
  if (level > 0) surface.plane = levelOf(header.wavelet, subbands, level, surface.plane);
  putFlat(whole, level, surface.plane);
  return surface;
}

/// 1 where a sample has a significant coefficient.
Plane significanceOf(const Surface& surface) {
  Plane marks{surface.plane.width, surface.plane.height, {}};
  marks.values.resize(surface.plane.values.size());
  for (size_t track = 0; track < surface.parts.size(); ++track) {
    for (size_t i = 0; i < surface.parts[track].size(); ++i) {
      const Part& part = surface.parts[track][i];
      for (int r = 0; r < part.rows; ++r) {
        for (int a = 0; a < part.columns; ++a) {
          const bool significant = surface.bands[track][i].get(r, a).magnitude > 0;
          marks.at(part.x(a), part.y(r)) =
              surface.plane.isValid(part.x(a), part.y(r)) && significant;
        }
      }
    }
  }
  return marks;
}

/// marks: of significance.
void correctSteps(const Layers& layers, std::span<const uint8_t> codeword, int f, Plane& marks,
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

std::vector<uint32_t> samplesOf(const GeometryHeader& header, const Surface& surface) {
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

/// FORMAT 8.1, "Stand-in": heights between steps in the place of a table.
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

/// FORMAT 8.1, "Table of values": the sample N near a value.
uint32_t nearValue(const GeometryHeader& header, uint32_t bits) {
  constexpr double kMost = 1 << 25;
  const double steps = (numberOf(header, bits) - header.base) / header.step;
  const double v16 = std::isnan(steps) ? 0 : std::round(std::clamp(steps, -kMost, kMost) * 16);
  return heightSampleOf(header, stepOf(static_cast<int32_t>(v16), 4));
}

/// near: the samples that hints come from.
void correctSamples(const GeometryHeader& header, std::span<const uint8_t> codeword,
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

/// FORMAT 8.1: corrections of samples, which are made of the heights.
void correctMade(const GeometryHeader& header, const Layers& layers,
                 std::span<const uint8_t> codeword, int f, Correctable& part) {
  if (layers.corrections == 2)
    correctSamples(header, codeword, part.plane, part.near, part.samples);
  if (layers.corrections == 3)
    correctFromRelative(header, layers, codeword, part.plane, part.samples);
  if (layers.corrections == 4)
    correctFromFacets(header, layers, codeword, part.plane, f, part.samples);
}

/// Corrects the plane with one codeword, or each of its parts with its own.
template <class Correct>
void correctParts(const GeometryHeader& header,
                  const std::vector<std::span<const uint8_t>>& codewords, Correctable& whole,
                  const Correct& correct) {
  const auto regions = finestRegionsOf(header.width, header.height, header.regions.log2);
  if (regions.empty()) correct(codewords.at(0), whole);
  for (size_t i = 0; i < regions.size(); ++i) {
    Correctable part = partOf(whole, regions[i]);
    correct(codewords.at(i), part);
    put(part.plane.values, header.width, regions[i], whole.plane.values);
    put(part.samples, header.width, regions[i], whole.samples);
  }
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

/// FORMAT 8.1, "Voids": voids get their value, and no other sample has it.
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
  constexpr int kBytes[] = {1, 1, 2, 2, 4, 4, 4};
  std::vector<uint8_t> bytes;
  for (const uint32_t sample : samples) {
    for (int i = 0; i < kBytes[header.sample]; ++i)
      bytes.push_back(static_cast<uint8_t>(sample >> (8 * i)));
  }
  return bytes;
}

/// FORMAT 8.2: of the samples at the places of a level.
std::vector<uint32_t> storedSamples(const GeometryHeader& header, std::span<const uint8_t> bytes,
                                    const std::vector<uint8_t>& valid, int level) {
  constexpr int kBytes[] = {1, 1, 2, 2, 4, 4, 4};
  const int width = kBytes[header.sample], step = 1 << level;
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
      if (x % step == 0 && y % step == 0)
        samples.push_back(known ? orderOf(header, narrow(header, order))
                                : heightSampleOf(header, 0));
      number += exists;
    }
  }
  return samples;
}

std::vector<uint8_t> decodeStored(const GeometryHeader& header, const Layers& layers,
                                  std::span<const uint8_t> bytes, const std::vector<uint8_t>& valid,
                                  int level) {
  std::vector<uint32_t> samples = storedSamples(header, bytes, valid, level);
  Plane plane;
  const size_t step = size_t{1} << level;
  for (size_t i = 0; i < valid.size(); ++i) {
    const size_t x = i % header.width, y = i / header.width;
    if (x % step == 0 && y % step == 0) plane.valid.push_back(valid[i]);
  }
  putVoids(header, layers, plane, samples);
  return bytesOf(header, samples);
}

}  // namespace

std::vector<uint8_t> decodeHeights(const GeometryHeader& header, const Layers& layers,
                                   const Codewords& codewords, int level) {
  level = std::min(level, subbandsOf(header.width, header.height).front().level);
  const FirstTrack track = takeApart(layers, codewords.at(0));
  const int width = header.width, height = header.height;
  Plane known{width, height, {}, {}};
  std::vector<uint8_t> lifted;
  if (layers.lateMask) {
    if (layers.liftedBytes > 0) lifted = decodeValidity(track.lifted, width, height);
    known.valid = decodeLateValidity(track.validity, {width, height, {}, lifted});
  } else if (layers.validityBytes > 0) {
    known.valid = decodeValidity(track.validity, width, height);
  }
  const bool stored = header.planes == kStoredPlanes && !header.drawn;
  if (stored) return decodeStored(header, layers, track.coefficients, known.valid, level);
  if (!layers.lateMask)
    lifted = layers.bridge > 0 ? bridged(known.valid, width, height, layers.bridge) : known.valid;
  if (layers.flatBytes > 0) {
    const std::vector<uint8_t>& among = layers.lateMask ? lifted : known.valid;
    known.flat = decodeFlat(track.flat, {width, height, {}, among}, layers.flatAreas);
  }
  std::vector<uint32_t> table;
  if (layers.tableBytes > 0) table = decodeTables(track.table, {layers.tableValues}, 32)[0];
  const auto tracks = codewords.begin() + regionsOf(width, height, header.regions.log2).size();
  std::vector<std::span<const uint8_t>> coefficients(codewords.begin(), tracks);
  std::vector<std::span<const uint8_t>> corrections(tracks, codewords.end());
  coefficients[0] = track.coefficients;
  if (corrections.empty()) corrections.push_back(track.corrections);
  Surface surface = decodeSurface(header, lifted, coefficients, std::move(known), level);
  if (table.empty() && !layers.tableKnots.empty()) standIn(layers, surface);
  if (layers.corrections == 1 && level == 0) {
    Correctable whole{surface.plane, significanceOf(surface), {}, {}};
    correctParts(header, corrections, whole, [&](std::span<const uint8_t> codeword, auto& part) {
      correctSteps(layers, codeword, surface.f, part.marks, part.plane);
    });
    surface.plane.values = whole.plane.values;
  }
  std::vector<uint32_t> samples =
      table.empty() ? samplesOf(header, surface) : valuesOf(header, table, surface);
  if (layers.corrections >= 2 && level == 0) {
    std::vector<uint32_t> near = samples;
    if (!table.empty()) {
      for (uint32_t& bits : near) bits = nearValue(header, bits);
    }
    Correctable whole{surface.plane, {width, height, {}}, samples, near};
    correctParts(header, corrections, whole, [&](std::span<const uint8_t> codeword, auto& part) {
      correctMade(header, layers, codeword, surface.f, part);
    });
    samples = whole.samples;
  }
  putVoids(header, layers, surface.plane, samples);
  return bytesOf(header, samples);
}

}  // namespace tetrakis::reference
