// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/page_index.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "bitstream/stream/fields.hpp"
#include "bitstream/track/track.hpp"

namespace tetrakis::inline stream {

namespace {

constexpr uint64_t kMostRecord = uint64_t{1} << 26;
constexpr size_t kSealBytes = 4;
constexpr int64_t kFarthest = int64_t{1} << 32;  ///< from a track to another one

uint64_t pagesAlong(uint64_t regions, int log2) {
  return ((regions - 1) >> log2) + 1;
}

}  // namespace

PageGrid::PageGrid(const GeometryHeader& header, const GeometryLayers& layers, int page_log2)
    : page_log2_(page_log2), coefficients_(coefficientTracks(header)) {
  const std::vector<RegionGroup> groups = regionGroups(header.extent(), header.regions.side_log2);
  for (auto group = groups.rbegin(); group != groups.rend(); ++group) {
    const uint64_t columns = pagesAlong(group->columns, page_log2);
    groups_.push_back({group->first, group->columns, pages_, columns});
    pages_ += columns * pagesAlong(group->rows, page_log2);
  }
  if (!groups.empty()) corrections_ = correctionTracks(header, layers);
}

uint32_t PageGrid::pageOf(uint64_t track) const {
  if (track == 0) return 0;
  const Group* group = &groups_.back();
  uint64_t region = track - coefficients_;
  if (!isCorrection(track)) {
    const auto behind =
        std::upper_bound(groups_.begin(), groups_.end(), track,
                         [](uint64_t number, const Group& g) { return number < g.first_track; });
    group = &*std::prev(behind);
    region = track - group->first_track;
  }
  const uint64_t row = (region / group->columns) >> page_log2_,
                 column = (region % group->columns) >> page_log2_;
  return static_cast<uint32_t>(group->first_page + row * group->page_columns + column);
}

bool takesPages(const StreamHeader& header) {
  return header.components.size() <= 1 && header.geometry && !header.texture &&
         header.geometry->regions.side_log2 > 0;
}

std::optional<PageIndex> PageIndex::of(const ParsedHeader& parsed) {
  const StreamHeader& header = parsed.header;
  if (header.pages.empty() || !takesPages(header) || !header.index.empty()) return std::nullopt;
  FieldReader reader({reinterpret_cast<const uint8_t*>(header.pages.data()), header.pages.size()});
  int page_log2 = 0;
  uint64_t coefficient_bytes = 0;
  reader.u8("page_log2", page_log2, 0, PageGrid::kMostLog2);
  reader.varint("coefficient_bytes", coefficient_bytes, 0, UINT64_MAX >> 1);
  if (!reader.ok()) return std::nullopt;
  PageIndex index(parsed, PageGrid(*header.geometry, header.layers, page_log2));
  const uint64_t pages = index.grid_.pages();
  if (2 * pages > header.pages.size()) return std::nullopt;  // two bytes each at least
  index.coefficient_bytes_ = coefficient_bytes;
  index.begins_ = {index.payload_.end};
  for (uint64_t page = 0; page < pages; ++page) {
    uint64_t bytes = 0;
    uint8_t slope = 0;
    reader.varint("record_bytes", bytes, 0, kMostRecord);
    reader.u8("page_slope", slope, 0, 255);
    index.begins_.push_back(index.begins_.back() + bytes);
    index.slopes_.push_back(slope);
  }
  if (!reader.ok() || reader.position() != header.pages.size()) return std::nullopt;
  index.is_known_.resize(pages);
  index.packets_.resize(pages);
  return index;
}

std::vector<uint32_t> PageIndex::pagesIn(const ByteRange& range) const {
  std::vector<uint32_t> pages;
  const auto after = std::upper_bound(begins_.begin(), begins_.end(), range.begin);
  auto page = static_cast<size_t>(after - begins_.begin());
  for (page -= page > 0 ? 1 : 0; page < slopes_.size() && begins_[page] < range.end; ++page)
    pages.push_back(static_cast<uint32_t>(page));
  return pages;
}

/// Whether no known packet shares bytes with a run.
bool PageIndex::isApart(const ByteRange& run) const {
  const auto next = runs_.lower_bound(run.begin);
  if (next != runs_.end() && next->first < run.end) return false;
  return next == runs_.begin() || std::prev(next)->second <= run.begin;
}

Status PageIndex::take(uint32_t page, std::span<const uint8_t> record) {
  if (isKnown(page)) return {};
  Result<Record> read_record = read(page, record);
  if (!read_record.ok()) return read_record.status();
  auto& [packets, runs] = *read_record;
  for (const ByteRange& run : runs)
    if (!isApart(run))
      return {TKS_CORRUPT, "Corrupt stream: two pages of its index list the same bytes."};
  for (const ByteRange& run : runs) runs_.emplace(run.begin, run.end);
  known_packets_ += packets.size();
  ++known_pages_;
  is_known_[page] = true;
  packets_[page] = std::move(packets);
  return {};
}

std::vector<uint32_t> PageIndex::known() const {
  std::vector<uint32_t> pages;
  for (uint32_t page = 0; page < is_known_.size(); ++page)
    if (is_known_[page]) pages.push_back(page);
  return pages;
}

std::vector<PagedPacket> PageIndex::inOrder(std::span<const uint32_t> pages) const {
  std::vector<PagedPacket> all;
  for (const uint32_t page : pages)
    all.insert(all.end(), packets_[page].begin(), packets_[page].end());
  std::sort(all.begin(), all.end(),
            [](const PagedPacket& a, const PagedPacket& b) { return a.begin < b.begin; });
  return all;
}

namespace {

bool isSealed(std::span<const uint8_t> record) {
  if (record.size() < kSealBytes) return false;
  const std::span<const uint8_t> body = record.first(record.size() - kSealBytes);
  uint32_t crc = 0;
  FieldReader(record.last(kSealBytes)).u32("crc", crc);
  return crc == crc32(body);
}

}  // namespace

Result<PageIndex::Record> PageIndex::read(uint32_t page, std::span<const uint8_t> record) const {
  const auto corrupt = [&] {
    return Status(TKS_CORRUPT, "Corrupt stream: page " + std::to_string(page) +
                                   " of its index, at byte " + std::to_string(begins_[page]) +
                                   ", is damaged.");
  };
  Record result;
  if (record.empty()) return result;  // a page without packets
  if (!isSealed(record)) return corrupt();
  FieldReader reader(record.first(record.size() - kSealBytes), begins_[page]);
  int64_t track = 0;
  while (reader.ok() && reader.position() < record.size() - kSealBytes)
    readRun(reader, page, track, result);
  return reader.ok() ? Result(std::move(result)) : corrupt();
}

/// Packets that touch, behind those of the runs before.
void PageIndex::readRun(FieldReader& reader, uint32_t page, int64_t& track, Record& record) const {
  uint64_t gap = 0, packets = 0;
  reader.varint("run_gap", gap, 0, UINT64_MAX >> 1);
  reader.varint("packets", packets, 1, kMostRecord);
  uint64_t at = (record.runs.empty() ? payload_.begin : record.runs.back().end) + gap;
  ByteRange run{at, at};
  for (uint64_t i = 0; reader.ok() && i < packets; ++i) {
    uint64_t field = 0;
    int64_t step = 0;
    PagedPacket packet;
    reader.varint("index_head", field, 0, UINT64_MAX);
    reader.zigzag("track_step", step, kFarthest);
    reader.u8("index_slope", packet.slope, 0, 255);
    if (!reader.ok()) return;
    track += step;
    packet.head = headOf(field, counts_);
    const bool is_there = run.end < payload_.end && packet.head.component == Component::kGeometry &&
                          packet.head.length > 0 && track >= 0 &&
                          static_cast<uint64_t>(track) < grid_.tracks() &&
                          grid_.pageOf(static_cast<uint64_t>(track)) == page;
    reader.require("index_head", is_there);
    if (!is_there) return;
    packet.head.track = static_cast<uint32_t>(track);
    packet.begin = run.end;
    packet.payload = packet.begin + headSize(packet.head, counts_);
    run.end = packet.end();
    record.packets.push_back(packet);
  }
  record.runs.push_back(run);
}

}  // namespace tetrakis::inline stream
