// SPDX-License-Identifier: Apache-2.0
// Reference decoder: heights and the layers beside their coefficients (docs/FORMAT.md, sections 8
// and 8.1).
#include <algorithm>
#include <utility>

#include "conformance/reference_decoder/frames.hpp"
#include "conformance/reference_decoder/height_corrections.hpp"
#include "conformance/reference_decoder/height_samples.hpp"
#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/reader.hpp"
#include "conformance/reference_decoder/regions.hpp"
#include "conformance/reference_decoder/stream.hpp"
#include "conformance/reference_decoder/surface.hpp"
#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {
namespace {

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

/// FORMAT 8.1.2, "Masks of regions": takes them off the tracks behind the first.
std::vector<std::span<const uint8_t>> takeMasks(std::span<std::span<const uint8_t>> coefficients) {
  std::vector<std::span<const uint8_t>> masks;
  for (std::span<const uint8_t>& codeword : coefficients) {
    Reader reader(codeword);
    const uint64_t bytes = reader.varint(0, UINT64_MAX);
    codeword = reader.outcome() == Outcome::kDone ? reader.rest() : codeword.first(0);
    masks.push_back(take(codeword, bytes));
  }
  return masks;
}

/// What is known of the samples before their coefficients.
struct Opening {
  Plane plane;                  ///< without values: which samples are valid, and the flat areas
  std::vector<uint8_t> lifted;  ///< what section 7 takes for valid samples; empty: all
};

Opening decodeOpening(const GeometryHeader& header, const Layers& layers, const FirstTrack& track) {
  const int width = header.width, height = header.height;
  Opening opening{{width, height, {}, {}}, {}};
  std::vector<uint8_t>&valid = opening.plane.valid, &lifted = opening.lifted;
  if (layers.lateMask) {
    if (layers.liftedBytes > 0) lifted = decodeValidity(track.lifted, width, height);
    valid = decodeLateValidity(track.validity, {width, height, {}, lifted});
  } else {
    if (layers.validityBytes > 0) valid = decodeValidity(track.validity, width, height);
    lifted = layers.bridge > 0 ? bridged(valid, width, height, layers.bridge) : valid;
  }
  if (layers.flatBytes > 0) {
    const Forest& forest = header.wavelet.domain.forest;
    std::vector<uint8_t> among = layers.lateMask ? lifted : valid;
    if (!forest.isGrid()) {
      among.resize(size_t(width) * size_t(height));
      for (size_t i = 0; i < among.size(); ++i) among[i] = forest.ownerOf(i) == i;
    }
    opening.plane.flat =
        decodeFlat(track.flat, {width, height, {}, among}, layers.flatAreas, forest);
  }
  return opening;
}

/// FORMAT 8.1, "Table of values"; empty: there is none, or it is not known.
std::vector<uint32_t> decodeTable(const Layers& layers, const FirstTrack& track) {
  if (layers.tableBytes == 0) return {};
  return decodeTables(track.table, {layers.tableValues}, 32)[0];
}

}  // namespace

std::vector<uint8_t> decodeHeights(const GeometryHeader& header, const Layers& layers,
                                   const Codewords& codewords, int level) {
  level = std::min(level, subbandsOf(header.width, header.height).front().level);
  if (header.frames.count > 0) return decodeHeightFrames(header, layers, codewords, level);
  const FirstTrack track = takeApart(layers, codewords.at(0));
  const auto regions = regionsOf(header.width, header.height, header.regions.log2,
                                 header.wavelet.domain.forest.patches());
  const auto behind = codewords.begin() + regions.size();
  std::vector<std::span<const uint8_t>> coefficients(codewords.begin(), behind);
  coefficients[0] = track.coefficients;
  Opening opening;
  if (layers.regionMasks) {
    const auto masks = takeMasks(std::span(coefficients).subspan(1));
    opening.lifted = decodeRegionMasks(track.validity, masks, regions);
    opening.plane = {header.width, header.height, {}, opening.lifted};
  } else {
    opening = decodeOpening(header, layers, track);
  }
  const bool stored = header.planes == kStoredPlanes && !header.drawn;
  if (stored) return decodeStored(header, layers, track.coefficients, opening.plane.valid, level);
  std::vector<std::span<const uint8_t>> corrections(behind, codewords.end());
  if (corrections.empty()) corrections.push_back(track.corrections);
  Surface surface =
      decodeSurface(header, opening.lifted, coefficients, std::move(opening.plane), level);
  const std::vector<uint32_t> table = decodeTable(layers, track);
  if (table.empty() && !layers.tableKnots.empty()) standIn(layers, surface);
  if (layers.corrections == 1 && level == 0) correctSteps(header, layers, corrections, surface);
  MadeSamples samples = samplesOf(header, table, surface);
  if (layers.corrections >= 2 && level == 0)
    correctSamples(header, layers, corrections, surface, samples);
  putVoids(header, layers, surface.plane, samples.bits);
  return bytesOf(header, samples.bits);
}

}  // namespace tetrakis::reference
