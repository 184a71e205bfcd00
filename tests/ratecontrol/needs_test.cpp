// SPDX-License-Identifier: Apache-2.0
// What meets a target: searches over packets, needs, budgets.
#include "ratecontrol/needs/needs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>

namespace tetrakis {
namespace {

/// Of each component one track: its packets, whole or not, mixed at random.
std::vector<Packet> randomPackets(std::mt19937& random, bool both) {
  std::vector<Packet> packets;
  std::array<uint64_t, kComponents> sent = {};
  const size_t count = 1 + random() % 12;
  for (size_t i = 0; i < count; ++i) {
    const auto component = static_cast<size_t>(both ? random() % 2 : 1);
    const uint64_t begin = sent[component];
    sent[component] += 1 + random() % 900;
    packets.push_back({static_cast<Component>(component),
                       random() % 4 == 0,
                       static_cast<uint8_t>(200 - i),
                       begin,
                       sent[component],
                       {}});
  }
  return packets;
}

uint64_t payloadOf(std::span<const Packet> packets, Component component) {
  uint64_t bytes = 0;
  for (const Packet& packet : packets) bytes += packet.component == component ? packet.length() : 0;
  return bytes;
}

TEST(LeastBytes, AreWithinA64thOfAPacketAndNeverInAWholeOne) {
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    const std::vector<Packet> packets = randomPackets(random, false);
    const uint64_t total = payloadOf(packets), enough = random() % (total + 50);
    const auto least = leastBytes(packets, [&](uint64_t bytes) { return bytes >= enough; });
    ASSERT_EQ(least.has_value(), enough <= total);
    if (!least) continue;
    const auto packet = std::find_if(packets.begin(), packets.end(),
                                     [&](const Packet& p) { return p.end >= enough; });
    if (enough == 0) {
      EXPECT_EQ(*least, 0u);
    } else if (packet->whole) {
      EXPECT_EQ(*least, packet->end);
    } else {
      EXPECT_GE(*least, enough);
      EXPECT_LE(*least - enough, std::max<uint64_t>(1, packet->length() / 64));
    }
  }
}

TEST(LeastBytes, OfNoPacketsAreNoneOrNothingSuffices) {
  EXPECT_EQ(leastBytes({}, [](uint64_t) { return true; }), 0u);
  EXPECT_FALSE(leastBytes({}, [](uint64_t) { return false; }));
}

TEST(Needs, AreKeptToTheByteAndOnlyCutPacketsAreStatedAnew) {
  std::mt19937 random(2);
  for (int round = 0; round < 300; ++round) {
    const std::vector<Packet> packets = randomPackets(random, true);
    const Needs needs = {random() % 3000, random() % 3 ? random() % 3000 : kAllBytes};
    const auto quality = [&](Component component, uint64_t bytes) {
      EXPECT_EQ(bytes, needs[static_cast<size_t>(component)]);
      return uint8_t{7};
    };
    const std::vector<Packet> kept = keepNeeded(packets, needs, quality);
    for (const Component component : {Component::kGeometry, Component::kTexture}) {
      EXPECT_EQ(payloadOf(kept, component),
                std::min(needs[static_cast<size_t>(component)], payloadOf(packets, component)));
    }
    for (const Packet& packet : kept) {
      const auto original = std::find_if(packets.begin(), packets.end(), [&](const Packet& p) {
        return p.component == packet.component && p.begin == packet.begin;
      });
      ASSERT_NE(original, packets.end());
      EXPECT_EQ(packet.quality, packet.end < original->end ? 7 : original->quality);
    }
  }
}

TEST(SentWith, EndsWithThePacketThatCompletesTheBytes) {
  const auto packet = [](Component component, uint64_t begin, uint64_t end) {
    return Packet{component, false, 80, begin, end, {}};
  };
  const Component g = Component::kGeometry, t = Component::kTexture;
  const std::vector<Packet> packets = {packet(t, 0, 10), packet(g, 0, 20), packet(t, 10, 40),
                                       packet(g, 20, 30), packet(t, 40, 45)};
  EXPECT_EQ(sentWith(packets, g, 0), (Needs{20, 10}));
  EXPECT_EQ(sentWith(packets, g, 20), (Needs{20, 10}));
  EXPECT_EQ(sentWith(packets, g, 21), (Needs{30, 40}));
  EXPECT_EQ(sentWith(packets, g, 31), (Needs{30, 45}));
}

/// Both components stay in their order, all of one is within the budget where that can be, and as
/// much of the other one stands before its end as was there and fits.
TEST(EndWithin, PutsOneComponentBeforeWhatPushesItOut) {
  std::mt19937 random(8);
  for (int round = 0; round < 300; ++round) {
    const std::vector<Packet> packets = randomPackets(random, true);
    const uint64_t budget = 1 + random() % (bytesOfPackets(packets) + 100);
    const Component component = round % 2 ? Component::kGeometry : Component::kTexture;
    const auto of_component = [&](const Packet& packet) { return packet.component == component; };
    const std::vector<Packet> ordered = endWithin(packets, component, kAllBytes, budget);
    ASSERT_EQ(ordered.size(), packets.size());
    std::vector<Packet> mine, others;
    std::partition_copy(packets.begin(), packets.end(), std::back_inserter(mine),
                        std::back_inserter(others), of_component);
    std::vector<Packet> mine_ordered, others_ordered;
    std::partition_copy(ordered.begin(), ordered.end(), std::back_inserter(mine_ordered),
                        std::back_inserter(others_ordered), of_component);
    const auto same = [](const Packet& a, const Packet& b) {
      return a.begin == b.begin && a.end == b.end && a.track == b.track;
    };
    EXPECT_TRUE(std::equal(mine.begin(), mine.end(), mine_ordered.begin(), same));
    EXPECT_TRUE(std::equal(others.begin(), others.end(), others_ordered.begin(), same));
    if (bytesOfPackets(mine) > budget) continue;
    const auto behind = std::find_if(ordered.rbegin(), ordered.rend(), of_component).base();
    EXPECT_LE(bytesOfPackets({ordered.begin(), behind}), budget);
    const auto end = std::find_if(packets.rbegin(), packets.rend(), of_component).base();
    if (bytesOfPackets({packets.begin(), end}) <= budget) {
      EXPECT_TRUE(std::equal(packets.begin(), packets.end(), ordered.begin(), same));
    }
  }
}

TEST(Budgets, KeepWhatBeginsWithinThemAndStateWhatEndsWithinThem) {
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    const std::vector<Packet> packets = randomPackets(random, true);
    const auto some = std::span(packets).first(1 + random() % packets.size());
    const uint64_t budget =
        round % 2 ? bytesOfPackets(some) : 1 + random() % (bytesOfPackets(packets) + 100);
    const std::vector<Packet> kept = keepWithinBudget(packets, budget);
    ASSERT_GE(kept.size(), 1u);
    EXPECT_LT(bytesOfPackets(std::span(kept).first(kept.size() - 1)), budget);
    if (kept.size() < packets.size()) {
      EXPECT_GE(bytesOfPackets(kept), budget);
    }
    std::array<double, kComponents> stated = {rmseOf(255), rmseOf(255)};
    for (size_t i = 0; i < packets.size(); ++i) {
      if (bytesOfPackets(std::span(packets).first(i + 1)) <= budget)
        stated[static_cast<size_t>(packets[i].component)] = rmseOf(packets[i].quality);
    }
    EXPECT_EQ(statedWithin(packets, budget), stated);
  }
}

}  // namespace
}  // namespace tetrakis
