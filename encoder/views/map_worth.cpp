// SPDX-License-Identifier: Apache-2.0
#include "encoder/views/map_worth.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/portable_math.hpp"
#include "encoder/selection/write_stream.hpp"
#include "encoder/views/errors_of_prefixes.hpp"

namespace tetrakis::inline views {

namespace {

/// The budget over this number is the earlier of the two lengths at which maps are judged. A larger
/// number counts earlier prefixes, of which the map takes more.
constexpr uint64_t kEarlyPart = 2;
/// Errors below this count as this, in squared parts of 255: no picture is judged by less. A larger
/// number lets nearly exact pictures decide nothing.
constexpr double kNone = 1e-6;

}  // namespace

uint64_t bytesOfMaps(const Selection& selection) {
  const auto bytes = [](const PriorityHeader& map) {
    return map.none() ? size_t{0} : map.code.size() + 2;  // the size of tiles, and the length
  };
  return bytes(selection.heights->header.priorities) + bytes(selection.texture->header.priorities);
}

bool mapsPay(const EncodeInputs& inputs, const Selection& with, const Selection& without) {
  const uint64_t header = headerBytesOf(inputs, without), map = bytesOfMaps(with);
  const uint64_t room = inputs.options.bytes - std::min(inputs.options.bytes, header);
  std::vector<uint64_t> lengths, behind_map;
  for (const uint64_t length : {room / kEarlyPart, room}) {
    lengths.push_back(length);
    behind_map.push_back(lengths.back() - std::min(lengths.back(), map));
  }
  const PrefixErrors errors(inputs, with);
  const std::vector<double> mapped = errors.of(with, behind_map);
  const std::vector<double> plain = errors.of(without, lengths);
  double logarithms = 0;
  for (size_t i = 0; i < mapped.size(); ++i)
    logarithms += portable::log(std::max(mapped[i], kNone) / std::max(plain[i], kNone));
  return logarithms < 0;
}

}  // namespace tetrakis::inline views
