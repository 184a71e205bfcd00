// SPDX-License-Identifier: Apache-2.0
// A Part holds the codewords that the task of a tile leaves for the merge, with their accounts. A
// LowPart holds the low band that it leaves for the tasks of the next group. Both are files of a
// mosaic, sealed by the hash of the plan that they belong to and by checksums.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "encoder/mosaic/mosaic_plan.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline mosaic {

// ByteWriter and ByteReader write and read numbers of fixed width, little endian, and seal bytes
// with a CRC-32 at their end.

class ByteWriter {
 public:
  template <class T>
  void number(T value) {
    auto bytes = std::bit_cast<std::array<uint8_t, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    append(bytes);
  }
  void append(std::span<const uint8_t> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  size_t size() const { return bytes_.size(); }
  std::vector<uint8_t> sealed() && {
    number(crc32(bytes_));
    return std::move(bytes_);
  }

 private:
  std::vector<uint8_t> bytes_;
};

/// Behind the last byte numbers are 0, and the reader is not ok() any more.
class ByteReader {
 public:
  explicit ByteReader(std::span<const uint8_t> bytes) : bytes_(bytes) {}
  /// Of bytes whose seal is right; else of none, and not ok().
  static ByteReader unsealed(std::span<const uint8_t> bytes);

  std::span<const uint8_t> take(uint64_t count) {
    ok_ = ok_ && count <= bytes_.size();
    if (!ok_) return {};
    const std::span<const uint8_t> taken = bytes_.first(static_cast<size_t>(count));
    bytes_ = bytes_.subspan(taken.size());
    return taken;
  }
  template <class T>
  T number() {
    const std::span<const uint8_t> taken = take(sizeof(T));
    std::array<uint8_t, sizeof(T)> bytes{};
    std::copy(taken.begin(), taken.end(), bytes.begin());
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }
  std::span<const uint8_t> rest() const { return bytes_; }
  bool ok() const { return ok_; }

 private:
  std::span<const uint8_t> bytes_;
  bool ok_ = true;
};

/// Which samples of a rectangle exist: a byte each; empty: all do.
using PartMask = std::vector<uint8_t>;

struct Part {
  std::vector<EncodedTrack> tracks;  ///< of MosaicGrid::tracks()
  /// Bytes of each codeword that the mask takes, which opens it; empty: none has a mask.
  std::vector<uint64_t> openings;
  uint64_t valid_samples = 0;  ///< of a tile of group 0 that codes
};

/// A low band that a tile leaves for the tasks of the next group: of the samples themselves where
/// it codes, or as decoders have it where it restores.
struct LowPart {
  Extent extent;
  std::vector<int32_t> values;
  /// Which samples exist; of a restored band, which of its vertices have a significant coefficient.
  PartMask marks;
};

/// The table of a part, which stands ahead of its codewords.
struct PartTable {
  struct Track {
    uint64_t offset = 0, bytes = 0;  ///< of its codeword in the file
    uint32_t crc = 0;                ///< of the codeword
    uint64_t opening = 0;            ///< Part::openings
    std::vector<RatePoint> points;
  };
  std::vector<Track> tracks;
  uint64_t valid_samples = 0;
};

std::vector<uint8_t> writePart(uint32_t plan, const Tile& tile, const Part& part);
std::vector<uint8_t> writeLow(uint32_t plan, const Tile& tile, const LowPart& low);

/// Reads the table of a part. TKS_IO: there is none, or it is damaged or of another plan; the tile
/// is to be coded again.
Result<PartTable> readTable(const MosaicFiles& files, uint32_t plan, const Tile& tile);

/// Reads a codeword that the table of a tile states. TKS_IO: as above.
Result<std::vector<uint8_t>> readCodeword(const MosaicFiles& files, const Tile& tile,
                                          const PartTable::Track& track);

/// Reads a low band. TKS_IO: as above.
Result<LowPart> readLow(const MosaicFiles& files, uint32_t plan, const Tile& tile);

/// Whether the table of the tile's part, and its low band if it leaves one, are there and whole.
bool isDone(const MosaicFiles& files, uint32_t plan, const MosaicGrid& grid, const Tile& tile);

}  // namespace tetrakis::inline mosaic
