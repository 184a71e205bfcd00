// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/report/pair_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "apps/tools/files/stream.hpp"

namespace tetrakis::tools {
namespace {

/// Bytes of a track that are looked at, rising; the last is all of it.
std::vector<uint64_t> ratesOf(uint64_t all, const PlaneGrid& grid) {
  constexpr double kFewest = 64;
  const auto bytes = static_cast<double>(all);
  const double span = std::max(1.0, bytes / kFewest);
  const auto most = static_cast<double>(std::max<size_t>(2, grid.most) - 1);
  const double needed = std::pow(span, 1 / most);
  const double ratio = std::max(1.0001, grid.ratio > 0 ? grid.ratio : needed);
  const double steps = std::min(std::floor(std::log(span) / std::log(ratio) + 1e-9), most);
  std::vector<uint64_t> rates;
  for (double step = steps; step >= 0; --step) {
    const auto rate = static_cast<uint64_t>(std::llround(bytes / std::pow(ratio, step)));
    if (rates.empty() || rate > rates.back()) rates.push_back(rate);
  }
  return rates;
}

/// Squared error, of any unit.
double squareOf(double psnr) {
  return std::isinf(psnr) ? 0 : std::pow(10, -psnr / 10);
}

SeenPair pairAt(const PairPlane& plane, size_t height, size_t texture) {
  return {{plane.heights[height], plane.textures[texture]}, plane.at(height, texture)};
}

/// What a byte between two pairs takes off the error.
double slope(const SeenPair& few, const SeenPair& many) {
  const auto bytes = static_cast<double>(many.split.total() - few.split.total());
  return (squareOf(few.psnr) - squareOf(many.psnr)) / bytes;
}

std::vector<SeenPair> hullOf(const PairPlane& plane) {
  std::vector<SeenPair> pairs;
  for (size_t h = 0; h < plane.heights.size(); ++h)
    for (size_t t = 0; t < plane.textures.size(); ++t) pairs.push_back(pairAt(plane, h, t));
  std::sort(pairs.begin(), pairs.end(), [](const SeenPair& a, const SeenPair& b) {
    return std::pair(a.split.total(), -a.psnr) < std::pair(b.split.total(), -b.psnr);
  });
  std::vector<SeenPair> hull;
  for (const SeenPair& pair : pairs) {
    if (!hull.empty() &&
        (pair.psnr <= hull.back().psnr || pair.split.total() == hull.back().split.total()))
      continue;
    while (hull.size() > 1 && slope(hull[hull.size() - 2], hull.back()) <= slope(hull.back(), pair))
      hull.pop_back();
    hull.push_back(pair);
  }
  return hull;
}

/// The shipped order at numbers of bytes a tenth apart.
std::vector<Split> shippedPath(const SplitStream& tracks) {
  constexpr double kApart = 1.1, kFewest = 96;
  const uint64_t all = tracks.most().total();
  std::vector<Split> path;
  for (double bytes = kFewest; bytes < static_cast<double>(all); bytes *= kApart)
    path.push_back(tracks.shipped(static_cast<uint64_t>(bytes)));
  path.push_back(tracks.shipped(all));
  return path;
}

}  // namespace

PairPlane withPaths(PairPlane plane) {
  plane.hull = hullOf(plane);
  plane.greedy.clear();
  size_t h = plane.heights.size() - 1, t = plane.textures.size() - 1;
  std::set<std::pair<size_t, size_t>> looked = {{h, t}};
  plane.greedy.push_back(pairAt(plane, h, t));
  while (h > 0 || t > 0) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    double fewer_heights = kNever, fewer_texels = kNever;
    if (h > 0) {
      looked.insert({h - 1, t});
      fewer_heights = slope(pairAt(plane, h - 1, t), plane.greedy.back());
    }
    if (t > 0) {
      looked.insert({h, t - 1});
      fewer_texels = slope(pairAt(plane, h, t - 1), plane.greedy.back());
    }
    --(fewer_heights <= fewer_texels ? h : t);
    plane.greedy.push_back(pairAt(plane, h, t));
  }
  plane.looked = looked.size();
  return plane;
}

namespace {

/// Decoders of rising bytes of one track, each of which goes on from the one before.
class GrowingTrackDecoder {
 public:
  /// most: what the stream holds, of one component.
  GrowingTrackDecoder(const SplitStream& tracks, const Split& most)
      : stream_(tracks.cut(most)), most_(most.total()) {}

  Result<Decoder*> decoderOf(uint64_t bytes) {
    const auto prefix = std::span(stream_).first(stream_.size() - (most_ - bytes));
    if (decoder_) {
      if (Status grown = decoder_->append(prefix.subspan(size_)); !grown.ok()) return grown;
    } else {
      Result<Decoder> opened = openDecoder(prefix);
      if (!opened) return opened.status();
      decoder_.emplace(std::move(*opened));
    }
    size_ = prefix.size();
    return &*decoder_;
  }

 private:
  std::vector<uint8_t> stream_;
  uint64_t most_;
  std::optional<Decoder> decoder_;
  size_t size_ = 0;
};

Result<std::vector<ImageFile>> texturesOf(const SplitStream& tracks,
                                          const std::vector<uint64_t>& rates) {
  GrowingTrackDecoder growing(tracks, {0, tracks.most().texture});
  std::vector<ImageFile> textures;
  for (const uint64_t bytes : rates) {
    const Result<Decoder*> decoder = growing.decoderOf(bytes);
    if (!decoder.ok()) return decoder.status();
    const uint64_t copies = imageBytes((*decoder)->info()) * rates.size();
    Result<ImageFile> texture = decodeImage(**decoder, {}, copies);
    if (!texture.ok()) return texture.status();
    textures.push_back(std::move(*texture));
  }
  return textures;
}

/// Draws each surface with all textures.
Status drawApart(Comparer& comparer, const SplitStream& tracks, uint32_t triangles,
                 const PlaneProgress& progress, PairPlane& plane) {
  const Result<std::vector<ImageFile>> textures = texturesOf(tracks, plane.textures);
  if (!textures.ok()) return textures.status();
  if (Status taken = comparer.takeTextures(*textures); !taken.ok()) return taken;
  GrowingTrackDecoder growing(tracks, {tracks.most().heights, 0});
  for (const uint64_t heights : plane.heights) {
    const Result<Decoder*> decoder = growing.decoderOf(heights);
    if (!decoder.ok()) return decoder.status();
    const Result<std::vector<double>> psnr = comparer.psnrWithEach(**decoder, triangles);
    if (!psnr.ok()) return psnr.status();
    plane.psnr.insert(plane.psnr.end(), psnr->begin(), psnr->end());
    progress(static_cast<double>(plane.psnr.size()) / static_cast<double>(plane.pairs()));
  }
  return comparer.takeTextures({});
}

/// Draws each pair by itself.
Status drawTogether(Comparer& comparer, const SplitStream& tracks, uint32_t triangles,
                    const PlaneProgress& progress, PairPlane& plane) {
  for (const uint64_t heights : plane.heights)
    for (const uint64_t texture : plane.textures) {
      const Result<Measurement> seen = comparer.measure(tracks.cut({heights, texture}), triangles);
      if (!seen.ok()) return seen.status();
      plane.psnr.push_back(seen->screen_psnr.value_or(0));
      progress(static_cast<double>(plane.psnr.size()) / static_cast<double>(plane.pairs()));
    }
  return Status();
}

}  // namespace

Result<PairPlane> lookAtPairs(Comparer& comparer, const SplitStream& tracks, const PlaneGrid& grid,
                              uint32_t triangles, const PlaneProgress& progress) {
  PairPlane plane;
  plane.heights = ratesOf(tracks.most().heights, grid);
  plane.textures = ratesOf(tracks.most().texture, grid);
  const auto draw = comparer.drawsApart(triangles) ? drawApart : drawTogether;
  if (Status status = draw(comparer, tracks, triangles, progress, plane); !status.ok())
    return status;
  plane.shipped = shippedPath(tracks);
  return withPaths(std::move(plane));
}

}  // namespace tetrakis::tools
