// SPDX-License-Identifier: Apache-2.0
// Shared by the stream tests: encode sample rasters, decode prefixes, measure errors.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "conformance/samples/terrain_samples.hpp"
#include "tests/support/same_bytes.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::test {

using Bytes = std::vector<uint8_t>;
using Prefix = std::span<const uint8_t>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline samples::Raster photograph() {
  return samples::make({samples::Pattern::kRidges, 192, 160, 3, TKS_U8, 7});
}

inline tks_encode_options lossless() {
  tks_encode_options options = {};
  options.size = sizeof options;
  options.lossless = 1;
  return options;
}

inline tks_encode_options budget(uint64_t bytes) {
  tks_encode_options options = {};
  options.size = sizeof options;
  options.bytes = bytes;
  return options;
}

inline tks_encode_options within(double error) {
  tks_encode_options options = {};
  options.size = sizeof options;
  options.max_error = error;
  return options;
}

inline tks_encode_options inRegions(tks_encode_options options, uint32_t side = 16) {
  options.regions = side;
  return options;
}

/// Sizes that a small decode may need, so that a damaged header cannot ask for gigabytes.
inline tks_limits smallLimits() {
  tks_limits limits = {};
  limits.size = sizeof limits;
  limits.max_samples = limits.max_texels = 1 << 14;
  limits.max_memory = 64 << 20;
  return limits;
}

/// The stream; a failed expectation and no bytes if there is none. Null leaves a track out.
inline Bytes encodeGiven(const tks_heights* heights, const tks_image* image,
                         const tks_encode_options& options) {
  tks_buffer buffer = {};
  char message[256] = "";
  const tks_status status = tks_encode(heights, image, &options, &buffer, message, sizeof message);
  EXPECT_EQ(status, TKS_OK) << message;
  Bytes bytes;
  if (status == TKS_OK) bytes.assign(buffer.data, buffer.data + buffer.size);
  tks_free_buffer(&buffer);
  return bytes;
}

/// Of heights that say more than their samples: voids, a spacing, a unit.
inline Bytes encodeHeights(const tks_heights& heights, const tks_encode_options& options) {
  return encodeGiven(&heights, nullptr, options);
}

inline Bytes encode(const samples::Raster* heights, const samples::Raster* image,
                    const tks_encode_options& options) {
  const tks_heights h = heights ? heights->heights() : tks_heights{};
  const tks_image i = image ? image->image() : tks_image{};
  return encodeGiven(heights ? &h : nullptr, image ? &i : nullptr, options);
}

/// One open decoder; closes it.
class Stream {
 public:
  explicit Stream(Prefix bytes, const tks_limits* limits = nullptr) {
    char message[256] = "";
    status_ = tks_open(bytes.data(), bytes.size(), limits, &decoder_, message, sizeof message);
    message_ = message;
    info_.size = sizeof info_;
    if (status_ == TKS_OK) status_ = tks_get_info(decoder_, &info_);
  }
  /// Keeps bytes that nobody else keeps.
  explicit Stream(Bytes&& bytes, const tks_limits* limits = nullptr)
      : Stream(Prefix(bytes), limits) {
    kept_ = std::move(bytes);
  }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() {
    if (decoder_) tks_close(decoder_);
  }

  tks_status status() const { return status_; }
  const std::string& message() const { return message_; }
  const tks_info& info() const { return info_; }
  tks_decoder* get() const { return decoder_; }
  /// To be called once more bytes came: a sketch gives way to a stream of other sizes.
  void lookAgain() { EXPECT_EQ(tks_get_info(decoder_, &info_), TKS_OK); }

  size_t heightsBytes() const {
    return size_t{info_.width} * info_.height * tks_sample_bytes(info_.sample);
  }
  size_t textureBytes() const {
    return size_t{info_.texture_width} * info_.texture_height * info_.texture_channels *
           tks_sample_bytes(info_.texture_sample);
  }
  std::vector<std::byte> heights() {
    std::vector<std::byte> out(info_.has_heights ? heightsBytes() : 0);
    if (info_.has_heights) {
      EXPECT_EQ(tks_decode_heights(decoder_, out.data(), out.size()), TKS_OK)
          << tks_message(decoder_);
    }
    return out;
  }
  /// Which heights are valid.
  std::vector<uint8_t> validity() {
    std::vector<uint8_t> out(size_t{info_.width} * info_.height, 9);  // no byte may stay 9
    EXPECT_EQ(tks_decode_validity(decoder_, out.data(), out.size()), TKS_OK)
        << tks_message(decoder_);
    return out;
  }
  std::vector<std::byte> texture() {
    std::vector<std::byte> out(info_.has_texture ? textureBytes() : 0);
    if (info_.has_texture) {
      EXPECT_EQ(tks_decode_texture(decoder_, out.data(), out.size()), TKS_OK)
          << tks_message(decoder_);
    }
    return out;
  }

 private:
  Bytes kept_;
  tks_decoder* decoder_ = nullptr;
  tks_status status_ = TKS_OK;
  tks_info info_ = {};
  std::string message_;
};

inline double sampleAt(const std::vector<std::byte>& data, tks_sample sample, size_t index) {
  const auto read = [&]<class T>(T value) {
    std::memcpy(&value, data.data() + index * sizeof value, sizeof value);
    return static_cast<double>(value);
  };
  switch (sample) {
    case TKS_U8:
      return read(uint8_t{});
    case TKS_I8:
      return read(int8_t{});
    case TKS_U16:
      return read(uint16_t{});
    case TKS_I16:
      return read(int16_t{});
    case TKS_U32:
      return read(uint32_t{});
    case TKS_I32:
      return read(int32_t{});
    case TKS_F32:
      return read(float{});
  }
  return 0;
}

/// Sum of the squared differences from the raster, in sample units.
inline double squaredError(const samples::Raster& raster, const std::vector<std::byte>& decoded) {
  if (decoded.size() != raster.data.size()) {
    ADD_FAILURE() << decoded.size() << " bytes decoded instead of " << raster.data.size();
    return 0;
  }
  double sum = 0;
  for (size_t i = 0; i < decoded.size() / tks_sample_bytes(raster.sample); ++i) {
    const double difference =
        sampleAt(decoded, raster.sample, i) - sampleAt(raster.data, raster.sample, i);
    sum += difference * difference;
  }
  return sum;
}

inline double rmseOf(const samples::Raster& raster, const std::vector<std::byte>& decoded) {
  const auto count = static_cast<double>(decoded.size() / tks_sample_bytes(raster.sample));
  return std::sqrt(squaredError(raster, decoded) / count);
}

/// Largest distance from the raster, in sample units.
inline double largestError(const samples::Raster& raster, const std::vector<std::byte>& decoded) {
  double largest = 0;
  for (size_t i = 0; i < decoded.size() / tks_sample_bytes(raster.sample); ++i) {
    largest = std::max(largest, std::abs(sampleAt(decoded, raster.sample, i) -
                                         sampleAt(raster.data, raster.sample, i)));
  }
  return largest;
}

}  // namespace tetrakis::test
