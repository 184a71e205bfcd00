// SPDX-License-Identifier: Apache-2.0
// Reference decoder: texture (docs/FORMAT.md, section 9).
#include <algorithm>
#include <array>

#include "conformance/reference_decoder/frames.hpp"
#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/regions.hpp"
#include "conformance/reference_decoder/stream.hpp"
#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {
namespace {

/// FORMAT 9: the bands of all colour planes in one track.
std::vector<Band> bandsOfAll(const TextureHeader& header, const std::vector<Part>& parts) {
  std::vector<Band> all;
  for (int c = 0; c < header.colourPlanes; ++c) {
    const bool alpha =
        !header.opaque && header.colourPlanes % 2 == 0 && c == header.colourPlanes - 1;
    const int kind = alpha ? 2 : c == 0 ? 0 : 1;
    const size_t first = all.size();
    std::vector<Band> bands = bandsOf(header.wavelet, parts, first);
    for (size_t i = 0; i < parts.size(); ++i) {
      Band& band = bands[i];
      const Subband& subband = parts[i].subband;
      band.logNorm += header.priority[c];
      if (band.leastKey) band.leastKey = header.priority[c];
      const auto& weights = header.bandPriority[c];
      if (subband.orientation != kLL && subband.level <= static_cast<int>(weights.size()))
        band.logNorm += weights[subband.level - 1][subband.orientation == kHH];
      band.modelClass += 5 * kind;
      if (c > 0) band.companion = all.size() - parts.size();
      all.push_back(std::move(band));
    }
  }
  return all;
}

/// FORMAT 9, "Inverse colour transform", at one place. Sums of samples wrap at 32 bits.
enum class Sums { kOfSamples, kOfCoefficients };

void unshear(const std::array<int, 6>& h, Sums sums, std::array<int32_t*, 3> c) {
  const auto shear = [&](int64_t h0, int64_t a, int64_t h1, int64_t b) {
    const int64_t sum = h0 * a + h1 * b + 64;
    return (sums == Sums::kOfSamples ? wrap(sum) : sum) >> 7;
  };
  *c[0] = wrap(*c[0] - shear(h[4], *c[1], h[5], *c[2]));
  *c[2] = wrap(*c[2] - shear(h[2], *c[1], h[3], *c[0]));
  *c[1] = wrap(*c[1] - shear(h[0], *c[2], h[1], *c[0]));
}

/// FORMAT 9, "Levels": before the inverse wavelet.
void unshearLevels(const TextureHeader& header, const std::vector<Part>& parts,
                   std::vector<Plane>& planes) {
  for (const Part& part : parts) {
    if (header.shears.size() < 2 || part.subband.level < 2) continue;
    const size_t set = std::min<size_t>(part.subband.level - 1, header.shears.size() - 1);
    for (int r = 0; r < part.rows; ++r) {
      for (int a = 0; a < part.columns; ++a) {
        const int x = part.x(a), y = part.y(r);
        unshear(header.shears[set], Sums::kOfCoefficients,
                {&planes[0].at(x, y), &planes[1].at(x, y), &planes[2].at(x, y)});
      }
    }
  }
}

/// FORMAT 9, "Tables": what lies at place v, in units of 2^-f.
int32_t valueAt(const std::vector<uint32_t>& table, int64_t v, int f, int32_t largest) {
  const auto value = [&](size_t i) { return static_cast<int32_t>(table[i]) & largest; };
  const int64_t place = std::clamp<int64_t>(v, 0, static_cast<int64_t>(table.size() - 1) << f);
  const auto i = static_cast<size_t>(place >> f);
  const auto part = static_cast<int32_t>(place - (static_cast<int64_t>(i) << f));
  if (part == 0) return value(i);
  return value(i) + (((value(i + 1) - value(i)) * part + (1 << (f - 1))) >> f);
}

/// The samples of one texel, by channel.
std::array<int32_t, 4> finish(const TextureHeader& header, std::array<int32_t, 4> planes, int f) {
  constexpr size_t kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                    {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  if (header.opaque) {
    int64_t sum = 64;
    for (size_t i = 0; i < 3; ++i) sum += int64_t{header.furtherShears[i]} * planes[i];
    int32_t& last = planes[static_cast<size_t>(header.channels) - 1];
    last = wrap(last - (wrap(sum) >> 7));
  }
  std::array<int32_t, 4> channels = planes;
  if (header.colourPlanes >= 3) {
    unshear(header.shears[0], Sums::kOfSamples, {&planes[0], &planes[1], &planes[2]});
    for (size_t i = 0; i < 3; ++i) {
      channels[kOrders[header.colourOrder][i]] = planes[i];
    }
  }
  const int32_t largest = header.sample == kU8 ? 255 : 65535;
  for (size_t i = 0; i < 4; ++i) {
    if (i < header.tables.size() && !header.tables[i].empty()) {
      const int64_t v = channels[i] + (int64_t{header.centre[i]} << f);
      channels[i] = valueAt(header.tables[i], v, f, largest);
      continue;
    }
    const int32_t rounded = f == 0 ? channels[i] : wrap(channels[i] + (int64_t{1} << (f - 1))) >> f;
    channels[i] = std::clamp(wrap(int64_t{rounded} + header.centre[i]), 0, largest);
  }
  return channels;
}

/// FORMAT 9.3.
std::vector<uint8_t> decodeStored(const TextureHeader& header, std::span<const uint8_t> bytes,
                                  int level) {
  const size_t count = static_cast<size_t>(header.width) * header.height * header.channels;
  const int width = header.sample == kU8 ? 1 : 2;
  std::vector<uint8_t> out;
  for (size_t i = 0; i < count; ++i) {
    const auto texel = static_cast<int>(i / header.channels);
    if (!header.wavelet.domain.forest.shows(level, texel % header.width, texel / header.width))
      continue;
    int value = (header.white + 1) / 2;
    if (i < bytes.size() && width == 1) value = bytes[i];
    if (i < bytes.size() && width == 2)
      value = bytes[i] << 8 | (i + count < bytes.size() ? bytes[i + count] : 0x80);
    if (width == 2) out.push_back(static_cast<uint8_t>(value & 255));
    out.push_back(static_cast<uint8_t>(value >> (width == 2 ? 8 : 0)));
  }
  return out;
}

/// The bands of all colour planes in a track, as they stand before it is decoded.
std::vector<Band> bandsBefore(const TextureHeader& header, const std::vector<Part>& parts,
                              const Plane& lifted, const PriorityMap& priorities, int level) {
  std::vector<Band> bands = bandsOfAll(header, parts);
  for (int c = 0; c < header.colourPlanes; ++c) {
    const auto own = std::span(bands).subspan(c * parts.size(), parts.size());
    markAbsent(header.wavelet.domain.forest, parts, lifted, own);
    setPriorities(parts, priorities, own);
    dropFiner(parts, level, own);
  }
  return bands;
}

/// What comes before the coefficients, and what follows from it (FORMAT 9, 9.2, "Bridges").
struct Opening {
  Plane seen;    ///< its validity: where alpha is not 0
  Plane coded;   ///< its validity: where coefficients count
  Plane lifted;  ///< its validity: what section 7 takes for valid
  std::vector<std::optional<std::array<int, 4>>> overlay;  ///< of each texel; empty: there is none
};

/// Takes it off the first track.
Opening takeOpening(const TextureHeader& header, std::span<const uint8_t>& codeword) {
  const Plane plane{header.width, header.height, {}};
  Opening opening{plane, plane, plane, {}};
  if (header.alphaBytes > 0)
    opening.seen.valid =
        decodeValidity(take(codeword, header.alphaBytes), header.width, header.height);
  std::vector<uint8_t>& coded = opening.coded.valid;
  if (header.hidden) coded = opening.seen.valid;
  if (header.overlayBytes > 0) {
    opening.overlay = decodeOverlay(header, take(codeword, header.overlayBytes));
    coded.resize(opening.overlay.size(), 1);
    for (size_t i = 0; i < coded.size(); ++i) coded[i] &= !opening.overlay[i];
  }
  opening.lifted.valid =
      header.bridge == 0 ? coded : bridged(coded, header.width, header.height, header.bridge);
  return opening;
}

/// The tracks of the coefficients, decoded.
struct Tracks {
  std::vector<std::vector<Part>> parts;
  std::vector<std::vector<Band>> bands;  ///< of each track those of plane 0, then plane 1, …
};

Tracks decodeTracks(const TextureHeader& header,
                    const std::vector<std::span<const uint8_t>>& coefficients, const Plane& lifted,
                    int level) {
  const PriorityMap priorities = priorityMapOf(header.priorities, header.width, header.height);
  Tracks tracks{partsOf(header.wavelet.domain.forest, header.width, header.height, header.regions),
                {}};
  for (const std::vector<Part>& parts : tracks.parts) {
    const std::span<const uint8_t> codeword = coefficients[tracks.bands.size()];
    tracks.bands.push_back(bandsBefore(header, parts, lifted, priorities, level));
    decodeTrack(codeword, header.planes, tracks.bands.back());
  }
  return tracks;
}

/// The colour planes of a level, in units of 2^-f.
std::vector<Plane> planesOf(const TextureHeader& header, const Tracks& tracks, const Plane& lifted,
                            int f, int level) {
  std::vector<Plane> planes(header.colourPlanes, lifted);
  for (int c = 0; c < header.colourPlanes; ++c) {
    planes[c].values.resize(static_cast<size_t>(header.width) * header.height);
    for (size_t i = 0; i < tracks.parts.size(); ++i) {
      const std::vector<Part>& parts = tracks.parts[i];
      place(std::span(tracks.bands[i]).subspan(c * parts.size(), parts.size()), parts,
            f - header.wavelet.fractionBits, planes[c]);
    }
  }
  for (const std::vector<Part>& parts : tracks.parts) unshearLevels(header, parts, planes);
  for (Plane& plane : planes) {
    synthesise(header.wavelet, level, plane);
    plane = levelOf(header.wavelet, level, plane);
  }
  return planes;
}

/// The texel at a place of the whole image, out of the values of its colour planes.
std::array<int32_t, 4> texelAt(const TextureHeader& header, const Opening& opening, int x, int y,
                               std::array<int32_t, 4> values, int f) {
  std::array<int32_t, 4> texel =
      finish(header, opening.coded.isValid(x, y) ? values : std::array<int32_t, 4>{}, f);
  if (header.alphaBytes > 0)
    texel[header.colourPlanes] = !opening.seen.isValid(x, y) ? 0
                                 : header.sample == kU8      ? 255
                                                             : 65535;
  if (opening.overlay.empty()) return texel;
  return opening.overlay[opening.seen.index(x, y)].value_or(texel);
}

void append(const TextureHeader& header, const std::array<int32_t, 4>& texel,
            std::vector<uint8_t>& samples) {
  for (int c = 0; c < header.channels; ++c) {
    samples.push_back(static_cast<uint8_t>(texel[c]));
    if (header.sample == kU16) samples.push_back(static_cast<uint8_t>(texel[c] >> 8));
  }
}

FramePlanes textureFrames(const TextureHeader& header,
                          const std::vector<std::span<const uint8_t>>& coefficients, int level) {
  const FrameLayout layout{
      header.wavelet,
      header.regions,
      header.frames,
      header.planes,
      {header.priority.begin(), header.priority.begin() + header.colourPlanes}};
  return decodeFrames(layout, {header.width, header.height, {}, {}}, coefficients, level);
}

/// FORMAT 9.4: all frames, one behind the other.
std::vector<uint8_t> decodeTextureFrames(const TextureHeader& header,
                                         const std::vector<std::span<const uint8_t>>& coefficients,
                                         int level) {
  const auto colours = static_cast<size_t>(header.colourPlanes);
  const FramePlanes frames = textureFrames(header, coefficients, level);
  std::vector<uint8_t> samples;
  for (size_t first = 0; first < frames.planes.size(); first += colours) {
    for (size_t i = 0; i < frames.planes[first].values.size(); ++i) {
      std::array<int32_t, 4> values = {};
      for (size_t c = 0; c < colours; ++c) values[c] = frames.planes[first + c].values[i];
      append(header, finish(header, values, frames.f), samples);
    }
  }
  return samples;
}

}  // namespace

ReferencePlanes lastTexels(const TextureHeader& header, const Codewords& codewords) {
  const FramePlanes frames = textureFrames(header, {codewords.begin(), codewords.end()}, 0);
  const auto colours = static_cast<size_t>(header.colourPlanes);
  ReferencePlanes last;
  for (size_t p = frames.planes.size() - colours; p < frames.planes.size(); ++p)
    last.push_back(wholeSteps(frames.planes[p], frames.f));
  return last;
}

std::vector<uint8_t> decodeTexture(const TextureHeader& header, const Codewords& codewords,
                                   int level) {
  std::vector<std::span<const uint8_t>> coefficients(codewords.begin(), codewords.end());
  if (header.planes == kDrawnPlanes && !header.stored)
    return decodeDrawn(header, coefficients[0], level);
  const Forest& forest = header.wavelet.domain.forest;
  level = std::min(level, subbandsOf(header.width, header.height).front().level);
  if (header.stored) return decodeStored(header, coefficients[0], level);
  if (header.frames.count > 0) return decodeTextureFrames(header, coefficients, level);
  const Opening opening = takeOpening(header, coefficients[0]);
  const Tracks tracks = decodeTracks(header, coefficients, opening.lifted, level);
  const int f = fractionOf(header.wavelet, header.planes, bytesOf(coefficients), level);
  std::vector<Plane> planes = planesOf(header, tracks, opening.lifted, f, level);
  std::vector<uint8_t> samples;
  size_t i = 0;
  for (int y = 0; y < header.height; ++y) {
    for (int x = 0; x < header.width; ++x) {
      if (!forest.shows(level, x, y)) continue;
      std::array<int32_t, 4> values = {};
      for (size_t c = 0; c < planes.size(); ++c) values[c] = planes[c].values[i];
      append(header, texelAt(header, opening, x, y, values, f), samples);
      ++i;
    }
  }
  return samples;
}

}  // namespace tetrakis::reference
