// SPDX-License-Identifier: Apache-2.0
// A tks_sequence_encoder holds the frames of a group until it is whole, and what it needs of the
// groups before. encodePending() codes the group and adds it to the bytes that are ready.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/encode_arguments.hpp"
#include "api/group_writer.hpp"
#include "bitstream/stream/header.hpp"
#include "tetrakis/sequence.h"

namespace tetrakis::inline api {

/// A frame with its own samples and texts.
class KeptFrame {
 public:
  KeptFrame(const tks_heights* heights, const tks_image* image) {
    if (heights != nullptr) {
      const size_t samples = size_t{heights->width} * heights->height;
      keep(heights->data, samples * tks_sample_bytes(heights->sample), heights_);
    }
    if (image != nullptr) {
      const size_t texels = size_t{image->width} * image->height * image->channels;
      keep(image->data, texels * tks_sample_bytes(image->sample), texels_);
    }
  }
  const void* heights() const { return heights_.data(); }
  const void* texels() const { return texels_.data(); }

 private:
  static void keep(const void* data, size_t bytes, std::vector<std::byte>& to) {
    const auto* first = static_cast<const std::byte*>(data);
    to.assign(first, first + bytes);
  }
  std::vector<std::byte> heights_, texels_;
};

/// The texts and positions of the first frame, which outlive the caller's.
class KeptTexts {
 public:
  void take(FrameArguments& first) {
    for (tks_heights& h : first.heights) {
      for (const char** text : {&h.unit, &h.vertical_datum, &h.crs, &h.description, &h.geo_keys})
        keep(*text);
      keepPositions(h);
    }
    for (tks_image& i : first.images) {
      for (const char** text : {&i.crs, &i.geo_keys}) keep(*text);
      keepPositions(i);
    }
  }

 private:
  void keep(const char*& text) {
    if (text != nullptr) text = texts_.emplace_back(std::make_unique<std::string>(text))->c_str();
  }
  void keepPositions(auto& raster) {
    if (raster.positions == nullptr) return;
    const auto* first = reinterpret_cast<const char*>(raster.positions);
    texts_.push_back(std::make_unique<std::string>(first, raster.positions_size));
    raster.positions = reinterpret_cast<const uint8_t*>(texts_.back()->data());
  }
  std::vector<std::unique_ptr<std::string>> texts_;
};

/// A group before its head and index are written.
struct PendingGroup {
  std::vector<KeptFrame> frames;
  std::vector<int64_t> times;
};

/// Whether it pays to code groups so that the next one can go on from them, which frames by
/// themselves pay for. Frames that have nothing in common with those before are told by two groups
/// that could go on and did not; then some groups are let alone before it is tried again.
class GoingOn {
 public:
  bool isTried() const { return rests_ == 0; }

  /// A group was written. could, did: go on from the one before.
  void tell(bool could, bool did, uint32_t most_rests) {
    if (rests_ > 0) {
      --rests_;
    } else if (could) {
      misses_ = did ? 0 : misses_ + 1;
      if (misses_ > 1) rests_ = std::min(1u << std::min(misses_, 16u), most_rests);
    }
  }

 private:
  uint32_t misses_ = 0, rests_ = 0;
};

}  // namespace tetrakis::inline api

struct tks_sequence_encoder {
  tks_encode_options options = {};
  uint32_t group = 0;
  uint64_t reference = 0;         ///< bytes a frame that later groups go on from; 0: none do
  uint32_t entry = 0;             ///< every how manyth group stands by itself
  tetrakis::FrameArguments like;  ///< the first frame of all, without samples; none so far: empty
  tetrakis::KeptTexts texts;
  tetrakis::PendingGroup pending;
  tetrakis::GroupWriter groups;
  std::shared_ptr<const tetrakis::GroupBefore> last;  ///< null: the next group stands by itself
  tetrakis::GoingOn going_on;
  /// Of the last group of the sequence that it goes on behind; none: it begins one.
  std::optional<tetrakis::StreamHeader> behind;
  bool has_time = false;
  int64_t last_time = 0;
  std::vector<uint8_t> ready;
};

namespace tetrakis::inline api {

/// The state of an encoder before a call. It comes back unless the call is done: memory may end
/// anywhere in it.
class Before {
 public:
  explicit Before(tks_sequence_encoder& encoder)
      : encoder_(encoder),
        groups_(encoder.groups),
        last_(encoder.last),
        going_on_(encoder.going_on),
        frames_(encoder.pending.frames.size()),
        ready_(encoder.ready.size()),
        first_(encoder.like.frames() == 0),
        has_time_(encoder.has_time),
        last_time_(encoder.last_time) {}
  Before(const Before&) = delete;
  Before& operator=(const Before&) = delete;
  ~Before() {
    if (done_) return;
    encoder_.groups = std::move(groups_);
    encoder_.last = std::move(last_);
    encoder_.going_on = going_on_;
    cut(encoder_.pending.frames, frames_);
    cut(encoder_.pending.times, frames_);
    encoder_.ready.resize(ready_);  // which is no more than there is
    encoder_.has_time = has_time_;
    encoder_.last_time = last_time_;
    if (!first_) return;
    encoder_.like = {};
    encoder_.texts = {};
  }

  Status done(Status status) {
    done_ = true;
    return status;
  }

 private:
  static void cut(auto& list, size_t count) {
    if (list.size() > count) list.erase(list.begin() + static_cast<ptrdiff_t>(count), list.end());
  }

  tks_sequence_encoder& encoder_;
  GroupWriter groups_;
  std::shared_ptr<const GroupBefore> last_;
  GoingOn going_on_;
  size_t frames_, ready_;
  bool first_, has_time_;
  int64_t last_time_;
  bool done_ = false;
};

/// Encodes all pending frames: together, or each by itself where they cannot be, or take fewer
/// bytes.
Status encodePending(tks_sequence_encoder& encoder);

}  // namespace tetrakis::inline api
