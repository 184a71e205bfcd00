// SPDX-License-Identifier: Apache-2.0
// What JavaScript calls of a sequence: the heads of its groups, and where groups lie in a file.
#include "tetrakis/sequence.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "bitstream/sequence/group_head.hpp"
#include "bitstream/sequence/group_index.hpp"
#include "bitstream/stream/header.hpp"

using tetrakis::Result;

/// Writes texts one behind the other, each with a 0 at its end, as far as there is room.
static void putTexts(std::initializer_list<const std::string*> texts, char* out, size_t room) {
  for (const std::string* text : texts) {
    const size_t length = std::min(text->size(), room > 0 ? room - 1 : 0);
    out = std::copy_n(text->data(), length, out);
    if (room > 0) *out++ = '\0';
    room -= std::min(room, length + 1);
  }
}

extern "C" {

/// The head of a group.
struct web_head {
  double bytes;  ///< that it takes; if `data` ends before that is known, more than there are
  double first_frame, frames, stream_bytes, index_bytes;
  double stream_header_bytes;  ///< of the stream behind it, likewise
  double number, depth, bytes_back;
  double numerator, denominator;  ///< of the clock; both 0: there is none
  double times[tetrakis::kMostFrames];
};

/// Reads the head that `data` begins with. `text`: epoch and calendar, each with a 0 at its end, or
/// the sentence of a failure. TKS_TRUNCATED: `data` ends inside the head.
tks_status web_read_head(const uint8_t* data, size_t size, web_head* out, char* text, size_t room) {
  *out = {};
  const auto fail = [&](const tetrakis::Status& status) {
    putTexts({&status.message()}, text, room);
    return status.code();
  };
  const Result<uint64_t> needed = tetrakis::headBytes({data, size});
  if (!needed.ok()) return fail(needed.status());
  out->bytes = static_cast<double>(*needed);
  const Result<tetrakis::ParsedHead> parsed = tetrakis::readHead({data, size});
  if (!parsed.ok()) return fail(parsed.status());
  const tetrakis::GroupHead& head = parsed->head;
  const auto header = tetrakis::headerBytes({data + parsed->bytes, size - parsed->bytes});
  if (!header.ok()) return fail(header.status());
  out->first_frame = static_cast<double>(head.first_frame);
  out->frames = head.frames();
  out->stream_bytes = static_cast<double>(head.stream_bytes);
  out->index_bytes = static_cast<double>(head.index_bytes);
  out->stream_header_bytes = static_cast<double>(*header);
  out->number = static_cast<double>(head.number);
  out->depth = static_cast<double>(head.back.depth);
  out->bytes_back = static_cast<double>(head.back.bytes);
  out->numerator = static_cast<double>(head.clock.numerator);
  out->denominator = static_cast<double>(head.clock.denominator);
  std::copy(head.times.begin(), head.times.end(), out->times);
  putTexts({&head.clock.epoch, &head.clock.calendar}, text, room);
  return TKS_OK;
}

/// What web_locate() finds.
struct web_place {
  double begin, end, found;  ///< the range of tks_sequence_locate
  double last_end;           ///< where the last group in the tail that has an index ends
  double frames;             ///< up to there
};

/// tks_sequence_locate, with places that JavaScript has as numbers.
tks_status web_locate(const uint8_t* tail, size_t size, double end, int by_time, double place,
                      web_place* out) {
  const auto file_end = static_cast<uint64_t>(end);
  const auto locate = [&](int in_time, int64_t at, tks_range& range) {
    int found = 0;
    const tks_status status =
        tks_sequence_locate(tail, size, file_end, in_time, at, &range, &found);
    out->found = found;
    return status;
  };
  *out = {};
  tks_range last = {}, range = {};
  if (const tks_status status = locate(1, tetrakis::kMostTime, last); status != TKS_OK)
    return status;
  constexpr auto kMost = static_cast<double>(tetrakis::kMostTime);
  const auto at = static_cast<int64_t>(std::clamp(place, -kMost, kMost));
  if (const tks_status status = locate(by_time, at, range); status != TKS_OK) return status;
  const uint64_t last_end = last.offset + last.size;
  const auto index = tetrakis::readIndex({tail, static_cast<size_t>(size - (file_end - last_end))});
  out->begin = static_cast<double>(range.offset);
  out->end = static_cast<double>(range.offset + range.size);
  out->last_end = static_cast<double>(last_end);
  if (index) out->frames = static_cast<double>(index->first_frame + index->own.frames);
  return TKS_OK;
}

}  // extern "C"
