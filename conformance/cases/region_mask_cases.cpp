// SPDX-License-Identifier: Apache-2.0
// Heights whose regions have masks of their own: mosaics, and noise.
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "bitstream/stream/page_index.hpp"
#include "conformance/cases/case_builders.hpp"
#include "conformance/cases/cases.hpp"
#include "conformance/cases/crafted_streams.hpp"
#include "conformance/samples/terrain_samples.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tetrakis/mosaic.h"

namespace tetrakis::conformance {

namespace {

constexpr uint32_t kWidth = 200, kHeight = 150;
constexpr int16_t kNodata = -9999;

/// A mosaic whose files are in memory.
class SmallMosaic {
 public:
  explicit SmallMosaic(std::vector<int16_t> samples) : samples_(std::move(samples)) {
    heights_.size = sizeof heights_;
    heights_.scale = 1;
    heights_.width = kWidth;
    heights_.height = kHeight;
    heights_.sample = TKS_I16;
    heights_.has_nodata = 1;
    heights_.nodata = kNodata;
  }

  Bytes encode(double max_error) {
    const tks_mosaic_source source{sizeof source, &heights_, readWindow, this};
    tks_mosaic_options options{};
    options.size = sizeof options;
    options.max_error = max_error;
    options.lossless = max_error == 0;
    options.regions = 16;
    options.tile = 64;
    tks_buffer plan{};
    tks_mosaic_plan(&source, &options, &plan, nullptr, 0);
    size_t count = 0;
    tks_mosaic_tiles(plan.data, plan.size, nullptr, 0, &count);
    std::vector<tks_tile> tiles(count);
    tks_mosaic_tiles(plan.data, plan.size, tiles.data(), count, &count);
    const tks_mosaic_files files{sizeof files, readFile, fileSize, writeFile, this};
    for (const tks_tile& tile : tiles)
      tks_mosaic_code(plan.data, plan.size, tile, &source, &files, 1, nullptr, 0);
    tks_mosaic_merge(plan.data, plan.size, &files, nullptr, writeAt, this, nullptr, 0);
    tks_free_buffer(&plan);
    return stream_;
  }

 private:
  static SmallMosaic& of(void* user) { return *static_cast<SmallMosaic*>(user); }
  static int readWindow(void* user, const tks_window* window, void* out) {
    auto* to = static_cast<int16_t*>(out);
    for (uint32_t y = window->y; y < window->y + window->height; ++y)
      for (uint32_t x = window->x; x < window->x + window->width; ++x)
        *to++ = of(user).samples_[size_t{y} * kWidth + x];
    return 0;
  }
  static int readFile(void* user, const char* name, uint64_t offset, uint64_t bytes, void* out,
                      uint64_t* read) {
    const auto file = of(user).files_.find(name);
    if (file == of(user).files_.end()) return 1;
    const uint64_t size = file->second.size(), begin = std::min(offset, size);
    *read = std::min(bytes, size - begin);
    if (*read > 0) std::memcpy(out, file->second.data() + begin, *read);
    return 0;
  }
  static int fileSize(void* user, const char* name, uint64_t* size) {
    const auto file = of(user).files_.find(name);
    if (file == of(user).files_.end()) return 1;
    *size = file->second.size();
    return 0;
  }
  static int writeFile(void* user, const char* name, const void* data, size_t size) {
    const auto* bytes = static_cast<const uint8_t*>(data);
    of(user).files_[name] = Bytes(bytes, bytes + size);
    return 0;
  }
  static int writeAt(void* user, uint64_t offset, const void* data, size_t size) {
    Bytes& stream = of(user).stream_;
    stream.resize(std::max<size_t>(stream.size(), offset + size));
    std::memcpy(stream.data() + offset, data, size);
    return 0;
  }

  std::vector<int16_t> samples_;
  tks_heights heights_{};
  std::map<std::string, Bytes> files_;
  Bytes stream_;
};

/// Hills with a coast.
std::vector<int16_t> coast() {
  const std::vector<uint8_t> valid = samples::validity(samples::VoidShape::kCoast, kWidth, kHeight);
  std::vector<int16_t> heights(valid.size());
  for (size_t i = 0; i < heights.size(); ++i) {
    const auto x = static_cast<uint32_t>(i % kWidth), y = static_cast<uint32_t>(i / kWidth);
    const auto hill = static_cast<int16_t>((x * x + 3 * y * y) / 256 + samples::hash(x, y, 5) % 3);
    heights[i] = valid[i] != 0 ? hill : kNodata;
  }
  return heights;
}

/// Masks and coefficients of noise: one track is missing, one ends in its mask, one in the length
/// of that, one begins with a varint that is none.
VectorCase noisyMasks() {
  StreamHeader header = heightsHeader(kWidth, kHeight, TKS_I32, 14);
  header.geometry->regions.side_log2 = 4;
  header.layers.validity_bytes = 9;
  header.layers.region_masks = true;
  header.layers.has_nodata = 1;
  header.layers.nodata = 7;
  header.layers.corrections = CorrectionKind::kSteps;
  header.layers.correction_step = 1;
  header.layers.coefficient_bytes = 30;
  std::vector<Bytes> tracks = {noise(39, 201)};
  const uint64_t coefficient_tracks = regionCount(kWidth, kHeight, 4);
  for (uint32_t track = 1; track < coefficient_tracks; ++track) {
    const uint64_t mask = samples::hash(track, 1, 43) % 14;
    Bytes codeword = varint(mask);
    append(codeword, noise(mask + 12, 210 + track));
    tracks.push_back(codeword);
  }
  tracks[5] = {};
  tracks[9] = {40, 3, 5, 7};
  tracks[12] = {0x83};
  tracks[20] = Bytes(14, 0xff);
  for (uint32_t part = 0; part < 30; ++part) tracks.push_back(noise(8, 500 + part));
  return crafted("noise_region_masks_200x150", "noise: masks of regions, of which some are cut",
                 streamOf(header, tracks));
}

/// The stream with an index in pages behind it.
Bytes inPages(const Bytes& stream) {
  Result<ParsedHeader> parsed = readHeader(stream);
  StreamHeader& header = parsed->header;
  const std::span<const uint8_t> payload = std::span(stream).subspan(parsed->bytes);
  const auto packets = demultiplex(payload, parsed->bytes, trackCounts(header));
  std::vector<IndexEntry> index;
  for (const PacketHead& head : packets->heads)
    index.push_back({head, static_cast<uint8_t>(255 - index.size() % 200)});
  const WrittenPages pages = writePages(header, index);
  header.pages = pages.root;
  Bytes paged = writeHeader(header);
  append(paged, Bytes(payload.begin(), payload.end()));
  append(paged, pages.records);
  return paged;
}

/// Index pages of a stream that cannot have them.
VectorCase strayPages() {
  StreamHeader header = heightsHeader(9, 9, TKS_I16, 8);
  header.pages = "no root";
  return crafted("index_pages_stray_9x9", "index pages that decoders ignore",
                 streamOf(header, noise(60, 216)));
}

}  // namespace

std::vector<VectorCase> regionMaskCases() {
  SmallMosaic lossless(coast()), bounded(coast());
  const Bytes masks = lossless.encode(0), corrected = bounded.encode(1);
  return {crafted("region_masks_200x150", "masks of regions, two groups", masks),
          crafted("region_masks_bounded_200x150", "masks of regions, corrections behind a cut",
                  corrected),
          crafted("index_pages_200x150", "an index in pages, of corrections as well",
                  inPages(corrected)),
          strayPages(), noisyMasks()};
}

}  // namespace tetrakis::conformance
