// SPDX-License-Identifier: Apache-2.0
// Bytes of streams with very many tracks and packets, in any order: taking them costs time in
// proportion to them. Four times as many may take at most nine times as long, where a cost for each
// track at each call would take sixteen times.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <functional>
#include <numeric>
#include <random>

#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/header.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

/// A stream of packets of three bytes, each of a track of its own.
struct ManyPackets {
  Bytes bytes;
  size_t header = 0;
  std::vector<size_t> begins;  ///< of the packets, and the end
};

ManyPackets manyPackets(uint32_t count, bool indexed) {
  StreamHeader header;
  GeometryHeader& g = header.geometry.emplace();
  g.width = g.height = 1 << 13;
  g.sample = TKS_I16;
  g.planes = 12;
  g.regions.side_log2 = 4;
  const TrackCounts tracks = trackCounts(header);
  EXPECT_LT(count, tracks[0].tracks);
  FieldWriter payload;
  std::vector<size_t> begins;
  for (uint32_t i = 0; i < count; ++i) {
    const PacketHead head{3, i, 64};
    begins.push_back(payload.bytes.size());
    const Bytes bytes = headBytes(head, tracks);
    payload.bytes.insert(payload.bytes.end(), bytes.begin(), bytes.end());
    for (int k = 0; k < 3; ++k) payload.bytes.push_back(static_cast<uint8_t>(7 * i + k));
    if (indexed) header.index.push_back({head, 9});
  }
  begins.push_back(payload.bytes.size());
  header.payload_bytes = payload.bytes.size();
  ManyPackets made{writeHeader(header), 0, begins};
  made.header = made.bytes.size();
  made.bytes.insert(made.bytes.end(), payload.bytes.begin(), payload.bytes.end());
  for (size_t& begin : made.begins) begin += made.header;
  return made;
}

double processorSeconds() {
  timespec now = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Takes the packets of a stream in some order, from its header on.
using Arrive = std::function<void(Stream&, const ManyPackets&)>;

/// The least of three times, of which what else the machine does takes no part.
double secondsOf(const ManyPackets& packets, const Arrive& arrive) {
  double least = 1e9;
  for (int trial = 0; trial < 3; ++trial) {
    Stream stream(Prefix(packets.bytes).first(packets.header));
    const double before = processorSeconds();
    arrive(stream, packets);
    least = std::min(least, processorSeconds() - before);
    tks_info info = {};
    info.size = sizeof info;
    EXPECT_EQ(tks_get_info(stream.get(), &info), TKS_OK);
    EXPECT_EQ(info.available_bytes, packets.bytes.size());
    EXPECT_EQ(info.packets, packets.begins.size() - 1);
    EXPECT_EQ(info.geometry_bytes, 3 * (packets.begins.size() - 1));
  }
  return least;
}

/// Four times the packets take four times as long, and where time goes with their square sixteen
/// times. Other work on the machine may disturb a trial, hardly three.
void expectProportion(uint32_t count, bool indexed, const Arrive& arrive) {
  double least = 16;
  for (int trial = 0; trial < 3 && least > 9; ++trial) {
    const double few = secondsOf(manyPackets(count, indexed), arrive);
    const double many = secondsOf(manyPackets(4 * count, indexed), arrive);
    least = std::min(least, many / (few + 0.001));
  }
  EXPECT_LE(least, 9);
}

void putPacket(Stream& stream, const ManyPackets& packets, size_t i) {
  const size_t begin = packets.begins[i], end = packets.begins[i + 1];
  ASSERT_EQ(tks_put(stream.get(), begin, packets.bytes.data() + begin, end - begin), TKS_OK)
      << tks_message(stream.get());
}

std::vector<size_t> numbersOf(const ManyPackets& packets) {
  std::vector<size_t> numbers(packets.begins.size() - 1);
  std::iota(numbers.begin(), numbers.end(), size_t{0});
  return numbers;
}

TEST(ArrivalTime, ByteByByte) {
  for (const bool indexed : {false, true}) {
    expectProportion(8000, indexed, [](Stream& stream, const ManyPackets& packets) {
      for (size_t at = packets.header; at < packets.bytes.size(); ++at)
        ASSERT_EQ(tks_append(stream.get(), packets.bytes.data() + at, 1), TKS_OK);
    });
  }
}

TEST(ArrivalTime, PacketsFromTheLastOn) {
  expectProportion(8000, true, [](Stream& stream, const ManyPackets& packets) {
    for (size_t i = packets.begins.size() - 1; i-- > 0;) putPacket(stream, packets, i);
  });
}

TEST(ArrivalTime, PacketsInAnyOrder) {
  expectProportion(8000, true, [](Stream& stream, const ManyPackets& packets) {
    std::vector<size_t> order = numbersOf(packets);
    std::shuffle(order.begin(), order.end(), std::mt19937(5));
    for (const size_t i : order) putPacket(stream, packets, i);
  });
}

/// Gaps open and close again and again.
TEST(ArrivalTime, EveryOtherPacketFirst) {
  expectProportion(8000, true, [](Stream& stream, const ManyPackets& packets) {
    for (size_t i = 0; i + 2 < packets.begins.size(); i += 2) {
      putPacket(stream, packets, i + 1);
      putPacket(stream, packets, i);
    }
    if (packets.begins.size() % 2 == 0) putPacket(stream, packets, packets.begins.size() - 2);
  });
}

/// However packets come, tracks have the bytes that they have in the stream's order.
TEST(ArrivalTime, AnyOrderGivesTheSameHeights) {
  const ManyPackets packets = manyPackets(3000, true);
  const tks_window window = {100, 0, 40, 30};
  const auto heightsOf = [&](Stream& stream) {
    std::vector<int16_t> heights(size_t{window.width} * window.height);
    EXPECT_EQ(tks_decode_heights_window(stream.get(), &window, heights.data(),
                                        heights.size() * sizeof(int16_t)),
              TKS_OK)
        << tks_message(stream.get());
    return heights;
  };
  Stream whole(packets.bytes);
  const std::vector<int16_t> expected = heightsOf(whole);
  for (const uint32_t seed : {1u, 2u, 3u}) {
    Stream stream(Prefix(packets.bytes).first(packets.header));
    std::vector<size_t> order = numbersOf(packets);
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    for (const size_t i : order) putPacket(stream, packets, i);
    EXPECT_TRUE(heightsOf(stream) == expected) << seed;
  }
}

}  // namespace
}  // namespace tetrakis::test
