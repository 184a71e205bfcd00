// SPDX-License-Identifier: Apache-2.0
// The pixels of the component and of the frames that were chosen.
#include <cstring>
#include <new>
#include <span>
#include <utility>

#include <cpl_error.h>
#include "apps/doors/gdal/source.hpp"

namespace tetrakis::gdal {
namespace {

/// Levels of so many pixels are decoded as a whole and kept; of larger ones parts are decoded.
constexpr uint64_t kWholeLevel = uint64_t{1} << 21;

}  // namespace

tks_status Source::decodeFrame(uint32_t frame, const tks_window* window, std::span<std::byte> out) {
  tks_decoder* const decoder = decoder_.get();
  if (const tks_status status = tks_set_frame(decoder, frame); status != TKS_OK) return status;
  void* const data = out.data();
  if (part_ == TKS_PART_HEIGHTS) {
    return window == nullptr ? tks_decode_heights(decoder, data, out.size())
                             : tks_decode_heights_window(decoder, window, data, out.size());
  }
  return window == nullptr ? tks_decode_texture(decoder, data, out.size())
                           : tks_decode_texture_window(decoder, window, data, out.size());
}

bool Source::decode(const tks_window* window, uint64_t pixels, std::vector<std::byte>& out) {
  out.resize(pixels * pixelBytes());
  if (frames() == 1) {
    const tks_status status = decodeFrame(frame_.value_or(0), window, out);
    return status == TKS_OK || failed(status);
  }
  const size_t sample = tks_sample_bytes(this->sample());
  std::vector<std::byte> plane(pixels * sample);
  for (uint32_t frame = 0; frame < frames(); ++frame) {
    if (const tks_status status = decodeFrame(frame, window, plane); status != TKS_OK)
      return failed(status);
    std::byte* to = out.data() + frame * sample;
    for (const std::byte* from = plane.data(); from != plane.data() + plane.size();
         from += sample, to += pixelBytes())
      std::memcpy(to, from, sample);
  }
  return true;
}

bool Source::decodeLevel(uint32_t level, std::vector<std::byte>& out) {
  const bool heights = part_ == TKS_PART_HEIGHTS;
  const uint64_t pixels = uint64_t{width(level)} * height(level);
  tks_decoder* const decoder = decoder_.get();
  const uint64_t beside = pixels * pixelBytes();
  tks_status status = tks_set_levels(decoder, heights ? level : 0, heights ? 0 : level);
  if (status == TKS_OK) status = tks_check_memory(decoder, part_, nullptr, 0, beside, nullptr);
  if (status != TKS_OK) return failed(status);
  return decode(nullptr, pixels, out);
}

const std::byte* Source::level(uint32_t level) {
  std::vector<std::byte>& kept = kept_[level];
  if (!kept.empty()) return kept.data();
  if (!load(level, nullptr)) return nullptr;
  try {
    std::vector<std::byte> pixels;
    if (!decodeLevel(level, pixels)) return nullptr;
    kept = std::move(pixels);
    return kept.data();
  } catch (const std::bad_alloc&) {
    reportFailure(TKS_NO_MEMORY, name_, "");
    return nullptr;
  }
}

bool Source::readsWindows(uint32_t level) const {
  if (regionSide() == 0) return false;
  const uint64_t pixels = uint64_t{width(level)} * height(level);
  return level == 0 || (pixels > kWholeLevel && frames() == 1 && !frame_);
}

bool Source::window(uint32_t level, const tks_window& window, std::vector<std::byte>& out) {
  CPLDebug("TKS", "%s: decoding %u x %u from %u, %u of level %u", name_.c_str(), window.width,
           window.height, window.x, window.y, level);
  if (!load(level, &window)) return false;
  const bool heights = part_ == TKS_PART_HEIGHTS;
  const tks_status status =
      tks_set_levels(decoder_.get(), heights ? level : 0, heights ? 0 : level);
  if (status != TKS_OK) return failed(status);
  return decode(&window, uint64_t{window.width} * window.height, out);
}

}  // namespace tetrakis::gdal
