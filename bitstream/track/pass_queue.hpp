// SPDX-License-Identifier: Apache-2.0
// PassQueue gives the order of a track's passes: the next pass is always the pending one of the
// greatest key, key = log2(norm of the band) + bit-plane + priority of the tier - delay. The delay
// depends on the kind of pass and on the number of coefficients that are known to be significant.
// Both sides know all of this, so the order costs no bits, and each pass improves the surface or
// image by about the same factor as its neighbours.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/track/track.hpp"

namespace tetrakis::inline track {

class PassQueue {
 public:
  PassQueue(const std::vector<BandPlan>& plan, int planes);

  bool empty() const { return pending_.empty(); }
  /// The next pass.
  const Pass& front() const { return pending_.front(); }
  /// Takes the next pass off the queue, once it has been coded. band: what is known by then of its
  /// band.
  void pop(const Band& band);
  /// Bands that are needed (BandPlan::needed) have passes left.
  bool needed() const { return needed_ > 0; }

 private:
  struct Progress {
    int log_norm = 0, key_floor = 0;  ///< those of the band, raised by the tier's priority
    bool needed = false;
    uint32_t coefficients = 0;  ///< that exist
    uint8_t open = 0;           ///< passes of the plane that are not coded yet
  };

  Progress& progressOf(const Pass& pass) { return progress_[kPriorities * pass.band + pass.tier]; }
  void push(Pass pass, uint32_t significant);

  std::vector<Progress> progress_;  ///< of each tier of each band
  std::vector<Pass> pending_;       ///< a heap
  size_t needed_ = 0;               ///< tiers of needed bands with passes left
};

}  // namespace tetrakis::inline track
