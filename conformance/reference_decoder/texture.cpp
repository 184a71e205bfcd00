// SPDX-License-Identifier: Apache-2.0
// Reference decoder: texture (docs/FORMAT.md, section 9).
#include <algorithm>
#include <array>
#include <iterator>

#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/stream.hpp"
#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {
namespace {

/// FORMAT 9: the bands of all components.
std::vector<Band> bandsOfAll(const TextureHeader& header, const std::vector<Subband>& subbands) {
  std::vector<Band> all;
  for (int c = 0; c < header.components; ++c) {
    const bool alpha = header.components % 2 == 0 && c == header.components - 1;
    const int kind = alpha ? 2 : c == 0 ? 0 : 1;
    const size_t first = all.size();
    std::vector<Band> bands = bandsOf(header.wavelet, subbands, first);
    for (Band& band : bands) {
      band.logNorm += header.priority[c];
      band.modelClass += 5 * kind;
      if (c > 0) band.companion = all.size() - subbands.size();
      all.push_back(std::move(band));
    }
  }
  return all;
}

/// FORMAT 9, "Inverse component transform", at one texel.
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
  if (header.components >= 3) {
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

std::vector<uint8_t> decodeTexture(const TextureHeader& header, std::span<const uint8_t> codeword,
                                   int level) {
  if (header.planes == kDrawnPlanes) return decodeDrawn(header, codeword, level);
  const std::vector<Subband> subbands = subbandsOf(header.width, header.height);
  level = std::min(level, subbands.front().level);
  Plane seen{header.width, header.height, {}};  // its validity: where alpha is not 0
  if (header.alphaBytes > 0) {
    const auto mask = codeword.first(std::min<uint64_t>(header.alphaBytes, codeword.size()));
    seen.valid = decodeValidity(mask, header.width, header.height);
    codeword = codeword.subspan(mask.size());
  }
  std::vector<Band> bands = bandsOfAll(header, subbands);
  const auto bandsOfComponent = [&](int c) {
    return std::span(bands).subspan(c * subbands.size(), subbands.size());
  };
  for (int c = 0; c < header.components && header.hidden; ++c)
    markAbsent(subbands, seen, bandsOfComponent(c));
  dropFiner(subbands, level, bands);
  const bool complete = decodeTrack(codeword, header.planes, bands);
  const int f = fractionOf(header.wavelet, header.planes, complete);
  std::vector<Plane> planes;
  for (int c = 0; c < header.components; ++c) {
    Plane plane{header.width, header.height, {}};
    if (header.hidden) plane.valid = seen.valid;
    synthesise(header.wavelet, subbands, bandsOfComponent(c), {f, level}, plane);
    planes.push_back(levelOf(header.wavelet, subbands, level, plane));
  }
  const int columns = planes[0].width, rows = planes[0].height;
  std::vector<uint8_t> samples;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const bool there = seen.isValid(x << level, y << level);
      std::array<int32_t, 4> texel = {};
      for (size_t c = 0; c < planes.size() && (there || !header.hidden); ++c)
        texel[c] = planes[c].at(x, y);
      texel = finish(header, texel, f);
      if (header.alphaBytes > 0)
        texel[planes.size()] = !there ? 0 : header.sample == kU8 ? 255 : 65535;
      for (int c = 0; c < header.channels; ++c) {
        samples.push_back(static_cast<uint8_t>(texel[c]));
        if (header.sample == kU16) samples.push_back(static_cast<uint8_t>(texel[c] >> 8));
      }
    }
  }
  return samples;
}

}  // namespace tetrakis::reference
