// SPDX-License-Identifier: Apache-2.0
#include "api/transmitter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include "api/answer_plan.hpp"
#include "api/encoded_stream.hpp"
#include "api/guarded.hpp"

namespace tetrakis::inline api {

namespace {

Status checkOptions(const tks_transmitter_options& options) {
  const bool fits = std::isfinite(options.seconds) && options.seconds >= 0 &&
                    (options.answer_bytes == 0 || options.answer_bytes >= kMostControlBytes);
  if (fits) return {};
  return {TKS_USAGE, "Answers take a positive number of seconds, and at least 100 bytes."};
}

Result<std::unique_ptr<tks_transmitter>> open(const tks_transmitter_options* given) {
  auto transmitter = std::make_unique<tks_transmitter>();
  if (given == nullptr) return transmitter;
  tks_transmitter_options options{};
  Status status = takeSized("the options", *given, sizeof *given, options);
  if (status.ok()) status = checkOptions(options);
  if (!status.ok()) return status;
  tks_sequence& sequence = transmitter->sequence;
  if (options.limits != nullptr) {
    sequence.has_limits = true;
    status = takeSized("the limits", *options.limits, sizeof options.limits->size, sequence.limits);
    if (!status.ok()) return status;
    sequence.limits.size = sizeof sequence.limits;
  }
  if (options.seconds > 0) transmitter->seconds = options.seconds;
  if (options.answer_bytes > 0) transmitter->answer_bytes = options.answer_bytes;
  if (options.receivers > 0) transmitter->most_receivers = options.receivers;
  return transmitter;
}

/// The bytes that a receiver takes in the time of an answer.
uint64_t budgetFor(const tks_transmitter& transmitter, const ControlMessage& message) {
  const double link = std::min(transmitter.seconds * message.link, 1e15);
  return std::clamp(static_cast<uint64_t>(link), uint64_t{kMostControlBytes},
                    transmitter.answer_bytes);
}

/// Forgets the pieces of groups that the receiver does not hold any more.
void forgetUnheld(const tks_transmitter& transmitter, uint64_t kept, SentPieces& sent) {
  const auto& groups = transmitter.sequence.groups;
  const auto first = std::upper_bound(
      groups.begin(), groups.end(), kept,
      [](uint64_t frame, const KeptGroup& group) { return frame < group.endFrame(); });
  if (first != groups.end()) sent.forgetBefore(first->parsed.head.number);
}

/// The pieces with their bytes.
Answer answerOf(const tks_transmitter& transmitter, const SentPieces& sent,
                std::vector<std::vector<uint8_t>>& heads) {
  const auto& groups = transmitter.sequence.groups;
  Answer answer{sent.answers(), infoOf(transmitter.sequence).end_frame, {}};
  for (const SentPiece& piece : sent.added()) {
    const auto group = std::lower_bound(
        groups.begin(), groups.end(), piece.group,
        [](const KeptGroup& g, uint64_t number) { return g.parsed.head.number < number; });
    const uint64_t head = group->parsed.bytes;
    const auto [begin, end] = piece.range;
    if (begin < head) {
      heads.push_back(writeHead(group->parsed.head));
      const std::span<const uint8_t> bytes(heads.back());
      answer.pieces.push_back(
          {piece.group, begin, bytes.subspan(begin, std::min(end, head) - begin)});
    }
    if (end <= head) continue;
    const uint64_t from = std::max(begin, head);
    answer.pieces.push_back(
        {piece.group, from, std::span(group->stream).subspan(from - head, end - from)});
  }
  return answer;
}

/// Takes a receiver's place among those that are remembered.
void remember(tks_transmitter& transmitter, uint64_t number, SentPieces sent) {
  auto& receivers = transmitter.receivers;
  if (!receivers.contains(number) && receivers.size() >= transmitter.most_receivers)
    receivers.erase(std::min_element(receivers.begin(), receivers.end(), [](auto& a, auto& b) {
      return a.second.last_turn < b.second.last_turn;
    }));
  receivers[number] = {std::move(sent), ++transmitter.turn};
}

Status answer(tks_transmitter& transmitter, std::span<const uint8_t> control, tks_buffer& out) {
  const Result<ControlMessage> message = readControl(control);
  if (!message.ok()) return message.status();
  const auto found = transmitter.receivers.find(message->receiver);
  SentPieces sent = found != transmitter.receivers.end() ? found->second.sent : SentPieces();
  if (Status status = sent.hear(message->answers, message->lost); !status.ok()) return status;
  forgetUnheld(transmitter, message->kept, sent);
  AnswerPlan plan(transmitter, *message, sent, budgetFor(transmitter, *message));
  if (Status status = plan.choose(); !status.ok()) return status;
  std::vector<std::vector<uint8_t>> heads;
  const std::vector<uint8_t> bytes = writeAnswer(answerOf(transmitter, sent, heads));
  sent.send();
  tks_buffer given = {};
  giveBytes(bytes, given);
  std::unique_ptr<uint8_t, void (*)(void*)> owned(given.data, std::free);
  remember(transmitter, message->receiver, std::move(sent));
  owned.release();
  out = given;
  return {};
}

Status forgetGroups(tks_transmitter& transmitter, uint64_t frame) {
  if (const tks_status status = tks_sequence_forget(&transmitter.sequence, frame); status != TKS_OK)
    return {status, tks_sequence_message(&transmitter.sequence)};
  const auto& groups = transmitter.sequence.groups;
  if (groups.empty()) return {};
  const uint64_t first = groups.front().parsed.head.number;
  transmitter.known.erase(transmitter.known.begin(), transmitter.known.lower_bound(first));
  for (auto& [number, receiver] : transmitter.receivers) receiver.sent.forgetBefore(first);
  return {};
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_transmitter_open(const tks_transmitter_options* options, tks_transmitter** out,
                                char* message, size_t message_size) {
  if (out != nullptr) *out = nullptr;
  return tetrakis::reporting(message, message_size, [&]() -> tetrakis::Status {
    if (out == nullptr) return tetrakis::outputMissing();
    auto opened = tetrakis::open(options);
    if (!opened.ok()) return opened.status();
    *out = opened->release();
    return {};
  });
}

void tks_transmitter_close(tks_transmitter* transmitter) {
  delete transmitter;
}

tks_status tks_transmitter_append(tks_transmitter* transmitter, const uint8_t* data, size_t size,
                                  char* message, size_t message_size) {
  if (transmitter == nullptr) return TKS_USAGE;
  return tetrakis::reporting(message, message_size, [&]() -> tetrakis::Status {
    tks_sequence& sequence = transmitter->sequence;
    const tks_status status = tks_sequence_append(&sequence, data, size);
    if (status == TKS_OK) return {};
    return {status, tks_sequence_message(&sequence)};
  });
}

tks_status tks_transmitter_forget(tks_transmitter* transmitter, uint64_t frame) {
  if (transmitter == nullptr) return TKS_USAGE;
  return tetrakis::answering([&] { return tetrakis::forgetGroups(*transmitter, frame); });
}

tks_status tks_transmitter_get_info(const tks_transmitter* transmitter, tks_sequence_info* info) {
  return transmitter != nullptr ? tks_sequence_get_info(&transmitter->sequence, info) : TKS_USAGE;
}

tks_status tks_transmitter_answer(tks_transmitter* transmitter, const uint8_t* control, size_t size,
                                  tks_buffer* out, char* message, size_t message_size) {
  if (out != nullptr) *out = {nullptr, 0};
  if (transmitter == nullptr) return TKS_USAGE;
  return tetrakis::reporting(message, message_size, [&]() -> tetrakis::Status {
    if (out == nullptr) return tetrakis::outputMissing();
    if (control == nullptr && size != 0) return {TKS_USAGE, "The control message is missing."};
    return tetrakis::answer(*transmitter, {control, size}, *out);
  });
}
