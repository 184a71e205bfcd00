// SPDX-License-Identifier: Apache-2.0
// takeArguments() copies and checks what callers of tks_encode and its siblings hand over, and
// proveFrames() checks the stream that was made of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "api/group_chain.hpp"
#include "encoder/groups/coded_frames.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

/// TKS_USAGE with a sentence.
Status misuse(const std::string& sentence);

/// The caller's structs as this library knows them, checked.
struct Arguments {
  tks_heights heights;
  tks_image image;
  tks_encode_options options;
};

/// heights, image: null: there are none.
Status takeArguments(const tks_heights* heights, const tks_image* image,
                     const tks_encode_options* options, Arguments& out);

/// The frames of a group as this library knows them, checked.
struct FrameArguments {
  std::vector<tks_heights> heights;  ///< empty: there are none
  std::vector<tks_image> images;
  tks_encode_options options;

  uint32_t frames() const {
    return static_cast<uint32_t>(heights.empty() ? images.size() : heights.size());
  }
};

/// Adds a frame, which has to be like those before. options: of the first frame.
Status takeFrame(const tks_heights* heights, const tks_image* image,
                 const tks_encode_options& options, FrameArguments& out);

/// How the frames of a group are coded.
struct GroupCoding {
  bool refers = false;  ///< later groups go on from it: also a single frame is coded as frames are
  const GroupBefore* before = nullptr;  ///< what it may go on from itself; null: nothing
};

/// The last frames that decoders of the next group take from this one, which outlives them.
inline References referencesTo(const GroupBefore& before) {
  return {{[&before] { return before.last_heights; }, 0},
          {[&before] { return before.last_texture; }, 0}};
}

/// The stream of one frame or more, which is proved to keep what it promises. TKS_UNSUPPORTED: as
/// of tks_encode_frames.
Result<std::vector<uint8_t>> encodeFrames(const FrameArguments& frames,
                                          const GroupCoding& coding = {});

}  // namespace tetrakis::inline api
