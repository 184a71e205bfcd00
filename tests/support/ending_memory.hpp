// SPDX-License-Identifier: Apache-2.0
// Calls of the library while memory ends at an allocation of theirs: at the first one and at the
// last one of each place in the code.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>

#include "tests/support/allocation_count.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tetrakis/transmit.h"

namespace tetrakis::test {

constexpr size_t kMostOut = 1 << 16;

/// A decoder and all that calls may hand over. Its end takes no memory.
class Desk {
 public:
  explicit Desk(Prefix stream) : out(kMostOut, 0xa5) {
    info.size = sizeof info;
    if (stream.empty()) return;
    EXPECT_EQ(tks_open(stream.data(), stream.size(), nullptr, &decoder, nullptr, 0), TKS_OK);
    EXPECT_EQ(tks_get_info(decoder, &info), TKS_OK);
  }
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;
  ~Desk() {
    failAllocation(1);
    tks_free_buffer(&buffer);
    tks_free_mesh(&mesh);
    tks_free_globe_mesh(&globe);
    tks_free_object_mesh(&object);
    tks_free_ranges(&ranges);
    tks_free_mesh_tree(tree);
    tks_close(decoder);
    tks_sequence_close(sequence);
    tks_sequence_encoder_close(sequence_encoder);
    tks_receiver_close(receiver);
    tks_transmitter_close(transmitter);
    EXPECT_FALSE(allocationHasFailed());
    failAllocation(0);
  }
  /// All that calls have handed over.
  Bytes given() const {
    Bytes all = out;
    const auto add = [&](const void* data, size_t bytes) {
      const auto* from = static_cast<const uint8_t*>(data);
      if (bytes > 0) all.insert(all.end(), from, from + bytes);
    };
    add(buffer.data, buffer.size);
    add(mesh.grid_index, mesh.vertex_count * sizeof *mesh.grid_index);
    add(mesh.height, mesh.vertex_count * sizeof *mesh.height);
    add(mesh.triangles, 3 * mesh.triangle_count * sizeof *mesh.triangles);
    add(globe.position, 3 * globe.vertex_count * sizeof *globe.position);
    add(globe.pixel, 2 * globe.vertex_count * sizeof *globe.pixel);
    add(globe.height, globe.vertex_count * sizeof *globe.height);
    add(globe.triangles, 3 * globe.triangle_count * sizeof *globe.triangles);
    add(object.position, 3 * object.vertex_count * sizeof *object.position);
    add(object.triangles, 3 * object.triangle_count * sizeof *object.triangles);
    for (size_t i = 0; i < ranges.count; ++i) add(&ranges.ranges[i], 2 * sizeof(uint64_t));
    return all;
  }

  size_t heightBytes() const {
    return size_t{info.width} * info.height * tks_sample_bytes(info.sample);
  }
  size_t texelBytes() const {
    return size_t{info.texture_width} * info.texture_height * info.texture_channels *
           tks_sample_bytes(info.texture_sample);
  }

  tks_decoder* decoder = nullptr;
  tks_info info = {};
  Bytes out;
  tks_buffer buffer = {};
  tks_mesh mesh = {};
  tks_globe_mesh globe = {};
  tks_object_mesh object = {};
  tks_ranges ranges = {};
  tks_mesh_tree* tree = nullptr;
  tks_sequence* sequence = nullptr;
  tks_sequence_encoder* sequence_encoder = nullptr;
  tks_receiver* receiver = nullptr;
  tks_transmitter* transmitter = nullptr;
  char message[128] = "";
};

/// A function of the library, with arguments that it takes.
struct Called {
  std::string name;
  std::function<tks_status(Desk&)> run;
  std::function<void(Desk&)> before = [](Desk&) {};  ///< what comes ahead of it
  std::function<void(Desk&)> after = [](Desk&) {};   ///< what shows that it has done its work
  bool has_sentence = true;
  bool may_be_lost = false;  ///< the decoder may say that it takes no more
  bool remembers = true;     ///< it may leave something to the next call
};

inline const char* sentenceOf(const Desk& desk) {
  return desk.decoder != nullptr ? tks_message(desk.decoder) : desk.message;
}

/// The same call again, with all the memory that it wants.
inline void expectGoesOn(const Called& called, Desk& desk, const Bytes& wanted) {
  const tks_status again = called.run(desk);
  if (called.may_be_lost && again == TKS_NO_MEMORY) {
    EXPECT_STRNE(sentenceOf(desk), "Not enough memory.");
    tks_info info = {};
    info.size = sizeof info;
    EXPECT_EQ(tks_get_info(desk.decoder, &info), TKS_NO_MEMORY);
    return;
  }
  EXPECT_EQ(again, TKS_OK) << sentenceOf(desk);
  called.after(desk);
  EXPECT_EQ(desk.given(), wanted);
}

/// The call whose allocation of that number fails.
inline void failsAt(uint64_t number, const Called& called, Prefix stream, const Bytes& wanted) {
  Desk desk(stream);
  called.before(desk);
  const Bytes blank = desk.given();
  failAllocation(number);
  const tks_status status = called.run(desk);
  const bool met = allocationHasFailed();
  failAllocation(0);
  if (!met || status == TKS_OK) {  // work of which a thread was refused is done by the others
    EXPECT_EQ(status, TKS_OK) << sentenceOf(desk);
    called.after(desk);
    EXPECT_EQ(desk.given(), wanted);
    return;
  }
  EXPECT_EQ(status, TKS_NO_MEMORY);
  if (called.has_sentence) {
    EXPECT_STREQ(sentenceOf(desk), "Not enough memory.");
  }
  EXPECT_EQ(desk.given(), blank);
  // Whole calls take most of the time, and those of encoders start from nothing.
  constexpr uint64_t kSometimes = 25;
  if (called.remembers || number % kSometimes == 0) expectGoesOn(called, desk, wanted);
}

/// The number of each place's first allocation and of its last one, counted from 1, in order.
inline std::vector<uint64_t> endsOfPlaces(std::span<const uint64_t> places) {
  std::set<uint64_t> numbers;
  std::map<uint64_t, uint64_t> last;
  for (size_t i = 0; i < places.size(); ++i) {
    const uint64_t number = i + 1;
    if (!last.contains(places[i])) numbers.insert(number);
    last[places[i]] = number;
  }
  for (const auto& [place, number] : last) numbers.insert(number);
  return {numbers.begin(), numbers.end()};
}

/// In loops calls make many thousands of allocations, of which those between the first and the last
/// one of a place in the code find the state that these two find. Encoders have thousands of
/// places: some of them.
inline void exhaust(const Called& called, Prefix stream) {
  SCOPED_TRACE(called.name);
  Bytes wanted;
  {
    Desk desk(stream);
    called.before(desk);
    ASSERT_EQ(called.run(desk), TKS_OK) << sentenceOf(desk);
    called.after(desk);
    wanted = desk.given();
  }
  Desk noting(stream);
  called.before(noting);
  startNotingPlaces();
  called.run(noting);
  const std::vector<uint64_t> numbers = endsOfPlaces(notedPlaces());
  constexpr size_t kMost = 240;
  for (size_t i = 0; i < numbers.size(); i += 1 + numbers.size() / kMost) {
    SCOPED_TRACE("allocation " + std::to_string(numbers[i]));
    const int64_t before = liveBlocks();
    failsAt(numbers[i], called, stream, wanted);
    EXPECT_EQ(liveBlocks(), before);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace tetrakis::test
