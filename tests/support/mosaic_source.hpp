// SPDX-License-Identifier: Apache-2.0
// Sources and files of mosaics in memory, for tests through the C interface.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "conformance/samples/void_masks.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tetrakis/mosaic.h"

namespace tetrakis::test {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// Heights that are read window by window.
struct Source {
  explicit Source(Raster from) : raster(std::move(from)), heights(raster.heights()) { point(); }
  Source(const Source&) = delete;

  void point() {
    heights.data = nullptr;
    source = {sizeof source, &heights, &Source::read, this};
  }
  static int read(void* user, const tks_window* window, void* samples) {
    auto& self = *static_cast<Source*>(user);
    self.largest = std::max(self.largest, uint64_t{window->width} * window->height);
    if (self.fails) return 1;
    const size_t bytes = tks_sample_bytes(self.heights.sample);
    auto* out = static_cast<std::byte*>(samples);
    for (uint32_t y = 0; y < window->height; ++y) {
      const size_t from = size_t{window->y + y} * self.raster.width + window->x;
      std::copy_n(self.raster.data.data() + from * bytes, window->width * bytes, out);
      out += window->width * bytes;
    }
    return 0;
  }

  Raster raster;
  tks_heights heights;
  tks_mosaic_source source{};
  uint64_t largest = 0;
  bool fails = false;
};

/// Parts in memory.
struct Files {
  std::map<std::string, Bytes> all;
  size_t writes = 0;

  tks_mosaic_files files() { return {sizeof(tks_mosaic_files), &read, &length, &write, this}; }

  static int read(void* user, const char* name, uint64_t offset, uint64_t bytes, void* out,
                  uint64_t* done) {
    const auto& all = static_cast<Files*>(user)->all;
    const auto found = all.find(name);
    if (found == all.end() || offset > found->second.size()) return 1;
    *done = std::min<uint64_t>(bytes, found->second.size() - offset);
    std::copy_n(found->second.data() + offset, *done, static_cast<uint8_t*>(out));
    return 0;
  }
  static int length(void* user, const char* name, uint64_t* size) {
    const auto& all = static_cast<Files*>(user)->all;
    const auto found = all.find(name);
    if (found == all.end()) return 1;
    *size = found->second.size();
    return 0;
  }
  static int write(void* user, const char* name, const void* data, size_t size) {
    auto& self = *static_cast<Files*>(user);
    const auto* bytes = static_cast<const uint8_t*>(data);
    self.all[name].assign(bytes, bytes + size);
    ++self.writes;
    return 0;
  }
};

inline tks_mosaic_options mosaicOptions() {
  tks_mosaic_options options = {};
  options.size = sizeof options;
  options.regions = 32;
  options.tile = 64;
  return options;
}

inline Bytes planOf(Source& source, const tks_mosaic_options& options,
                    tks_status expected = TKS_OK) {
  tks_buffer buffer = {};
  char message[256] = "";
  EXPECT_EQ(tks_mosaic_plan(&source.source, &options, &buffer, message, sizeof message), expected)
      << message;
  const Bytes plan(buffer.data, buffer.data + buffer.size);
  tks_free_buffer(&buffer);
  return plan;
}

inline std::vector<tks_tile> tilesOf(const Bytes& plan) {
  size_t count = 0;
  EXPECT_EQ(tks_mosaic_tiles(plan.data(), plan.size(), nullptr, 0, &count), TKS_OK);
  std::vector<tks_tile> tiles(count);
  EXPECT_EQ(tks_mosaic_tiles(plan.data(), plan.size(), tiles.data(), count, &count), TKS_OK);
  return tiles;
}

inline bool isDone(const Bytes& plan, const tks_tile& tile, Files& files) {
  int done = -1;
  const tks_mosaic_files storage = files.files();
  EXPECT_EQ(tks_mosaic_is_done(plan.data(), plan.size(), tile, &storage, &done), TKS_OK);
  return done == 1;
}

inline tks_status code(const Bytes& plan, const tks_tile& tile, Source& source, Files& files,
                       uint32_t threads = 1) {
  char message[256] = "";
  const tks_mosaic_files storage = files.files();
  return tks_mosaic_code(plan.data(), plan.size(), tile, &source.source, &storage, threads, message,
                         sizeof message);
}

inline int writeAt(void* user, uint64_t offset, const void* data, size_t size) {
  auto& stream = *static_cast<Bytes*>(user);
  stream.resize(std::max<size_t>(stream.size(), offset + size));
  std::copy_n(static_cast<const uint8_t*>(data), size,
              stream.begin() + static_cast<ptrdiff_t>(offset));
  return 0;
}

inline tks_status merge(const Bytes& plan, Files& files, Bytes& stream,
                        tks_layout layout = TKS_LAYOUT_PROGRESSIVE, uint64_t preview = 0) {
  char message[256] = "";
  const tks_mosaic_files storage = files.files();
  const tks_merge_options options{sizeof options, layout, preview};
  return tks_mosaic_merge(plan.data(), plan.size(), &storage, &options, writeAt, &stream, message,
                          sizeof message);
}

/// All tasks in their order, then the merge.
inline Bytes mosaicOf(Source& source, const tks_mosaic_options& options,
                      tks_layout layout = TKS_LAYOUT_PROGRESSIVE, uint64_t preview = 0) {
  const Bytes plan = planOf(source, options);
  Files files;
  for (const tks_tile& tile : tilesOf(plan)) EXPECT_EQ(code(plan, tile, source, files), TKS_OK);
  Bytes stream;
  EXPECT_EQ(merge(plan, files, stream, layout, preview), TKS_OK);
  return stream;
}

inline Raster hills(tks_sample sample, uint32_t width = 330, uint32_t height = 215) {
  return make({Pattern::kRidges, width, height, 1, sample, 5});
}

/// Sets samples void that the shape leaves out.
inline void dig(Source& source, samples::VoidShape shape) {
  const auto valid = samples::validity(shape, source.raster.width, source.raster.height);
  const size_t bytes = tks_sample_bytes(source.heights.sample);
  source.heights.has_nodata = 1;
  source.heights.nodata = source.heights.sample == TKS_F32 ? -9999.0 : 1;
  const float void_float = -9999;
  const int32_t void_whole = 1;  // little endian, as all machines that test
  const void* nodata =
      source.heights.sample == TKS_F32 ? static_cast<const void*>(&void_float) : &void_whole;
  for (size_t i = 0; i < valid.size(); ++i)
    if (!valid[i]) std::memcpy(source.raster.data.data() + bytes * i, nodata, bytes);
}

}  // namespace tetrakis::test
