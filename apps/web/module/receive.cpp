// SPDX-License-Identifier: Apache-2.0
// What JavaScript calls of a receiver of a served sequence (tetrakis/transmit.h): what its messages
// say, and which groups it holds, in numbers of 64 bits.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "api/receiver.hpp"
#include "tetrakis/transmit.h"

namespace {

/// Numbers of what a receiver knows, in front of those of its groups.
void putInfo(const tks_receiver_info& info, std::vector<double>& numbers) {
  for (const uint64_t number : {info.source_end_frame, info.answers, info.last_pieces, info.bytes,
                                info.clock.numerator, info.clock.denominator})
    numbers.push_back(static_cast<double>(number));
}

/// A group: its first frame, how many it has, how many bytes of its stream came and how many there
/// are, and the times of its frames.
void putGroup(const tetrakis::HeldGroup& group, std::vector<double>& numbers) {
  const tetrakis::GroupHead& head = group.parsed->head;
  const uint64_t bytes = group.pieces.bytes();
  const uint64_t of_stream = bytes - std::min<uint64_t>(bytes, group.parsed->bytes);
  for (const uint64_t number :
       {head.first_frame, uint64_t{head.frames()}, of_stream, head.stream_bytes})
    numbers.push_back(static_cast<double>(number));
  for (const int64_t time : head.times) numbers.push_back(static_cast<double>(time));
}

}  // namespace

extern "C" {

/// tks_receiver_open, with the lower and the upper half of its number. Null: there is no memory.
tks_receiver* web_receiver_open(uint32_t low, uint32_t high, double max_memory) {
  tks_limits limits = {};
  limits.size = sizeof limits;
  limits.max_memory = static_cast<uint64_t>(max_memory);
  tks_receiver* receiver = nullptr;
  tks_receiver_open(uint64_t{high} << 32 | low, &limits, &receiver);
  return receiver;
}

/// tks_receiver_control. frame: below 0: the newest one; view: width and height of the picture and
/// 16 numbers; null: all ground counts alike. Writes the size of the message, and then that.
tks_status web_receiver_control(tks_receiver* receiver, double frame, uint32_t link,
                                uint32_t triangles, const double* view, uint32_t* out) {
  tks_wants wants = {};
  wants.size = sizeof wants;
  wants.frame = frame < 0 ? TKS_NEWEST_FRAME : static_cast<uint64_t>(frame);
  wants.link = link;
  wants.triangles = triangles;
  tks_screen_camera camera = {};
  camera.size = sizeof camera;
  if (view != nullptr) {
    camera.width = static_cast<uint32_t>(view[0]);
    camera.height = static_cast<uint32_t>(view[1]);
    std::copy_n(view + 2, 16, camera.clip);
    wants.view = &camera;
  }
  size_t size = 0;
  const tks_status status =
      tks_receiver_control(receiver, &wants, reinterpret_cast<uint8_t*>(out + 1), &size);
  *out = static_cast<uint32_t>(size);
  return status;
}

/// What a receiver knows and the groups that it can decode, as putInfo() and putGroup() write them.
struct web_reception {
  uint32_t count;
  double* numbers;  ///< to be freed; null: there is no memory
};
void web_receiver_info(const tks_receiver* receiver, web_reception* out) {
  tks_receiver_info info = {};
  info.size = sizeof info;
  tks_receiver_get_info(receiver, &info);
  std::vector<double> numbers;
  putInfo(info, numbers);
  for (const auto& [number, group] : receiver->groups)
    if (tetrakis::decodes(*receiver, number)) putGroup(group, numbers);
  out->count = static_cast<uint32_t>(numbers.size());
  out->numbers = static_cast<double*>(std::malloc(numbers.size() * sizeof(double)));
  if (out->numbers != nullptr) std::copy(numbers.begin(), numbers.end(), out->numbers);
}

/// Epoch (0) and calendar (1) of the clock. They belong to the receiver.
const char* web_receiver_text(const tks_receiver* receiver, int which) {
  tks_receiver_info info = {};
  info.size = sizeof info;
  tks_receiver_get_info(receiver, &info);
  return which == 0 ? info.clock.epoch : info.clock.calendar;
}

/// tks_receiver_frame and tks_receiver_forget.
tks_status web_receiver_frame(tks_receiver* receiver, double frame, tks_decoder** out) {
  return tks_receiver_frame(receiver, static_cast<uint64_t>(frame), out);
}
void web_receiver_forget(tks_receiver* receiver, double frame) {
  tks_receiver_forget(receiver, static_cast<uint64_t>(frame));
}

}  // extern "C"
