// SPDX-License-Identifier: Apache-2.0
// decodeTrack() decodes any prefix of a track's codeword to the known bits of the coefficients.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/coder/range_decoder.hpp"
#include "bitstream/track/track.hpp"

namespace tetrakis::inline track {

/// Runs the passes of `plan` over `codeword`, up to the last one of a band that is needed, until
/// its bytes decide nothing more. Bands that are not needed are decoded as far as they come before
/// that: there is one codeword. Safe on any bytes: work is bounded by planes * coefficients, memory
/// by the plan.
TrackState decodeTrack(const std::vector<BandPlan>& plan, int planes,
                       std::span<const uint8_t> codeword);

/// Decodes one prefix after the other, each longer than the one before: what that one decided is
/// not decoded again.
class GrowingTrack {
 public:
  GrowingTrack(std::vector<BandPlan> plan, int planes);

  /// codeword: begins with that of the call before, wherever it lies; what an encoder wrote (of
  /// other bytes the state may be one that no prefix has). The state is valid until the next call.
  const TrackState& decode(std::span<const uint8_t> codeword);

  /// decode() goes on for these bands too. parts: of each whether it is needed; the plan has one or
  /// more planes of so many bands.
  void need(const std::vector<bool>& parts);

  /// All passes that the first `bytes` bytes decide, to the end of the last one of them, which may
  /// read on: nothing has to be taken back. codeword: all of it, the same at every call. Not mixed
  /// with calls of decode().
  const TrackState& decodePasses(std::span<const uint8_t> codeword, uint64_t bytes);

  /// What the state takes, as it is and as it was at the beginning of a pass.
  uint64_t bytes() const;

 private:
  void goOn(std::span<const uint8_t> codeword);
  void keep();
  bool mayEnd() const;

  std::vector<BandPlan> plan_;
  int planes_;
  PassQueue passes_;
  TrackState state_;
  size_t bytes_ = 0;    ///< of the codeword before
  size_t longest_ = 0;  ///< bytes that a pass has taken at most
  // As they were at the beginning of the pass that is next, if it has begun.
  std::optional<RangeDecoder> decoder_;
  size_t read_ = 0;  ///< by the decoder
  std::optional<Band> band_;
  std::optional<BandModels> models_;
  bool lost_ = false;   ///< it has begun, and they were not kept
  bool ended_ = false;  ///< the codeword ends in it
};

}  // namespace tetrakis::inline track
