// SPDX-License-Identifier: Apache-2.0
// FrameMaskPass codes which samples of each frame of a group are valid. The mask of the first frame
// is coded as that of a single one is (codec/lattice/validity.hpp). Each further one is coded by
// what changes: first the samples that arrive among those that were void, then those that go among
// those that were valid. Masks that stay take two decisions a frame.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/bit_plane.hpp"
#include "base/plane.hpp"
#include "bitstream/coder/adaptive_bit.hpp"
#include "codec/lattice/validity.hpp"

namespace tetrakis::inline frames {

/// The masks of frames; null: every sample is valid.
using FrameMasks = std::vector<SharedBits>;

/// The marks of `a` without those of `b`.
inline BitPlane without(BitPlane a, const BitPlane& b) {
  for (uint32_t y = 0; y < a.extent().height; ++y)
    for (uint32_t k = 0; k < a.words(); ++k) a.row(y)[k] &= ~b.row(y)[k];
  return a;
}
inline BitPlane joined(BitPlane a, const BitPlane& b) {
  for (uint32_t y = 0; y < a.extent().height; ++y)
    for (uint32_t k = 0; k < a.words(); ++k) a.row(y)[k] |= b.row(y)[k];
  return a;
}
inline BitPlane inverse(BitPlane of) {
  of.invert();
  return of;
}

enum Change : uint8_t { kArrives = 0, kGoes = 1 };

/// Runs over the masks of all frames once. Side is the encoder's or the decoder's side of
/// decisions:
///   void begin(size_t frame)                what follows is the mask of the frame, or ...
///   void begin(size_t frame, Change, const BitPlane& among)    ... a change to it, among these
///   bool any(AdaptiveBit&)                  whether there is such a change
///   bit, run, stopped                       as of ValidityPass
template <class Side>
class FrameMaskPass {
 public:
  FrameMaskPass(Extent plane, Side& side) : plane_(plane), side_(side) {}

  std::vector<BitPlane> run(size_t frames) {
    MaskIo whole{side_};
    side_.begin(0);
    std::vector<BitPlane> masks;
    masks.push_back(ValidityPass<MaskIo>(plane_, whole).run());
    while (masks.size() < frames) {
      const BitPlane& before = masks.back();
      const BitPlane arrived = changes(kArrives, inverse(before), masks.size());
      const BitPlane gone = changes(kGoes, before, masks.size());
      masks.push_back(without(joined(before, arrived), gone));
    }
    return masks;
  }

 private:
  /// Of a whole mask: a vertex of which nothing is known is what most of its neighbours are. Of
  /// changes, which only some samples may have: what nothing is known of stays.
  struct MaskIo {
    Side& side;
    const BitPlane* among = nullptr;  ///< null: it is a whole mask
    uint64_t asked(const SampleLine& line) const { return marksOf(among, line); }
    bool bit(AdaptiveBit& model, size_t sample) { return side.bit(model, sample); }
    uint32_t run(AdaptiveBit& model, bool valid, uint32_t most) {
      return side.run(model, valid, most);
    }
    bool stopped() const { return side.stopped(); }
    uint64_t otherwise(uint64_t, uint64_t majority) const {
      return among == nullptr ? majority : 0;
    }
  };

  /// Which samples arrive among those that were void, or go among those that were valid.
  BitPlane changes(Change kind, const BitPlane& among, size_t frame) {
    side_.begin(frame, kind, among);
    if (!side_.any(any_[kind]) || side_.stopped()) return BitPlane(plane_);
    io_[kind].among = &among;
    return passes_[kind].run();
  }

  Extent plane_;
  Side& side_;
  std::array<AdaptiveBit, 2> any_;
  // Models of both kinds go on from frame to frame.
  std::array<MaskIo, 2> io_{MaskIo{side_}, MaskIo{side_}};
  std::array<ValidityPass<MaskIo>, 2> passes_{ValidityPass<MaskIo>{plane_, io_[0]},
                                              ValidityPass<MaskIo>{plane_, io_[1]}};
};

/// Returns the masks of so many frames. codeword: any prefix of that of encodeFrameMasks(); an
/// empty one says that every sample is valid. Safe on any bytes.
FrameMasks decodeFrameMasks(std::span<const uint8_t> codeword, Extent plane, size_t frames);

/// Returns the codeword of the masks of frames, one byte or more; none if all samples of all frames
/// are valid. Encoder only.
std::vector<uint8_t> encodeFrameMasks(const FrameMasks& masks, Extent plane);

/// Marks the samples that are valid in a frame at least; null: all.
SharedBits everValid(const FrameMasks& masks);

}  // namespace tetrakis::inline frames
