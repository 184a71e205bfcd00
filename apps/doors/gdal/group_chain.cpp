// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/group_chain.hpp"

#include <algorithm>

namespace tetrakis::gdal {

SequencePointer openSequence(const tks_limits* limits) {
  tks_sequence* sequence = nullptr;
  return SequencePointer(tks_sequence_open(limits, &sequence) == TKS_OK ? sequence : nullptr);
}

tks_status GroupChain::open(const ChainedGroup& group, const tks_limits& limits,
                            tks_decoder** decoder) {
  *decoder = nullptr;
  tks_status status = TKS_CORRUPT;
  if (group.bytes_back <= group.begin)
    status = hold(group.begin - group.bytes_back, group.end, limits);
  // Without the groups before it the library says which ones it lacks.
  if (status == TKS_CORRUPT || status == TKS_UNSUPPORTED)
    status = hold(group.begin, group.end, limits);
  if (status != TKS_OK) return status;
  status = tks_sequence_frame(sequence_.get(), group.first_frame, decoder);
  message_ = tks_sequence_message(sequence_.get());
  return status;
}

tks_status GroupChain::hold(uint64_t begin, uint64_t end, const tks_limits& limits) {
  if (!sequence_ || held_begin_ != begin) {
    sequence_ = openSequence(&limits);
    if (!sequence_) return TKS_NO_MEMORY;
    held_begin_ = held_end_ = begin;
  }
  const uint64_t wanted_end = std::min(end, end_);
  const tks_range missing{held_end_, wanted_end - std::min(held_end_, wanted_end), 0};
  if (missing.size == 0) return TKS_OK;
  FileBytes bytes(file_);
  if (bytes.read({&missing, 1})) {
    message_ = "The file cannot be read.";
    return TKS_IO;
  }
  const tks_status status =
      tks_sequence_append(sequence_.get(), bytes.at(missing.offset).data(), missing.size);
  message_ = tks_sequence_message(sequence_.get());
  if (status == TKS_OK) held_end_ += missing.size;
  return status;
}

}  // namespace tetrakis::gdal
