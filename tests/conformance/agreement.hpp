// SPDX-License-Identifier: Apache-2.0
// The library against the reference decoder, which was written from docs/FORMAT.md alone: for every
// prefix of every stream, whole or damaged, both give the same bytes or both refuse.
#pragma once

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>

#include "conformance/reference_decoder.hpp"
#include "conformance/samples/header_seal.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/reference_status.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// The byte where two rasters part; their size if they do not.
inline size_t firstDifference(const std::optional<Bytes>& expected,
                              const std::vector<std::byte>& actual) {
  if (!expected) return 0;
  const auto same = [](uint8_t a, std::byte b) { return a == std::to_integer<uint8_t>(b); };
  return static_cast<size_t>(
      std::mismatch(expected->begin(), expected->end(), actual.begin(), actual.end(), same).first -
      expected->begin());
}

/// Both decoders on the same bytes.
inline void expectAgreement(Prefix prefix) {
  const tks_limits limits = smallLimits();
  const reference::Decoded decoded = reference::decode(prefix, limits.max_samples);
  Stream stream(prefix, &limits);
  ASSERT_EQ(stream.status(), statusOf(decoded.outcome)) << stream.message();
  if (stream.status() != TKS_OK) return;
  ASSERT_EQ(decoded.heights.has_value(), stream.info().has_heights != 0);
  ASSERT_EQ(decoded.texture.has_value(), stream.info().has_texture != 0);
  const std::vector<std::byte> heights = stream.heights(), texture = stream.texture();
  ASSERT_EQ(decoded.heights ? decoded.heights->size() : 0, heights.size());
  ASSERT_EQ(decoded.texture ? decoded.texture->size() : 0, texture.size());
  ASSERT_EQ(firstDifference(decoded.heights, heights), heights.size()) << "heights";
  ASSERT_EQ(firstDifference(decoded.texture, texture), texture.size()) << "texture";
}

inline void expectAgreementOnPrefixes(const Bytes& stream, size_t most = 24) {
  const size_t stride = std::max<size_t>(1, stream.size() / most);
  for (size_t n = 0; n <= stream.size(); n += stride) {
    SCOPED_TRACE("prefix of " + std::to_string(n) + " of " + std::to_string(stream.size()));
    expectAgreement(Prefix(stream).first(n));
    if (::testing::Test::HasFatalFailure()) return;
  }
  expectAgreement(stream);
}

/// Encodes both ways and compares prefixes.
inline void expectAgreementOn(const Raster* heights, const Raster* image, uint64_t bytes = 0) {
  const Bytes stream = encode(heights, image, bytes == 0 ? lossless() : budget(bytes));
  ASSERT_FALSE(stream.empty());
  expectAgreementOnPrefixes(stream);
}

inline std::string nameOf(const samples::Recipe& r) {
  return std::to_string(r.width) + "x" + std::to_string(r.height) + " pattern " +
         std::to_string(static_cast<int>(r.pattern)) + " type " + std::to_string(r.sample) +
         " channels " + std::to_string(r.channels);
}

inline constexpr Pattern kPatterns[] = {Pattern::kFlat,  Pattern::kRamp,    Pattern::kRidges,
                                        Pattern::kSteps, Pattern::kChecker, Pattern::kExtreme};

/// Encodes with a target of the caller's and voids, whole and damaged, and compares prefixes.
inline void expectAgreementOnLayers(const tks_heights& heights, const tks_encode_options& options) {
  const Bytes stream = encodeHeights(heights, options);
  expectAgreementOnPrefixes(stream, 16);
  const size_t header = static_cast<size_t>(Stream(stream).info().header_bytes);
  for (size_t i = 0; i < 8; ++i) {
    Bytes damaged = stream;
    const size_t at = i < 4 ? 12 + 9 * i : header + samples::hash(uint32_t(i), 0, 1) % 200;
    if (at >= damaged.size()) continue;
    damaged[at] ^= static_cast<uint8_t>(1 << (i % 8));
    sealHeader(damaged);
    expectAgreement(damaged);
  }
}

/// Floats with voids.
inline Raster withCoast(Raster heights) {
  constexpr uint32_t kQuietNan = 0x7fc00000;
  const auto valid = samples::validity(samples::VoidShape::kCoast, heights.width, heights.height);
  for (size_t i = 0; i < valid.size(); ++i) {
    if (!valid[i]) std::memcpy(heights.data.data() + 4 * i, &kQuietNan, sizeof kQuietNan);
  }
  return heights;
}

}  // namespace tetrakis::test
