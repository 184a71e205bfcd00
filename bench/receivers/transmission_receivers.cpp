// SPDX-License-Identifier: Apache-2.0
#include "bench/receivers/transmission_receivers.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "apps/tools/report/viewed_mesh.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::bench {
namespace {

/// Of a request beside its ranges: "GET /a.tks HTTP/1.1", host, "Range: bytes=".
constexpr uint64_t kRequestBytes = 60;

Result<Ground> groundOf(Decoder& decoder, const Ground& like) {
  Ground ground = like;
  const Result<std::vector<float>> heights = decoder.surface();
  if (!heights) return heights.status();
  std::copy(heights->begin(), heights->end(), ground.heights.values.begin());
  Result<std::vector<std::byte>> texels = decoder.texture();
  if (!texels) return texels.status();
  ground.image.data = std::move(*texels);
  return ground;
}

class StreamReceiver : public Receiver {
 public:
  StreamReceiver(Decoder decoder, std::span<const uint8_t> stream, const Ground& truth, bool plans)
      : decoder_(std::move(decoder)), stream_(stream), like_(truth), plans_(plans) {
    there_.resize(stream.size());
    std::fill_n(there_.begin(), decoder_.info().header_bytes, true);
  }

  Result<Exchange> fetch(const Camera& camera, uint64_t bytes) override {
    Exchange exchange;
    if (header_left_ > 0) {  // the first bytes are the header and its index
      exchange.bytes = std::min(header_left_, bytes);
      header_left_ -= exchange.bytes;
      bytes -= exchange.bytes;
    }
    if (bytes == 0) return exchange;
    if (!plans_) return take(next(bytes), exchange);
    const tks_screen_camera view = tools::meshCamera(camera, like_.frame);
    const auto ranges = decoder_.plan(&view, bytes);
    if (!ranges) return ranges.status();
    exchange.control += kRequestBytes;
    for (const tks_range& range : *ranges) {
      exchange.control += std::to_string(range.offset).size() +
                          std::to_string(range.offset + range.size - 1).size() + 2;
      const Result<Exchange> taken = take(range, exchange);
      if (!taken.ok()) return taken;
      exchange = *taken;
    }
    return exchange;
  }

  bool asks() const override { return plans_; }

  Result<Ground> shown() const override { return groundOf(decoder_, like_); }

 private:
  tks_range next(uint64_t bytes) const {
    const uint64_t from = decoder_.info().available_bytes;
    return {from, std::min(bytes, stream_.size() - from), 1};
  }

  Result<Exchange> take(const tks_range& range, Exchange exchange) {
    for (uint64_t i = range.offset; i < range.offset + range.size; ++i) {
      exchange.again += there_[i] ? 1 : 0;
      there_[i] = true;
    }
    exchange.bytes += range.size;
    const Status status = decoder_.put(range.offset, stream_.subspan(range.offset, range.size));
    if (!status.ok()) return status;
    return exchange;
  }

  mutable Decoder decoder_;
  std::span<const uint8_t> stream_;
  Ground like_;
  bool plans_;
  uint64_t header_left_ = decoder_.info().header_bytes;
  std::vector<bool> there_;
};

Result<std::unique_ptr<Receiver>> streamReceiver(std::span<const uint8_t> stream,
                                                 const Ground& truth, bool plans) {
  Result<Decoder> whole = Decoder::open(stream);
  if (!whole) return whole.status();
  Result<Decoder> decoder = Decoder::open(stream.first(whole->info().header_bytes));
  if (!decoder) return decoder.status();
  return std::unique_ptr<Receiver>(
      std::make_unique<StreamReceiver>(std::move(*decoder), stream, truth, plans));
}

}  // namespace

Result<std::unique_ptr<Receiver>> prefixReceiver(std::span<const uint8_t> stream,
                                                 const Ground& truth) {
  return streamReceiver(stream, truth, false);
}

Result<std::unique_ptr<Receiver>> planningReceiver(std::span<const uint8_t> stream,
                                                   const Ground& truth) {
  return streamReceiver(stream, truth, true);
}

}  // namespace tetrakis::bench
