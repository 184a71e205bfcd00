// SPDX-License-Identifier: Apache-2.0
// Reference decoder: the indices of drawings (docs/FORMAT.md, section 9.1).
#include "conformance/reference_decoder/drawing.hpp"

#include <algorithm>

#include "conformance/reference_decoder/mixed.hpp"

namespace tetrakis::reference {
namespace {

uint32_t hash(uint32_t context, int bits) {
  return (context * 2654435761u) >> (32 - bits);
}

}  // namespace

void Drawing::decodeIndices() {
  try {
    forEachVertex(width_, height_, [&](const Vertex& v) {
      if (isValid(at(v.x, v.y))) indices_[at(v.x, v.y)] = next(candidatesOf(v), v.centre);
    });
  } catch (Undecided) {
  }
}

std::vector<Candidate> Drawing::candidatesOf(const Vertex& v) const {
  std::vector<Candidate> found;
  uint32_t bit = 1;
  const auto meet = [&](Offset o) {
    const int x = v.x + o.x, y = v.y + o.y;
    if (inside(x, y) && isValid(at(x, y))) {
      const int index = indices_[at(x, y)];
      auto same = std::find_if(found.begin(), found.end(),
                               [&](const Candidate& c) { return c.index == index; });
      if (same == found.end()) same = found.insert(found.end(), Candidate{index});
      same->pattern |= bit;
    }
    bit *= 2;
  };
  if (v.s == 0) return found;
  for (int i = 0; i < 4; ++i) meet(v.coarser(i));
  meet(v.c1());
  meet(v.c2());
  for (int i = 4; i < 12; ++i) meet(v.coarser(i));
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.votes() > b.votes(); });
  return found;
}

int Drawing::next(const std::vector<Candidate>& candidates, bool centre) {
  for (size_t i = 0; i < std::min<size_t>(candidates.size(), 3); ++i) {
    if (isCandidate(candidates, i, centre)) return candidates[i].index;
  }
  if (listed() == 0 || (listed() < 4096 && fresh_.decode(decoder_))) {
    append(candidates);
    return static_cast<int>(listed()) - 1;
  }
  return known(candidates);
}

bool Drawing::isCandidate(const std::vector<Candidate>& candidates, size_t i, bool centre) {
  const size_t n = candidates.size();
  const Candidate& c = candidates[i];
  int more = 0;
  if (i == 0 && n > 1) more = std::min(candidates[1].near(), 3);
  if (i == 1) more = static_cast<int>(std::min<size_t>(n, 4)) - 1;
  const int place = static_cast<int>(i);
  const int count =
      ((((place * 4 + more) * 5 + c.near()) * 3 + c.causal()) * 9 + c.ring()) * 2 + centre;
  const auto asked = static_cast<uint32_t>(2 * place + centre);
  const uint32_t pattern = asked * 16384 + c.pattern;
  const uint32_t rival = n > 1 ? candidates[i == 0 ? 1 : 0].pattern % 64 : 0;
  Model* const shape[3] = {&rival_[hash(64 * pattern + rival, 18)], &pattern_[pattern],
                           &count_.at(static_cast<size_t>(count))};
  if (c.pattern == 0x3fff) return decide({shape[0], shape[1], shape[2]}) != 0;
  uint32_t trio = asked;
  for (size_t k = 0; k < 3; ++k)
    trio = trio * 4099 + (k < n ? static_cast<uint32_t>(candidates[k].index) : 65535u);
  Model* const models[5] = {shape[0], shape[1], shape[2],
                            &slope_[hash(slopeOf(candidates, i, asked), 16)],
                            &trio_[hash(trio, 16)]};
  return decodeMixed(decoder_, models, weights_[4 * asked + std::min<size_t>(n, 4) - 1]) != 0;
}

uint32_t Drawing::slopeOf(const std::vector<Candidate>& candidates, size_t i,
                          uint32_t asked) const {
  uint32_t slope = asked;
  for (uint32_t neighbour = 0; neighbour < 4; ++neighbour) {
    uint32_t d = 36;
    for (const Candidate& c : candidates) {
      if (c.pattern >> neighbour & 1) d = difference(c.index, candidates[i].index);
    }
    slope = slope * 37 + d;
  }
  return slope;
}

int Drawing::known(const std::vector<Candidate>& candidates) {
  const uint32_t k1 = candidates.empty() ? 4096 : candidates[0].index;
  const uint32_t k2 = candidates.size() < 2 ? 4096 : candidates[1].index;
  uint32_t node = 1;
  while (node < 4096) {
    Model* const models[3] = {&pair_[hash((k1 * 4099 + k2) * 4099 + node, 18)],
                              &single_[hash(k1 * 4099 + node, 16)], &plain_[node]};
    node = 2 * node + static_cast<uint32_t>(decodeMixed(decoder_, models, known_weights_));
  }
  return std::min(static_cast<int>(node) - 4096, static_cast<int>(listed()) - 1);
}

int32_t Drawing::residual(std::span<Model> models) {
  return static_cast<int32_t>(signedNumber(decoder_, models));
}

/// FORMAT 9.1: "The first of three models".
int Drawing::decide(const std::array<Model*, 3>& models) {
  Model* asked = models[2];
  if (models[1]->seen() >= 2) asked = models[1];
  if (models[0]->seen() >= 2) asked = models[0];
  const int bit = asked->decode(decoder_);
  for (Model* model : models) {
    if (model != asked) model->learn(bit);
  }
  return bit;
}

}  // namespace tetrakis::reference
