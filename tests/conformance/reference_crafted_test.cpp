// SPDX-License-Identifier: Apache-2.0
// The library against the reference decoder (agreement.hpp): streams that no encoder makes. Headers
// and payloads are damaged, and sound ones are joined that were not made for each other.
#include <utility>

#include "conformance/samples/header_parts.hpp"
#include "tests/conformance/agreement.hpp"

namespace tetrakis::test {
namespace {

/// A byte of the header says something else, and the rest is as sound as before.
TEST(Reference, AgreesOnDamagedGeoreferences) {
  const Raster surface = make({Pattern::kRidges, 4, 3, 1, TKS_I16, 3});
  const Raster picture = make({Pattern::kRidges, 2, 6, 1, TKS_U8, 4});
  tks_heights heights = surface.heights();
  tks_image image = picture.image();
  const double north_up[] = {399960, 30, 0, 5300040, 0, -30}, turned[] = {1, 3, 8, 0.5, 4, -6};
  std::copy_n(north_up, 6, heights.geotransform);
  heights.has_geotransform = image.has_geotransform = 1;
  heights.geo_keys = "1024=1";
  for (const bool shared : {false, true}) {
    std::copy_n(turned, 6, image.geotransform);
    if (shared)
      std::copy_n(std::begin({399960., 60., 0., 5300040., 0., -15.}), 6, image.geotransform);
    const Bytes stream = encodeGiven(&heights, &image, lossless());
    const size_t header = static_cast<size_t>(Stream(stream).info().header_bytes);
    for (size_t at = 8; at + 4 < header; ++at) {
      for (const int change : {1, 2, 4, 127, 128, 255}) {
        SCOPED_TRACE(std::to_string(at) + " changed by " + std::to_string(change));
        Bytes damaged = stream;
        damaged[at] ^= static_cast<uint8_t>(change);
        sealHeader(damaged);
        expectAgreement(damaged);
        if (HasFatalFailure()) return;
      }
    }
  }
}

/// Any value in any byte of the header.
void expectAgreementOnDamagedHeaders(const Bytes& good) {
  Stream stream(good);
  ASSERT_EQ(stream.status(), TKS_OK);
  for (size_t at = 0; at < stream.info().header_bytes; ++at) {
    for (const int value : {0, 1, 2, 3, 4, 5, 6, 7, 127, 128, 255, good[at] + 1, good[at] - 1}) {
      Bytes damaged = good;
      damaged[at] = static_cast<uint8_t>(value);
      sealHeader(damaged);
      SCOPED_TRACE("byte " + std::to_string(at) + " := " + std::to_string(value));
      expectAgreement(damaged);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

// Any value in any byte of the header, under a right checksum: both read the same samples from it,
// or both refuse for the same reason.
TEST(Reference, AgreesOnDamagedHeaders) {
  const Raster heights = make({Pattern::kRidges, 9, 7, 1, TKS_I16, 19});
  const Raster image = make({Pattern::kRidges, 6, 9, 3, TKS_U8, 20});
  tks_encode_options options = lossless();
  options.index = 1;
  expectAgreementOnDamagedHeaders(encode(&heights, &image, options));
  const Raster wide = make({Pattern::kRidges, 25, 7, 1, TKS_I16, 19});
  options.regions = 16;
  expectAgreementOnDamagedHeaders(encode(&wide, &image, options));
  Raster cut = make({Pattern::kRidges, 9, 6, 4, TKS_U8, 21});
  samples::cutOut(cut, samples::validity(samples::VoidShape::kCoast, 9, 6));
  expectAgreementOnDamagedHeaders(encode(nullptr, &cut, budget(300)));
}

/// Streams whose payload is damaged: any bytes are a codeword, so the samples have to agree.
TEST(Reference, AgreesOnDamagedPayloads) {
  const Raster heights = make({Pattern::kExtreme, 18, 11, 1, TKS_I16, 12});
  const Raster image = make({Pattern::kRidges, 10, 9, 4, TKS_U16, 13});
  const Bytes good = encode(&heights, &image, lossless());
  Stream stream(good);
  ASSERT_EQ(stream.status(), TKS_OK);
  const size_t start = stream.info().header_bytes;
  for (uint32_t trial = 0; trial < 300; ++trial) {
    Bytes damaged = good;
    for (uint32_t k = 0; k <= trial % 4; ++k) {
      const uint32_t h = samples::hash(trial, k, 14);
      damaged[start + h % (damaged.size() - start)] = static_cast<uint8_t>(h >> 24);
    }
    SCOPED_TRACE(trial);
    expectAgreement(damaged);
    if (HasFatalFailure()) return;
  }
}

constexpr size_t kFilters = 1;  // in a wavelet, behind the number of bit-planes

// A narrow range and a budget make the encoder work between the integers.
TEST(Reference, AgreesOnFractionsOfSteps) {
  constexpr std::pair<tks_sample, uint64_t> kBudgets[] = {{TKS_U8, 160}, {TKS_I8, 300}};
  for (const auto& [sample, bytes] : kBudgets) {
    const Raster heights = make({Pattern::kRidges, 40, 31, 1, sample, 7});
    SCOPED_TRACE(bytes);
    const Bytes stream = encode(&heights, nullptr, budget(bytes));
    ASSERT_GT(componentOfStream(stream).wavelet[kFractionByte], 0);
    expectAgreementOnPrefixes(stream);
  }
}

/// The stream of one component with other filters, fraction bits, sample bits and roundings than it
/// was made with. It decodes to something else, but to one thing.
Bytes withAnyWavelet(const Bytes& stream, uint32_t trial) {
  constexpr uint8_t kFractions[] = {0, 0, 1, 4, 8};
  constexpr uint8_t kSampleBits[] = {0, 16, 17, 20, 21, 32};
  constexpr uint64_t kRoundedBytes[] = {0, 50, 250, 1 << 20};
  const uint32_t h = samples::hash(trial, 0, 21);
  HeaderParts component = componentOfStream(stream);
  Bytes& fields = component.wavelet;
  fields.resize(kFilters);
  for (uint32_t i = 0; i < 3; ++i) fields.push_back(static_cast<uint8_t>((h >> (2 * i) & 7) % 5));
  fields.push_back(kFractions[(h >> 8) % 5]);
  fields.push_back(kSampleBits[(h >> 16) % 6]);
  if (fields[kFractionByte] == 0) {
    fields.push_back(static_cast<uint8_t>((h >> 20) % 5));
    putVarint(kRoundedBytes[h >> 30], fields);
  }
  return withComponent(stream, component);
}

TEST(Reference, AgreesOnAllWavelets) {
  const Raster heights = make({Pattern::kRidges, 37, 27, 1, TKS_F32, 22});
  const Raster image = make({Pattern::kRidges, 22, 37, 2, TKS_U8, 23});
  const Raster coast = withCoast(heights);
  const Bytes streams[] = {encode(&heights, nullptr, lossless()),
                           encode(&coast, nullptr, lossless()),
                           encode(nullptr, &image, lossless())};
  for (uint32_t trial = 0; trial < 90; ++trial) {
    SCOPED_TRACE(trial);
    expectAgreementOnPrefixes(withAnyWavelet(streams[trial % 3], trial), 3);
    if (HasFatalFailure()) return;
  }
}

// More than ten splits: the norms of further ones follow a rule.
TEST(Reference, AgreesOnManyLevels) {
  const Raster heights = make({Pattern::kRidges, 8192, 2, 1, TKS_I16, 24});
  const Bytes stream = encode(&heights, nullptr, budget(600));
  for (uint32_t trial = 0; trial < 4; ++trial) {
    SCOPED_TRACE(trial);
    expectAgreement(withAnyWavelet(stream, trial));
  }
}

/// The header of a stream of one component, made to announce `planes`, and one packet of
/// `codeword`.
Bytes withCodeword(const Bytes& stream, uint8_t planes, const Bytes& codeword) {
  HeaderParts component = componentOfStream(stream);
  component.wavelet[0] = planes;
  Bytes out = withComponent(stream, component);
  const size_t size = out.size();
  out.resize(Stream(out).info().header_bytes);
  putVarint(codeword.size() << 2, out);
  out.push_back(0);  // quality
  out.insert(out.end(), codeword.begin(), codeword.end());
  out.resize(std::min(out.size(), size));  // as far as payload_bytes
  return out;
}

/// `ones` bytes FF, which begin at the very end of the range and make coefficients as large as can
/// be, and behind them noise, or zeros.
Bytes codewordOf(size_t ones, size_t size, uint32_t seed, bool noise) {
  Bytes codeword(size, 255);
  for (size_t i = ones; i < size; ++i) {
    const uint32_t h = samples::hash(static_cast<uint32_t>(i), seed, 18);
    codeword[i] = static_cast<uint8_t>(noise ? h >> 24 : 0);
  }
  return codeword;
}

TEST(Reference, AgreesOnArbitraryCodewords) {
  const Raster heights = make({Pattern::kExtreme, 33, 13, 1, TKS_U16, 15});
  const Raster coast = withCoast(make({Pattern::kRidges, 35, 26, 1, TKS_F32, 17}));
  const Raster image = make({Pattern::kRidges, 24, 21, 3, TKS_U8, 16});
  Raster cut = make({Pattern::kExtreme, 17, 16, 4, TKS_U8, 18});
  samples::cutOut(cut, samples::validity(samples::VoidShape::kCoast, 17, 16));
  // Noise is stored where a stream is to be lossless, and drawn where a budget holds that.
  const Bytes streams[] = {encode(&heights, nullptr, budget(450)),
                           encode(&coast, nullptr, lossless()), encode(nullptr, &image, lossless()),
                           encode(nullptr, &cut, budget(600))};
  for (const Bytes& good : streams) {
    ASSERT_GT(good.size(), 400u);
    for (uint32_t trial = 0; trial < 120; ++trial) {
      const Bytes codeword = codewordOf(trial / 3, 300, trial, trial % 2 == 0);
      const Bytes stream = trial % 3 == 0 ? good : withAnyWavelet(good, trial);
      SCOPED_TRACE(trial);
      expectAgreement(withCodeword(stream, trial % 4 < 2 ? 30 : 12, codeword));
      if (HasFatalFailure()) return;
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
