// SPDX-License-Identifier: Apache-2.0
// writePages() makes the index pages of a stream.
#include <algorithm>
#include <utility>

#include "bitstream/stream/page_index.hpp"

namespace tetrakis::inline stream {

namespace {

/// The record of a page while it grows.
struct GrowingRecord {
  FieldWriter fields;  ///< of the runs that have ended
  FieldWriter run;     ///< packets of the last one
  uint64_t run_packets = 0;
  uint64_t run_begin = 0, run_end = 0, last_end = 0;  ///< in the payload
  int64_t track = 0;
  uint8_t slope = 0;

  void add(const IndexEntry& entry, uint64_t begin, uint64_t end, const TrackCounts& counts) {
    if (begin != run_end || run_packets == 0) {
      endRun();
      run_begin = begin;
    }
    run.put(fieldOf(entry.packet, counts));
    int64_t step = static_cast<int64_t>(entry.packet.track) - track;
    run.zigzag("track_step", step, step);
    run.bytes.push_back(entry.slope);
    ++run_packets;
    run_end = end;
    track += step;
    slope = std::max(slope, entry.slope);
  }

  void endRun() {
    if (run_packets == 0) return;
    fields.put(run_begin - last_end);
    fields.put(run_packets);
    fields.bytes.insert(fields.bytes.end(), run.bytes.begin(), run.bytes.end());
    last_end = run_end;
    run_packets = 0;
    run.bytes.clear();
  }

  std::vector<uint8_t> sealed() && {
    endRun();
    if (!fields.bytes.empty()) fields.u32("crc", crc32(fields.bytes));
    return std::move(fields.bytes);
  }
};

/// How many pages a root of three bytes for each may have.
constexpr uint64_t kMostPages = 5000;

PageGrid gridFor(const StreamHeader& header, int& page_log2) {
  for (page_log2 = kUsualPageLog2;; ++page_log2) {
    PageGrid grid(*header.geometry, header.layers, page_log2);
    if (grid.pages() <= kMostPages || page_log2 == PageGrid::kMostLog2) return grid;
  }
}

}  // namespace

WrittenPages writePages(const StreamHeader& header, std::span<const IndexEntry> index) {
  const uint64_t payload_bytes = header.payload_bytes;
  int page_log2 = 0;
  const PageGrid grid = gridFor(header, page_log2);
  const TrackCounts counts = trackCounts(header);
  std::vector<GrowingRecord> growing(grid.pages());
  uint64_t at = 0, coefficient_bytes = 0;
  for (const IndexEntry& entry : index) {
    if (at >= payload_bytes) break;
    const PacketHead& head = entry.packet;
    const uint64_t payload = at + headSize(head, counts), end = payload + head.length;
    growing[grid.pageOf(head.track)].add(entry, at, end, counts);
    if (!grid.isCorrection(head.track))
      coefficient_bytes += std::min(end, payload_bytes) - std::min(payload, payload_bytes);
    at = end;
  }
  FieldWriter root;
  root.u8("page_log2", page_log2, 0, PageGrid::kMostLog2);
  root.put(coefficient_bytes);
  WrittenPages written;
  for (GrowingRecord& page : growing) {
    const uint8_t slope = page.slope;
    const std::vector<uint8_t> record = std::move(page).sealed();
    root.put(record.size());
    root.bytes.push_back(slope);
    written.records.insert(written.records.end(), record.begin(), record.end());
  }
  written.root.assign(root.bytes.begin(), root.bytes.end());
  return written;
}

}  // namespace tetrakis::inline stream
