// SPDX-License-Identifier: Apache-2.0
// DecidedPlaces notes how many bytes of a codeword decide each place of a plane, as a
// GrowingDecoder finds out. It then lists the places that a prefix of any length shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetrakis::inline coder {

class DecidedPlaces {
 public:
  /// The decisions of a place follow. bytes: that decide all places before it; they do not fall.
  void next(size_t place, uint64_t bytes) {
    end(bytes);
    places_.push_back({place, 0});
  }
  /// All decisions have been made.
  void end(uint64_t bytes) {
    if (!places_.empty()) places_.back().bytes = bytes;
  }

  /// Calls show() for the places that so many bytes decide beside those of the call before. If they
  /// are fewer, hide() comes first, and all are shown again.
  template <class Hide, class Show>
  void showAfter(uint64_t bytes, const Hide& hide, const Show& show) {
    if (shown_ > 0 && places_[shown_ - 1].bytes > bytes) {
      hide();
      shown_ = 0;
    }
    for (; shown_ < places_.size() && places_[shown_].bytes <= bytes; ++shown_)
      show(places_[shown_].place);
  }

 private:
  struct Decided {
    size_t place;
    uint64_t bytes;  ///< that decide it and all before it
  };
  std::vector<Decided> places_;
  size_t shown_ = 0;
};

}  // namespace tetrakis::inline coder
