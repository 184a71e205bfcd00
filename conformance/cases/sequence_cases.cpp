// SPDX-License-Identifier: Apache-2.0
// Sequences: groups with and without an index, that stand by themselves or go on from the one
// before, with voids that are filled later, and with a group that was lost.
#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include "conformance/cases/case_builders.hpp"
#include "conformance/cases/cases.hpp"
#include "conformance/samples/moving_frames.hpp"
#include "tetrakis/sequence.hpp"

namespace tetrakis::conformance {

namespace {

using samples::FrameRasters;

constexpr int16_t kVoid = -32768;

/// What to encode, and how.
struct Sequenced {
  FrameRasters heights, images;
  tks_encode_options encode;
  tks_sequence_options sequence;
  bool voids = false;
};

tks_sequence_options inGroups(uint32_t group, uint64_t reference = 0, uint32_t entry = 0) {
  tks_sequence_options options = makeSequenceOptions();
  options.group = group;
  options.reference = reference;
  options.entry = entry;
  return options;
}

VectorCase encodedSequence(const std::string& name, const std::string& purpose, Sequenced frames) {
  VectorCase made;
  made.name = name;
  made.purpose = purpose;
  frames.sequence.encode = &frames.encode;
  auto encoder = SequenceEncoder::open(frames.sequence);
  const size_t count = std::max(frames.heights.size(), frames.images.size());
  for (size_t t = 0; encoder && t < count; ++t) {
    tks_heights heights = {};
    tks_image image = {};
    if (!frames.heights.empty()) heights = frames.heights[t].heights();
    if (!frames.images.empty()) image = frames.images[t].image();
    if (frames.voids) {
      heights.has_nodata = 1;
      heights.nodata = kVoid;
    }
    const auto time = static_cast<int64_t>(5 * t + t % 3);
    const Status pushed = encoder->push(frames.heights.empty() ? nullptr : &heights,
                                        frames.images.empty() ? nullptr : &image, time);
    if (!pushed.ok()) return made;
  }
  if (!encoder || !encoder->flush().ok()) return made;
  if (const auto bytes = encoder->take())
    made.stream.assign(bytes->bytes().begin(), bytes->bytes().end());
  return made;
}

/// Ground of which more is seen from frame to frame; the rest is void.
FrameRasters growing(FrameRasters frames) {
  for (size_t t = 0; t < frames.size(); ++t) {
    const int width = static_cast<int>(frames[t].width), reach = 3 + 2 * static_cast<int>(t);
    auto* const data = reinterpret_cast<int16_t*>(frames[t].data.data());
    for (int i = 0; i < width * static_cast<int>(frames[t].height); ++i)
      if (std::abs(i % width - 12) > reach || std::abs(i / width - 9) > reach) data[i] = kVoid;
  }
  return frames;
}

/// A sequence without one of its groups.
VectorCase without(uint64_t group, VectorCase from) {
  const auto sequence = Sequence::open(from.stream);
  if (!sequence) return from;
  uint64_t frame = 0;
  for (; group > 0; --group) frame += sequence->group(frame)->frames;
  const auto first = from.stream.begin() + static_cast<ptrdiff_t>(sequence->group(frame)->offset);
  from.stream.erase(first, first + static_cast<ptrdiff_t>(sequence->group(frame)->bytes));
  return from;
}

}  // namespace

std::vector<VectorCase> sequenceCases() {
  const auto hills = [](uint32_t width, uint32_t height, uint32_t frames) {
    return samples::movingFrames({Pattern::kHills, width, height, 1, TKS_I16}, frames);
  };
  const auto images = [](uint32_t width, uint32_t height, uint32_t channels, uint32_t frames) {
    return samples::movingFrames({Pattern::kRidges, width, height, channels, TKS_U8, 7}, frames);
  };
  const tks_encode_options exact = lossless();
  tks_sequence_options timed = inGroups(4);
  timed.clock = {sizeof timed.clock, 1, 25, "2019-03-01T00:00:00Z", "noleap"};
  tks_sequence_options bare = inGroups(2, TKS_ALL_BYTES);
  bare.no_index = 1;
  return {
      encodedSequence("groups_33x26", "groups with a clock and an index",
                      {hills(33, 26, 10), {}, exact, timed}),
      encodedSequence("reference_33x26",
                      "groups that go on from the one before, with points of entry",
                      {hills(33, 26, 12), {}, exact, inGroups(2, TKS_ALL_BYTES, 3)}),
      encodedSequence("reference_bare_20x31", "the same without an index",
                      {hills(20, 31, 7), {}, exact, bare}),
      encodedSequence("reference_voids_28x22", "voids that are filled in later groups",
                      {growing(hills(28, 22, 9)), {}, exact, inGroups(3, TKS_ALL_BYTES), true}),
      encodedSequence("reference_single_24x24", "groups of one frame",
                      {hills(24, 24, 6), {}, exact, inGroups(1, TKS_ALL_BYTES)}),
      encodedSequence("reference_rgb_30x21", "colours that go on",
                      {{}, images(30, 21, 3, 8), exact, inGroups(3, TKS_ALL_BYTES)}),
      encodedSequence("reference_joint_30x30_40x40",
                      "heights and texture that go on from a part of the group before",
                      {hills(30, 30, 8), images(40, 40, 3, 8), budget(400), inGroups(2, 150)}),
      without(1, encodedSequence("reference_lost_21x17",
                                 "a group was lost: the next point of entry is right",
                                 {hills(21, 17, 12), {}, exact, inGroups(2, TKS_ALL_BYTES, 3)})),
  };
}

}  // namespace tetrakis::conformance
