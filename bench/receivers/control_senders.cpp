// SPDX-License-Identifier: Apache-2.0
#include "bench/receivers/control_senders.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>

#include "tetrakis/transmit.hpp"

namespace tetrakis::bench {

namespace {

/// Of this processor, whatever else the machine does.
class Stopwatch {
 public:
  double seconds() const { return static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC; }

 private:
  std::clock_t begin_ = std::clock();
};

/// In steps.
Heights stepsOf(const Heights& heights, double step) {
  Heights steps = heights;
  for (float& value : steps) value = static_cast<float>(std::round(value / step));
  return steps;
}

Result<std::vector<uint8_t>> encodeHeights(const tks_heights& heights, uint64_t bytes) {
  tks_encode_options options = makeEncodeOptions();
  options.bytes = bytes;
  const Result<Buffer> stream = encode(&heights, nullptr, options);
  if (!stream) return stream.status();
  return std::vector<uint8_t>(stream->bytes().begin(), stream->bytes().end());
}

/// Of a prefix of a stream; nothing where it lacks its header.
std::optional<Heights> decodePrefix(std::span<const uint8_t> prefix, double step) {
  Result<Decoder> decoder = Decoder::open(prefix);
  if (!decoder) return std::nullopt;
  Result<std::vector<float>> heights = decoder->surface();
  if (!heights) return std::nullopt;
  for (float& value : *heights) value = static_cast<float>(value * step);
  return *std::move(heights);
}

}  // namespace

Result<EncodedGroups> encodeGroups(const Source& source, uint32_t group, uint64_t bytes,
                                   uint64_t reference) {
  tks_encode_options encode = makeEncodeOptions();
  encode.bytes = bytes;
  encode.regions = 64;
  encode.index = TKS_INDEX_PACKETS;
  tks_sequence_options options = makeSequenceOptions();
  options.encode = &encode;
  options.group = group;
  options.reference = reference;
  options.entry = 8;
  options.clock.numerator = 1000;
  options.clock.denominator = static_cast<uint64_t>(std::round(source.fps * 1000));
  Result<SequenceEncoder> encoder = SequenceEncoder::open(options);
  if (!encoder) return encoder.status();
  EncodedGroups encoded;
  const Stopwatch watch;
  for (size_t frame = 0; frame < source.frames.size(); ++frame) {
    const Heights steps = stepsOf(source.frames[frame], source.step);
    const tks_heights heights = givenHeights(source.width, source.height, steps);
    Status status = encoder->push(&heights, nullptr, static_cast<int64_t>(frame));
    if (status.ok() && frame + 1 == source.frames.size()) status = encoder->flush();
    if (!status.ok()) return status;
    const Result<Buffer> ready = encoder->take();
    if (!ready) return ready.status();
    if (!ready->bytes().empty())
      encoded.groups.emplace_back(ready->bytes().begin(), ready->bytes().end());
  }
  encoded.seconds = watch.seconds();
  return encoded;
}

namespace {

/// What it says in one slot is answered in the next one.
class ControlledSender : public Sender {
 public:
  ControlledSender(const Source& source, const EncodedGroups& encoded, uint32_t group,
                   const LinkEnd& end, Transmitter transmitter)
      : source_(source),
        encoded_(encoded),
        group_(group),
        end_(end),
        transmitter_(std::move(transmitter)),
        receiver_(*Receiver::open(1)) {}

  Status pass(double time, const std::optional<tks_screen_camera>& view, bool is_lost) override {
    // A group is there when its last frame is.
    const double whole = (time + 1e-9) * source_.fps / group_;
    while (given_ < encoded_.groups.size() && static_cast<double>(given_ + 1) <= whole)
      if (Status status = transmitter_.append(encoded_.groups[given_++]); !status.ok())
        return status;
    if (!message_.empty()) {
      const Result<Buffer> answer = transmitter_.answer(message_);
      if (!answer.ok()) return answer.status();
      bytes += answer->bytes().size();
      if (!is_lost)
        if (Status status = receiver_.take(answer->bytes()); !status.ok()) return status;
    }
    tks_wants wants = makeWants();
    wants.frame = TKS_NEWEST_FRAME;
    wants.link = static_cast<uint32_t>(end_.rate / 8);
    wants.triangles = end_.triangles;
    wants.view = view ? &*view : nullptr;
    Result<std::vector<uint8_t>> message = receiver_.control(wants);
    if (!message.ok()) return message.status();
    message_ = *std::move(message);
    control += message_.size();
    return {};
  }

  Result<Heights> shown(size_t frame) override {
    const Result<Receiver::TimedFrame> found = receiver_.find(frame);
    if (!found.ok()) return Heights(source_.frames.front().size());
    Result<Decoder> decoder = receiver_.decoder(found->frame);
    if (!decoder.ok()) return decoder.status();
    Result<std::vector<float>> heights = decoder->surface();
    if (!heights) return heights.status();
    for (float& value : *heights) value = static_cast<float>(value * source_.step);
    if (Status status = receiver_.forget(found->frame); !status.ok()) return status;
    return *std::move(heights);
  }

  /// A group is waited for, and sent while the next one is.
  double latency() const override { return 2 * group_ / source_.fps + kSlot; }

 private:
  const Source& source_;
  const EncodedGroups& encoded_;
  uint32_t group_;
  LinkEnd end_;
  Transmitter transmitter_;
  Receiver receiver_;
  size_t given_ = 0;
  std::vector<uint8_t> message_;
};

}  // namespace

Result<std::unique_ptr<Sender>> controlledSender(const Source& source, const EncodedGroups& encoded,
                                                 uint32_t group, const LinkEnd& end) {
  tks_transmitter_options options = makeTransmitterOptions();
  options.seconds = kSlot;
  Result<Transmitter> transmitter = Transmitter::open(options);
  if (!transmitter.ok()) return transmitter.status();
  return std::unique_ptr<Sender>(
      std::make_unique<ControlledSender>(source, encoded, group, end, *std::move(transmitter)));
}

Result<EncodedFrames> encodeFrames(const Source& source, uint64_t bytes) {
  EncodedFrames encoded;
  const Stopwatch watch;
  for (const Heights& frame : source.frames) {
    const Heights steps = stepsOf(frame, source.step);
    auto stream = encodeHeights(givenHeights(source.width, source.height, steps), bytes);
    if (!stream.ok()) return stream.status();
    encoded.streams.push_back(*std::move(stream));
  }
  encoded.seconds = watch.seconds();
  return encoded;
}

Result<EncodedFrames> encodeDifferences(const Source& source, uint64_t bytes, size_t key) {
  EncodedFrames encoded{{}, 0, true, key};
  const Stopwatch watch;
  Heights before;
  for (size_t t = 0; t < source.frames.size(); ++t) {
    Heights steps = stepsOf(source.frames[t], source.step);
    if (t % key == 0) before.assign(steps.size(), 0);
    for (size_t i = 0; i < steps.size(); ++i) steps[i] = std::round(steps[i] - before[i]);
    auto stream = encodeHeights(givenHeights(source.width, source.height, steps), bytes);
    if (!stream.ok()) return stream.status();
    const std::optional<Heights> decoded = decodePrefix(*stream, 1);
    if (!decoded) return Status(TKS_MISMATCH, "a difference does not decode");
    for (size_t i = 0; i < steps.size(); ++i) before[i] += (*decoded)[i];
    encoded.streams.push_back(*std::move(stream));
  }
  encoded.seconds = watch.seconds();
  return encoded;
}

namespace {

class FrameSender : public Sender {
 public:
  FrameSender(const Source& source, const EncodedFrames& encoded, const LinkEnd& end)
      : source_(source), encoded_(encoded), end_(end), shown_(source.frames.front().size()) {}

  Status pass(double time, const std::optional<tks_screen_camera>&, bool is_lost) override {
    const auto frame = static_cast<size_t>((time + 1e-9) * source_.fps);
    if (frame >= encoded_.streams.size()) return {};
    if (frame != frame_) show();
    if (frame != frame_) whole_ = true, there_ = 0;
    frame_ = frame;
    const uint64_t left =
        encoded_.streams[frame].size() - std::min<uint64_t>(there_, encoded_.streams[frame].size());
    const auto sent = std::min(left, static_cast<uint64_t>(end_.sent / 8 * kSlot));
    bytes += sent;
    whole_ &= !is_lost;  // of what lies behind a gap nothing decodes
    if (whole_) there_ += sent;
    return {};
  }

  Result<Heights> shown(size_t) override {
    show();
    return shown_;
  }

  double latency() const override { return 1 / source_.fps; }

 private:
  /// The frame whose bytes came last, once.
  void show() {
    if (frame_ == SIZE_MAX || frame_ == last_shown_) return;
    last_shown_ = frame_;
    const bool is_key = !encoded_.are_differences || frame_ % encoded_.key == 0;
    const std::span<const uint8_t> stream(encoded_.streams[frame_]);
    const auto decoded = decodePrefix(stream.first(static_cast<size_t>(there_)), source_.step);
    if (!decoded) return;
    if (is_key) shown_ = *decoded;
    if (is_key) return;
    for (size_t i = 0; i < shown_.size(); ++i) shown_[i] += (*decoded)[i];
  }

  const Source& source_;
  const EncodedFrames& encoded_;
  LinkEnd end_;
  Heights shown_;
  size_t frame_ = SIZE_MAX, last_shown_ = SIZE_MAX;
  uint64_t there_ = 0;  ///< bytes of the frame up to the first that is missing
  bool whole_ = true;
};

}  // namespace

std::unique_ptr<Sender> frameSender(const Source& source, const EncodedFrames& encoded,
                                    const LinkEnd& end) {
  return std::make_unique<FrameSender>(source, encoded, end);
}

namespace {

class TileSender : public Sender {
 public:
  TileSender(const Source& source, const LinkEnd& end)
      : source_(source), end_(end), shown_(source.frames.front().size()) {
    for (uint32_t y = 0; y < source.height; y += kSide)
      for (uint32_t x = 0; x < source.width; x += kSide)
        tiles_.push_back(
            {x, y, std::min(kSide, source.width - x), std::min(kSide, source.height - y), -1});
  }

  Status pass(double time, const std::optional<tks_screen_camera>& view, bool is_lost) override {
    const size_t frame =
        std::min(static_cast<size_t>((time + 1e-9) * source_.fps), source_.frames.size() - 1);
    for (left_ += static_cast<uint64_t>(end_.sent / 8 * kSlot); left_ >= kTileBytes;) {
      Tile& tile =
          *std::min_element(tiles_.begin(), tiles_.end(), [&](const Tile& a, const Tile& b) {
            return std::pair(!isSeen(a, view), a.sent_at) < std::pair(!isSeen(b, view), b.sent_at);
          });
      const Result<uint64_t> sent = send(tile, frame, is_lost);
      if (!sent.ok()) return sent.status();
      tile.sent_at = time + 1e-6 * static_cast<double>(order_++);
      bytes += *sent;
      left_ -= *sent;
    }
    if (view) control += 60;  // a request
    return {};
  }

  Result<Heights> shown(size_t) override { return shown_; }
  double latency() const override { return 1 / source_.fps; }

 private:
  static constexpr uint32_t kSide = 64;
  static constexpr uint64_t kTileBytes = 1024;
  struct Tile {
    uint32_t x, y, width, height;
    double sent_at;
  };

  /// Whether one of nine points of a tile is in the picture.
  bool isSeen(const Tile& tile, const std::optional<tks_screen_camera>& view) const {
    if (!view) return true;
    for (int i = 0; i < 9; ++i) {
      const double x = tile.x + (tile.width - 1) * (i % 3) / 2.;
      const double y = tile.y + (tile.height - 1) * (i / 3) / 2.;
      const size_t at = static_cast<size_t>(y) * source_.width + static_cast<size_t>(x);
      const double h = source_.frames.front()[at], *m = view->clip;
      const auto row = [&](int r) {
        return m[4 * r] * x + m[4 * r + 1] * y + m[4 * r + 2] * h + m[4 * r + 3];
      };
      const double w = row(3);
      if (w > 0 && std::abs(row(0)) <= w && std::abs(row(1)) <= w) return true;
    }
    return false;
  }

  Result<uint64_t> send(const Tile& tile, size_t frame, bool is_lost) {
    Heights part;
    for (uint32_t y = tile.y; y < tile.y + tile.height; ++y) {
      const float* const row = &source_.frames[frame][size_t{y} * source_.width + tile.x];
      part.insert(part.end(), row, row + tile.width);
    }
    part = stepsOf(part, source_.step);
    const auto stream = encodeHeights(givenHeights(tile.width, tile.height, part), kTileBytes);
    if (!stream.ok()) return stream.status();
    const auto decoded = decodePrefix(*stream, source_.step);
    for (uint32_t y = 0; decoded && !is_lost && y < tile.height; ++y)
      std::copy_n(&(*decoded)[size_t{y} * tile.width], tile.width,
                  &shown_[size_t{tile.y + y} * source_.width + tile.x]);
    return stream->size();
  }

  const Source& source_;
  LinkEnd end_;
  Heights shown_;
  std::vector<Tile> tiles_;
  uint64_t left_ = 0, order_ = 0;
};

}  // namespace

std::unique_ptr<Sender> tileSender(const Source& source, const LinkEnd& end) {
  return std::make_unique<TileSender>(source, end);
}

}  // namespace tetrakis::bench
