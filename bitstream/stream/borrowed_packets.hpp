// SPDX-License-Identifier: Apache-2.0
// BorrowedPackets knows the packets of a payload where they lie, so that opening a stream copies
// nothing of it. The packets of a track are joined when a codeword is wanted that they are of.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "bitstream/stream/packet.hpp"

namespace tetrakis::inline stream {

class BorrowedPackets {
 public:
  BorrowedPackets() = default;
  /// passed: the heads of the payload, by passHeads(), and no codewords; gets the numbers of bytes.
  /// The payload outlives this, or joinAll().
  BorrowedPackets(std::span<const uint8_t> payload, Demultiplexed& passed);

  /// The codewords of a component. Joins those of needed tracks into `out`. Those of the others
  /// have the right lengths, but other bytes.
  Codewords codewordsOf(Component component, const std::vector<bool>& needed, Demultiplexed& out);
  /// Afterwards `out` is what demultiplex() returns.
  void joinAll(Demultiplexed& out);

  /// Bytes of a track that were not joined.
  uint64_t bytesOf(Component component, uint32_t track) const;
  /// Of those tracks of a component.
  uint64_t bytesOf(Component component, const std::vector<bool>& tracks) const;
  /// Of all.
  uint64_t bytes() const;

  /// What this allocates for each packet at most: a vector that grows has up to twice its size
  /// beside the one before.
  static constexpr uint64_t kPacketBytes = 3 * sizeof(std::span<const uint8_t>);

 private:
  struct Track {
    std::vector<std::span<const uint8_t>> packets;
    uint64_t bytes = 0;
  };
  using Tracks = std::map<uint32_t, Track>;

  Tracks& tracksOf(Component component) { return tracks_[static_cast<size_t>(component)]; }
  const Tracks& tracksOf(Component component) const {
    return tracks_[static_cast<size_t>(component)];
  }
  void add(const PacketHead& head, std::span<const uint8_t> bytes);

  std::array<Tracks, kComponents> tracks_;
};

}  // namespace tetrakis::inline stream
