// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/serve/received_sequence.hpp"

#include <httplib.h>
#include <algorithm>
#include <chrono>
#include <limits>
#include <random>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/stream.hpp"

namespace tetrakis::tools {

namespace {

using Seconds = std::chrono::duration<double>;

struct Url {
  std::string host, path;
};

Result<Url> urlOf(const std::string& text) {
  constexpr std::string_view kScheme = "http://";
  const bool has_scheme = text.starts_with(kScheme);
  const size_t slash = has_scheme ? text.find('/', kScheme.size()) : std::string::npos;
  if (slash == std::string::npos || slash == kScheme.size() || slash + 1 == text.size())
    return Status(TKS_USAGE,
                  tools::quoted(text) + " is no URL as http://127.0.0.1:8000/frames.tks");
  return Url{text.substr(0, slash), text.substr(slash)};
}

uint64_t randomNumber() {
  std::random_device random;
  return uint64_t{random()} << 32 | random();
}

/// Asks a server, and takes what it answers.
class Reading {
 public:
  Reading(const ReceiveOptions& options, const Url& url, Receiver receiver)
      : options_(options), url_(url), client_(url.host), receiver_(std::move(receiver)) {
    client_.set_keep_alive(true);
    client_.set_tcp_nodelay(true);
    client_.set_read_timeout(60);
  }

  Receiver& receiver() { return receiver_; }
  const Reception& reception() const { return reception_; }
  void end(const std::string& why) { reception_.ended = why; }

  /// waits: for frames behind those that are known.
  Status ask(uint64_t frame, bool waits) {
    if (Status status = look(); !status.ok()) return status;
    tks_wants wants = makeWants();
    wants.frame = frame;
    wants.view = view_ ? &*view_ : nullptr;
    wants.link = options_.link;
    wants.triangles = options_.triangles;
    const Result<std::vector<uint8_t>> control = receiver_.control(wants);
    if (!control.ok()) return control.status();
    const std::string after =
        waits ? "?after=" + std::to_string(receiver_.info().source_end_frame) : "";
    const auto answer =
        client_.Post(url_.path + after, reinterpret_cast<const char*>(control->data()),
                     control->size(), "application/octet-stream");
    reception_.control_bytes += control->size();
    ++reception_.messages;
    if (!answer) return {TKS_IO, "no answer comes from " + tools::quoted(options_.url)};
    if (answer->status != 200) return refused(*answer);
    return receiver_.take(
        {reinterpret_cast<const uint8_t*>(answer->body.data()), answer->body.size()});
  }

  /// Hands over the groups before a frame.
  Status pass(uint64_t frame, const std::function<Status(std::span<const uint8_t>)>& write) {
    const Result<Buffer> bytes = receiver_.write(frame);
    if (!bytes.ok()) return bytes.status();
    reception_.bytes = receiver_.info().bytes;
    return bytes->bytes().empty() ? Status() : write(bytes->bytes());
  }

 private:
  /// A camera over the ground is known once a frame tells of the ground.
  Status look() {
    if (!options_.look || view_ || receiver_.info().end_frame == 0) return {};
    Result<Decoder> decoder = receiver_.decoder(receiver_.info().first_frame);
    if (!decoder.ok()) return decoder.status();
    const Result<tks_screen_camera> camera = options_.look(*decoder);
    if (!camera.ok()) return camera.status();
    view_ = *camera;
    return {};
  }

  Status refused(const httplib::Response& response) const {
    std::string why = response.body.substr(0, 300);
    while (!why.empty() && why.back() == '\n') why.pop_back();
    return {TKS_IO, tools::quoted(options_.url) + " answers " + std::to_string(response.status) +
                        (why.empty() ? "" : ": " + why)};
  }

  const ReceiveOptions& options_;
  const Url& url_;
  httplib::Client client_;
  Receiver receiver_;
  std::optional<tks_screen_camera> view_;
  Reception reception_;
};

/// The frame that is shown after so many seconds: of those that came, the last that is due.
class Playback {
 public:
  /// Passes on from a frame to those that are due.
  uint64_t passOn(Receiver& receiver, uint64_t frame, double seconds) {
    const tks_clock clock = receiver.info().clock;
    if (clock.numerator == 0) return frame;
    const double tick =
        static_cast<double>(clock.numerator) / static_cast<double>(clock.denominator);
    for (;; ++frame) {
      const Result<Receiver::TimedFrame> next = receiver.find(frame + 1);
      if (!next.ok()) return frame;
      if (!begin_) begin_ = next->time;
      const double due = (static_cast<double>(next->time) - static_cast<double>(*begin_)) * tick;
      if (next->frame != frame + 1 || due > seconds) return frame;
    }
  }

 private:
  std::optional<int64_t> begin_;
};

/// Frame after frame, each as well as the link allows.
Status readAll(const ReceiveOptions& options, Reading& reading,
               const std::function<Status(std::span<const uint8_t>)>& write) {
  Playback playback;
  for (uint64_t frame = 0;;) {
    if (Status status = reading.ask(frame, false); !status.ok()) return status;
    Receiver& receiver = reading.receiver();
    const tks_receiver_info info = receiver.info();
    if (info.last_pieces == 0) {  // nothing helps this group any more
      const Result<Receiver::TimedFrame> last = receiver.find(frame);
      frame = std::max(frame, last.ok() ? last->frame : frame) + 1;
    } else if (options.has_link) {
      const double seconds = static_cast<double>(info.bytes) / options.link;
      frame = playback.passOn(receiver, frame, seconds);
    }
    if (frame >= info.source_end_frame) break;
    if (Status status = reading.pass(frame, write); !status.ok()) return status;
  }
  return reading.pass(TKS_NEWEST_FRAME, write);
}

/// The newest frame, again and again.
Status readLive(const ReceiveOptions& options, Reading& reading,
                const std::function<Status(std::span<const uint8_t>)>& write) {
  const auto begin = std::chrono::steady_clock::now();
  bool waits = false;
  while (!options.seconds ||
         Seconds(std::chrono::steady_clock::now() - begin).count() < *options.seconds) {
    const Status status = reading.ask(TKS_NEWEST_FRAME, waits);
    const tks_receiver_info info = reading.receiver().info();
    if (!status.ok() && info.end_frame == 0) return status;
    if (!status.ok()) {  // what came stays
      reading.end(status.message());
      break;
    }
    waits = info.last_pieces == 0;
    if (info.end_frame == 0) continue;
    if (Status passed = reading.pass(info.end_frame - 1, write); !passed.ok()) return passed;
  }
  return reading.pass(TKS_NEWEST_FRAME, write);
}

}  // namespace

Result<Reception> receiveSequence(const ReceiveOptions& options,
                                  const std::function<Status(std::span<const uint8_t>)>& write) {
  const Result<Url> url = urlOf(options.url);
  if (!url.ok()) return url.status();
  Result<Receiver> receiver = Receiver::open(randomNumber(), limitsOfTools());
  if (!receiver.ok()) return receiver.status();
  Reading reading(options, *url, *std::move(receiver));
  const auto read = options.live ? readLive : readAll;
  if (Status status = read(options, reading, write); !status.ok()) return status;
  return reading.reception();
}

}  // namespace tetrakis::tools
