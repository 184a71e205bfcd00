// SPDX-License-Identifier: Apache-2.0
// Tetrakis through its C interface; see tetrakis_peer.hpp.
#include "bench/peers/tetrakis_peer.hpp"

#include <algorithm>
#include <array>
#include <memory>

namespace tetrakis::bench {
namespace {

using DecoderPtr = std::unique_ptr<tks_decoder, decltype(&tks_close)>;

// Room for the one sentence of a failure.
using Message = std::array<char, 512>;

tks_heights describeHeights(const Raster& raster) {
  tks_heights heights{};
  heights.size = sizeof(heights);
  heights.width = raster.width;
  heights.height = raster.height;
  heights.sample = TKS_U16;
  heights.data = raster.samples.data();
  heights.scale = raster.unit;
  return heights;
}

tks_image describeImage(const Raster& raster, const std::vector<uint8_t>& samples) {
  tks_image image{};
  image.size = sizeof(image);
  image.width = raster.width;
  image.height = raster.height;
  image.channels = raster.channels;
  image.sample = TKS_U8;
  image.data = samples.data();
  return image;
}

Status decodeHeights(tks_decoder* decoder, const tks_info& info, std::vector<uint16_t>& out) {
  out.resize(size_t{info.width} * info.height);
  const tks_status code = tks_decode_heights(decoder, out.data(), out.size() * sizeof(out.front()));
  return code == TKS_OK ? Status() : Status(code, tks_message(decoder));
}

Status decodeSurface(tks_decoder* decoder, const tks_info& info, std::vector<float>& out) {
  out.resize(size_t{info.width} * info.height);
  const tks_status code = tks_decode_surface(decoder, out.data(), out.size());
  if (code != TKS_OK) return {code, tks_message(decoder)};
  for (float& height : out) height /= static_cast<float>(info.scale);
  return {};
}

Status decodeImage(tks_decoder* decoder, const tks_info& info, std::vector<uint8_t>& out) {
  out.resize(size_t{info.texture_width} * info.texture_height * info.texture_channels);
  const tks_status code = tks_decode_texture(decoder, out.data(), out.size());
  return code == TKS_OK ? Status() : Status(code, tks_message(decoder));
}

struct Opened {
  DecoderPtr decoder;
  tks_info info;
};

Result<Opened> openTetrakis(std::span<const uint8_t> stream) {
  Message message{};
  tks_decoder* handle = nullptr;
  const tks_status code =
      tks_open(stream.data(), stream.size(), nullptr, &handle, message.data(), message.size());
  if (code != TKS_OK) return Status(code, message.data());
  Opened opened{DecoderPtr(handle, &tks_close), {}};
  opened.info.size = sizeof(opened.info);
  const tks_status informed = tks_get_info(handle, &opened.info);
  if (informed != TKS_OK) return Status(informed, tks_message(handle));
  return opened;
}

}  // namespace

Result<std::vector<uint8_t>> encodeTetrakis(const StreamSource& source, uint64_t bytes) {
  tks_heights heights{};
  tks_image image{};
  std::vector<uint8_t> image_samples;
  if (source.heights) heights = describeHeights(*source.heights);
  if (source.image) {
    image_samples.assign(source.image->samples.begin(), source.image->samples.end());
    image = describeImage(*source.image, image_samples);
  }
  tks_encode_options options{};
  options.size = sizeof(options);
  options.bytes = bytes;
  options.lossless = bytes == 0;
  options.weights = source.weights;

  tks_buffer buffer{};
  Message message{};
  const tks_status code =
      tks_encode(source.heights ? &heights : nullptr, source.image ? &image : nullptr, &options,
                 &buffer, message.data(), message.size());
  if (code != TKS_OK) return Status(code, message.data());
  std::vector<uint8_t> stream(buffer.data, buffer.data + buffer.size);
  tks_free_buffer(&buffer);
  return stream;
}

Result<DecodedStream> decodeTetrakis(std::span<const uint8_t> prefix) {
  const Result<Opened> opened = openTetrakis(prefix);
  if (!opened.ok()) return opened.status();
  const tks_info& info = opened->info;
  tks_decoder* decoder = opened->decoder.get();
  DecodedStream out;
  out.geometry_bytes = info.geometry_bytes;
  out.texture_bytes = info.texture_bytes;
  Status status;
  std::vector<uint8_t> image;
  if (info.has_heights) status = decodeHeights(decoder, info, out.heights);
  if (status.ok() && info.has_heights) status = decodeSurface(decoder, info, out.surface);
  if (status.ok() && info.has_texture) status = decodeImage(decoder, info, image);
  if (!status.ok()) return status;
  out.image.assign(image.begin(), image.end());
  return out;
}

Status decodeTetrakisSamples(std::span<const uint8_t> stream) {
  const Result<Opened> opened = openTetrakis(stream);
  if (!opened.ok()) return opened.status();
  std::vector<uint16_t> heights;
  std::vector<uint8_t> image;
  Status status;
  if (opened->info.has_heights)
    status = decodeHeights(opened->decoder.get(), opened->info, heights);
  if (status.ok() && opened->info.has_texture)
    status = decodeImage(opened->decoder.get(), opened->info, image);
  return status;
}

namespace {

/// The stream cut at each of `lengths` that it reaches.
Result<std::vector<CodedPoint>> cutsOf(const StreamSource& source, std::span<const uint8_t> stream,
                                       std::span<const uint64_t> lengths) {
  std::vector<CodedPoint> cuts;
  for (const uint64_t bytes : lengths) {
    if (bytes > stream.size()) break;
    const auto decoded = decodeTetrakis(stream.first(bytes));
    if (decoded.status().code() == TKS_TRUNCATED) continue;
    if (!decoded.ok()) return decoded.status();
    cuts.push_back({bytes, source.image ? meanSquaredError(*source.image, decoded->image)
                                        : meanSquaredError(*source.heights, decoded->surface)});
  }
  return cuts;
}

/// A stream for each length; where it ends before, all is there and there is no point.
Result<std::vector<CodedPoint>> madeFor(const StreamSource& source,
                                        std::span<const uint64_t> lengths) {
  std::vector<CodedPoint> points;
  for (const uint64_t& bytes : lengths) {
    const auto stream = encodeTetrakis(source, bytes);
    if (stream.status().code() == TKS_USAGE) continue;  // shorter than its header
    if (!stream.ok()) return stream.status();
    const auto whole = cutsOf(source, *stream, std::span(&bytes, 1));
    if (!whole.ok()) return whole.status();
    points.insert(points.end(), whole->begin(), whole->end());
  }
  return points;
}

}  // namespace

Result<PeerCurves> TetrakisPeer::curves(const Raster& raster,
                                        const std::vector<uint64_t>& targets) const {
  const bool is_image = kind_ == RasterKind::kImage;
  const StreamSource source{is_image ? nullptr : &raster, is_image ? &raster : nullptr};
  // One lossless stream, and one lossy stream made for the highest rate below it and cut at all.
  const auto lossless = encodeTetrakis(source, 0);
  if (!lossless.ok()) return lossless.status();
  const auto above = std::lower_bound(targets.begin(), targets.end(), lossless->size());
  const auto stream =
      encodeTetrakis(source, above == targets.begin() ? targets.front() : *(above - 1));
  if (!stream.ok()) return stream.status();

  PeerCurves curves;
  std::vector<uint64_t> ends;
  for (const double share : kNearEnd)
    ends.push_back(lossless->size() -
                   static_cast<uint64_t>(share * static_cast<double>(lossless->size())));
  const auto cuts = cutsOf(source, *stream, targets), low = cutsOf(source, *lossless, targets),
             made = madeFor(source, targets), near_end = cutsOf(source, *lossless, ends);
  for (const auto* points : {&cuts, &low, &made, &near_end}) {
    if (!points->ok()) return points->status();
  }
  curves.settings.push_back(*cuts);
  curves.lossless_cuts = *low;
  curves.made = *made;
  curves.near_end = *near_end;
  const auto restored = decodeTetrakis(*lossless);
  if (!restored.ok()) return restored.status();
  if ((is_image ? restored->image : restored->heights) != raster.samples) {
    return Status(TKS_MISMATCH, "The lossless stream does not restore the samples.");
  }
  curves.lossless_bytes = lossless->size();
  return curves;
}

}  // namespace tetrakis::bench
