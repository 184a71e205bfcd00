// SPDX-License-Identifier: Apache-2.0
// The picture that each order of the encoder gives, how far it is from the best pair of prefixes of
// its two tracks, found by rendering many; how far fixed splits of the default tracks are; and what
// it gains that the encoder is told the cameras.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "apps/tools/report/split_stream.hpp"
#include "bench/allocation/joint_studies.hpp"

namespace tetrakis::bench {
namespace {

using tools::Split;
using tools::SplitStream;

constexpr uint64_t kLeastBudget = 2048, kMostBudget = 262144;
constexpr uint64_t kLeastGain = 8192, kMostGain = 131072;  // where gains are counted
constexpr int kFixed = 9;                                  // splits of 10/90 to 90/10

/// Prefixes of one stream's tracks, judged on the screen; each pair is rendered once.
class Judge {
 public:
  Judge(tools::Comparer comparer, SplitStream tracks)
      : comparer_(std::move(comparer)), tracks_(std::move(tracks)) {}

  /// dB over all cameras.
  Result<double> screenPsnr(const Split& split) {
    const auto known = seen_.find(split);
    if (known != seen_.end()) return known->second;
    const Result<tools::Measurement> measured = comparer_.measure(tracks_.cut(split), 0);
    if (!measured.ok()) return measured.status();
    return seen_[split] = measured->screen_psnr.value_or(0);
  }

  const SplitStream& tracks() const { return tracks_; }
  size_t renderings() const { return seen_.size(); }

 private:
  tools::Comparer comparer_;
  SplitStream tracks_;
  std::map<Split, double> seen_;
};

Result<Judge> judgeOf(const Terrain& terrain, const std::string& view,
                      std::span<const uint8_t> stream) {
  const Result<Decoder> decoder = Decoder::open(stream);
  if (!decoder) return decoder.status();
  Result<tools::Comparer> comparer = tools::Comparer::create(terrain.original, decoder->info());
  if (!comparer.ok()) return comparer.status();
  if (Status status = comparer->look({"", view}); !status.ok()) return status;
  Result<SplitStream> tracks = SplitStream::take(stream);
  if (!tracks.ok()) return tracks.status();
  return Judge(std::move(*comparer), std::move(*tracks));
}

/// Shares of the bytes for the heights: tenths, and `grid` more, from a 400th to 0.97 at equal
/// ratios of share and rest.
std::vector<double> sharesOf(uint32_t grid) {
  std::vector<double> shares;
  for (int i = 1; i <= kFixed; ++i) shares.push_back(i / 10.0);
  const double low = std::log(0.0025 / 0.9975), high = std::log(0.97 / 0.03);
  for (uint32_t i = 0; i < grid; ++i) {
    const double x = low + (high - low) * i / std::max(1u, grid - 1);
    shares.push_back(1 / (1 + std::exp(-x)));
  }
  std::sort(shares.begin(), shares.end());
  return shares;
}

/// A split of so many bytes; what one track is too short for goes to the other.
Split splitOf(uint64_t bytes, double share, const Split& most) {
  Split split;
  split.heights = std::min(most.heights, static_cast<uint64_t>(share * static_cast<double>(bytes)));
  split.texture = std::min(most.texture, bytes - split.heights);
  split.heights = std::min(most.heights, bytes - split.texture);
  return split;
}

struct Best {
  double share = 0, psnr = -std::numeric_limits<double>::infinity();
};

/// The best pair of so many bytes: the best of the shares, and of the tops of parabolas around the
/// best one.
Result<Best> bestPair(Judge& judge, uint64_t bytes, std::vector<double> shares) {
  constexpr int kRefinements = 2;
  const auto logit = [](double share) { return std::log(share / (1 - share)); };
  std::vector<double> psnrs;
  for (const double share : shares) {
    const Result<double> psnr = judge.screenPsnr(splitOf(bytes, share, judge.tracks().most()));
    if (!psnr.ok()) return psnr.status();
    psnrs.push_back(*psnr);
  }
  for (int round = 0; round < kRefinements; ++round) {
    const auto top =
        static_cast<size_t>(std::max_element(psnrs.begin(), psnrs.end()) - psnrs.begin());
    if (top == 0 || top + 1 == psnrs.size()) break;
    const double a = logit(shares[top - 1]), b = logit(shares[top]), c = logit(shares[top + 1]);
    const double left = (psnrs[top] - psnrs[top - 1]) / (b - a);
    const double right = (psnrs[top + 1] - psnrs[top]) / (c - b);
    if (!(left - right > 0)) break;
    const double x = (a + b) / 2 + left * (c - a) / 2 / (left - right);
    if (!(x > a && x < c) || std::abs(x - b) < 0.01) break;
    const double share = 1 / (1 + std::exp(-x));
    const Result<double> psnr = judge.screenPsnr(splitOf(bytes, share, judge.tracks().most()));
    if (!psnr.ok()) return psnr.status();
    const size_t at = x < b ? top : top + 1;
    shares.insert(shares.begin() + static_cast<ptrdiff_t>(at), share);
    psnrs.insert(psnrs.begin() + static_cast<ptrdiff_t>(at), *psnr);
  }
  const auto top = std::max_element(psnrs.begin(), psnrs.end()) - psnrs.begin();
  return Best{shares[static_cast<size_t>(top)], psnrs[static_cast<size_t>(top)]};
}

/// dB below the best pair, or above another order, over the numbers of bytes.
struct Losses {
  std::string name;
  std::vector<double> values;

  double mean() const {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }
  double worst() const { return *std::max_element(values.begin(), values.end()); }
  double least() const { return *std::min_element(values.begin(), values.end()); }
};

/// An order of the encoder: a name, a judge of the stream that has it, and what was drawn for it.
struct Order {
  std::string name;
  Judge judge;
  size_t drawn = 0;
};

Result<std::vector<Order>> ordersOf(const Terrain& terrain, const SplitOptions& options) {
  constexpr uint64_t kHeaderAndHeads = 8192;
  std::vector<std::pair<const char*, Knows>> kinds = {{"default", Knows::kNothing},
                                                      {"told", Knows::kCameras}};
  if (options.rendered) kinds.push_back({"rendered", Knows::kPictures});
  std::vector<Order> orders;
  for (const auto& [name, knows] : kinds) {
    const auto coded =
        encodeTerrain(terrain.original, {kMostBudget + kHeaderAndHeads, knows, 0, options.view});
    if (!coded.ok()) return coded.status();
    Result<Judge> judge = judgeOf(terrain, options.view, coded->stream.bytes());
    if (!judge.ok()) return judge.status();
    orders.push_back({name, std::move(*judge), coded->drawn});
  }
  return orders;
}

/// What is measured of a terrain over the numbers of bytes.
struct Measured {
  std::vector<Losses> orders;  ///< against the best pair of the order's own tracks
  std::vector<Losses> fixed;   ///< against that of the default ones
  std::vector<Losses> gains;   ///< what an order is above the default one, at 8 to 128 kB
};

/// One line of the table. Maps of priorities count among the bytes.
Status measureBytes(std::vector<Order>& orders, uint64_t all_bytes,
                    const std::vector<double>& shares, Measured& measured) {
  std::printf("  %7llu", static_cast<unsigned long long>(all_bytes));
  double default_psnr = 0, best_psnr = 0;
  for (size_t i = 0; i < orders.size(); ++i) {
    Judge& judge = orders[i].judge;
    const uint64_t bytes = all_bytes - judge.tracks().mapBytes();
    const Result<Best> best = bestPair(judge, bytes, shares);
    if (!best.ok()) return best.status();
    const Split split = judge.tracks().shipped(bytes);
    const Result<double> psnr = judge.screenPsnr(split);
    if (!psnr.ok()) return psnr.status();
    if (i == 0) std::tie(default_psnr, best_psnr) = std::pair(*psnr, best->psnr);
    measured.orders[i].values.push_back(best->psnr - *psnr);
    const bool counts = i > 0 && all_bytes >= kLeastGain && all_bytes <= kMostGain;
    if (counts) measured.gains[i - 1].values.push_back(*psnr - default_psnr);
    std::printf(" %7.2f %6.3f %5.1f%% %5.1f%%", *psnr, best->psnr - *psnr,
                100.0 * static_cast<double>(split.heights) / static_cast<double>(split.total()),
                100 * best->share);
  }
  double least = std::numeric_limits<double>::infinity();
  Judge& judge = orders.front().judge;
  for (int i = 1; i <= kFixed; ++i) {
    const Result<double> psnr =
        judge.screenPsnr(splitOf(all_bytes, i / 10.0, judge.tracks().most()));
    if (!psnr.ok()) return psnr.status();
    const double loss = best_psnr - *psnr;
    measured.fixed[static_cast<size_t>(i) - 1].values.push_back(loss);
    least = std::min(least, loss);
  }
  std::printf(" %8.3f\n", least);
  std::fflush(stdout);
  return {};
}

void report(const Terrain& terrain, const Measured& measured, std::vector<ResultRow>& rows) {
  std::printf("  mean/worst loss:");
  for (const auto* losses : {&measured.orders, &measured.fixed}) {
    for (const Losses& loss : *losses) {
      std::printf("  %s %.3f/%.3f", loss.name.c_str(), loss.mean(), loss.worst());
      rows.push_back({terrain.name, loss.name, "mean_loss_db", loss.mean()});
      rows.push_back({terrain.name, loss.name, "worst_loss_db", loss.worst()});
    }
  }
  std::printf("\n  mean/least gain:");
  for (const Losses& gain : measured.gains) {
    std::printf("  %s %.3f/%.3f", gain.name.c_str(), gain.mean(), gain.least());
    rows.push_back({terrain.name, gain.name, "mean_gain_db", gain.mean()});
    rows.push_back({terrain.name, gain.name, "least_gain_db", gain.least()});
  }
  std::printf("\n");
}

}  // namespace

Status studySplits(const Terrain& terrain, const SplitOptions& options,
                   std::vector<ResultRow>& rows) {
  Result<std::vector<Order>> orders = ordersOf(terrain, options);
  if (!orders.ok()) return orders.status();
  std::printf("  view %s\n  %7s", options.view.c_str(), "bytes");
  Measured measured;
  for (const Order& order : *orders) {
    std::printf(" %7s %6s %6s %6s", order.name.c_str(), "loss", "split", "best");
    measured.orders.push_back({order.name, {}});
    if (measured.orders.size() > 1) measured.gains.push_back({order.name, {}});
  }
  std::printf(" %8s\n", "fixed");
  for (int i = 1; i <= kFixed; ++i)
    measured.fixed.push_back({"fixed_" + std::to_string(10 * i), {}});
  const std::vector<double> shares = sharesOf(options.grid);
  for (uint64_t bytes = kLeastBudget; bytes <= kMostBudget; bytes *= 2) {
    const bool enough = std::all_of(orders->begin(), orders->end(), [&](const Order& order) {
      return bytes <= order.judge.tracks().most().total();
    });
    if (!enough) break;
    if (Status status = measureBytes(*orders, bytes, shares, measured); !status.ok()) return status;
  }
  report(terrain, measured, rows);
  size_t renderings = 0;
  for (const Order& order : *orders) renderings += order.judge.renderings();
  std::printf("  %zu renderings", renderings);
  for (const Order& order : *orders) {
    if (order.drawn == 0) continue;
    std::printf(", %zu for the order %s", order.drawn, order.name.c_str());
    rows.push_back({terrain.name, order.name, "renderings", static_cast<double>(order.drawn)});
  }
  std::printf("\n");
  return {};
}

}  // namespace tetrakis::bench
