// SPDX-License-Identifier: Apache-2.0
// OpenJPEG through libopenjp2, in memory; see openjpeg_peer.hpp.
#include "bench/peers/openjpeg_peer.hpp"

#include <openjpeg.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>

namespace tetrakis::bench {
namespace {

using ImagePtr = std::unique_ptr<opj_image_t, decltype(&opj_image_destroy)>;
using CodecPtr = std::unique_ptr<opj_codec_t, decltype(&opj_destroy_codec)>;
using StreamPtr = std::unique_ptr<opj_stream_t, decltype(&opj_stream_destroy)>;

Status failure(const char* what) {
  return {TKS_MISMATCH, std::string("OpenJPEG failed to ") + what + "."};
}

// A growing file in memory: what OpenJPEG reads or writes, and where it stands.
struct MemoryFile {
  std::vector<uint8_t> data;
  size_t position = 0;
};

OPJ_SIZE_T readMemory(void* buffer, OPJ_SIZE_T size, void* user) {
  auto& file = *static_cast<MemoryFile*>(user);
  const size_t n = std::min<size_t>(size, file.data.size() - file.position);
  if (n == 0) return static_cast<OPJ_SIZE_T>(-1);  // end of file
  std::memcpy(buffer, file.data.data() + file.position, n);
  file.position += n;
  return n;
}

OPJ_SIZE_T writeMemory(void* buffer, OPJ_SIZE_T size, void* user) {
  auto& file = *static_cast<MemoryFile*>(user);
  if (file.position + size > file.data.size()) file.data.resize(file.position + size);
  std::memcpy(file.data.data() + file.position, buffer, size);
  file.position += size;
  return size;
}

OPJ_OFF_T skipMemory(OPJ_OFF_T size, void* user) {
  auto& file = *static_cast<MemoryFile*>(user);
  const auto target = static_cast<OPJ_OFF_T>(file.position) + size;
  if (target < 0 || target > static_cast<OPJ_OFF_T>(file.data.size())) return -1;
  file.position = static_cast<size_t>(target);
  return size;
}

OPJ_BOOL seekMemory(OPJ_OFF_T target, void* user) {
  auto& file = *static_cast<MemoryFile*>(user);
  if (target < 0 || target > static_cast<OPJ_OFF_T>(file.data.size())) return OPJ_FALSE;
  file.position = static_cast<size_t>(target);
  return OPJ_TRUE;
}

StreamPtr openStream(MemoryFile& file, bool reading) {
  constexpr size_t kBuffer = size_t{1} << 20;
  StreamPtr stream(opj_stream_create(kBuffer, reading), &opj_stream_destroy);
  opj_stream_set_read_function(stream.get(), readMemory);
  opj_stream_set_write_function(stream.get(), writeMemory);
  opj_stream_set_skip_function(stream.get(), skipMemory);
  opj_stream_set_seek_function(stream.get(), seekMemory);
  opj_stream_set_user_data(stream.get(), &file, nullptr);
  opj_stream_set_user_data_length(stream.get(), file.data.size());
  return stream;
}

ImagePtr makeImage(const Raster& raster) {
  std::vector<opj_image_cmptparm_t> parameters(raster.channels);
  for (opj_image_cmptparm_t& p : parameters) {
    p.dx = p.dy = 1;
    p.w = raster.width;
    p.h = raster.height;
    p.prec = static_cast<OPJ_UINT32>(raster.bits);
  }
  ImagePtr image(opj_image_create(raster.channels, parameters.data(),
                                  raster.channels == 3 ? OPJ_CLRSPC_SRGB : OPJ_CLRSPC_GRAY),
                 &opj_image_destroy);
  if (!image) return image;
  image->x1 = raster.width;
  image->y1 = raster.height;
  for (uint32_t c = 0; c < raster.channels; ++c) {
    OPJ_INT32* plane = image->comps[c].data;
    const uint16_t* sample = raster.samples.data() + c;
    for (size_t i = 0; i < raster.pixels(); ++i) plane[i] = sample[i * raster.channels];
  }
  return image;
}

opj_cparameters_t makeParameters(const Raster& raster, const OpenJpegSettings& settings,
                                 char* empty_comment) {
  opj_cparameters_t p;
  opj_set_default_encoder_parameters(&p);
  const double raw_bytes =
      static_cast<double>(raster.pixels()) * raster.channels * raster.bits / 8.0;
  p.tcp_numlayers = 1;
  p.cp_disto_alloc = 1;
  p.tcp_rates[0] =
      settings.bytes == 0 ? 0 : static_cast<float>(raw_bytes / static_cast<double>(settings.bytes));
  p.irreversible = settings.bytes != 0;
  p.tcp_mct = raster.channels == 3;
  p.numresolution =
      std::min<int>(settings.resolutions, std::bit_width(std::min(raster.width, raster.height)));
  p.cp_comment = empty_comment;
  return p;
}

Raster stretched(const Raster& raster, uint32_t factor) {
  Raster out = raster;
  out.bits = 16;
  for (uint16_t& s : out.samples) s = static_cast<uint16_t>(s * factor);
  return out;
}

// One file for each target.
Result<std::vector<CodedPoint>> filesAt(const Raster& raster, int resolutions,
                                        const std::vector<uint64_t>& targets) {
  std::vector<CodedPoint> points;
  for (const uint64_t bytes : targets) {
    const auto codestream = encodeOpenJpeg(raster, {bytes, resolutions});
    if (!codestream.ok()) return codestream.status();
    const auto decoded = decodeOpenJpeg(*codestream);
    if (!decoded.ok()) return decoded.status();
    points.push_back({codestream->size(), meanSquaredError(raster, *decoded)});
  }
  return points;
}

}  // namespace

Result<std::vector<uint8_t>> encodeOpenJpeg(const Raster& raster,
                                            const OpenJpegSettings& settings) {
  const ImagePtr image = makeImage(raster);
  const CodecPtr codec(opj_create_compress(OPJ_CODEC_J2K), &opj_destroy_codec);
  if (!image || !codec) return failure("allocate");
  char empty_comment[] = "";
  opj_cparameters_t parameters = makeParameters(raster, settings, empty_comment);
  if (!opj_setup_encoder(codec.get(), &parameters, image.get())) return failure("set up");
  MemoryFile file;
  const StreamPtr stream = openStream(file, false);
  if (!opj_start_compress(codec.get(), image.get(), stream.get()) ||
      !opj_encode(codec.get(), stream.get()) || !opj_end_compress(codec.get(), stream.get())) {
    return failure("encode");
  }
  return std::move(file.data);
}

Result<std::vector<uint16_t>> decodeOpenJpeg(const std::vector<uint8_t>& codestream) {
  MemoryFile file{codestream, 0};
  const StreamPtr stream = openStream(file, true);
  const CodecPtr codec(opj_create_decompress(OPJ_CODEC_J2K), &opj_destroy_codec);
  opj_dparameters_t parameters;
  opj_set_default_decoder_parameters(&parameters);
  opj_image_t* header = nullptr;
  if (!codec || !opj_setup_decoder(codec.get(), &parameters) ||
      !opj_read_header(stream.get(), codec.get(), &header)) {
    return failure("read its header");
  }
  const ImagePtr image(header, &opj_image_destroy);
  if (!opj_decode(codec.get(), stream.get(), image.get()) ||
      !opj_end_decompress(codec.get(), stream.get())) {
    return failure("decode");
  }
  const size_t channels = image->numcomps;
  const size_t pixels = size_t{image->comps[0].w} * image->comps[0].h;
  std::vector<uint16_t> samples(pixels * channels);
  for (size_t c = 0; c < channels; ++c) {
    const OPJ_INT32* plane = image->comps[c].data;
    for (size_t i = 0; i < pixels; ++i) samples[i * channels + c] = static_cast<uint16_t>(plane[i]);
  }
  return samples;
}

Result<PeerCurves> OpenJpegPeer::curves(const Raster& raster,
                                        const std::vector<uint64_t>& targets) const {
  std::vector<uint32_t> factors{1};
  const uint32_t largest = *std::max_element(raster.samples.begin(), raster.samples.end());
  if (stretch_ && largest > 0 && 65535 / largest > 1) factors.push_back(65535 / largest);

  PeerCurves curves;
  for (const uint32_t factor : factors) {
    const Raster input = factor == 1 ? raster : stretched(raster, factor);
    for (const int resolutions : resolutions_) {
      auto points = filesAt(input, resolutions, targets);
      if (!points.ok()) return points.status();
      for (CodedPoint& p : *points) p.mse /= double{1} * factor * factor;
      curves.settings.push_back(std::move(*points));
    }
  }
  const auto lossless = encodeOpenJpeg(raster, {0, resolutions_.front()});
  if (!lossless.ok()) return lossless.status();
  const auto restored = decodeOpenJpeg(*lossless);
  if (!restored.ok()) return restored.status();
  if (*restored != raster.samples) return failure("restore the samples of its lossless file");
  curves.lossless_bytes = lossless->size();
  return curves;
}

}  // namespace tetrakis::bench
