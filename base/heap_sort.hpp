// SPDX-License-Identifier: Apache-2.0
// heapSort() sorts a range in a tenth of the code of std::sort and in about twice its time, which
// suits short lists.
#pragma once

#include <algorithm>
#include <functional>

namespace tetrakis::inline base {

template <class Range, class Less = std::less<>>
void heapSort(Range& range, const Less& less = {}) {
  std::make_heap(range.begin(), range.end(), less);
  std::sort_heap(range.begin(), range.end(), less);
}

}  // namespace tetrakis::inline base
