// SPDX-License-Identifier: Apache-2.0
// bench_transmission FOLDER: one stream for receivers of several channels and renderers (thesis,
// figure 1.2: static source, static view), and for one that flies over the terrain (static source,
// dynamic view), in a simulation of discrete events. FOLDER holds height.tif and texture.png, as
// `tetrakis synth` writes them. Screen PSNR comes from the renderer, of the full grid, against the
// original.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/report/comparison.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/receivers/transmission_receivers.hpp"
#include "codec/ground/camera.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::bench {
namespace {

struct Options {
  std::string folder, csv;
  double rate = 64, latency = 0.1, step = 1;
  uint64_t bytes = 512 << 10;
};

constexpr double kFlight = 60, kTurn = 30;  // seconds
constexpr double kAsk = 0.5;                // seconds of the channel that one request asks for
constexpr double kExact = 60;               // dB that count for equal pictures

struct Terrain {
  tools::Reference original;
  Ground ground;
};

Result<Terrain> readTerrain(const std::string& folder) {
  Result<tools::HeightFile> heights = tools::readHeights(folder + "/height.tif");
  if (!heights.ok()) return heights.status();
  Result<tools::ImageFile> image = tools::readImage(folder + "/texture.png");
  if (!image.ok()) return image.status();
  if (image->channels != 3 || image->sample != TKS_U8)
    return Status(TKS_USAGE, "the texture has to be RGB of 8 bits");
  Ground ground{tools::heightsOf(*heights), *image, tools::frameOf(*heights), heights->scale};
  return Terrain{{std::move(*heights), std::move(*image)}, std::move(ground)};
}

Result<Buffer> encodeTerrain(const Terrain& terrain, const Options& options) {
  const tks_heights heights = tools::asHeights(*terrain.original.heights);
  const tks_image image = tools::asImage(*terrain.original.image);
  tks_encode_options encode = makeEncodeOptions();
  encode.bytes = options.bytes;
  encode.regions = 128;
  encode.index = 1;
  return tetrakis::encode(&heights, &image, encode);
}

/// Straight on to the east above the highest ground, then a turn by 120 degrees to the left.
Camera flightAt(const Ground& ground, double time) {
  const Bounds bounds = tools::boundsOf(ground.heights, ground.frame);
  const double width = bounds.high[0] - bounds.low[0], speed = width / 3 / kTurn;
  const double turned = 120 * std::numbers::pi / 180;
  const double angle = time < kTurn ? 0 : turned;
  const double first = std::min(time, kTurn), second = std::max(0.0, time - kTurn);
  Camera camera;
  camera.name = "flight";
  camera.fov_y = 50;
  camera.width = 640;
  camera.height = 400;
  camera.eye = {-width / 4 + speed * (first + std::cos(turned) * second),
                bounds.high[1] + width / 60, width / 5 - speed * std::sin(turned) * second};
  const Vec3 ahead = {std::cos(angle), -0.35, -std::sin(angle)};
  camera.target = add(camera.eye, scale(ahead, width));
  return camera;
}

double shownPsnr(double psnr) {
  return std::isnan(psnr) ? 0 : std::min(psnr, kExact);
}

// ---- static source, static view -----------------------------------------------------------------

struct StaticReceiver {
  const char* name;
  double rate;         ///< of the stream that it is sent, in kilobits a second
  uint32_t triangles;  ///< 0: the full grid
};

/// When the picture first has so many dB, between the moments that were looked at.
double secondsTo(const std::vector<std::pair<double, double>>& curve, double psnr) {
  for (size_t i = 0; i < curve.size(); ++i) {
    if (curve[i].second < psnr) continue;
    if (i == 0) return curve[i].first;
    const auto& [t0, p0] = curve[i - 1];
    const auto& [t1, p1] = curve[i];
    return t0 + (t1 - t0) * (psnr - p0) / (p1 - p0);
  }
  return std::nan("");
}

Status runStatic(const Terrain& terrain, std::span<const uint8_t> stream) {
  const Result<Decoder> decoder = Decoder::open(stream);
  if (!decoder) return decoder.status();
  const tks_info& info = decoder->info();
  Result<tools::Comparer> comparer = tools::Comparer::create(terrain.original, info);
  if (!comparer.ok()) return comparer.status();
  if (Status status = comparer->look({}); !status.ok()) return status;
  std::printf(
      "static view            kb/s  triangles  s to 25 dB  30 dB  35 dB  last dB  kB to "
      "0.1 dB below\n");
  // The figure's R2 has a link of 512 kb/s as well, and is sent a quarter of that, because it draws
  // no more; beside it what filling the link would bring.
  for (const auto& [name, rate, triangles] :
       {StaticReceiver{"R1, strong", 512, 0}, StaticReceiver{"R2, weak renderer", 128, 3000},
        StaticReceiver{"R2 with a full link", 512, 3000},
        StaticReceiver{"R3, slow link", 256, 0}}) {
    std::vector<std::pair<double, double>> curve;
    for (double bytes = static_cast<double>(info.header_bytes) + 500;; bytes *= 1.25) {
      const double cut = std::min(bytes, static_cast<double>(stream.size()));
      const auto seen = comparer->measure(stream.first(static_cast<size_t>(cut)), triangles);
      if (!seen.ok()) return seen.status();
      curve.push_back({cut * 8 / (1000 * rate), shownPsnr(seen->screen_psnr.value_or(0))});
      if (cut < bytes) break;
    }
    const double last = curve.back().second;
    std::printf("%-20s %6.0f %10s %11.2f %6.2f %6.2f %8.2f %8.0f\n", name, rate,
                triangles > 0 ? std::to_string(triangles).c_str() : "all", secondsTo(curve, 25),
                secondsTo(curve, 30), secondsTo(curve, 35), last,
                secondsTo(curve, last - 0.1) * rate / 8);
    std::fflush(stdout);
  }
  return {};
}

// ---- static source, dynamic view ----------------------------------------------------------------

struct Flight {
  std::string name;
  std::vector<double> psnr;  ///< of each frame
  Exchange first, second;    ///< laps
};

/// Frames of a flight, and what the original looks like from there.
class Screen {
 public:
  static Result<Screen> of(const Terrain& terrain, double step) {
    Screen screen;
    auto renderer = tools::Renderer::create();
    if (!renderer.ok()) return renderer.status();
    screen.renderer_ = std::move(*renderer);
    for (double t = step; t <= kFlight; t += step) {
      screen.times_.push_back(t);
      screen.cameras_.push_back(flightAt(terrain.ground, t));
    }
    auto truth = screen.draw(terrain.ground, screen.cameras_);
    if (!truth.ok()) return truth.status();
    screen.truth_ = std::move(*truth);
    return screen;
  }

  const std::vector<double>& times() const { return times_; }

  Result<double> psnr(const Ground& shown, size_t frame) {
    const auto picture = draw(shown, {cameras_[frame]});
    if (!picture.ok()) return picture.status();
    return shownPsnr(tools::screenPsnr({truth_[frame]}, *picture));
  }

 private:
  Result<std::vector<tools::Picture>> draw(const Ground& ground,
                                           const std::vector<Camera>& cameras) {
    tools::MeshFile mesh = tools::fullGrid(ground.heights, ground.frame);
    mesh.texture = &ground.image;
    return renderer_->draw(mesh, cameras);
  }

  std::unique_ptr<tools::Renderer> renderer_;
  std::vector<double> times_;
  std::vector<Camera> cameras_;
  std::vector<tools::Picture> truth_;
};

/// The link: requests, latency and bytes, one after the other.
class Link {
 public:
  Link(Receiver& receiver, const Ground& truth, const Options& options)
      : receiver_(receiver), truth_(truth), options_(options) {}

  /// Everything that has come by then. Who asks does so while the answer before still comes, as
  /// much sooner as the latency takes: the channel is never idle, but views are that much older.
  Status runUntil(double time) {
    const auto bytes = static_cast<uint64_t>(options_.rate * 1000 / 8 * kAsk);
    const double ahead = receiver_.asks() ? options_.latency : 0;
    for (; ready_ + kAsk <= time; ready_ += kAsk) {
      const auto taken = receiver_.fetch(flightAt(truth_, std::max(0.0, ready_ - ahead)), bytes);
      if (!taken.ok()) return taken.status();
      total_.bytes += taken->bytes;
      total_.again += taken->again;
      total_.control += taken->control;
    }
    return {};
  }
  const Exchange& total() const { return total_; }

 private:
  Receiver& receiver_;
  const Ground& truth_;
  const Options& options_;
  double ready_ = options_.latency;  ///< when the channel is free again
  Exchange total_;
};

Result<Flight> fly(const std::string& name, Receiver& receiver, const Terrain& terrain,
                   Screen& screen, const Options& options) {
  Flight flight{name, {}, {}, {}};
  Link link(receiver, terrain.ground, options);
  for (size_t i = 0; i < screen.times().size(); ++i) {
    if (Status status = link.runUntil(screen.times()[i]); !status.ok()) return status;
    const Result<Ground> shown = receiver.shown();
    if (!shown.ok()) return shown.status();
    const Result<double> psnr = screen.psnr(*shown, i);
    if (!psnr.ok()) return psnr.status();
    flight.psnr.push_back(*psnr);
  }
  flight.first = link.total();
  Link again(receiver, terrain.ground, options);
  if (Status status = again.runUntil(kFlight); !status.ok()) return status;
  flight.second = again.total();
  return flight;
}

double meanOf(const std::vector<double>& values, size_t first, size_t count) {
  double sum = 0;
  for (size_t i = first; i < first + count; ++i) sum += values[i];
  return sum / static_cast<double>(count);
}

/// Seconds from the turn to a picture within 1 dB of the mean of the ten before it.
double secondsAfterTurn(const Flight& flight, const std::vector<double>& times) {
  const auto turn =
      static_cast<size_t>(std::lower_bound(times.begin(), times.end(), kTurn) - times.begin());
  const size_t before = std::min<size_t>(turn, 10);
  const double most = meanOf(flight.psnr, turn - before, before) - 1;
  for (size_t i = turn; i < times.size(); ++i)
    if (flight.psnr[i] >= most) return times[i] - kTurn;
  return std::nan("");
}

void report(const std::vector<Flight>& flights, const std::vector<double>& times) {
  std::printf(
      "flight of 60 s         mean dB  5th percentile  s after turn   kB  control bytes/s"
      "  kB of lap 2  asked twice\n");
  for (const Flight& flight : flights) {
    std::vector<double> sorted = flight.psnr;
    std::sort(sorted.begin(), sorted.end());
    std::printf("%-22s %7.2f %15.2f %13.1f %4.0f %16.0f %12.0f %12llu\n", flight.name.c_str(),
                meanOf(sorted, 0, sorted.size()), sorted[sorted.size() / 20],
                secondsAfterTurn(flight, times), static_cast<double>(flight.first.bytes) / 1000,
                static_cast<double>(flight.first.control) / kFlight,
                static_cast<double>(flight.second.bytes) / 1000,
                static_cast<unsigned long long>(flight.first.again + flight.second.again));
  }
}

Status writeCsv(const std::string& path, const std::vector<Flight>& flights,
                const std::vector<double>& times) {
  if (path.empty()) return {};
  std::FILE* const file = std::fopen(path.c_str(), "w");
  if (file == nullptr) return {TKS_IO, "cannot write " + path};
  std::fprintf(file, "seconds");
  for (const Flight& flight : flights) std::fprintf(file, ",%s", flight.name.c_str());
  for (size_t i = 0; i < times.size(); ++i) {
    std::fprintf(file, "\n%g", times[i]);
    for (const Flight& flight : flights) std::fprintf(file, ",%.3f", flight.psnr[i]);
  }
  std::fprintf(file, "\n");
  return std::fclose(file) == 0 ? Status() : Status(TKS_IO, "cannot write " + path);
}

Status runFlights(const Terrain& terrain, std::span<const uint8_t> stream, const Options& options) {
  const Result<Decoder> decoder = Decoder::open(stream);
  if (!decoder) return decoder.status();
  const auto heights = static_cast<double>(decoder->info().geometry_bytes);
  const double share = heights / (heights + static_cast<double>(decoder->info().texture_bytes));
  Result<Screen> screen = Screen::of(terrain, options.step);
  if (!screen.ok()) return screen.status();
  const Ground& ground = terrain.ground;
  const auto tiles = [&](TileCodec codec) {
    return tileReceiver(ground, codec, stream.size(), share);
  };
  std::vector<std::pair<const char*, Result<std::unique_ptr<Receiver>>>> receivers;
  receivers.emplace_back("plan for the view", planningReceiver(stream, ground));
  receivers.emplace_back("prefix", prefixReceiver(stream, ground));
  receivers.emplace_back("Tetrakis tiles", tiles(TileCodec::kTetrakis));
  receivers.emplace_back("JPEG 2000 tiles", tiles(TileCodec::kJpeg2000));
  std::vector<Flight> flights;
  for (auto& [name, receiver] : receivers) {
    if (!receiver.ok()) return receiver.status();
    Result<Flight> flight = fly(name, **receiver, terrain, *screen, options);
    if (!flight.ok()) return flight.status();
    flights.push_back(std::move(*flight));
  }
  report(flights, screen->times());
  return writeCsv(options.csv, flights, screen->times());
}

Status run(const Options& options) {
  const Result<Terrain> terrain = readTerrain(options.folder);
  if (!terrain.ok()) return terrain.status();
  const Result<Buffer> stream = encodeTerrain(*terrain, options);
  if (!stream) return stream.status();
  if (Status status = runStatic(*terrain, stream->bytes()); !status.ok()) return status;
  return runFlights(*terrain, stream->bytes(), options);
}

}  // namespace
}  // namespace tetrakis::bench

int main(int argc, char** argv) {
  using namespace tetrakis::bench;
  Options options;
  Arguments arguments("One stream for several receivers, and for one that flies");
  arguments.text({"FOLDER", "Holds height.tif and texture.png"}, options.folder);
  arguments.positive({"--rate", "Kilobits a second, of the flight (64)"}, options.rate);
  arguments.positive({"--latency", "Seconds from a request to its first byte (0.1)"},
                     options.latency);
  arguments.positive({"--step", "Seconds between pictures of the flight (1)"}, options.step);
  arguments.positive({"--bytes", "Of the stream, and of all tiles together"}, options.bytes);
  arguments.text({"--frames", "Write PSNR over time to a CSV file"}, options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return exitCode(run(options));
}
