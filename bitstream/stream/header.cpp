// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/header.hpp"

#include <algorithm>
#include <utility>

#include "bitstream/stream/component_details.hpp"
#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/header_body.hpp"

namespace tetrakis::inline stream {

namespace {

constexpr size_t kChecksumBytes = 4;

}  // namespace

Status needMore(uint64_t bytes) {
  return {TKS_TRUNCATED, "The stream ends inside its header: at least " + std::to_string(bytes) +
                             " bytes are needed."};
}

bool Metadata::isDefault() const {
  return scale == 1 && offset == 0 && spacing_x == 0 && spacing_y == 0 && unit.empty() &&
         vertical_datum.empty() && crs.empty();
}

TrackCounts trackCounts(const StreamHeader& header) {
  TrackCounts counts;
  for (const ListedComponent& one : listOf(header)) {
    TrackCount count{0, one.region_log2 > 0};
    if (one.component == Component::kGeometry)
      count.tracks =
          coefficientTracks(*header.geometry) + correctionTracks(*header.geometry, header.layers);
    if (one.component == Component::kTexture)
      count.tracks = regionCount(header.texture->width, header.texture->height, one.region_log2,
                                 header.texture->wavelet.patches());
    counts.add(one.component, count);
  }
  return counts;
}

Result<uint64_t> headerBytes(std::span<const uint8_t> bytes) {
  const size_t known = std::min(bytes.size(), kMagic.size());
  if (!std::equal(kMagic.begin(), kMagic.begin() + static_cast<ptrdiff_t>(known), bytes.begin())) {
    return Status(TKS_CORRUPT, "This is not a Tetrakis stream: it does not begin with TKS 1A.");
  }
  if (bytes.size() < kFixedBytes + 1) return kFixedBytes + 1;
  if (bytes[4] != kFormatVersion || bytes[5] != kMainProfile) {
    return Status(TKS_UNSUPPORTED, "The stream has format version " + std::to_string(bytes[4]) +
                                       ", profile " + std::to_string(bytes[5]) +
                                       "; this decoder knows version 1, profile 0.");
  }
  FieldReader size_reader(bytes.subspan(kFixedBytes), kFixedBytes);
  const uint64_t body_bytes = size_reader.take();
  if (size_reader.starved()) return bytes.size() + 1;
  if (!size_reader.ok()) return size_reader.status();
  if (body_bytes > kMaxHeaderBytes) {
    return Status(TKS_CORRUPT,
                  "Corrupt stream: the header claims " + std::to_string(body_bytes) + " bytes.");
  }
  return kFixedBytes + size_reader.position() + body_bytes + kChecksumBytes;
}

Result<ParsedHeader> readHeader(std::span<const uint8_t> bytes, const ComponentChoice& choice) {
  const Result<uint64_t> needed = headerBytes(bytes);
  if (!needed.ok()) return needed.status();
  if (bytes.size() < *needed) return needMore(*needed);
  ParsedHeader parsed;
  parsed.bytes = *needed;
  StreamHeader& header = parsed.header;
  header.choice = choice;
  header.version = bytes[4];
  header.profile = bytes[5];
  header.level = bytes[6];
  const size_t crc_start = parsed.bytes - kChecksumBytes;
  uint32_t crc = 0;
  for (size_t i = 0; i < kChecksumBytes; ++i) crc |= uint32_t{bytes[crc_start + i]} << (8 * i);
  if (crc != crc32(bytes.first(crc_start))) {
    return Status(TKS_CORRUPT, "Corrupt stream: the header's checksum does not match.");
  }
  FieldReader size_reader(bytes.subspan(kFixedBytes), kFixedBytes);
  size_reader.take();
  const size_t body_start = kFixedBytes + size_reader.position();
  FieldReader body(bytes.subspan(body_start, crc_start - body_start), body_start);
  visitBody(body, header);
  if (!body.ok()) return body.status();
  if (!has(header, choice)) return Status(TKS_USAGE, "The stream has no such component.");
  if (Status meaning = checkMeaning(header); !meaning.ok()) return meaning;
  if (header.level != levelFor(header)) {
    return Status(TKS_CORRUPT, "Corrupt stream: the level does not fit the sizes.");
  }
  takeDetails(header);
  return parsed;
}

}  // namespace tetrakis::inline stream
