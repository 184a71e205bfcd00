// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "bitstream/coder/range_encoder.hpp"
#include "codec/frames/frame_masks.hpp"

namespace tetrakis::inline frames {

namespace {

/// Knows the masks of all frames, and says what each decision asks for.
class EncodingSide {
 public:
  EncodingSide(const std::vector<BitPlane>& masks) : masks_(masks) {}
  void begin(size_t frame) { shown_ = masks_[frame].bytes(); }
  void begin(size_t frame, Change change, const BitPlane& among) {
    const BitPlane& mask = masks_[frame];
    shown_ = without(among, change == kArrives ? inverse(mask) : mask).bytes();
  }
  bool any(AdaptiveBit& model) {
    const bool marked = std::find(shown_.begin(), shown_.end(), 1) != shown_.end();
    encoder_.encode(model, marked);
    return marked;
  }
  bool bit(AdaptiveBit& model, size_t sample) {
    encoder_.encode(model, shown_[sample] != 0);
    return shown_[sample] != 0;
  }
  uint32_t run(AdaptiveBit&, bool, uint32_t) { return 0; }
  bool stopped() const { return false; }
  std::vector<uint8_t> finish() { return encoder_.finish(); }

 private:
  const std::vector<BitPlane>& masks_;
  std::vector<uint8_t> shown_;
  RangeEncoder encoder_;
};

}  // namespace

std::vector<uint8_t> encodeFrameMasks(const FrameMasks& masks, Extent plane) {
  const auto is_whole = [](const SharedBits& mask) { return mask == nullptr || mask->all(); };
  if (std::all_of(masks.begin(), masks.end(), is_whole)) return {};
  const BitPlane whole = inverse(BitPlane(plane));
  std::vector<BitPlane> known;
  for (const SharedBits& mask : masks) known.push_back(mask == nullptr ? whole : *mask);
  EncodingSide side(known);
  FrameMaskPass<EncodingSide>(plane, side).run(known.size());
  std::vector<uint8_t> codeword = side.finish();
  if (codeword.empty()) codeword.push_back(0);
  return codeword;
}

}  // namespace tetrakis::inline frames
