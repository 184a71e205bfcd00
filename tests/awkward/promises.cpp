// SPDX-License-Identifier: Apache-2.0
#include "tests/awkward/promises.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "base/samples.hpp"
#include "tests/awkward/surface_promises.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::test {

namespace {

using Samples = std::vector<std::byte>;

struct Decoded {
  Samples samples;
  std::string complaint;
};

/// Of the heights, or of the texture.
Decoded decode(tks_decoder* decoder, bool heights) {
  tks_info info = {};
  info.size = sizeof info;
  tks_get_info(decoder, &info);
  Decoded out;
  const size_t count = heights ? size_t{info.width} * info.height * tks_sample_bytes(info.sample)
                               : size_t{info.texture_width} * info.texture_height *
                                     info.texture_channels * tks_sample_bytes(info.texture_sample);
  out.samples.resize(count);
  const tks_status status = heights ? tks_decode_heights(decoder, out.samples.data(), count)
                                    : tks_decode_texture(decoder, out.samples.data(), count);
  if (status != TKS_OK) out.complaint = std::string("decoding fails: ") + tks_message(decoder);
  return out;
}

/// Compares samples. Voids are to stay voids, and no other sample may become one, unless a budget
/// may end inside the mask.
class Comparison {
 public:
  explicit Comparison(const AwkwardCase& c) : c_(c) {}

  std::string complaint(const Samples& decoded, bool lossless) const {
    return withSampleType(c_.heights.sample, [&](auto type) {
      using T = decltype(type);
      std::vector<T> truth(decoded.size() / sizeof(T)), seen(truth.size());
      std::memcpy(truth.data(), c_.heights.data.data(), decoded.size());
      std::memcpy(seen.data(), decoded.data(), decoded.size());
      for (size_t i = 0; i < truth.size(); ++i) {
        if (std::string found = at<T>(truth[i], seen[i], lossless); !found.empty())
          return "sample " + std::to_string(i) + " " + found;
      }
      return std::string();
    });
  }

 private:
  template <class T>
  bool isVoid(T sample) const {
    const auto value = static_cast<double>(sample);
    const bool is_float = std::is_floating_point_v<T>;
    const double nodata = c_.nodata.value_or(0);
    return std::isnan(value) ||
           (c_.nodata &&
            value == (is_float ? static_cast<double>(static_cast<float>(nodata)) : nodata));
  }

  template <class T>
  std::string at(T truth, T seen, bool lossless) const {
    const bool mask_may_be_cut = c_.options.bytes > 0 && !lossless;
    if (mask_may_be_cut) return {};
    const std::string became = "of " + std::to_string(truth) + " became " + std::to_string(seen);
    if (isVoid(truth)) return isVoid(seen) ? "" : became + " though it is void";
    if (isVoid(seen)) return became + ", the value of voids";
    if (lossless && std::memcmp(&truth, &seen, sizeof truth) != 0) return became;
    const double error = std::abs(static_cast<double>(truth) - static_cast<double>(seen));
    if (c_.options.max_error > 0 && error > c_.options.max_error) return became;
    return {};
  }

  const AwkwardCase& c_;
};

/// What a stream may take at most beside its samples: the header, and a mask that no model helps.
uint64_t mostBytes(const AwkwardCase& c) {
  const uint64_t samples = c.heights.data.size() / tks_sample_bytes(c.heights.sample);
  return c.heights.data.size() + 64 + samples / 6 + 3 * c.sides.size() + (c.grid ? 80 : 0) +
         (c.texture ? c.texture->data.size() * 5 / 4 + 200 : 0) + 64;
}

std::string checkWhole(const AwkwardCase& c, std::span<const uint8_t> stream) {
  tks_decoder* decoder = nullptr;
  if (tks_open(stream.data(), stream.size(), nullptr, &decoder, nullptr, 0) != TKS_OK)
    return "the stream does not open";
  const std::unique_ptr<tks_decoder, void (*)(tks_decoder*)> owner(decoder, tks_close);
  tks_info info = {};
  info.size = sizeof info;
  tks_get_info(decoder, &info);
  if (tks_verify(decoder) != TKS_OK) return std::string("verify: ") + tks_message(decoder);
  if (c.options.bytes > 0 && stream.size() > c.options.bytes) return "the budget is exceeded";
  if (c.options.lossless && !info.lossless) return "the stream does not call itself lossless";
  if (c.options.max_error > 0 && info.max_error != c.options.max_error)
    return "the stream does not state its bound";
  // Within a budget nothing is stored.
  const bool may_store = info.lossless && c.options.bytes == 0;
  if (may_store && !c.options.index && stream.size() > mostBytes(c))
    return std::to_string(stream.size()) + " bytes, the samples take " +
           std::to_string(c.heights.data.size());
  const Decoded heights = decode(decoder, true);
  if (!heights.complaint.empty()) return heights.complaint;
  const std::string found = Comparison(c).complaint(heights.samples, info.lossless != 0);
  if (!found.empty()) return found;
  if (c.texture) {
    const Decoded texture = decode(decoder, false);
    if (!texture.complaint.empty()) return texture.complaint;
    if (info.lossless && texture.samples != c.texture->data) return "a texel has changed";
  }
  return brokenSurface(c, decoder);
}

bool hasArea(tks_decoder* decoder) {
  tks_info info = {};
  info.size = sizeof info;
  tks_get_info(decoder, &info);
  return info.width > 1 && info.height > 1;
}

/// A prefix decodes, and so do a level and a mesh of it.
std::string checkCut(const AwkwardCase& c, std::span<const uint8_t> prefix) {
  tks_decoder* decoder = nullptr;
  const tks_status status = tks_open(prefix.data(), prefix.size(), nullptr, &decoder, nullptr, 0);
  if (status == TKS_TRUNCATED) return {};
  if (status != TKS_OK) return "a prefix does not open";
  const std::unique_ptr<tks_decoder, void (*)(tks_decoder*)> owner(decoder, tks_close);
  if (std::string found = brokenSurface(c, decoder); !found.empty()) return found;
  tks_mesh mesh = {};
  const tks_status meshed = tks_decode_mesh(decoder, TKS_MESH_BUDGET, 40, &mesh);
  if (meshed != (hasArea(decoder) ? TKS_OK : TKS_USAGE)) return tks_message(decoder);
  tks_free_mesh(&mesh);
  if (tks_set_levels(decoder, 1, 0) != TKS_OK) return {};
  return decode(decoder, true).complaint;
}

/// A decoder that gets its bytes in two pieces, and decodes in between, gives what others give.
std::string checkGrown(std::span<const uint8_t> stream, size_t first) {
  Samples heights[2], texels[2];
  for (const bool grown : {false, true}) {
    tks_decoder* decoder = nullptr;
    const size_t size = grown ? first : stream.size();
    if (tks_open(stream.data(), size, nullptr, &decoder, nullptr, 0) != TKS_OK)
      return "a prefix does not open";
    const std::unique_ptr<tks_decoder, void (*)(tks_decoder*)> owner(decoder, tks_close);
    if (grown) {
      decode(decoder, true);
      decode(decoder, false);
      const std::span<const uint8_t> rest = stream.subspan(first);
      if (tks_append(decoder, rest.data(), rest.size()) != TKS_OK) return tks_message(decoder);
    }
    heights[grown] = decode(decoder, true).samples;
    texels[grown] = decode(decoder, false).samples;
  }
  return heights[0] == heights[1] && texels[0] == texels[1]
             ? ""
             : "bytes that come later decode to something else";
}

}  // namespace

std::string brokenPromise(const AwkwardCase& c) {
  const tks_heights heights = c.input();
  const tks_image image = c.texture ? c.picture() : tks_image{};
  tks_buffer buffer = {};
  char message[256] = "";
  const tks_status status = tks_encode(&heights, c.texture ? &image : nullptr, &c.options, &buffer,
                                       message, sizeof message);
  const Buffer owner(buffer);
  if (status == TKS_USAGE && !c.options.lossless && message[0] != 0) return {};
  if (status != TKS_OK) return "encoding fails: " + std::string(message);
  const std::span<const uint8_t> stream = owner.bytes();
  if (std::string found = checkWhole(c, stream); !found.empty()) return found;
  uint64_t header = 0;
  tks_header_bytes(stream.data(), stream.size(), &header);
  for (const uint64_t eighths : {0, 1, 3, 5, 7}) {
    const size_t cut = eighths == 0 ? header : stream.size() * eighths / 8;
    if (std::string found = checkCut(c, stream.first(cut)); !found.empty())
      return "cut at " + std::to_string(cut) + ": " + found;
  }
  return checkGrown(stream, std::max<size_t>(header, stream.size() / 3));
}

}  // namespace tetrakis::test
