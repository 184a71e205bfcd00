// SPDX-License-Identifier: Apache-2.0
#include "base/samples.hpp"

size_t tks_sample_bytes(tks_sample sample) {
  if (sample < TKS_U8 || sample > TKS_F32) return 0;
  return tetrakis::withSampleType(sample, [](auto type) { return sizeof(type); });
}
