// SPDX-License-Identifier: Apache-2.0
// Reference decoder: heights on the 4-8 lattice (docs/FORMAT.md, section 7).
#include <algorithm>
#include <bit>
#include <cmath>

#include "conformance/reference_decoder/stream.hpp"
#include "conformance/reference_decoder/track.hpp"

namespace tetrakis::reference {
namespace {

enum Shape { kRoots, kCentres, kMidpoints };

/// One band of the lattice: which vertices of the grid its coefficients belong to.
struct LatticeBand {
  Shape shape;
  int step;  ///< s; for roots 2^d

  int x(int r, int a) const {
    if (shape == kRoots) return step * a;
    return shape == kMidpoints && r % 2 == 1 ? 2 * step * a : step * (2 * a + 1);
  }
  int y(int r) const { return shape == kCentres ? step * (2 * r + 1) : step * r; }
};

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

/// The bands of a track, each with its place on the lattice.
struct Lattice {
  std::vector<LatticeBand> places;
  std::vector<Band> bands;
};

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

struct Tap {
  int dx, dy, weight;
};

/// FORMAT 7: "24 neighbours and weights", as offsets on the grid.
std::vector<Tap> tapsOf(const LatticeBand& band) {
  constexpr Tap kQuarter[] = {{1, 0, 174}, {2, 1, -27}, {1, 2, -27},
                              {3, 0, 2},   {3, 2, 3},   {2, 3, 3}};
  std::vector<Tap> taps;
  for (Tap tap : kQuarter) {
    if (band.shape == kCentres) tap = {tap.dx - tap.dy, tap.dx + tap.dy, tap.weight};
    for (int turn = 0; turn < 4; ++turn) {
      taps.push_back({band.step * tap.dx, band.step * tap.dy, tap.weight});
      tap = {-tap.dy, tap.dx, tap.weight};
    }
  }
  return taps;
}

struct Grid {
  int width, height;
  std::vector<int32_t> values;

  int32_t& at(int x, int y) { return values[static_cast<size_t>(y) * width + x]; }
};

/// FORMAT 7, "Boundary", on one axis: mirrors `offset` if it leads outside; false: left out.
bool mirror(int position, int size, int& offset) {
  const auto inside = [&](int o) { return position + o >= 0 && position + o < size; };
  if (!inside(offset)) offset = -offset;
  return inside(offset);
}

struct Weighted {
  int64_t sum = 0, weights = 0;
};

Weighted sumNeighbours(Grid& grid, const std::vector<Tap>& taps, int x, int y) {
  Weighted result;
  for (Tap tap : taps) {
    if (!mirror(x, grid.width, tap.dx) || !mirror(y, grid.height, tap.dy)) continue;
    result.sum += int64_t{tap.weight} * grid.at(x + tap.dx, y + tap.dy);
    result.weights += tap.weight;
  }
  return result;
}

int64_t floorDivide(int64_t a, int64_t b) {
  return a / b - (a % b < 0 ? 1 : 0);
}

/// FORMAT 7, "Inverse transform", for one band with its coefficients on the grid already.
void synthesise(Grid& grid, const LatticeBand& band) {
  const std::vector<Tap> taps = tapsOf(band);
  const int s = band.step, coarse = band.shape == kCentres ? 2 * s : s;
  for (int y = 0; y < grid.height; y += coarse) {
    for (int x = 0; x < grid.width; x += coarse) {
      if (band.shape == kMidpoints && (x / s + y / s) % 2 != 0) continue;
      const int64_t change = (sumNeighbours(grid, taps, x, y).sum + 512) >> 10;
      grid.at(x, y) = wrap(grid.at(x, y) - change);
    }
  }
  for (int r = 0; band.y(r) < grid.height; ++r) {
    const int y = band.y(r);
    for (int a = 0; band.x(r, a) < grid.width; ++a) {
      const int x = band.x(r, a);
      const auto [sum, weights] = sumNeighbours(grid, taps, x, y);
      const int64_t guess = weights <= 0 ? 0 : floorDivide(2 * sum + weights, 2 * weights);
      grid.at(x, y) = wrap(grid.at(x, y) + guess);
    }
  }
}

Grid reconstruct(const GeometryHeader& header, Lattice& lattice) {
  Grid grid{header.width, header.height, {}};
  grid.values.resize(static_cast<size_t>(header.width) * header.height);
  for (size_t i = 0; i < lattice.bands.size(); ++i) {
    Band& band = lattice.bands[i];
    for (int r = 0; r < band.rows; ++r) {
      for (int a = 0; a < band.columnsOf(r); ++a) {
        grid.at(lattice.places[i].x(r, a), lattice.places[i].y(r)) = band.at(r, a).value();
      }
    }
    if (i > 0) synthesise(grid, lattice.places[i]);
  }
  return grid;
}

/// FORMAT 7, "Samples": the bits of one.
uint32_t sampleOf(const GeometryHeader& header, int32_t v) {
  constexpr double kLeast[] = {0, -128, 0, -32768, 0, -2147483648.0};
  constexpr double kLargest[] = {255, 127, 65535, 32767, 4294967295.0, 2147483647};
  const int f = header.fractionBits;
  const int32_t q = f == 0 ? v : wrap(v + (int64_t{1} << (f - 1))) >> f;
  const double sample = header.base + q * header.step;
  if (header.sample == kF32) return std::bit_cast<uint32_t>(static_cast<float>(sample));
  const double clamped =
      std::clamp(std::round(sample), kLeast[header.sample], kLargest[header.sample]);
  return static_cast<uint32_t>(static_cast<int64_t>(clamped));
}

}  // namespace

std::vector<uint8_t> decodeHeights(const GeometryHeader& header,
                                   std::span<const uint8_t> codeword) {
  Lattice lattice = makeLattice(header.width, header.height);
  decodeTrack(codeword, header.planes, lattice.bands);
  const Grid grid = reconstruct(header, lattice);
  std::vector<uint8_t> samples;
  constexpr int kBytes[] = {1, 1, 2, 2, 4, 4, 4};
  for (const int32_t v : grid.values) {
    const uint32_t sample = sampleOf(header, v);
    for (int i = 0; i < kBytes[header.sample]; ++i) {
      samples.push_back(static_cast<uint8_t>(sample >> (8 * i)));
    }
  }
  return samples;
}

}  // namespace tetrakis::reference
