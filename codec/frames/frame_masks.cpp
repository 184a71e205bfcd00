// SPDX-License-Identifier: Apache-2.0
#include "codec/frames/frame_masks.hpp"

#include <algorithm>

#include "bitstream/coder/range_decoder.hpp"

namespace tetrakis::inline frames {

namespace {

class DecodingSide {
 public:
  explicit DecodingSide(std::span<const uint8_t> codeword) : decoder_(codeword) {}
  void begin(size_t) {}
  void begin(size_t, Change, const BitPlane&) {}
  bool any(AdaptiveBit& model) { return !stopped() && decoder_.decode(model); }
  bool bit(AdaptiveBit& model, size_t) { return decoder_.decode(model); }
  uint32_t run(AdaptiveBit& model, bool valid, uint32_t most) {
    return decoder_.decodeRun(model, valid, most);
  }
  bool stopped() const { return decoder_.exhausted(); }

 private:
  RangeDecoder decoder_;
};

}  // namespace

FrameMasks decodeFrameMasks(std::span<const uint8_t> codeword, Extent plane, size_t frames) {
  if (codeword.empty()) return FrameMasks(frames);
  DecodingSide side(codeword);
  FrameMasks masks;
  for (BitPlane& mask : FrameMaskPass<DecodingSide>(plane, side).run(frames))
    masks.push_back(shared(std::move(mask)));
  return masks;
}

SharedBits everValid(const FrameMasks& masks) {
  const auto none = [](const SharedBits& mask) { return mask == nullptr; };
  if (std::any_of(masks.begin(), masks.end(), none)) return nullptr;
  BitPlane ever = *masks.front();
  for (size_t t = 1; t < masks.size(); ++t) ever = joined(std::move(ever), *masks[t]);
  return ever.all() ? nullptr : shared(std::move(ever));
}

}  // namespace tetrakis::inline frames
