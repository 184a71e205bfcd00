// SPDX-License-Identifier: Apache-2.0
// Packets are runs of bytes of one track's codeword, and the multiplexer joins the packets of all
// tracks into a payload (docs/FORMAT.md, section 3). A packet consists of:
//
//   head     varint   (length << 1 | whole) << number_bits | number     length >= 1
//   region   varint   number of the track, if the component is coded in regions
//   quality  u8       error of the component after the packet: RMSE = 2^((quality - 64) / 8);
//                     0: exact
//   payload  length bytes
//
// number: place of the component in the header's list, which has at most 2^number_bits components.
//
// A packet that is cut keeps what its bytes decide, unless `whole` is set: then it counts only when
// complete (the encoder sets it where a part of the packet could look worse than none).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::inline stream {

/// What a stream holds: heights (the geometry), a texture, or both. A component is coded in one
/// track, or in several if it has regions. Components that this decoder does not know, or of a kind
/// of which there was one before, are others: their packets are passed over.
enum class Component : uint8_t { kGeometry = 0, kTexture = 1, kOther = 2 };
inline constexpr size_t kComponents = 2;  ///< that are known
inline constexpr size_t kRoles = 3;       ///< with kOther

struct Packet {
  Component component = Component::kGeometry;
  bool whole = false;
  uint8_t quality = 0;
  uint64_t begin = 0, end = 0;    ///< bytes of the track's codeword
  std::optional<uint32_t> track;  ///< number of the track; nothing: the component has but one
  double slope = 0;               ///< what a byte takes off the error; only the front index says it

  uint64_t length() const { return end - begin; }  ///< of the payload
};

/// RMSE to its byte, rounded up, and back. In integer steps of the heights, or texel units.
uint8_t qualityOf(double rmse);
double rmseOf(uint8_t quality);

/// What stands before a packet's payload; the front index repeats it.
struct PacketHead {
  uint64_t length = 0;  ///< of the payload
  uint32_t track = 0;
  uint8_t quality = 0;
  bool whole = false;
  uint8_t number = 0;  ///< of the component in the header's list
  Component component = Component::kGeometry;
  bool operator==(const PacketHead&) const = default;
};

struct TrackCount {
  uint64_t tracks = 0;  ///< 0: the header does not announce the component
  bool named = false;   ///< packets say which track they belong to
};

/// How packets name components and tracks: what the header says of it.
class TrackCounts {
 public:
  /// The next component of the header's list. Of others all tracks are taken to be there.
  void add(Component component, TrackCount count);

  /// By component; of kOther nothing.
  const TrackCount& operator[](size_t component) const { return counts_[component]; }
  /// By the number in the header's list; no tracks if no component has it.
  TrackCount of(const PacketHead& head) const;
  Component componentOf(size_t number) const;
  /// At least one, so that the heads of streams of one component and of two have the same size.
  int numberBits() const;
  uint64_t all() const;  ///< tracks of the components that are known

 private:
  struct Listed {
    Component component;
    TrackCount count;
  };
  std::vector<Listed> listed_;
  std::array<TrackCount, kRoles> counts_;
};

/// The head of a packet of a stream of these components.
PacketHead headOf(const Packet& packet, const TrackCounts& counts);

/// Bytes before the payload, in a stream of one component or two.
size_t overheadOf(const Packet& packet);

/// The codewords of a component's tracks, in the order of their numbers.
using Codewords = std::vector<std::span<const uint8_t>>;

/// Writes the packets in order, stopping at `limit` bytes (inside a packet if need be).
std::vector<uint8_t> multiplex(std::span<const Packet> packets, const TrackCounts& counts,
                               const std::array<Codewords, kComponents>& codewords, uint64_t limit);

/// The field `head`, and what it says of a packet.
uint64_t fieldOf(const PacketHead& head, const TrackCounts& counts);
PacketHead headOf(uint64_t field, const TrackCounts& counts);

/// What the front index says of a packet.
struct IndexEntry {
  PacketHead packet;
  uint8_t slope = 0;  ///< slopeOf()
  bool operator==(const IndexEntry&) const = default;
};

/// Whether the index begins with these heads. Where an encoder cut the payload to a budget, the
/// index runs ahead of the packets. Heads are as short as can be: it then tells their places too.
bool describes(std::span<const IndexEntry> index, std::span<const PacketHead> heads);

/// What a byte of a packet takes off the error, beside the steepest packet, to its byte and back:
/// quarters of an octave. The least is 0 and comes back as 0.
uint8_t slopeByte(double slope, double steepest);
double slopeOf(uint8_t slope);

/// The bytes before a payload.
std::vector<uint8_t> headBytes(const PacketHead& head, const TrackCounts& counts);
/// How many they are.
size_t headSize(const PacketHead& head, const TrackCounts& counts);

/// A place in a payload that may grow: before a head, or in a packet whose end is not there yet.
struct PayloadPlace {
  size_t at = 0;                   ///< the head's first byte, or that of the packet's payload
  std::optional<PacketHead> open;  ///< of that packet
  size_t seen = 0;                 ///< how many bytes of it were there
};

struct Demultiplexed {
  TrackCounts counts;
  PayloadPlace end;  ///< of what was taken apart
  /// What is available of the tracks of each component, by number; of the others nothing is.
  std::array<std::map<uint32_t, std::vector<uint8_t>>, kRoles> codewords;
  std::array<uint64_t, kRoles> bytes{};                ///< of those codewords together
  std::array<std::optional<uint8_t>, kRoles> quality;  ///< of the last complete packet of each
  std::vector<PacketHead> heads;                       ///< of every packet begun

  /// The bytes of each track of a component. There may be many tracks.
  Codewords codewordsOf(Component component) const;
  /// No byte of any track of the component is available.
  bool nothingOf(Component component) const { return bytes[static_cast<size_t>(component)] == 0; }
  /// Adds to what is available of a track; of other components nothing is kept.
  void add(Component component, uint32_t track, std::span<const uint8_t> more);
};

/// A packet where it stands: its head, and what is there of its payload.
struct FoundPacket {
  PacketHead head;
  std::span<const uint8_t> bytes;

  bool isCut() const { return bytes.size() < head.length; }
};

/// The packets of a payload, the last of which may be cut. TKS_CORRUPT.
Result<std::vector<FoundPacket>> packetsIn(std::span<const uint8_t> payload, size_t origin,
                                           const TrackCounts& counts);

/// What a payload holds, for an idea of what it takes to take it apart.
struct PayloadCount {
  uint64_t packets = 0, bytes = 0;  ///< begun; of all payloads
};
/// from: what lies before it is not counted.
Result<PayloadCount> countPackets(std::span<const uint8_t> payload, size_t origin,
                                  const TrackCounts& counts, PayloadPlace from = {});

/// payload: the available bytes behind the header. Any prefix is legal; TKS_CORRUPT on a head that
/// no encoder writes. Allocates in proportion to the payload, whatever `counts` says. packets: how
/// many there are, if that is known.
Result<Demultiplexed> demultiplex(std::span<const uint8_t> payload, size_t origin,
                                  const TrackCounts& counts, uint64_t packets = 0);

/// Goes on where the payload ended before, in time for what is new. On an error some of it was
/// taken: countPackets() tells of errors first.
Status demultiplexMore(std::span<const uint8_t> payload, size_t origin, Demultiplexed& out);

/// The same of heads and qualities alone, where the codewords have what packets hold already.
Status passHeads(std::span<const uint8_t> payload, size_t origin, Demultiplexed& out);

}  // namespace tetrakis::inline stream
