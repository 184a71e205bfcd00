// SPDX-License-Identifier: Apache-2.0
// A pyramid of tiles, each a file of its own, as web maps have them.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "apps/tools/report/viewed_mesh.hpp"
#include "bench/peers/openjpeg_peer.hpp"
#include "bench/peers/raster.hpp"
#include "bench/receivers/transmission_receivers.hpp"
#include "ratecontrol/receiver/ground_sight.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::bench {
namespace {

constexpr uint32_t kTile = 128;    // heights a side
constexpr int kLevels = 3;         // of the pyramid, 0 the finest
constexpr uint64_t kRequest = 60;  // bytes of one

/// Means of 2^level x 2^level samples. Samples beyond the border are those at it.
Raster tileOf(const Raster& whole, int level, uint32_t column, uint32_t row, uint32_t side) {
  Raster tile = {side, side, whole.channels, whole.bits, whole.unit, {}, {}};
  const uint32_t block = 1u << level;
  for (uint32_t y = 0; y < side; ++y) {
    for (uint32_t x = 0; x < side; ++x) {
      for (uint32_t c = 0; c < whole.channels; ++c) {
        uint64_t sum = 0;
        for (uint32_t j = 0; j < block; ++j)
          for (uint32_t i = 0; i < block; ++i) {
            const uint32_t px = std::min((column * side + x) * block + i, whole.width - 1);
            const uint32_t py = std::min((row * side + y) * block + j, whole.height - 1);
            sum += whole.samples[(size_t{py} * whole.width + px) * whole.channels + c];
          }
        const uint64_t count = uint64_t{block} * block;
        tile.samples.push_back(static_cast<uint16_t>((sum + count / 2) / count));
      }
    }
  }
  return tile;
}

/// One file, or two of JPEG 2000, and what came of it.
struct Tile {
  int level = 0;
  uint32_t column = 0, row = 0;
  std::vector<uint8_t> stream, texture_stream;  ///< the latter of JPEG 2000 alone
  uint64_t came = 0;
  std::vector<uint16_t> heights, texels;  ///< decoded, once there is something

  uint64_t bytes() const { return stream.size() + texture_stream.size(); }
};

class TileReceiver : public Receiver {
 public:
  TileReceiver(const Ground& truth, TileCodec codec) : truth_(truth), codec_(codec) {
    low_ = *std::min_element(truth.heights.values.begin(), truth.heights.values.end());
    heights_ = {truth.heights.width, truth.heights.height, 1, 16, truth.step, {}, {}};
    for (const double h : truth.heights.values)
      heights_.samples.push_back(static_cast<uint16_t>(std::lround((h - low_) / truth.step)));
    image_ = imageRaster(truth.image);
    texels_ = kTile * ((image_.width + heights_.width / 2) / heights_.width);
  }

  Status encode(uint64_t bytes, double heights_share) {
    for (int level = kLevels - 1; level >= 0; --level) {
      const uint32_t columns = countOf(heights_.width, level),
                     rows = countOf(heights_.height, level);
      for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) tiles_.push_back({level, x, y, {}, {}, 0, {}, {}});
    }
    const uint64_t each = bytes / tiles_.size();
    for (Tile& tile : tiles_) {
      const Raster heights = tileOf(heights_, tile.level, tile.column, tile.row, kTile);
      const Raster image = tileOf(image_, tile.level, tile.column, tile.row, texels_);
      const Status status = codec_ == TileCodec::kTetrakis
                                ? encodeTetrakis(heights, image, each, tile)
                                : encodeJpeg2000(heights, image, each, heights_share, tile);
      if (!status.ok()) return status;
    }
    return {};
  }

  Result<Exchange> fetch(const Camera& camera, uint64_t bytes) override {
    const std::vector<double> worth = worthOf(camera);
    Exchange exchange;
    while (bytes > 0) {
      size_t best = tiles_.size();
      for (size_t i = 0; i < tiles_.size(); ++i)
        if (tiles_[i].came < tiles_[i].bytes() && worth[i] > 0 &&
            (best == tiles_.size() || worth[i] > worth[best]))
          best = i;
      if (best == tiles_.size()) break;
      Tile& tile = tiles_[best];
      if (tile.came == 0) exchange.control += kRequest;
      const uint64_t taken = std::min(bytes, tile.bytes() - tile.came);
      tile.came += taken;
      bytes -= taken;
      exchange.bytes += taken;
      if (Status status = decode(tile); !status.ok()) return status;
    }
    return exchange;
  }

  bool asks() const override { return true; }

  Result<Ground> shown() const override {
    Ground ground = truth_;
    for (uint32_t y = 0; y < heights_.height; ++y)
      for (uint32_t x = 0; x < heights_.width; ++x)
        ground.heights.values[size_t{y} * heights_.width + x] =
            low_ + truth_.step * valueAt({&Tile::heights, kTile, 1}, x, y, 0);
    const uint32_t channels = image_.channels;
    const Layer texels{&Tile::texels, texels_, channels};
    for (uint32_t y = 0; y < image_.height; ++y)
      for (uint32_t x = 0; x < image_.width; ++x)
        for (uint32_t c = 0; c < channels; ++c)
          ground.image.data[(size_t{y} * image_.width + x) * channels + c] =
              static_cast<std::byte>(std::lround(std::clamp(valueAt(texels, x, y, c), 0.0, 255.0)));
    return ground;
  }

 private:
  static uint32_t countOf(uint32_t side, int level) {
    const uint32_t tile = kTile << level;
    return std::max(1u, (side - 1 + tile - 1) / tile);
  }

  static Status encodeTetrakis(const Raster& heights, const Raster& image, uint64_t bytes,
                               Tile& tile) {
    tks_heights h = makeHeights();
    h.width = h.height = heights.width;
    h.sample = TKS_U16;
    h.scale = heights.unit;
    h.data = heights.samples.data();
    const std::vector<uint8_t> octets(image.samples.begin(), image.samples.end());
    tks_image i = makeImage();
    i.width = i.height = image.width;
    i.channels = image.channels;
    i.sample = TKS_U8;
    i.data = octets.data();
    tks_encode_options options = makeEncodeOptions();
    options.bytes = bytes;
    const Result<Buffer> stream = tetrakis::encode(&h, &i, options);
    if (!stream) return stream.status();
    tile.stream.assign(stream->bytes().begin(), stream->bytes().end());
    return {};
  }

  static Status encodeJpeg2000(const Raster& heights, const Raster& image, uint64_t bytes,
                               double share, Tile& tile) {
    const auto part = static_cast<uint64_t>(share * static_cast<double>(bytes));
    auto h = encodeOpenJpeg(heights, {std::max<uint64_t>(part, 200), 6});
    if (!h.ok()) return h.status();
    auto i = encodeOpenJpeg(image, {bytes - part, 6});
    if (!i.ok()) return i.status();
    tile.stream = std::move(*h);
    tile.texture_stream = std::move(*i);
    return {};
  }

  Status decode(Tile& tile) const {
    if (codec_ == TileCodec::kJpeg2000) {
      if (tile.came < tile.bytes()) return {};
      auto h = decodeOpenJpeg(tile.stream), i = decodeOpenJpeg(tile.texture_stream);
      if (!h.ok() || !i.ok()) return h.ok() ? i.status() : h.status();
      tile.heights = std::move(*h);
      tile.texels = std::move(*i);
      return {};
    }
    Result<Decoder> decoder = Decoder::open(std::span(tile.stream).first(tile.came));
    if (!decoder) return {};  // not even the header
    const auto heights = decoder->heights(), texels = decoder->texture();
    if (!heights || !texels) return heights ? texels.status() : heights.status();
    tile.heights.resize(heights->size() / 2);
    std::memcpy(tile.heights.data(), heights->data(), heights->size());
    tile.texels.clear();
    for (const std::byte b : *texels) tile.texels.push_back(static_cast<uint16_t>(b));
    return {};
  }

  /// Pixels that show a tile, those of coarse levels first.
  std::vector<double> worthOf(const Camera& camera) const {
    const Ground& g = truth_;
    CoarseGround coarse{0, 0, 8, {}};
    for (uint32_t y = 0; y < g.heights.height; y += coarse.step, ++coarse.rows)
      for (uint32_t x = 0; x < g.heights.width; x += coarse.step)
        coarse.heights.push_back(
            static_cast<float>(g.heights.values[size_t{y} * g.heights.width + x]));
    coarse.columns = static_cast<uint32_t>(coarse.heights.size()) / coarse.rows;
    const tks_screen_camera view = tools::meshCamera(camera, g.frame);
    Eye eye{{}, view.width, view.height};
    std::copy_n(view.clip, 16, eye.clip.begin());
    const std::vector<GroundPoint> seen = sightOf(coarse, eye);
    std::vector<double> worth(tiles_.size());
    for (size_t t = 0; t < tiles_.size(); ++t) {
      const uint32_t side = (kTile << tiles_[t].level) / coarse.step;
      for (uint32_t y = tiles_[t].row * side; y < std::min((tiles_[t].row + 1) * side, coarse.rows);
           ++y)
        for (uint32_t x = tiles_[t].column * side;
             x < std::min((tiles_[t].column + 1) * side, coarse.columns); ++x)
          worth[t] += seen[size_t{y} * coarse.columns + x].pixels;
      worth[t] *= std::pow(4, tiles_[t].level);
    }
    return worth;
  }

  const Tile* tileAt(int level, uint32_t column, uint32_t row) const {
    for (const Tile& tile : tiles_)
      if (tile.level == level && tile.column == column && tile.row == row) return &tile;
    return nullptr;
  }

  /// What tiles hold of one component.
  struct Layer {
    std::vector<uint16_t> Tile::*values;
    uint32_t side, channels;  ///< of a tile
  };

  /// Bilinear inside the finest tile that is there; the middle of all values without one.
  double valueAt(const Layer& layer, uint32_t x, uint32_t y, uint32_t channel) const {
    const auto [values, side, channels] = layer;
    for (int level = 0; level < kLevels; ++level) {
      const uint32_t tile_side = side << level;
      const uint32_t column = std::min(x / tile_side, countOf(heights_.width, level) - 1);
      const uint32_t row = std::min(y / tile_side, countOf(heights_.height, level) - 1);
      const Tile* const tile = tileAt(level, column, row);
      if (tile == nullptr || (tile->*values).empty()) continue;
      const double size = 1u << level, most = side - 1.0;
      const double u = std::clamp((x - column * tile_side + 0.5) / size - 0.5, 0.0, most);
      const double v = std::clamp((y - row * tile_side + 0.5) / size - 0.5, 0.0, most);
      const auto at = [&](double px, double py) {
        const auto i = static_cast<size_t>(std::min(py, most)) * layer.side +
                       static_cast<size_t>(std::min(px, most));
        return static_cast<double>((tile->*layer.values)[i * layer.channels + channel]);
      };
      const double fx = u - std::floor(u), fy = v - std::floor(v);
      return (1 - fy) * ((1 - fx) * at(u, v) + fx * at(u + 1, v)) +
             fy * ((1 - fx) * at(u, v + 1) + fx * at(u + 1, v + 1));
    }
    return channels == 1 ? 0.5 * *std::max_element(heights_.samples.begin(), heights_.samples.end())
                         : 128;
  }

  const Ground& truth_;
  TileCodec codec_;
  double low_ = 0;
  Raster heights_, image_;
  uint32_t texels_ = 0;  ///< of a tile, a side
  std::vector<Tile> tiles_;
};

}  // namespace

Result<std::unique_ptr<Receiver>> tileReceiver(const Ground& truth, TileCodec codec, uint64_t bytes,
                                               double heights_share) {
  auto receiver = std::make_unique<TileReceiver>(truth, codec);
  if (Status status = receiver->encode(bytes, heights_share); !status.ok()) return status;
  return std::unique_ptr<Receiver>(std::move(receiver));
}

}  // namespace tetrakis::bench
