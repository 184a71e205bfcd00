// SPDX-License-Identifier: Apache-2.0
#include "tests/pace/pace.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/header.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::test {

namespace {

/// Processor time of this thread.
double seconds() {
  timespec now = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

constexpr double kWindowSeconds = 1;       // of one sample
constexpr double kPerPlaneSample = 4e-9;   // of a plane that is marked: masks, areas, tiers
constexpr double kPerDecidingByte = 2e-3;  // of a codeword for the whole plane
constexpr double kPerSample = 2e-6, kPerByte = 2e-6;  // of all others
constexpr double kPerMeshSample = 8e-6;               // whatever the stream: sorting, quadrics

/// Runs calls and keeps the first that is too slow.
class Watch {
 public:
  Watch(std::span<const uint8_t> stream, double slow)
      : bytes_(static_cast<double>(stream.size())), slow_(slow) {}

  void window(const char* name, double plane, const std::function<void()>& call) {
    check(name, call,
          kWindowSeconds + kPerPlaneSample * plane +
              std::min(kPerSample * plane, kPerDecidingByte * bytes_));
  }
  /// samples: that the call is asked for.
  void all(const char* name, double samples, const std::function<void()>& call,
           double per_sample = kPerSample) {
    check(name, call, 0.05 + per_sample * samples + kPerByte * bytes_);
  }
  std::string found() const { return found_; }

 private:
  void check(const char* name, const std::function<void()>& call, double limit) {
    const double before = seconds();
    call();
    const double took = seconds() - before;
    if (took <= slow_ * limit || !found_.empty()) return;
    char sentence[160];
    std::snprintf(sentence, sizeof sentence, "%s took %.3f s, the limit is %.3f s", name, took,
                  slow_ * limit);
    found_ = sentence;
  }

  double bytes_;
  double slow_;
  std::string found_;
};

/// Calls that take so much memory are not tried.
constexpr uint64_t kMostSamples = uint64_t{1} << 24;

void watchHeights(tks_decoder* decoder, const tks_info& info, Watch& watch) {
  const tks_window window = {info.width / 2, info.height - 1, 1, 1};
  float height = 0;
  uint32_t sample = 0;
  const uint64_t count = uint64_t{info.width} * info.height;
  const auto samples = static_cast<double>(count) * info.frames;  // all frames are decoded
  watch.window("a window of the surface", samples,
               [&] { tks_decode_surface_window(decoder, &window, &height, 1); });
  watch.window("a window of the heights", samples, [&] {
    tks_decode_heights_window(decoder, &window, &sample, tks_sample_bytes(info.sample));
  });
  if (count > kMostSamples) return;
  std::vector<float> surface(count);
  std::vector<uint8_t> valid(count);
  watch.all("validity", samples, [&] { tks_decode_validity(decoder, valid.data(), valid.size()); });
  watch.all("the surface", samples,
            [&] { tks_decode_surface(decoder, surface.data(), surface.size()); });
  for (const tks_mesh_kind kind : {TKS_MESH_CODED, TKS_MESH_BUDGET}) {
    tks_mesh mesh = {};
    watch.all(
        kind == TKS_MESH_CODED ? "the coded mesh" : "the mesh of 1000 triangles", samples,
        [&] { tks_decode_mesh(decoder, kind, 1000, &mesh); }, kPerMeshSample);
    tks_free_mesh(&mesh);
  }
}

void watchTexture(tks_decoder* decoder, const tks_info& info, Watch& watch) {
  const tks_window window = {info.texture_width / 2, info.texture_height - 1, 1, 1};
  uint64_t texel = 0;
  const size_t texel_bytes = info.texture_channels * tks_sample_bytes(info.texture_sample);
  const uint64_t count = uint64_t{info.texture_width} * info.texture_height * info.texture_channels;
  const auto samples = static_cast<double>(count) * info.frames;
  watch.window("a window of the texture", samples,
               [&] { tks_decode_texture_window(decoder, &window, &texel, texel_bytes); });
  if (count > kMostSamples) return;
  std::vector<uint8_t> texels(count * tks_sample_bytes(info.texture_sample));
  watch.all("the texture", samples,
            [&] { tks_decode_texture(decoder, texels.data(), texels.size()); });
}

/// The coarsest levels, whose samples are few: a codeword is decoded up to where they are known.
void watchLevels(tks_decoder* decoder, Watch& watch) {
  tks_info info = {};
  info.size = sizeof info;
  tks_get_info(decoder, &info);
  const double heights = static_cast<double>(info.width) * info.height * info.frames;
  const double texels_of_plane = static_cast<double>(info.texture_width) * info.texture_height *
                                 info.texture_channels * info.frames;
  tks_set_levels(decoder, info.coarsest_level, info.texture_coarsest_level);
  tks_get_info(decoder, &info);
  std::vector<float> surface(size_t{info.width} * info.height);
  std::vector<uint8_t> texels(size_t{info.texture_width} * info.texture_height *
                              info.texture_channels * tks_sample_bytes(info.texture_sample));
  watch.window("the coarsest heights", heights,
               [&] { tks_decode_surface(decoder, surface.data(), surface.size()); });
  watch.window("the coarsest texels", texels_of_plane,
               [&] { tks_decode_texture(decoder, texels.data(), texels.size()); });
}

void watchPlans(tks_decoder* decoder, Watch& watch) {
  tks_fetch fetch = {};
  fetch.size = sizeof fetch;
  fetch.bytes = 1000;
  tks_ranges ranges = {};
  watch.window("a plan", 0, [&] { tks_plan(decoder, nullptr, &fetch, &ranges); });
  tks_free_ranges(&ranges);
  watch.window("a check", 0, [&] { tks_verify(decoder); });
}

std::vector<uint8_t> noiseStream(uint32_t side) {
  GeometryHeader g;
  g.width = g.height = side;
  g.sample = TKS_I32;
  g.planes = 30;
  StreamHeader header;
  header.geometry = std::move(g);
  std::mt19937 random(1);
  std::vector<uint8_t> payload(size_t{side} * side * 4);
  for (uint8_t& byte : payload) byte = static_cast<uint8_t>(random());
  FieldWriter head;
  head.put(payload.size() << 2);
  head.bytes.push_back(0);
  header.payload_bytes = head.bytes.size() + payload.size();
  std::vector<uint8_t> stream = writeHeader(header);
  stream.insert(stream.end(), head.bytes.begin(), head.bytes.end());
  stream.insert(stream.end(), payload.begin(), payload.end());
  return stream;
}

}  // namespace

double slowness() {
  constexpr uint32_t kSide = 256;
  constexpr double kExpected = 0.2e-6;
  const std::vector<uint8_t> stream = noiseStream(kSide);
  std::vector<float> surface(size_t{kSide} * kSide);
  const double before = seconds();
  tks_decoder* decoder = nullptr;
  tks_open(stream.data(), stream.size(), nullptr, &decoder, nullptr, 0);
  tks_decode_surface(decoder, surface.data(), surface.size());
  tks_close(decoder);
  const double took = seconds() - before;
  return std::max(1.0, took / (kExpected * static_cast<double>(surface.size())));
}

std::string slowCall(std::span<const uint8_t> stream, double slow) {
  Watch watch(stream, slow);
  tks_decoder* decoder = nullptr;
  watch.all("opening", 0,
            [&] { tks_open(stream.data(), stream.size(), nullptr, &decoder, nullptr, 0); });
  if (decoder == nullptr) return watch.found();
  tks_info info = {};
  info.size = sizeof info;
  tks_get_info(decoder, &info);
  if (info.has_heights) watchHeights(decoder, info, watch);
  if (info.has_texture) watchTexture(decoder, info, watch);
  watchPlans(decoder, watch);
  watchLevels(decoder, watch);
  tks_close(decoder);
  return watch.found();
}

}  // namespace tetrakis::test
