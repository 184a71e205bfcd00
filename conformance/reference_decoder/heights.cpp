// SPDX-License-Identifier: Apache-2.0
// Reference decoder: heights on the 4-8 lattice (docs/FORMAT.md, section 7), and the layers beside
// their coefficients (section 7.1).
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "conformance/reference_decoder/lattice.hpp"
#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/stream.hpp"
#include "conformance/reference_decoder/track.hpp"

namespace tetrakis::reference {
namespace {

/// Values k >= 0 with first + k * stride < size.
int count(int first, int stride, int size) {
  return first < size ? (size - 1 - first) / stride + 1 : 0;
}

Band makeBand(const LatticeBand& b, int width, int height) {
  const int s = b.step, k = std::countr_zero(static_cast<unsigned>(s));
  if (b.shape == kRoots) {
    Band band(count(0, s, height), count(0, s, width), count(0, s, width), false);
    band.logNorm = 16 * k;
    band.modelClass = 0;
    return band;
  }
  if (b.shape == kCentres) {
    Band band(count(s, 2 * s, height), count(s, 2 * s, width), count(s, 2 * s, width), false);
    band.logNorm = k == 0 ? -1 : k == 1 ? 13 : 16 * k - 3;
    band.modelClass = 1 + std::min(k, 2);
    return band;
  }
  Band band(count(0, s, height), count(s, 2 * s, width), count(0, 2 * s, width), true);
  band.logNorm = k == 0 ? -4 : k == 1 ? 5 : 16 * k - 11;
  band.modelClass = 4 + std::min(k, 2);
  return band;
}

/// FORMAT 7, "Hints", for midpoints: from the centres of the same step.
uint32_t hintOfMidpoint(const Band& centres, int r, int a) {
  const uint32_t first = centres.get(r / 2, a).magnitude;
  const Coefficient second = r % 2 == 0 ? centres.get(r / 2 - 1, a) : centres.get(r / 2, a - 1);
  return 2 * (first + second.magnitude);
}

/// FORMAT 7, "Hints", for centres: from the midpoints of twice the step.
uint32_t hintOfCentre(const Band& midpoints, int r, int a) {
  const bool even = (a + r) % 2 == 0;
  const int upper = even ? (a + 1) / 2 : a / 2, lower = even ? a / 2 : (a + 1) / 2;
  return 2 * (midpoints.get(r, upper).magnitude + midpoints.get(r + 1, lower).magnitude);
}

Lattice makeLattice(int width, int height) {
  int d = 0;
  while (1 << d < std::max(width, height) - 1) ++d;
  Lattice lattice;
  lattice.places.push_back({kRoots, 1 << d});
  for (int k = d - 1; k >= 0; --k) {
    lattice.places.push_back({kCentres, 1 << k});
    lattice.places.push_back({kMidpoints, 1 << k});
  }
  for (size_t i = 0; i < lattice.places.size(); ++i) {
    Band band = makeBand(lattice.places[i], width, height);
    if (i >= 2) {
      const auto hintOf = lattice.places[i].shape == kCentres ? hintOfCentre : hintOfMidpoint;
      band.hint = [i, hintOf](const std::vector<Band>& bands, int r, int a) {
        return hintOf(bands[i - 1], r, a);
      };
    }
    lattice.bands.push_back(std::move(band));
  }
  return lattice;
}

int64_t floorDivide(int64_t a, int64_t b) {
  return a / b - (a % b < 0 ? 1 : 0);
}

/// Rounded half up.
int64_t divide(int64_t sum, int64_t count) {
  return floorDivide(2 * sum + count, 2 * count);
}

/// FORMAT 7.1: whether a neighbour counts; turns to the opposite one where it is void.
bool find(Grid& grid, int x, int y, Tap& tap) {
  Tap opposite = {-tap.dx, -tap.dy, tap.weight};
  for (Tap* t : {&tap, &opposite}) {
    if (!mirror(x, grid.width, t->dx) || !mirror(y, grid.height, t->dy)) return false;
    if (!grid.isValid(x + t->dx, y + t->dy)) continue;
    tap = *t;
    return true;
  }
  return false;
}

/// Sums over the neighbours that count, and over those of each weight alone, nearest first.
struct Weighted {
  int64_t sum = 0, weights = 0;
  std::array<int64_t, 4> ringSum = {}, ringCount = {};
};

Weighted sumNeighbours(Grid& grid, const std::vector<Tap>& taps, int x, int y) {
  Weighted result;
  for (Tap tap : taps) {
    if (!find(grid, x, y, tap)) continue;
    const int32_t value = grid.at(x + tap.dx, y + tap.dy);
    const int ring = tap.weight == 174 ? 0 : tap.weight == -27 ? 1 : tap.weight == 2 ? 2 : 3;
    result.sum += int64_t{tap.weight} * value;
    result.weights += tap.weight;
    result.ringSum[ring] += value;
    ++result.ringCount[ring];
  }
  return result;
}

int64_t predictionOf(const Weighted& around, bool voids) {
  if (voids && around.weights != 512) {
    for (int ring = 0; ring < 4; ++ring) {
      if (around.ringCount[ring] > 0) return divide(around.ringSum[ring], around.ringCount[ring]);
    }
    return 0;
  }
  return around.weights <= 0 ? 0 : divide(around.sum, around.weights);
}

/// FORMAT 7, "Inverse transform", for one band with its coefficients on the grid already.
void synthesise(Grid& grid, const LatticeBand& band) {
  const std::vector<Tap> taps = tapsOf(band);
  const int s = band.step, coarse = band.shape == kCentres ? 2 * s : s;
  for (int y = 0; y < grid.height; y += coarse) {
    for (int x = 0; x < grid.width; x += coarse) {
      if (band.shape == kMidpoints && (x / s + y / s) % 2 != 0) continue;
      if (!grid.isValid(x, y)) continue;
      const int64_t change = (sumNeighbours(grid, taps, x, y).sum + 512) >> 10;
      grid.at(x, y) = wrap(grid.at(x, y) - change);
    }
  }
  for (int r = 0; band.y(r) < grid.height; ++r) {
    const int y = band.y(r);
    for (int a = 0; band.x(r, a) < grid.width; ++a) {
      const int x = band.x(r, a);
      if (!grid.isValid(x, y)) continue;
      const int64_t guess = predictionOf(sumNeighbours(grid, taps, x, y), !grid.valid.empty());
      grid.at(x, y) = wrap(grid.at(x, y) + guess);
    }
  }
}

Grid reconstruct(const GeometryHeader& header, Lattice& lattice, std::vector<uint8_t> valid) {
  Grid grid{header.width, header.height, {}, std::move(valid)};
  grid.values.resize(static_cast<size_t>(header.width) * header.height);
  for (size_t i = 0; i < lattice.bands.size(); ++i) {
    Band& band = lattice.bands[i];
    for (int r = 0; r < band.rows; ++r) {
      for (int a = 0; a < band.columnsOf(r); ++a) {
        const int x = lattice.places[i].x(r, a), y = lattice.places[i].y(r);
        grid.at(x, y) = grid.isValid(x, y) ? band.at(r, a).value() : 0;
      }
    }
    if (i > 0) synthesise(grid, lattice.places[i]);
  }
  return grid;
}

/// FORMAT 7, "Samples": q of a value.
int32_t stepOf(const GeometryHeader& header, int32_t v) {
  const int f = header.fractionBits;
  return f == 0 ? v : wrap(v + (int64_t{1} << (f - 1))) >> f;
}

/// FORMAT 7, "Samples": the bits of one.
uint32_t sampleOf(const GeometryHeader& header, double sample) {
  constexpr double kLeast[] = {0, -128, 0, -32768, 0, -2147483648.0};
  constexpr double kLargest[] = {255, 127, 65535, 32767, 4294967295.0, 2147483647};
  if (header.sample == kF32) return std::bit_cast<uint32_t>(static_cast<float>(sample));
  const double clamped =
      std::clamp(std::round(sample), kLeast[header.sample], kLargest[header.sample]);
  return static_cast<uint32_t>(static_cast<int64_t>(clamped));
}

/// FORMAT 7.1, "Order": the word of a sample, and back (it is its own inverse).
uint32_t orderOf(const GeometryHeader& header, uint32_t bits) {
  return header.sample == kF32 && bits >> 31 ? bits ^ 0x7FFFFFFF : bits;
}

/// "Modulo 2^bits of the type": a word of 8 or 16 bits, with its sign.
uint32_t narrow(const GeometryHeader& header, uint32_t bits) {
  switch (header.sample) {
    case kU8:
      return static_cast<uint8_t>(bits);
    case kI8:
      return static_cast<uint32_t>(static_cast<int8_t>(bits));
    case kU16:
      return static_cast<uint16_t>(bits);
    case kI16:
      return static_cast<uint32_t>(static_cast<int16_t>(bits));
    default:
      return bits;
  }
}

/// FORMAT 7.1: hints of corrections of samples.
int openBits(const GeometryHeader& header, uint32_t bits) {
  const int spacing =
      header.sample == kF32 ? std::max(static_cast<int>(bits >> 23 & 255), 1) - 150 : 0;
  return std::clamp(std::ilogb(header.step) - spacing, 0, 31);
}

/// FORMAT 7.1: hints of corrections of steps.
std::vector<int> activity(Grid& significant) {
  std::vector<int> hints;
  for (int y = 0; y < significant.height; ++y) {
    for (int x = 0; x < significant.width; ++x) {
      int sum = significant.at(x, y);
      if (x > 0) sum += significant.at(x - 1, y);
      if (x + 1 < significant.width) sum += significant.at(x + 1, y);
      if (y > 0) sum += significant.at(x, y - 1);
      if (y + 1 < significant.height) sum += significant.at(x, y + 1);
      hints.push_back(sum);
    }
  }
  return hints;
}

Grid significanceOf(Lattice& lattice, const Grid& like) {
  Grid marks{like.width, like.height, std::vector<int32_t>(like.values.size())};
  for (size_t i = 0; i < lattice.places.size(); ++i) {
    Band& band = lattice.bands[i];
    for (int r = 0; r < band.rows; ++r) {
      for (int a = 0; a < band.columnsOf(r); ++a) {
        const int x = lattice.places[i].x(r, a), y = lattice.places[i].y(r);
        marks.at(x, y) = like.isValid(x, y) && band.at(r, a).value() != 0;
      }
    }
  }
  return marks;
}

void correctSteps(const GeometryHeader& header, const Layers& layers,
                  std::span<const uint8_t> codeword, Lattice& lattice, Grid& grid) {
  Grid marks = significanceOf(lattice, grid);
  const std::vector<uint32_t> corrections = decodeCorrections(codeword, grid, activity(marks));
  for (size_t i = 0; i < corrections.size(); ++i) {
    const uint32_t change = corrections[i] * (layers.correctionStep << header.fractionBits);
    grid.values[i] = static_cast<int32_t>(static_cast<uint32_t>(grid.values[i]) + change);
  }
}

std::vector<uint32_t> samplesOf(const GeometryHeader& header, const Grid& grid) {
  std::vector<uint32_t> samples;
  for (const int32_t v : grid.values) {
    samples.push_back(sampleOf(header, header.base + stepOf(header, v) * header.step));
  }
  return samples;
}

void correctSamples(const GeometryHeader& header, std::span<const uint8_t> codeword,
                    const Grid& grid, std::vector<uint32_t>& samples) {
  std::vector<int> hints;
  for (const uint32_t bits : samples) hints.push_back(openBits(header, bits));
  const std::vector<uint32_t> corrections = decodeCorrections(codeword, grid, hints);
  for (size_t i = 0; i < corrections.size(); ++i) {
    samples[i] = narrow(header, orderOf(header, orderOf(header, samples[i]) + corrections[i]));
  }
}

/// FORMAT 7.1, "Voids": voids get their value, and no other sample has it.
void putVoids(const GeometryHeader& header, const Layers& layers, const Grid& grid,
              std::vector<uint32_t>& samples) {
  constexpr uint32_t kQuietNan = 0x7FC00000;
  const uint32_t hole = layers.hasNodata ? sampleOf(header, layers.nodata) : kQuietNan;
  constexpr uint32_t kLargest[] = {255, 127, 65535, 32767, 0xFFFFFFFF, 0x7FFFFFFF, 0x7F7FFFFF};
  const auto equal = [&](uint32_t a, uint32_t b) {
    if (header.sample != kF32) return a == b;
    return std::bit_cast<float>(a) == std::bit_cast<float>(b);
  };
  const uint32_t besides =
      orderOf(header, orderOf(header, hole) + (hole == kLargest[header.sample] ? 0xFFFFFFFF : 1));
  for (size_t i = 0; i < samples.size(); ++i) {
    if (!grid.valid[i]) {
      samples[i] = hole;
    } else if (equal(samples[i], hole)) {
      samples[i] = besides;
    }
  }
}

/// Takes up to `count` bytes off the front.
std::span<const uint8_t> take(std::span<const uint8_t>& codeword, uint64_t count) {
  const auto taken = codeword.first(std::min<uint64_t>(count, codeword.size()));
  codeword = codeword.subspan(taken.size());
  return taken;
}

}  // namespace

std::vector<uint8_t> decodeHeights(const GeometryHeader& header, const Layers& layers,
                                   std::span<const uint8_t> codeword) {
  Lattice lattice = makeLattice(header.width, header.height);
  std::vector<uint8_t> valid;
  if (layers.validityBytes > 0) {
    const auto validity = take(codeword, layers.validityBytes);
    valid = decodeValidity(validity, header.width, header.height, lattice);
  }
  const auto coefficients =
      take(codeword, layers.corrections > 0 ? layers.coefficientBytes : UINT64_MAX);
  decodeTrack(coefficients, header.planes, lattice.bands);
  Grid grid = reconstruct(header, lattice, std::move(valid));
  if (layers.corrections == 1) correctSteps(header, layers, codeword, lattice, grid);
  std::vector<uint32_t> samples = samplesOf(header, grid);
  if (layers.corrections == 2) correctSamples(header, codeword, grid, samples);
  if (!grid.valid.empty()) putVoids(header, layers, grid, samples);
  std::vector<uint8_t> bytes;
  constexpr int kBytes[] = {1, 1, 2, 2, 4, 4, 4};
  for (const uint32_t sample : samples) {
    for (int i = 0; i < kBytes[header.sample]; ++i) {
      bytes.push_back(static_cast<uint8_t>(sample >> (8 * i)));
    }
  }
  return bytes;
}

}  // namespace tetrakis::reference
