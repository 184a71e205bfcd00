// SPDX-License-Identifier: Apache-2.0
#include "api/renderer_bound.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bitstream/stream/packet.hpp"
#include "bitstream/stream/scattered_packets.hpp"

namespace tetrakis::inline api {

namespace {

struct MeshCorner {
  double x, y, height;
};

double doubledArea(const MeshCorner& a, const MeshCorner& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/// Squared errors of the triangles of a mesh at the samples that they cover. Samples on common
/// sides count once for each triangle.
class MeshSquares {
 public:
  MeshSquares(std::span<const float> surface, uint32_t width) : surface_(surface), width_(width) {}

  void add(const tks_mesh& mesh) {
    for (uint32_t t = 0; t < mesh.triangle_count; ++t) {
      const auto corner = [&](int i) {
        const uint32_t v = mesh.triangles[3 * size_t{t} + i], at = mesh.grid_index[v];
        return MeshCorner{static_cast<double>(at % width_), static_cast<double>(at / width_),
                          mesh.height[v]};
      };
      add(corner(0), corner(1), corner(2));
    }
  }
  double mean() const { return count_ > 0 ? sum_ / static_cast<double>(count_) : 0; }

 private:
  void add(const MeshCorner& a, const MeshCorner& b, const MeshCorner& c) {
    const double area = doubledArea(a, b, c.x, c.y);
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
    for (double y = top; y <= bottom; ++y) {
      for (double x = left; x <= right; ++x) {
        const double at_a = doubledArea(b, c, x, y) / area, at_b = doubledArea(c, a, x, y) / area;
        const double at_c = 1 - at_a - at_b;
        if (at_a < 0 || at_b < 0 || at_c < 0) continue;
        const float truth = surface_[static_cast<size_t>(y) * width_ + static_cast<size_t>(x)];
        const double error = at_a * a.height + at_b * b.height + at_c * c.height - truth;
        if (std::isnan(error)) continue;
        sum_ += error * error;
        ++count_;
      }
    }
  }

  std::span<const float> surface_;
  uint32_t width_;
  double sum_ = 0;
  uint64_t count_ = 0;
};

/// A packet of a stream, and its place.
struct PlacedHead {
  PacketHead head;
  uint64_t begin = 0, end = 0;
};

/// Of those that have begun; in a stream with an index, of all.
std::vector<PlacedHead> headsOf(const ParsedHeader& parsed, std::span<const uint8_t> bytes) {
  std::vector<PlacedHead> placed;
  if (!parsed.header.index.empty()) {
    for (const IndexedPacket& packet : IndexedPackets(parsed.header, parsed.bytes))
      placed.push_back({packet.entry.packet, packet.begin, packet.end});
    return placed;
  }
  Demultiplexed taken;
  taken.counts = trackCounts(parsed.header);
  if (bytes.size() < parsed.bytes ||
      !passHeads(bytes.subspan(parsed.bytes), parsed.bytes, taken).ok())
    return placed;
  uint64_t at = parsed.bytes;
  for (const PacketHead& head : taken.heads) {
    const uint64_t end = at + headSize(head, taken.counts) + head.length;
    placed.push_back({head, at, end});
    at = end;
  }
  return placed;
}

}  // namespace

Result<double> meshError(tks_decoder& decoder, uint32_t max_triangles) {
  tks_info info = {};
  info.size = sizeof info;
  tks_status status = tks_get_info(&decoder, &info);
  std::vector<float> surface(size_t{info.width} * info.height);
  if (status == TKS_OK) status = tks_decode_surface(&decoder, surface.data(), surface.size());
  tks_mesh mesh = {};
  if (status == TKS_OK) status = tks_decode_mesh(&decoder, TKS_MESH_BUDGET, max_triangles, &mesh);
  if (status != TKS_OK) return Status(status, tks_message(&decoder));
  MeshSquares squares(surface, info.width);
  squares.add(mesh);
  tks_free_mesh(&mesh);
  return std::sqrt(squares.mean());
}

ByteRanges beyondError(const ParsedHeader& parsed, std::span<const uint8_t> bytes, double error) {
  ByteRanges beyond;
  const StreamHeader& header = parsed.header;
  if (!header.geometry) return beyond;
  const double unit = header.geometry->step * std::abs(header.metadata.scale);
  bool reached = false;
  uint64_t last = parsed.bytes;  // the end of what is shown
  for (const PlacedHead& packet : headsOf(parsed, bytes)) {
    const bool is_heights = packet.head.component == Component::kGeometry;
    if (reached && is_heights)
      beyond.add({packet.begin, packet.end});
    else
      last = packet.end;
    reached |= is_heights && rmseOf(packet.head.quality) * unit <= error;
  }
  if (!header.index.empty()) return beyond;
  ByteRanges behind;
  behind.add({last, parsed.bytes + header.payload_bytes});
  return behind;
}

}  // namespace tetrakis::inline api
