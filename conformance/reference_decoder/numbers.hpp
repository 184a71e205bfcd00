// SPDX-License-Identifier: Apache-2.0
// Reference decoder: the numbers of corrections, from those of samples nearby (docs/FORMAT.md,
// section 8.1.8).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "conformance/reference_decoder/error_forecast.hpp"
#include "conformance/reference_decoder/mixed.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"
#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {

inline int bitsOf(int64_t n) {
  return static_cast<int>(std::bit_width(static_cast<uint64_t>(n)));
}

/// The numbers of samples that have been decoded.
class KnownNumbers {
 public:
  explicit KnownNumbers(const Plane& plane) : plane_(plane), q_(plane.values.size()) {}

  void put(int x, int y, int32_t q) { q_[index(x, y)] = q; }
  bool has(int x, int y) const {
    return x >= 0 && x < plane_.width && y >= 0 && plane_.isValid(x, y);
  }
  int32_t at(int x, int y) const { return q_[index(x, y)]; }

 private:
  size_t index(int x, int y) const { return static_cast<size_t>(y) * plane_.width + x; }

  const Plane& plane_;
  std::vector<int32_t> q_;
};

/// FORMAT 8.1.8: the numbers of samples nearby, counted from r in the direction d.
struct Nearby {
  int64_t w = 0, n = 0, nw = 0, ne = 0, ww = 0, nn = 0, nne = 0, nww = 0, nnw = 0;

  Nearby() = default;
  Nearby(const KnownNumbers& known, int x, int y, int64_t r, int d) {
    const auto at = [&](int i, int j, int64_t otherwise) {
      return known.has(x + i, y + j) ? (int64_t{known.at(x + i, y + j)} - r) * d : otherwise;
    };
    w = at(-1, 0, at(0, -1, 0));
    n = at(0, -1, w);
    nw = at(-1, -1, n);
    ne = at(1, -1, n);
    ww = at(-2, 0, w);
    nn = at(0, -2, n);
    nne = at(1, -2, ne);
    nww = at(-2, -1, nw);
    nnw = at(-1, -2, nw);
  }
  int alike() const {
    const bool same[9] = {w == nw, w == n,    n == ne,   n == nn,  w == ww,
                          n == nw, ne == nne, nw == nww, nw == nnw};
    int bits = 0;
    for (int i = 0; i < 9; ++i) bits |= same[i] << i;
    return bits;
  }
  int64_t divisor() const {
    int64_t divisor = 0;
    for (const int64_t other : {nw, n, ne, ww, nn, nne, nnw, nww})
      divisor = std::gcd(divisor, w - other);
    return divisor;
  }
  int spread() const { return bitsOf(std::abs(w - nw) + std::abs(n - nw) + std::abs(n - ne)); }
};

/// FORMAT 8.1.8, "Numbers".
class NumberDecoder {
 public:
  explicit NumberDecoder(RangeDecoder& decoder) : decoder_(decoder) {
    for (auto& weights : weights_) weights.fill(kFirstWeight);
    for (auto& weights : farWeights_) weights.fill(kFirstWeight);
  }

  /// The correction of a sample. l: its level, 0 to 63; g: its place, 0 to 15.
  uint32_t next(const Nearby& nearby, int l, int g) {
    nearby_ = &nearby;
    z_ = 16 * l + g;
    const bool expected = nearby.alike() == 511 && nearby.w == 0;
    if (expected && !expected_[z_].decode(decoder_)) return 0;
    return expected ? other() : farOrOther(l);
  }

 private:
  uint32_t farOrOther(int l) {
    const Nearby& nearby = *nearby_;
    const int64_t far[3] = {nearby.w, nearby.n, nearby.ne};
    for (int i = 0; i < 3; ++i) {
      if (std::abs(far[i]) <= 8 || std::find(far, far + i, far[i]) != far + i) continue;
      if (askFar(i, far[i], l)) return static_cast<uint32_t>(far[i]);
    }
    return ask(0, 0, 0) == 0 ? 0 : other();
  }

  /// A correction that is not 0.
  uint32_t other() {
    const int negative = ask(1, 1, 0), s = negative ? -1 : 1;
    int k = 1 + ones(7, [&](int i) {
              return ask(1 + std::min(i + 1, 4) + 4 * negative, 2 + negative, s * (i + 1));
            });
    uint32_t size = static_cast<uint32_t>(k);
    if (k == 8) {
      k = 1 + ones(31, [&](int i) { return ask(10 + i, 4, 8 * s); });
      size = 7 + digits(decoder_, k, high_);
    }
    return s < 0 ? 0 - size : size;
  }

  int askFar(int i, int64_t a, int l) {
    const Nearby& q = *nearby_;
    const int64_t six[6] = {q.w, q.n, q.nw, q.ne, q.ww, q.nn};
    int which = 0;
    for (int bit = 0; bit < 6; ++bit) which |= (six[bit] == a) << bit;
    const int z = std::min(bitsOf(std::abs(a)), 15);
    Model* const models[3] = {&farSize_[(l * 16 + z) * 3 + i], &farSix_[(which * 64 + l) * 3 + i],
                              &farAlike_[(q.alike() * 16 + z) * 3 + i]};
    return decodeMixed(decoder_, models, farWeights_[std::min(q.spread(), 9) * 3 + i]);
  }

  int ask(int i, int t, int64_t a) {
    const Nearby& q = *nearby_;
    const auto near = [&](int64_t step, int64_t k) {
      return static_cast<int>(std::clamp(step - a, -k, k) + k);
    };
    const int two = near(q.w, 1) + 3 * near(q.n, 1), spread = q.spread();
    const int64_t plane = q.w + q.n - q.nw;
    const int lines =
        (near(plane, 5) * 11 + near((q.w + q.n) >> 1, 5)) * 11 + near(q.n + q.ne - q.nne, 5);
    const int straight = near(2 * q.w - q.ww, 5) * 11 + near(2 * q.n - q.nn, 5);
    const int around = ((near(q.w, 3) * 7 + near(q.n, 3)) * 7 + near(q.nw, 3)) * 7 + near(q.ne, 3);
    const int64_t divisor = q.divisor();
    const bool multiple = divisor > 0 && (q.w - a) % divisor == 0;
    const int multiples = (static_cast<int>(std::min<int64_t>(divisor, 40)) * 2 + multiple) * 10 +
                          std::min(spread, 9);
    Model* const models[7] = {&size_[z_ * 41 + i],
                              &lines_[lines * 5 + t],
                              &plane_[(near(plane, 10) * 8 + std::min(spread, 7)) * 5 + t],
                              &alike_[(q.alike() * 9 + two) * 5 + t],
                              &straight_[straight * 5 + t],
                              &around_[around * 5 + t],
                              &multiples_[multiples * 5 + t]};
    return decodeMixed(decoder_, models, weights_[std::min(spread, 9) * 41 + i]);
  }

  RangeDecoder& decoder_;
  const Nearby* nearby_ = nullptr;
  int z_ = 0;
  ModelTable expected_ = ModelTable(64 * 16);
  ModelTable size_ = ModelTable(64 * 16 * 41), lines_ = ModelTable(11 * 11 * 11 * 5),
             plane_ = ModelTable(21 * 8 * 5);
  ModelTable alike_ = ModelTable(512 * 9 * 5), straight_ = ModelTable(11 * 11 * 5);
  ModelTable around_ = ModelTable(7 * 7 * 7 * 7 * 5), high_ = ModelTable(33);
  ModelTable multiples_ = ModelTable(41 * 2 * 10 * 5);
  ModelTable farSize_ = ModelTable(64 * 16 * 3), farSix_ = ModelTable(64 * 64 * 3);
  ModelTable farAlike_ = ModelTable(512 * 16 * 3);
  std::array<std::array<int64_t, 7>, 10 * 41> weights_;
  std::array<std::array<int64_t, 3>, 10 * 3> farWeights_;
};

/// FORMAT 8.1.8, "Corrections": numbers that are expected to be 0.
class CorrectionDecoder {
 public:
  CorrectionDecoder(RangeDecoder& decoder, const Plane& plane) : numbers_(decoder), known_(plane) {}

  /// The correction of the next valid sample.
  uint32_t next(int hint, int x, int y) {
    const Nearby nearby(known_, x, y, 0, 1);
    const int64_t n =
        2 * std::abs(nearby.w) + 2 * std::abs(nearby.n) + std::abs(nearby.nw) + std::abs(nearby.ne);
    const uint32_t c = numbers_.next(nearby, std::min(levelOf(n), 63), hint);
    known_.put(x, y, static_cast<int32_t>(c));
    return c;
  }

 private:
  NumberDecoder numbers_;
  KnownNumbers known_;
};

}  // namespace tetrakis::reference
