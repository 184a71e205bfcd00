// SPDX-License-Identifier: Apache-2.0
#include "encoder/mosaic/part.hpp"

#include <algorithm>
#include <cassert>
#include <string>

#include "base/bit_plane.hpp"

namespace tetrakis::inline mosaic {

ByteReader ByteReader::unsealed(std::span<const uint8_t> bytes) {
  ByteReader none({});
  none.ok_ = false;
  if (bytes.size() < sizeof(uint32_t)) return none;
  const std::span<const uint8_t> body = bytes.first(bytes.size() - sizeof(uint32_t));
  if (ByteReader(bytes.last(sizeof(uint32_t))).number<uint32_t>() != crc32(body)) return none;
  return ByteReader(body);
}

namespace {

// A part:   opening, length of the table, CRC of both; table, CRC of it; codewords
// A low:    opening, width, height, mask, values; CRC of all
// Opening:  magic, hash of the plan, group, column, row

constexpr std::array<uint8_t, 4> kPartMagic = {'T', 'K', 'P', 2}, kLowMagic = {'T', 'K', 'L', 1};

void writeOpening(ByteWriter& out, std::span<const uint8_t> magic, uint32_t plan,
                  const Tile& tile) {
  out.append(magic);
  out.number(plan);
  out.number(static_cast<uint32_t>(tile.group));
  out.number(tile.column);
  out.number(tile.row);
}

constexpr size_t kOpeningBytes = 20;

bool passOpening(ByteReader& in, std::span<const uint8_t> magic, uint32_t plan, const Tile& tile) {
  const std::span<const uint8_t> found = in.take(magic.size());
  if (!in.ok() || !std::equal(magic.begin(), magic.end(), found.begin())) return false;
  const bool of_plan = in.number<uint32_t>() == plan;
  const auto group = static_cast<int>(in.number<uint32_t>());
  const auto column = in.number<uint32_t>(), row = in.number<uint32_t>();
  return in.ok() && of_plan && Tile{group, column, row} == tile;
}

enum class MaskKind : uint8_t { kAll = 0, kBits = 1 };

void writeMask(ByteWriter& out, const PartMask& valid) {
  out.number(valid.empty() ? MaskKind::kAll : MaskKind::kBits);
  for (size_t i = 0; i < valid.size(); i += 8) {
    uint8_t bits = 0;
    for (size_t k = i; k < std::min(i + 8, valid.size()); ++k)
      bits |= static_cast<uint8_t>(valid[k] << (k - i));
    out.number(bits);
  }
}

PartMask readMask(ByteReader& in, size_t samples) {
  if (in.number<MaskKind>() == MaskKind::kAll) return {};
  const std::span<const uint8_t> bits = in.take((samples + 7) / 8);
  PartMask valid(in.ok() ? samples : 0);
  for (size_t i = 0; i < valid.size(); ++i) valid[i] = bits[i / 8] >> i % 8 & 1;
  return valid;
}

Status missing(const std::string& name) {
  return {TKS_IO, "The part " + name +
                      " of the mosaic is missing, damaged or of another plan: its tile has to be "
                      "coded again."};
}

}  // namespace

std::vector<uint8_t> writePart(uint32_t plan, const Tile& tile, const Part& part) {
  ByteWriter table;
  table.number(static_cast<uint32_t>(part.tracks.size()));
  assert(part.openings.empty() || part.openings.size() == part.tracks.size());
  for (size_t i = 0; i < part.tracks.size(); ++i) {
    const EncodedTrack& track = part.tracks[i];
    table.number(uint64_t{track.codeword.size()});
    table.number(crc32(track.codeword));
    table.number(part.openings.empty() ? uint64_t{0} : part.openings[i]);
    table.number(static_cast<uint32_t>(track.points.size()));
    for (const RatePoint& point : track.points) {
      table.number(point.bytes);
      table.number(point.distortion);
      table.number<uint8_t>(point.dips);
    }
  }
  table.number(part.valid_samples);
  const std::vector<uint8_t> sealed = std::move(table).sealed();
  ByteWriter head;
  writeOpening(head, kPartMagic, plan, tile);
  head.number(uint64_t{sealed.size()});
  std::vector<uint8_t> bytes = std::move(head).sealed();
  bytes.insert(bytes.end(), sealed.begin(), sealed.end());
  for (const EncodedTrack& track : part.tracks)
    bytes.insert(bytes.end(), track.codeword.begin(), track.codeword.end());
  return bytes;
}

Result<PartTable> readTable(const MosaicFiles& files, uint32_t plan, const Tile& tile) {
  constexpr size_t kHeadBytes = kOpeningBytes + sizeof(uint64_t) + sizeof(uint32_t);
  const std::string name = partName(tile);
  const auto head = files.read(name, 0, kHeadBytes);
  if (!head.ok() || head->size() != kHeadBytes) return missing(name);
  ByteReader in = ByteReader::unsealed(*head);
  if (!passOpening(in, kPartMagic, plan, tile)) return missing(name);
  const auto table_bytes = in.number<uint64_t>();
  const auto table = files.read(name, kHeadBytes, table_bytes);
  if (!table.ok() || table->size() != table_bytes) return missing(name);
  in = ByteReader::unsealed(*table);
  PartTable out;
  out.tracks.resize(std::min<size_t>(in.number<uint32_t>(), table->size()));
  uint64_t offset = kHeadBytes + table_bytes;
  for (PartTable::Track& track : out.tracks) {
    track.offset = offset;
    track.bytes = in.number<uint64_t>();
    track.crc = in.number<uint32_t>();
    track.opening = std::min(in.number<uint64_t>(), track.bytes);
    track.points.resize(std::min<size_t>(in.number<uint32_t>(), table->size()));
    for (RatePoint& point : track.points) {
      point.bytes = in.number<uint64_t>();
      point.distortion = in.number<double>();
      point.dips = in.number<uint8_t>() != 0;
    }
    offset += track.bytes;
  }
  out.valid_samples = in.number<uint64_t>();
  if (!in.ok()) return missing(name);
  return out;
}

Result<std::vector<uint8_t>> readCodeword(const MosaicFiles& files, const Tile& tile,
                                          const PartTable::Track& track) {
  if (track.bytes == 0) return std::vector<uint8_t>();
  const std::string name = partName(tile);
  Result<std::vector<uint8_t>> codeword = files.read(name, track.offset, track.bytes);
  if (codeword.ok() && codeword->size() == track.bytes && crc32(*codeword) == track.crc)
    return codeword;
  return missing(name);
}

std::vector<uint8_t> writeLow(uint32_t plan, const Tile& tile, const LowPart& low) {
  assert(low.values.size() == low.extent.samples());
  ByteWriter out;
  writeOpening(out, kLowMagic, plan, tile);
  out.number(low.extent.width);
  out.number(low.extent.height);
  writeMask(out, low.marks);
  for (const int32_t value : low.values) out.number(value);
  return std::move(out).sealed();
}

Result<LowPart> readLow(const MosaicFiles& files, uint32_t plan, const Tile& tile) {
  const std::string name = lowName(tile);
  const auto bytes = files.read(name, 0, UINT64_MAX);
  if (!bytes.ok()) return missing(name);
  ByteReader in = ByteReader::unsealed(*bytes);
  if (!passOpening(in, kLowMagic, plan, tile)) return missing(name);
  LowPart low;
  low.extent.width = in.number<uint32_t>();
  low.extent.height = in.number<uint32_t>();
  low.marks = readMask(in, low.extent.samples());
  low.values.resize(std::min(low.extent.samples(), in.rest().size() / sizeof(int32_t)));
  for (int32_t& value : low.values) value = in.number<int32_t>();
  if (!in.ok() || low.values.size() != low.extent.samples()) return missing(name);
  return low;
}

bool isDone(const MosaicFiles& files, uint32_t plan, const MosaicGrid& grid, const Tile& tile) {
  const Result<PartTable> table = readTable(files, plan, tile);
  if (!table.ok() || table->tracks.size() != grid.tracks(tile).size()) return false;
  if (!table->tracks.empty() && table->tracks.back().bytes > 0) {
    const PartTable::Track& last = table->tracks.back();
    const auto end = files.read(partName(tile), last.offset + last.bytes - 1, 1);
    if (!end.ok() || end->empty()) return false;
  }
  return !grid.leavesLow(tile) || readLow(files, plan, tile).ok();
}

}  // namespace tetrakis::inline mosaic
