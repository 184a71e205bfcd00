// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/glue.hpp"

#include <algorithm>

#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {
namespace {

/// Thrown: the codeword names what it must not name.
struct Unsound {};

class Walk {
 public:
  Walk(RangeDecoder& decoder, int faces, int m)
      : decoder_(decoder), m_(m), most_(m == 3 ? 11 : 7), met_(faces), sides_(size_t(m) * faces) {}

  std::vector<int> run() {
    while (lowestUnmet() < faces()) {
      meet(m_ * lowestUnmet());
      while (!open_.empty()) tell(chosen());
    }
    std::vector<int> glued;
    for (const Side& side : sides_) glued.push_back(side.glued);
    return glued;
  }

 private:
  struct Side {
    int next = 0, last = 0, around = 0, glued = 0;
    bool open = false;
  };

  int faces() const { return static_cast<int>(met_.size()); }
  int lowestUnmet() const {
    return static_cast<int>(std::find(met_.begin(), met_.end(), false) - met_.begin());
  }

  int rank(int s) const {
    const Side& next = sides_[sides_[s].next];
    return next.open ? std::min(next.around, most_) : 0;
  }
  /// The highest rank; among those the one that was pushed last.
  int chosen() const {
    int best = open_.back();
    for (auto s = open_.rbegin(); s != open_.rend(); ++s)
      if (rank(*s) > rank(best)) best = *s;
    return best;
  }

  void tell(int s) {
    const int next = sides_[s].next, last = sides_[s].last;
    const int i = sides_[next].open && next != s;
    const int j = sides_[last].open && last != s && last != next;
    if (i && after_[std::min(sides_[next].around, most_)][j].decode(decoder_)) return glue(s, next);
    if (j && before_[std::min(sides_[s].around, most_)][i].decode(decoder_)) return glue(s, last);
    if (lowestUnmet() < faces() && new_[i][j].decode(decoder_)) return attach(s);
    if (!border_[i][j].decode(decoder_)) return glue(s, number(m_ * faces()));
    sides_[s].glued = s;
    close(s);
    push(last);
  }

  void attach(int s) {
    const int p = other_.decode(decoder_) ? number(faces()) : lowestUnmet();
    const int h = turn_[0].decode(decoder_);
    const int entered = 2 * h + turn_[1 + h].decode(decoder_);
    if (entered >= m_) throw Unsound();
    meet(m_ * p + entered);
    glue(s, m_ * p + entered);
  }

  void meet(int t) {
    const int first = t / m_ * m_;
    if (t >= static_cast<int>(sides_.size()) || met_[t / m_]) throw Unsound();
    met_[t / m_] = true;
    for (int i = 0; i < m_; ++i)
      sides_[first + i] = {first + (i + 1) % m_, first + (i + m_ - 1) % m_, 1, 0, true};
    for (int i = 0; i < m_; ++i) push(first + (t - first + i) % m_);
  }

  void glue(int s, int t) {
    if (t >= static_cast<int>(sides_.size()) || t == s || !sides_[t].open) throw Unsound();
    sides_[s].glued = t;
    sides_[t].glued = s;
    close(s);
    close(t);
    unite(s, t);
    unite(t, s);
    push(sides_[s].last);
    push(sides_[t].last);
  }
  void unite(int s, int t) {
    sides_[sides_[t].next].around += sides_[s].around;
    sides_[sides_[s].last].next = sides_[t].next;
    sides_[sides_[t].next].last = sides_[s].last;
  }

  void close(int s) {
    sides_[s].open = false;
    std::erase(open_, s);
  }
  void push(int s) {
    if (!sides_[s].open) return;
    std::erase(open_, s);
    open_.push_back(s);
  }

  int number(int count) {
    int value = 0;
    for (int left = count - 1; left > 0; left /= 2) value = 2 * value + decoder_.even();
    return value;
  }

  RangeDecoder& decoder_;
  int m_, most_;
  std::vector<bool> met_;
  std::vector<Side> sides_;
  std::vector<int> open_;  ///< in the order in which they were pushed last
  Model after_[12][2], before_[12][2], new_[2][2], border_[2][2], other_, turn_[3];
};

}  // namespace

std::optional<std::vector<int>> readGlue(RangeDecoder& decoder, int faces, int sides) {
  try {
    return Walk(decoder, faces, sides).run();
  } catch (const Undecided&) {
    return {};
  } catch (const Unsound&) {
    return {};
  }
}

}  // namespace tetrakis::reference
