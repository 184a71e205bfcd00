// SPDX-License-Identifier: Apache-2.0
// PageIndex tells where the packets of a large plane lie, page by page, so that a window of it is
// found without the index of the rest (docs/FORMAT.md, section 2, Index pages). The header has the
// root, which says how long the record of each page is. The records lie behind the payload: whoever
// looks at a window reads those of its regions, and a cut stream decodes without them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/header.hpp"
#include "bitstream/stream/pieces.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline stream {

// PageGrid divides the tracks of heights into pages: squares of regions of one group, and with the
// finest regions their corrections.

class PageGrid {
 public:
  static constexpr int kMostLog2 = 16;

  /// page_log2: of the regions along the side of a page, at most kMostLog2.
  PageGrid(const GeometryHeader& header, const GeometryLayers& layers, int page_log2);

  uint64_t pages() const { return pages_; }
  uint64_t tracks() const { return coefficients_ + corrections_; }
  bool isCorrection(uint64_t track) const { return track >= coefficients_; }
  /// track: below tracks().
  uint32_t pageOf(uint64_t track) const;

 private:
  struct Group {
    uint64_t first_track, columns;      ///< of regions
    uint64_t first_page, page_columns;  ///< of pages
  };

  std::vector<Group> groups_;  ///< the coarsest first, as tracks are numbered
  int page_log2_;
  uint64_t coefficients_, corrections_ = 0, pages_ = 1;
};

/// Whether a stream may have index pages: its only component is heights in regions.
bool takesPages(const StreamHeader& header);

/// A packet that the record of a page lists. Records do not state qualities.
struct PagedPacket {
  uint64_t begin = 0;    ///< of its head, in the stream
  uint64_t payload = 0;  ///< behind its head
  PacketHead head;
  uint8_t slope = 0;  ///< as of IndexEntry

  uint64_t end() const { return payload + head.length; }
};

class PageIndex {
 public:
  /// Of a header that was read; nothing where it has no root, or one of another form.
  static std::optional<PageIndex> of(const ParsedHeader& parsed);

  const PageGrid& grid() const { return grid_; }
  /// Bytes of all packets' payloads of coefficient tracks, with what opens these.
  uint64_t coefficientBytes() const { return coefficient_bytes_; }
  /// Where the record of a page lies in the stream, and where all of them do.
  ByteRange record(uint32_t page) const { return {begins_[page], begins_[page + 1]}; }
  ByteRange records() const { return {begins_.front(), begins_.back()}; }
  /// The greatest slope of a page's packets.
  uint8_t slope(uint32_t page) const { return slopes_[page]; }
  /// The pages whose records have bytes in a range of the stream.
  std::vector<uint32_t> pagesIn(const ByteRange& range) const;

  bool isKnown(uint32_t page) const { return is_known_[page]; }
  bool knowsTrack(uint64_t track) const { return isKnown(grid_.pageOf(track)); }
  /// Takes the bytes of a record. TKS_CORRUPT: it is damaged, or lists packets that cannot be
  /// there; then nothing changes.
  Status take(uint32_t page, std::span<const uint8_t> record);
  /// What the record lists, in the order of the stream; nothing of one that is not known.
  const std::vector<PagedPacket>& packets(uint32_t page) const { return packets_[page]; }
  std::vector<uint32_t> known() const;
  uint64_t knownPages() const { return known_pages_; }
  uint64_t knownPackets() const { return known_packets_; }
  /// The packets of some pages, in the order of the stream.
  std::vector<PagedPacket> inOrder(std::span<const uint32_t> pages) const;
  /// What this allocates.
  uint64_t bytes() const {
    constexpr uint64_t kPage = sizeof(uint64_t) + 2 + sizeof(std::vector<PagedPacket>);
    constexpr uint64_t kNode = 64;
    return slopes_.size() * kPage + known_packets_ * (3 * sizeof(PagedPacket) + kNode);
  }

 private:
  PageIndex(const ParsedHeader& parsed, PageGrid grid)
      : payload_{parsed.bytes, parsed.bytes + parsed.header.payload_bytes},
        counts_(trackCounts(parsed.header)),
        grid_(std::move(grid)) {}

  /// What a record lists; runs: of packets that touch.
  struct Record {
    std::vector<PagedPacket> packets;
    std::vector<ByteRange> runs;
  };
  Result<Record> read(uint32_t page, std::span<const uint8_t> record) const;
  void readRun(FieldReader& reader, uint32_t page, int64_t& track, Record& record) const;
  bool isApart(const ByteRange& run) const;

  ByteRange payload_;  ///< of the stream
  TrackCounts counts_;
  PageGrid grid_;
  uint64_t coefficient_bytes_ = 0;
  std::vector<uint64_t> begins_;  ///< of each record, and the end of the last one
  std::vector<uint8_t> slopes_;
  std::vector<bool> is_known_;                     ///< by page, ...
  std::vector<std::vector<PagedPacket>> packets_;  ///< ... as these
  std::map<uint64_t, uint64_t> runs_;  ///< begin and end of those of all records that are known
  uint64_t known_packets_ = 0, known_pages_ = 0;
};

// writePages() makes root and records of the packets of a stream.

/// Of the regions along the side of a page, unless the root would become long: larger pages have
/// longer records, smaller ones are more.
inline constexpr int kUsualPageLog2 = 3;

struct WrittenPages {
  std::string root;              ///< StreamHeader::pages
  std::vector<uint8_t> records;  ///< what follows the payload
};

/// (Encoder) index: of all packets, in the order of the payload. header: takesPages(), with
/// payload_bytes.
WrittenPages writePages(const StreamHeader& header, std::span<const IndexEntry> index);

}  // namespace tetrakis::inline stream
