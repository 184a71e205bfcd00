// SPDX-License-Identifier: Apache-2.0
// decodeTrack() decodes any prefix of a track's codeword to the known bits of the coefficients.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bitstream/coder/range_decoder.hpp"
#include "bitstream/track/track.hpp"

namespace tetrakis::inline track {

/// Runs the passes of `plan` over `codeword`, up to the last one of a band that is needed, until
/// its bytes decide nothing more. Bands that are not needed are decoded as far as they come before
/// that: there is one codeword. Safe on any bytes: work is bounded by planes * coefficients, memory
/// by the plan.
TrackState decodeTrack(std::vector<BandPlan> plan, int planes, std::span<const uint8_t> codeword);

/// What the decisions from one place of a pass to the next change.
class BeforeRow {
 public:
  BeforeRow(const RangeDecoder& decoder, const Band& band, size_t tier, const BandModels& models,
            PassPlace place);

  const RangeDecoder& decoder() const { return decoder_; }
  PassPlace place() const { return place_; }
  /// Takes back what they have changed.
  void restore(Band& band, size_t tier, BandModels& models) const;

 private:
  static constexpr size_t kColumns = 32;

  RangeDecoder decoder_;
  BandModels models_;
  PassPlace place_;
  TierState tier_;
  uint32_t significant_, visited_;
  std::array<uint32_t, kColumns> magnitude_;
  std::array<uint8_t, kColumns> scaled_;
  std::array<int8_t, kColumns> sign_;
};

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

  /// What the call before knew.
  TrackState state() && { return std::move(state_); }
  uint64_t bytes() const;

 private:
  void goOn(std::span<const uint8_t> codeword);
  /// Runs the next pass to its end; false: the codeword ends in it.
  bool runNext();

  std::vector<BandPlan> plan_;
  int planes_;
  PassQueue passes_;
  TrackState state_;
  size_t bytes_ = 0;                     ///< of the codeword before
  std::optional<RangeDecoder> decoder_;  ///< as it was at the beginning of the next pass
  size_t read_ = 0;                      ///< by it, or by that of stop_
  std::optional<BeforeRow> stop_;        ///< where the codeword before ends in that pass
};

}  // namespace tetrakis::inline track
