// SPDX-License-Identifier: Apache-2.0
// Reference decoder: texture (docs/FORMAT.md, section 8).
#include <algorithm>
#include <array>

#include "conformance/reference_decoder/stream.hpp"
#include "conformance/reference_decoder/track.hpp"

namespace tetrakis::reference {
namespace {

enum Orientation { kLL, kHL, kLH, kHH };

/// What a level splits, and how often each side was split from level 1 down to it.
struct Level {
  int width, height, lowWidth, lowHeight, splitsX, splitsY;
};

/// FORMAT 8: "A side n > 4 splits into n - floor(n/2) low and floor(n/2) high samples".
int lowSide(int n) {
  return n > 4 ? n - n / 2 : n;
}

/// Level 1 comes first.
std::vector<Level> splitLevels(int width, int height) {
  std::vector<Level> levels;
  int splitsX = 0, splitsY = 0;
  while (width > 4 || height > 4) {
    splitsX += width > 4;
    splitsY += height > 4;
    levels.push_back({width, height, lowSide(width), lowSide(height), splitsX, splitsY});
    width = lowSide(width);
    height = lowSide(height);
  }
  return levels;
}

struct Place {
  int component, level;  ///< LL has the level that it was left over from
  Orientation orientation;
};

bool highInX(Orientation o) {
  return o == kHL || o == kHH;
}
bool highInY(Orientation o) {
  return o == kLH || o == kHH;
}

/// The decoder's idea of a texture track.
struct Subbands {
  std::vector<Level> levels;
  std::vector<Place> places;
  std::vector<Band> bands;

  size_t bandsPerComponent() const { return 1 + 3 * levels.size(); }
};

/// FORMAT 8, log_norm.
int logNormOf(const Place& place, const std::vector<Level>& levels, int priority) {
  constexpr int kLow[] = {0,   96,   217,  342,  469,  597,  725, 853,
                          981, 1109, 1237, 1365, 1493, 1621, 1749};
  constexpr int kHigh[] = {0,   -88, -11, 105,  228,  354,  482, 610,
                           738, 866, 994, 1122, 1250, 1378, 1506};
  int norm = 0;
  if (place.level > 0) {
    const Level& level = levels[place.level - 1];
    norm = (highInX(place.orientation) ? kHigh : kLow)[level.splitsX] +
           (highInY(place.orientation) ? kHigh : kLow)[level.splitsY];
  }
  const int m = place.orientation == kLL ? place.level : place.level - 1;
  norm -= 256 * ((m >= 3) + (m >= 4));
  return priority + ((norm + 8) >> 4);
}

/// FORMAT 8, "Model class".
int modelClassOf(const Place& place, int channels) {
  const bool alpha = channels % 2 == 0 && place.component == channels - 1;
  const int kind = alpha ? 2 : place.component == 0 ? 0 : 1;
  const int scale = std::clamp(place.level, 1, 3) - 1;
  return (kind * 3 + scale) * 4 + place.orientation;
}

Band makeBand(const Place& place, const Subbands& subbands, const TextureHeader& header) {
  int width = header.width, height = header.height;
  if (place.level > 0) {
    const Level& level = subbands.levels[place.level - 1];
    width = highInX(place.orientation) ? level.width - level.lowWidth : level.lowWidth;
    height = highInY(place.orientation) ? level.height - level.lowHeight : level.lowHeight;
  }
  Band band(height, width, width, false);
  band.logNorm = logNormOf(place, subbands.levels, header.priority[place.component]);
  band.modelClass = modelClassOf(place, header.channels);
  return band;
}

/// FORMAT 8, "Hint", for the band with number `index`.
uint32_t hintOf(const std::vector<Band>& bands, size_t index, size_t bandsPerComponent, int r,
                int a) {
  const size_t within = index % bandsPerComponent;
  uint32_t hint = 0;
  if (within >= 4) {
    const Band& parent = bands[index - 3];
    if (!parent.empty()) {
      const int row = std::min(r / 2, parent.rows - 1);
      hint += 2 * parent.get(row, std::min(a / 2, parent.columns[0] - 1)).magnitude;
    }
  }
  if (index >= bandsPerComponent) hint += 2 * bands[index - bandsPerComponent].get(r, a).magnitude;
  return hint;
}

Subbands makeSubbands(const TextureHeader& header) {
  Subbands subbands;
  subbands.levels = splitLevels(header.width, header.height);
  const int levels = static_cast<int>(subbands.levels.size());
  for (int c = 0; c < header.channels; ++c) {
    subbands.places.push_back({c, levels, kLL});
    for (int l = levels; l >= 1; --l) {
      for (const Orientation o : {kHL, kLH, kHH}) subbands.places.push_back({c, l, o});
    }
  }
  const size_t stride = subbands.bandsPerComponent();
  for (size_t i = 0; i < subbands.places.size(); ++i) {
    subbands.bands.push_back(makeBand(subbands.places[i], subbands, header));
    subbands.bands.back().hint = [i, stride](const std::vector<Band>& bands, int r, int a) {
      return hintOf(bands, i, stride, r, a);
    };
  }
  return subbands;
}

/// One component: rows of the image's width.
struct Plane {
  int width;
  std::vector<int32_t> values;

  int32_t& at(int x, int y) { return values[static_cast<size_t>(y) * width + x]; }
};

/// x[i], "mirrored about the first and the last sample (period 2n - 2)".
int32_t mirrored(const std::vector<int32_t>& x, int i) {
  const int n = static_cast<int>(x.size()), period = 2 * n - 2;
  i = (i % period + period) % period;
  return x[static_cast<size_t>(i < n ? i : period - i)];
}

/// FORMAT 8, "One signal of n samples": x holds the low part and the high part behind it.
void synthesise(std::vector<int32_t>& x) {
  const int n = static_cast<int>(x.size());
  const std::vector<int32_t> parts = x;
  for (int i = 0; i < n; ++i) {
    x[i] = parts[static_cast<size_t>(i % 2 == 0 ? i / 2 : n - n / 2 + i / 2)];
  }
  const auto lift = [&x](int i, std::array<int64_t, 3> weights) {
    int64_t sum = 0;
    for (int k = 0; k < 3; ++k) {
      const int reach = 2 * k + 1;
      sum += weights[k] * (int64_t{mirrored(x, i - reach)} + mirrored(x, i + reach));
    }
    return wrap(sum + 128) >> 8;
  };
  for (int i = 0; i < n; i += 2) {
    int32_t& even = x[i];
    even = wrap(int64_t{even} - lift(i, {78, -20, 6}));
  }
  for (int i = 1; i < n; i += 2) {
    int32_t& odd = x[i];
    odd = wrap(int64_t{odd} + lift(i, {147, -28, 9}));
  }
}

/// Reads `count` values from `first` on, `stride` apart, restores the signal, puts it back.
void synthesiseLine(Plane& plane, size_t first, size_t stride, int count) {
  std::vector<int32_t> line;
  for (int i = 0; i < count; ++i) {
    line.push_back(plane.values[first + i * stride]);
  }
  synthesise(line);
  for (size_t i = 0; i < line.size(); ++i) plane.values[first + i * stride] = line[i];
}

/// FORMAT 8, "Inverse wavelet", one level.
void synthesiseLevel(Plane& plane, const Level& level, int number) {
  if (number == 3 || number == 4) {
    for (int y = 0; y < level.lowHeight; ++y) {
      for (int x = 0; x < level.lowWidth; ++x) {
        plane.at(x, y) = wrap(int64_t{plane.at(x, y)} + 1) >> 1;
      }
    }
  }
  const auto width = plane.width;
  for (int x = 0; x < level.width && level.lowHeight < level.height; ++x) {
    synthesiseLine(plane, x, width, level.height);
  }
  for (int y = 0; y < level.height && level.lowWidth < level.width; ++y) {
    synthesiseLine(plane, static_cast<size_t>(y) * width, 1, level.width);
  }
}

Plane reconstruct(const TextureHeader& header, Subbands& subbands, int component, int f) {
  Plane plane{header.width, {}};
  plane.values.resize(static_cast<size_t>(header.width) * header.height);
  for (size_t i = 0; i < subbands.bands.size(); ++i) {
    const Place& place = subbands.places[i];
    if (place.component != component) continue;
    Level origin = {};
    if (place.orientation != kLL) origin = subbands.levels[place.level - 1];
    const int left = highInX(place.orientation) ? origin.lowWidth : 0;
    const int top = highInY(place.orientation) ? origin.lowHeight : 0;
    Band& band = subbands.bands[i];
    for (int r = 0; r < band.rows; ++r) {
      for (int a = 0; a < band.columns[0]; ++a) {
        plane.at(left + a, top + r) = wrap(int64_t{band.at(r, a).value()} << f);
      }
    }
  }
  for (size_t l = subbands.levels.size(); l >= 1; --l) {
    synthesiseLevel(plane, subbands.levels[l - 1], static_cast<int>(l));
  }
  return plane;
}

/// FORMAT 8, "Inverse component transform", at one texel.
void unshear(const std::array<int, 6>& h, std::array<int32_t, 4>& c) {
  const auto shear = [](int64_t h0, int64_t a, int64_t h1, int64_t b) {
    return wrap(h0 * a + h1 * b + 512) >> 10;
  };
  c[0] = wrap(int64_t{c[0]} - shear(h[4], c[1], h[5], c[2]));
  c[2] = wrap(int64_t{c[2]} - shear(h[2], c[1], h[3], c[0]));
  c[1] = wrap(int64_t{c[1]} - shear(h[0], c[2], h[1], c[0]));
}

/// The samples of one texel, by channel.
std::array<int32_t, 4> finish(const TextureHeader& header, std::array<int32_t, 4> planes, int f) {
  constexpr size_t kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                    {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  std::array<int32_t, 4> channels = planes;
  if (header.channels >= 3) {
    unshear(header.shear, planes);
    for (size_t i = 0; i < 3; ++i) {
      channels[kOrders[header.colourOrder][i]] = planes[i];
    }
  }
  const int32_t largest = header.sample == kU8 ? 255 : 65535;
  for (size_t i = 0; i < 4; ++i) {
    const int32_t rounded = f == 0 ? channels[i] : wrap(channels[i] + (int64_t{1} << (f - 1))) >> f;
    channels[i] = std::clamp(wrap(int64_t{rounded} + header.centre[i]), 0, largest);
  }
  return channels;
}

}  // namespace

std::vector<uint8_t> decodeTexture(const TextureHeader& header, std::span<const uint8_t> codeword) {
  Subbands subbands = makeSubbands(header);
  const bool complete = decodeTrack(codeword, header.planes, subbands.bands);
  const int f = complete ? 0 : header.sample == kU8 ? 4 : 1;
  std::vector<Plane> planes;
  for (int c = 0; c < header.channels; ++c) {
    planes.push_back(reconstruct(header, subbands, c, f));
  }
  std::vector<uint8_t> samples;
  for (size_t i = 0; i < planes[0].values.size(); ++i) {
    std::array<int32_t, 4> texel = {};
    for (size_t c = 0; c < planes.size(); ++c) texel[c] = planes[c].values[i];
    texel = finish(header, texel, f);
    for (size_t c = 0; c < planes.size(); ++c) {
      samples.push_back(static_cast<uint8_t>(texel[c]));
      if (header.sample == kU16) samples.push_back(static_cast<uint8_t>(texel[c] >> 8));
    }
  }
  return samples;
}

}  // namespace tetrakis::reference
