// SPDX-License-Identifier: Apache-2.0
// Reference decoder: what drawn textures (docs/FORMAT.md, section 9.1) and drawn heights (8.4) have
// in common.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "conformance/reference_decoder/lattice.hpp"
#include "conformance/reference_decoder/mixed.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {

struct Candidate {
  int index;
  uint32_t pattern = 0;

  int near() const { return std::popcount(pattern & 15); }
  int causal() const { return std::popcount(pattern >> 4 & 3); }
  int ring() const { return std::popcount(pattern >> 6); }
  int votes() const { return 6 * near() + 4 * causal() + ring(); }
};

class Drawing {
 public:
  /// valid: empty: all vertices are.
  Drawing(int width, int height, std::vector<uint8_t> valid, std::span<const uint8_t> codeword)
      : width_(width),
        height_(height),
        valid_(std::move(valid)),
        indices_(static_cast<size_t>(width) * height, -1),
        decoder_(codeword),
        pair_(1 << 18),
        single_(1 << 16),
        plain_(1 << 12),
        rival_(1 << 18),
        pattern_(6 << 14),
        slope_(1 << 16),
        trio_(1 << 16) {
    for (auto& weights : weights_) weights.fill(kFirstWeight);
    known_weights_.fill(kFirstWeight);
  }

 protected:
  /// Appends a new value to the list.
  virtual void append(const std::vector<Candidate>& candidates) = 0;
  virtual size_t listed() const = 0;
  /// `difference` of FORMAT 9.1 and 8.4.
  virtual uint32_t difference(int a, int b) const = 0;
  ~Drawing() = default;

  void decodeIndices();
  /// `residual` of FORMAT 9.1, from the models of one channel, modulo 2^32.
  int32_t residual(std::span<Model> models);

  bool inside(int x, int y) const { return x >= 0 && x < width_ && y >= 0 && y < height_; }
  size_t at(int x, int y) const { return static_cast<size_t>(y) * width_ + x; }
  bool isValid(size_t vertex) const { return valid_.empty() || valid_[vertex] != 0; }

  int width_, height_;
  std::vector<uint8_t> valid_;
  std::vector<int> indices_;  ///< -1: none

 private:
  std::vector<Candidate> candidatesOf(const Vertex& vertex) const;
  int next(const std::vector<Candidate>& candidates, bool centre);
  bool isCandidate(const std::vector<Candidate>& candidates, size_t i, bool centre);
  uint32_t slopeOf(const std::vector<Candidate>& candidates, size_t i, uint32_t asked) const;
  int known(const std::vector<Candidate>& candidates);
  int decide(const std::array<Model*, 3>& models);

  RangeDecoder decoder_;
  std::array<Model, 3 * 4 * 5 * 3 * 9 * 2> count_;
  Model fresh_;
  std::vector<Model> pair_, single_, plain_, rival_, pattern_, slope_, trio_;
  std::array<std::array<int64_t, 5>, 24> weights_;
  std::array<int64_t, 3> known_weights_;
};

}  // namespace tetrakis::reference
