// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/mixed.hpp"

#include <algorithm>
#include <vector>

namespace tetrakis::reference {
namespace {

int squash(int odds) {
  constexpr int kAt[33] = {1,    2,    3,    6,    10,   16,   27,   45,   73,   120,  194,
                           310,  488,  747,  1101, 1546, 2047, 2549, 2994, 3348, 3607, 3785,
                           3901, 3975, 4022, 4050, 4068, 4079, 4085, 4089, 4092, 4093, 4094};
  const int place = (odds + 2048) / 128, part = (odds + 2048) % 128;
  return (kAt[place] * (128 - part) + kAt[place + 1] * part + 64) / 128;
}

int stretch(int probability) {
  int odds = -2047;
  for (int half = 2048; half > 0; half /= 2) {
    if (odds + half <= 2047 && squash(odds + half - 1) < probability) odds += half;
  }
  return odds;
}

}  // namespace

int decodeMixed(RangeDecoder& decoder, std::span<Model* const> models, std::span<int64_t> weights) {
  std::vector<int64_t> odds;
  int64_t sum = 0;
  for (size_t i = 0; i < models.size(); ++i) {
    odds.push_back(stretch(models[i]->zero() / 16));
    sum += odds[i] * weights[i];
  }
  const int p = squash(static_cast<int>(std::clamp<int64_t>(sum >> 16, -2047, 2047)));
  const int bit = decoder.decode(static_cast<uint32_t>(16 * p + 8));
  const int error = 16 * ((bit ? 0 : 4095) - p);
  for (size_t i = 0; i < models.size(); ++i) {
    const int64_t weight = weights[i] + ((odds[i] * error + 32768) >> 16);
    weights[i] = std::clamp<int64_t>(weight, -1048576, 1048576);
    models[i]->learn(bit);
  }
  return bit;
}

}  // namespace tetrakis::reference
