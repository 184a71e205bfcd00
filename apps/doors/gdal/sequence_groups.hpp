// SPDX-License-Identifier: Apache-2.0
// The groups of a sequence in a file: which frames they have, when these are, and where their
// streams lie. Groups are found by the index at the end of the file, or else from head to head,
// when they are asked for.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/doors/gdal/file_bytes.hpp"
#include "apps/doors/gdal/group_chain.hpp"
#include "apps/doors/gdal/source.hpp"
#include "tetrakis/sequence.h"

namespace tetrakis::gdal {

/// What the times of a sequence mean, as tks_clock says it.
struct SequenceClock {
  uint64_t numerator = 0, denominator = 0;  ///< seconds of a tick; 0: nobody knows
  std::string epoch, calendar;
};

struct FrameGroup {
  uint64_t first_frame = 0;
  std::vector<int64_t> times;      ///< of its frames, in ticks
  uint64_t offset = 0, bytes = 0;  ///< in the file
  Extent stream;

  uint64_t endFrame() const { return first_frame + times.size(); }
  uint64_t end() const { return offset + bytes; }
};

class SequenceGroups {
 public:
  /// Reads what tells the first and the last frame. Null after a reported error, or where there is
  /// no frame at all.
  static std::unique_ptr<SequenceGroups> open(const std::string& name, const File& file,
                                              const OpenSettings& settings);

  const std::string& name() const { return name_; }
  const SequenceClock& clock() const { return clock_; }
  uint64_t firstFrame() const { return groups_.begin()->first; }
  uint64_t endFrame() const { return groups_.rbegin()->second.endFrame(); }
  /// Whether the last group is all there.
  bool complete() const { return groups_.rbegin()->second.end() <= end_; }

  /// The group of a frame, which stays where it is. Null after a reported error.
  const FrameGroup* holding(uint64_t frame);

 private:
  SequenceGroups(std::string name, const File& file, uint64_t end)
      : name_(std::move(name)),
        end_(end),
        heads_(file),
        indices_(file),
        chain_(std::make_shared<GroupChain>(file, end)) {}

  bool findEnds();
  bool read(FileBytes& bytes, uint64_t offset, uint64_t size);
  /// Takes the group that begins there. Null where the file ends or after a reported error, which
  /// `good_` tells apart.
  const FrameGroup* take(uint64_t offset);
  const FrameGroup* take(std::span<const uint8_t> bytes, uint64_t offset);
  /// Takes the group of a frame by the index at the end; null without one.
  const FrameGroup* locate(int64_t frame);
  bool follows(const FrameGroup& group) const;

  std::string name_;
  uint64_t end_;  ///< of the bytes that may be used
  FileBytes heads_, indices_;
  std::shared_ptr<GroupChain> chain_;
  SequenceClock clock_;
  std::map<uint64_t, FrameGroup> groups_;  ///< that were read, by their first frames
  std::string checksum_;                   ///< of the head of the first one
  bool good_ = true;
};

/// Whether bytes begin as a sequence does.
bool isSequence(std::span<const uint8_t> bytes);

}  // namespace tetrakis::gdal
