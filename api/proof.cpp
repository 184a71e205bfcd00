// SPDX-License-Identifier: Apache-2.0
#include "api/proof.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "base/samples.hpp"
#include "codec/geometry/quantiser/voids.hpp"

namespace tetrakis::inline api {

namespace {

Status broken(const std::string& what) {
  return {TKS_MISMATCH,
          "The encoder could not keep its promise: " + what + "; please report this fault."};
}

/// Whether a call has done its work. That memory is exhausted says nothing of the promise.
bool works(tks_status status) {
  if (status == TKS_NO_MEMORY) throw std::bad_alloc();
  return status == TKS_OK;
}

template <class T>
bool sameBits(T a, T b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// What a decoded height may be.
class HeightPromise {
 public:
  HeightPromise(const tks_heights& heights, bool lossless, double max_error)
      : heights_(heights), lossless_(lossless), max_error_(max_error) {}

  template <class T>
  bool keeps(T truth, T decoded, bool valid) const {
    if (!valid) return isVoid(decoded);
    if (lossless_) return sameBits(truth, decoded);
    const double error = std::abs(static_cast<double>(truth) - static_cast<double>(decoded));
    return error * std::abs(heights_.scale) <= max_error_ && !isVoid(decoded);
  }

 private:
  template <class T>
  bool isVoid(T sample) const {
    // As findVoids() does: a nodata value that an integer type cannot hold meets no sample.
    const auto value = static_cast<double>(sample);
    const double nodata = std::is_floating_point_v<T>
                              ? static_cast<double>(static_cast<float>(heights_.nodata))
                              : heights_.nodata;
    return std::isnan(value) || (heights_.has_nodata && value == nodata);
  }

  const tks_heights& heights_;
  bool lossless_;
  double max_error_;
};

Status proveHeights(tks_decoder* decoder, const tks_heights& heights,
                    const HeightPromise& promise) {
  const Result<std::vector<uint8_t>> valid = findVoids(heights);
  if (!valid.ok()) return valid.status();
  return withSampleType(heights.sample, [&](auto type) -> Status {
    using T = decltype(type);
    std::vector<T> decoded(size_t{heights.width} * heights.height);
    if (!works(tks_decode_heights(decoder, decoded.data(), decoded.size() * sizeof(T))))
      return broken(tks_message(decoder));
    const auto* truth = static_cast<const T*>(heights.data);
    for (size_t i = 0; i < decoded.size(); ++i) {
      if (promise.keeps(truth[i], decoded[i], valid->empty() || (*valid)[i])) continue;
      return broken("the height in column " + std::to_string(i % heights.width) + ", row " +
                    std::to_string(i / heights.width) + " does not come back");
    }
    return {};
  });
}

Status proveTexture(tks_decoder* decoder, const tks_image& image) {
  std::vector<uint8_t> decoded(size_t{image.width} * image.height * image.channels *
                               tks_sample_bytes(image.sample));
  if (!works(tks_decode_texture(decoder, decoded.data(), decoded.size())))
    return broken(tks_message(decoder));
  if (std::memcmp(decoded.data(), image.data, decoded.size()) == 0) return {};
  return broken("a texel does not come back");
}

tks_limits noLimits() {
  tks_limits limits = {};
  limits.size = sizeof limits;
  limits.max_samples = limits.max_texels = limits.max_memory = std::numeric_limits<uint64_t>::max();
  return limits;
}

}  // namespace

Status prove(std::span<const uint8_t> stream, const tks_heights* heights, const tks_image* image,
             const tks_encode_options& options) {
  if (options.bytes != 0 && stream.size() > options.bytes)
    return broken("the stream takes more than its budget");
  tks_decoder* opened = nullptr;
  const tks_limits limits = noLimits();
  if (!works(tks_open(stream.data(), stream.size(), &limits, &opened, nullptr, 0)))
    return broken("the stream does not open");
  const std::unique_ptr<tks_decoder, void (*)(tks_decoder*)> decoder(opened, tks_close);
  tks_set_threads(opened, options.threads);
  tks_info info = {};
  info.size = sizeof info;
  if (!works(tks_get_info(opened, &info))) return broken("the stream says nothing of itself");
  const bool lossless = info.lossless != 0;
  if (options.lossless != 0 && !lossless) return broken("the stream is not lossless");
  if (heights != nullptr && (lossless || options.max_error > 0)) {
    const HeightPromise promise(*heights, lossless, options.max_error);
    if (Status status = proveHeights(opened, *heights, promise); !status.ok()) return status;
  }
  return image != nullptr && lossless ? proveTexture(opened, *image) : Status();
}

}  // namespace tetrakis::inline api
