// SPDX-License-Identifier: Apache-2.0
#include "bitstream/coder/mixture.hpp"

namespace tetrakis::inline coder {

OddsTable makeOddsTable() {
  OddsTable table{};
  int32_t odds = -kMostOdds;
  for (int32_t p = 0; p < static_cast<int32_t>(table.size()); ++p) {
    while (odds < kMostOdds && probabilityOf(odds) < p) ++odds;
    table[static_cast<size_t>(p)] = static_cast<int16_t>(odds);
  }
  return table;
}

}  // namespace tetrakis::inline coder
