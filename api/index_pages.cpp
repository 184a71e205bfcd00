// SPDX-License-Identifier: Apache-2.0
#include "api/index_pages.hpp"

namespace tetrakis::inline api {

namespace {

/// The bytes of a decoder from a place of the stream on, up to the first that is missing.
std::span<const uint8_t> bytesFrom(const tks_decoder& decoder, uint64_t place) {
  if (!decoder.pieces.empty()) return decoder.pieces.from(place);
  return decoder.data.subspan(std::min<uint64_t>(place, decoder.data.size()));
}

/// The bytes of the record of a page that are there.
std::span<const uint8_t> recordOf(const tks_decoder& decoder, uint32_t page) {
  const ByteRange record = decoder.pages->record(page);
  const std::span<const uint8_t> there = bytesFrom(decoder, record.begin);
  return there.first(std::min<uint64_t>(there.size(), record.end - record.begin));
}

bool isThere(const tks_decoder& decoder, uint32_t page) {
  const ByteRange record = decoder.pages->record(page);
  return recordOf(decoder, page).size() == record.end - record.begin;
}

}  // namespace

Result<std::vector<uint32_t>> takeRecords(tks_decoder& decoder, std::span<const ByteRange> ranges) {
  std::vector<uint32_t> fresh;
  if (!decoder.pages) return fresh;
  for (const ByteRange& range : ranges) {
    for (const uint32_t page : decoder.pages->pagesIn(range)) {
      if (decoder.pages->isKnown(page) || !isThere(decoder, page)) continue;
      if (Status status = decoder.pages->take(page, recordOf(decoder, page)); !status.ok())
        return status;
      fresh.push_back(page);
    }
  }
  return fresh;
}

namespace {

/// Between two records that are nearer to each other, the bytes cost less than another request.
constexpr uint64_t kNear = 32 << 10;

void addNear(const ByteRange& record, std::vector<ByteRange>& ranges) {
  if (!ranges.empty() && record.begin - ranges.back().end <= kNear)
    ranges.back().end = record.end;
  else
    ranges.push_back(record);
}

/// Takes records that came before anybody needed them, and what is there of their packets.
Status takeEarlier(tks_decoder& decoder, std::span<const ByteRange> records) {
  if (records.empty()) return {};
  if (decoder.pieces.empty()) return takeRecords(decoder, records).status();
  const uint64_t before = decoder.packets.payload.bytes[0];
  const Status status = takeMorePackets(decoder, records);
  if (!status.ok()) decoder.refused = Status(status);
  if (decoder.packets.payload.bytes[0] != before) decoder.heights.reset();
  return status;
}

}  // namespace

Result<std::vector<ByteRange>> lackingRecords(tks_decoder& decoder,
                                              const std::vector<bool>& needed) {
  std::vector<ByteRange> lacking;
  if (!decoder.pages) return lacking;
  std::vector<bool> seen(decoder.pages->grid().pages());
  for (uint32_t track = 0; track < needed.size(); ++track) {
    if (needed[track]) seen[decoder.pages->grid().pageOf(track)] = true;
  }
  std::vector<ByteRange> there;
  for (uint32_t page = 0; page < seen.size(); ++page) {
    if (!seen[page] || decoder.pages->isKnown(page)) continue;
    if (isThere(decoder, page))
      there.push_back(decoder.pages->record(page));
    else
      addNear(decoder.pages->record(page), lacking);
  }
  if (Status status = takeEarlier(decoder, there); !status.ok()) return status;
  return lacking;
}

}  // namespace tetrakis::inline api
