// SPDX-License-Identifier: Apache-2.0
// openRawWindows() reads windows of files without a header: of raw samples row by row, of .hgt
// tiles from memory.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/little_endian.hpp"
#include "apps/tools/files/place/world_file.hpp"
#include "apps/tools/files/plain_heights.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/mosaic/height_source.hpp"

namespace tetrakis::tools {

namespace {

class RawWindows : public HeightSource {
 public:
  RawWindows(std::string path, HeightFile described)
      : path_(std::move(path)), described_(std::move(described)), file_(path_, std::ios::binary) {}

  const HeightFile& described() const override { return described_; }
  Status read(const tks_window& window, std::byte* samples) override {
    const size_t sample = tks_sample_bytes(described_.sample), row = window.width * sample;
    for (uint32_t y = 0; y < window.height; ++y) {
      const uint64_t first = uint64_t{window.y + y} * described_.width + window.x;
      file_.seekg(static_cast<std::streamoff>(first * sample));
      file_.read(reinterpret_cast<char*>(samples + y * row), static_cast<std::streamsize>(row));
    }
    if (!file_) return {TKS_IO, "cannot read " + quoted(path_)};
    reorderBytes({samples, window.height * row}, sample, std::endian::little);
    return {};
  }
  std::vector<std::string> filesOf(const tks_window&) const override { return {path_}; }

 private:
  const std::string path_;
  HeightFile described_;
  std::ifstream file_;
};

class HgtTile : public HeightSource {
 public:
  HgtTile(std::string path, HeightFile described)
      : path_(std::move(path)), described_(std::move(described)) {
    samples_ = std::exchange(described_.data, {});
  }

  const HeightFile& described() const override { return described_; }
  Status read(const tks_window& window, std::byte* samples) override {
    const size_t sample = tks_sample_bytes(described_.sample), row = window.width * sample;
    for (uint32_t y = 0; y < window.height; ++y) {
      const size_t first = (size_t{window.y + y} * described_.width + window.x) * sample;
      std::copy_n(samples_.data() + first, row, samples + y * row);
    }
    return {};
  }
  std::vector<std::string> filesOf(const tks_window&) const override { return {path_}; }

 private:
  std::string path_;
  HeightFile described_;
  std::vector<std::byte> samples_;
};

}  // namespace

Result<OpenSource> openRawWindows(const std::string& path) {
  const auto raw = parseRawName(path);
  if (!raw) {
    Result<HeightFile> tile = readHgt(path);
    if (!tile.ok()) return tile.status();
    return OpenSource(std::make_unique<HgtTile>(path, *std::move(tile)));
  }
  HeightFile described;
  described.width = raw->width;
  described.height = raw->height;
  described.sample = raw->sample;
  const uint64_t wanted = uint64_t{raw->width} * raw->height * tks_sample_bytes(raw->sample);
  std::error_code error;
  const uint64_t there = std::filesystem::file_size(raw->path, error);
  if (error) return Status(TKS_IO, "cannot read " + quoted(raw->path) + ": " + error.message());
  if (wanted == 0 || there != wanted) {
    return Status(TKS_IO, quoted(raw->path) + " holds " + std::to_string(there) +
                              " bytes, and these samples take " + std::to_string(wanted));
  }
  const auto transform = readWorldFile(raw->path);
  if (!transform.ok()) return transform.status();
  described.geotransform = *transform;
  return OpenSource(std::make_unique<RawWindows>(raw->path, std::move(described)));
}

}  // namespace tetrakis::tools
