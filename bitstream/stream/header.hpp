// SPDX-License-Identifier: Apache-2.0
// StreamHeader is the header of a stream (docs/FORMAT.md, section 2). A decoder can size everything
// from it before it allocates anything.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/forest.hpp"
#include "base/plane.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/stream/georeference.hpp"
#include "bitstream/stream/packet.hpp"
#include "bitstream/stream/texture_header.hpp"
#include "bitstream/stream/triangle_mesh_header.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline stream {

inline constexpr std::array<uint8_t, 4> kMagic = {'T', 'K', 'S', 0x1a};
inline constexpr uint8_t kFormatVersion = 1;
inline constexpr uint8_t kMainProfile = 0;
inline constexpr uint32_t kMaxHeaderBytes = 1u << 26;

/// What the heights mean on the ground.
struct Metadata {
  double scale = 1, offset = 0;  ///< height in the unit = sample * scale + offset
  double spacing_x = 0, spacing_y = 0;
  std::string unit, vertical_datum, crs;

  bool isDefault() const;

  /// What most streams leave out comes last.
  template <class V>
  void visit(V& v) {
    const auto text = [&](const char* name, std::string& value) {
      v.unless(std::string(), value, [&] { v.text(name, value); });
    };
    const auto number = [&](const char* name, double usual, double& value) {
      v.unless(usual, value, [&] { v.f64(name, value); });
    };
    text("unit", unit);
    text("crs", crs);
    number("spacing_x", 0, spacing_x);
    number("spacing_y", spacing_x, spacing_y);
    v.require("spacing", spacing_x >= 0 && spacing_y >= 0);
    text("vertical_datum", vertical_datum);
    number("scale", 1, scale);
    v.require("scale", scale != 0);
    number("offset", 0, offset);
  }
};

/// Ground that components are sampled on. Streams share one between components of the same samples.
struct Domain {
  static constexpr uint8_t kGrid = 0;
  static constexpr uint8_t kCylinder = 1;  ///< a grid whose last column lies beside its first one
  static constexpr uint8_t kForest = 2;    ///< patches, in a raster one below the other
  /// In streams alone: a forest whose sides are glued as those of a domain before it.
  static constexpr uint8_t kForestAlike = 3;

  uint8_t kind = kGrid;      ///< others are not known: components on them are passed over
  Extent grid = {0, 0};      ///< of those that are known: columns and rows
  SharedForest forest = {};  ///< of a forest alone
  uint64_t number = 0;       ///< of others, which are told apart by it: as it was read

  bool isKnown() const { return kind <= kForest; }
  bool operator==(const Domain& other) const {
    return kind == other.kind && grid == other.grid && number == other.number &&
           sameForest(forest, other.forest);
  }
};

/// What a component says of itself that its samples do not depend on. Of the first heights and the
/// first texture of a stream the body has all of it but the name.
struct ComponentDetails {
  std::string name;
  Metadata metadata;        ///< of heights
  Georeference place;       ///< of heights, or of a texture
  uint8_t lossless = 0;     ///< the complete stream restores every sample of the component
  std::string later_parts;  ///< of kinds that are not known and inform, as they were read

  bool none() const {
    return name.empty() && metadata.isDefault() && !place.hasHeights() && !place.hasTexture() &&
           lossless == 0 && later_parts.empty();
  }
};

/// What every component of the header's list begins with, whoever knows its kind.
struct ListedComponent {
  Component component = Component::kOther;
  uint8_t kind = 0;  ///< as the stream has it: kHeights, kColours, or not known
  Domain domain;
  uint8_t region_log2 = 0;  ///< RegionHeader::side_log2
  std::string rest;         ///< of kOther: all behind the domain, or behind its unknown kind
  ComponentDetails details = {};

  static constexpr uint8_t kHeights = 0, kColours = 1;
  bool isHeights() const { return kind == kHeights && domain.isKnown(); }
  bool isTexture() const { return kind == kColours && domain.isKnown(); }
};

/// Which components are taken for the heights and for the texture, by their numbers in the header's
/// list: those that are chosen, else the first of each kind.
struct ComponentChoice {
  std::optional<size_t> heights, texture;
};

struct StreamHeader {
  uint8_t version = kFormatVersion;
  uint8_t profile = kMainProfile;
  uint8_t level = 0;
  uint64_t payload_bytes = 0;  ///< what the encoder wrote behind the header
  std::string sketch;    ///< a stream that shows the same in fewer bytes (sketch.hpp); empty: none
  uint8_t lossless = 0;  ///< the complete stream restores every sample
  /// crc32() of the payload, by which a complete stream that promises something is known to be
  /// whole.
  std::optional<uint32_t> payload_crc;
  uint32_t triangles = 0;  ///< budget the stream was made for; 0: none
  std::optional<GeometryHeader> geometry;
  GeometryLayers layers;
  std::optional<TextureHeader> texture;
  TriangleMeshHeader triangle_mesh;  ///< an object that is not heights, which the texture lies on
  Metadata metadata;
  Georeference georeference;
  std::vector<IndexEntry> index;  ///< of all packets, ahead of time
  std::string pages;  ///< root of an index in pages (page_index.hpp), unchecked; empty: none
  /// GroundPositions as bytes; empty: none. No status depends on them.
  std::string height_positions, texture_positions;
  /// The grid that heights on a forest were resampled from; no samples: none.
  Extent grid = {0, 0};
  std::string material;     ///< of an object: JSON, as glTF has it, but not checked; empty: none
  std::string later_parts;  ///< of kinds that are not known and inform, as they were read
  /// In the stream's order: of a header that was read. Of one that is made heights come before the
  /// texture, unless their order is stated here.
  std::vector<ListedComponent> components;
  std::string later_details;  ///< of what details are not known and inform, as they were read
  ComponentChoice choice;     ///< by which the header was read
};

/// Components and their tracks; see demultiplex().
TrackCounts trackCounts(const StreamHeader& header);

/// (Encoder) magic, version, profile, level, size of the body, body, CRC-32 of everything before
/// it. A long index may make more than kMaxHeaderBytes, which no decoder reads; encoders refuse it.
std::vector<uint8_t> writeHeader(const StreamHeader& header);

struct ParsedHeader {
  StreamHeader header;
  size_t bytes = 0;  ///< header bytes: the payload starts here
};

/// How many bytes the header takes. If `bytes` ends before that is known: a smaller number, but
/// greater than bytes.size(). TKS_CORRUPT, TKS_UNSUPPORTED.
Result<uint64_t> headerBytes(std::span<const uint8_t> bytes);

/// TKS_TRUNCATED: a header ends early, and needs so many bytes at least.
Status needMore(uint64_t bytes);

/// TKS_TRUNCATED with the number of bytes needed if `bytes` ends early; TKS_CORRUPT,
/// TKS_UNSUPPORTED. Metadata, place and promise of a chosen component that is not the first of its
/// kind are its own; the header of such a choice is not for writing.
Result<ParsedHeader> readHeader(std::span<const uint8_t> bytes, const ComponentChoice& choice = {});

// checkMeaning() refuses a header whose fields contradict each other, once all fields are read; the
// range of each is checked while it is read. A stream with a part that this decoder does not know
// but must know is refused before that, as unsupported (docs/FORMAT.md, section 2, Statuses).

/// TKS_CORRUPT where a header says what no stream can hold.
Status checkMeaning(const StreamHeader& header);

// crc32() computes the checksum of headers, and of the payloads of streams that promise exact
// samples or a largest error; Crc32 that of bytes which come piece by piece.

/// CRC-32 as in PNG and zip: polynomial EDB88320 reflected, initial and final xor FFFFFFFF.
class Crc32 {
 public:
  void add(std::span<const uint8_t> bytes);
  uint32_t value() const { return ~crc_; }

 private:
  uint32_t crc_ = 0xffffffff;
};
uint32_t crc32(std::span<const uint8_t> bytes);

}  // namespace tetrakis::inline stream
