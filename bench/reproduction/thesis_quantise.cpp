// SPDX-License-Identifier: Apache-2.0
// bench_thesis_quantise [FOLDER]: section 7.3.2 of the thesis, an open problem: quantise or
// decimate. Node (v, k) is the k-th bit-plane of the coefficient v: it needs (v, k - 1), takes
// something off the squared error, and costs -log2 p of its decisions as an ideal adaptive coder
// codes them plane by plane. Closed sets of nodes are ways to cut a stream:
//   planes     what all coefficients have down to a plane, in passes by contexts: quantise alone
//   whole      some coefficients with all planes, the others without any: decimate alone
//   closure    any closed set: what no order that decides coefficient by coefficient can beat
// Nobody says which coefficients the last two hold, so they bound what such orders can save.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/synth/synth.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/height_files.hpp"
#include "bench/peers/raster.hpp"

namespace {

using namespace tetrakis;
using namespace tetrakis::bench;

constexpr uint32_t kSide = 257, kLevels = 6;
constexpr double kFinest = 0.5;  // the threshold of the last plane, in samples
constexpr std::array<double, 3> kBytes = {1000, 4000, 16000};

/// An adaptive probability of a bit.
struct BitModel {
  double counts[2] = {0.5, 0.5};

  double code(bool bit) {
    const double bits = -std::log2(counts[bit] / (counts[0] + counts[1]));
    ++counts[bit];
    return bits;
  }
};

/// One splitting by the 9/7 filters, about orthonormal; low-pass samples come first.
void split(std::vector<double>& x) {
  constexpr double kSteps[] = {-1.586134342, -0.05298011854, 0.8829110762, 0.4435068522};
  constexpr double kScale = 1.149604398;
  const size_t n = x.size();
  for (size_t step = 0; step < 4; ++step)
    for (size_t i = 1 - step % 2; i < n; i += 2) {
      const double before = i > 0 ? x[i - 1] : x[i + 1], after = i + 1 < n ? x[i + 1] : x[i - 1];
      x[i] += kSteps[step] * (before + after);
    }
  std::vector<double> split;
  for (size_t i = 0; i < n; i += 2) split.push_back(x[i] * kScale);
  for (size_t i = 1; i < n; i += 2) split.push_back(x[i] / kScale);
  x = std::move(split);
}

std::vector<double> coefficientsOf(const Raster& raster) {
  std::vector<double> plane(raster.samples.begin(), raster.samples.end());
  double mean = 0;
  for (const double h : plane) mean += h / static_cast<double>(plane.size());
  for (double& h : plane) h -= mean;
  uint32_t side = kSide;
  for (uint32_t level = 0; level < kLevels; ++level, side = (side + 1) / 2)
    for (const size_t apart : {size_t{1}, size_t{kSide}})
      for (size_t line = 0; line < side; ++line) {
        std::vector<double> values(side);
        double* const first = &plane[line * (apart == 1 ? kSide : 1)];
        for (size_t i = 0; i < side; ++i) values[i] = first[i * apart];
        split(values);
        for (size_t i = 0; i < side; ++i) first[i * apart] = values[i];
      }
  return plane;
}

/// What some decisions take off the squared error, and their bits.
struct Step {
  double gain = 0, bits = 0;
  double slope() const { return gain / bits; }
};

/// Codes coefficients plane by plane.
class PlaneCoder {
 public:
  explicit PlaneCoder(const Raster& raster)
      : values_(coefficientsOf(raster)), nodes_(values_.size()), shown_(values_.size()) {
    double most = 0;
    for (const double v : values_) {
      most = std::max(most, std::abs(v));
      error_ += v * v;
    }
    for (double t = std::exp2(std::floor(std::log2(most))); t >= kFinest; t /= 2) codePlane(t);
  }

  double error() const { return error_; }  ///< of nothing
  const std::vector<Step>& passes() const { return passes_; }
  const std::vector<std::vector<Step>>& nodes() const { return nodes_; }

 private:
  static constexpr size_t kContexts = 6;  ///< significant neighbours, 5 at most

  bool significant(size_t i) const { return shown_[i] != 0; }
  uint32_t levelOf(size_t i) const {
    uint32_t level = 0, side = (kSide + 1) / 2;
    for (; level + 1 < kLevels && i % kSide < side && i / kSide < side; ++level)
      side = (side + 1) / 2;
    return level;
  }
  size_t neighbours(const std::vector<double>& before, size_t i) const {
    const auto x = static_cast<int>(i % kSide), y = static_cast<int>(i / kSide);
    size_t count = 0;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, int{kSide} - 1); ++v)
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, int{kSide} - 1); ++u)
        count += before[static_cast<size_t>(v) * kSide + static_cast<size_t>(u)] != 0;
    return std::min(count, kContexts - 1);
  }

  /// The passes of a plane: by levels and contexts, refinement in one; steepest first.
  void codePlane(double threshold) {
    const std::vector<double> before = shown_;
    std::vector<BitModel> models((kContexts + 1) * kLevels);
    std::vector<Step> passes(models.size());
    for (size_t i = 0; i < values_.size(); ++i) {
      const double size = std::abs(values_[i]), old = size - shown_[i];
      const size_t context = significant(i) ? kContexts : neighbours(before, i);
      const size_t pass = context * kLevels + levelOf(i);
      Step step;
      if (significant(i)) {
        const bool upper = size >= shown_[i];
        step.bits = models[pass].code(upper);
        shown_[i] += (upper ? 0.5 : -0.5) * threshold;
      } else {
        const bool found = size >= threshold;
        step.bits = models[pass].code(found) + (found ? 1 : 0);
        if (found) shown_[i] = 1.5 * threshold;
      }
      step.gain = old * old - (size - shown_[i]) * (size - shown_[i]);
      nodes_[i].push_back(step);
      passes[pass].gain += step.gain;
      passes[pass].bits += step.bits;
    }
    std::erase_if(passes, [](const Step& pass) { return !(pass.bits > 0); });
    std::sort(passes.begin(), passes.end(),
              [](const Step& a, const Step& b) { return a.slope() > b.slope(); });
    passes_.insert(passes_.end(), passes.begin(), passes.end());
  }

  std::vector<double> values_;
  std::vector<std::vector<Step>> nodes_;  ///< of each coefficient, plane by plane
  std::vector<double> shown_;             ///< sizes as far as they are known; 0: not significant
  std::vector<Step> passes_;              ///< in the order in which they are coded
  double error_ = 0;
};

std::vector<Step> steepestFirst(std::vector<Step> steps) {
  std::sort(steps.begin(), steps.end(),
            [](const Step& a, const Step& b) { return a.slope() > b.slope(); });
  return steps;
}

std::vector<Step> wholes(const PlaneCoder& coder) {
  std::vector<Step> steps;
  for (const auto& planes : coder.nodes()) {
    steps.emplace_back();
    for (const Step& plane : planes) {
      steps.back().gain += plane.gain;
      steps.back().bits += plane.bits;
    }
  }
  return steepestFirst(std::move(steps));
}

/// The largest closures are those of chains: a node whose slope is above that of the nodes which it
/// needs goes with them.
std::vector<Step> closures(const PlaneCoder& coder) {
  std::vector<Step> steps;
  for (const auto& planes : coder.nodes()) {
    const size_t first = steps.size();
    for (const Step& plane : planes) {
      steps.push_back(plane);
      while (steps.size() > first + 1 && steps.back().slope() > steps[steps.size() - 2].slope()) {
        const Step last = steps.back();
        steps.pop_back();
        steps.back().gain += last.gain;
        steps.back().bits += last.bits;
      }
    }
  }
  return steepestFirst(std::move(steps));
}

double errorAfter(double bits, double error, const std::vector<Step>& order) {
  for (const Step& step : order) {
    if (step.bits > bits) return error - step.gain * bits / step.bits;
    error -= step.gain;
    bits -= step.bits;
  }
  return error;
}

double bytesUntil(double wanted, double error, const std::vector<Step>& order) {
  double bits = 0;
  for (const Step& step : order) {
    if (error - step.gain <= wanted) return (bits + step.bits * (error - wanted) / step.gain) / 8;
    error -= step.gain;
    bits += step.bits;
  }
  return bits / 8;
}

void measure(const std::string& name, const Raster& raster) {
  const PlaneCoder coder(raster);
  const std::vector<Step> whole = wholes(coder), closure = closures(coder);
  for (const double bytes : kBytes) {
    const double error = errorAfter(8 * bytes, coder.error(), coder.passes());
    const auto until = [&](const auto& order) { return bytesUntil(error, coder.error(), order); };
    std::printf("%-16s %8.0f %9.3f %10.0f %10.0f\n", name.c_str(), bytes,
                std::sqrt(error / static_cast<double>(raster.pixels())), until(whole),
                until(closure));
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder;
  Arguments arguments("Section 7.3.2 of the thesis: quantise or decimate");
  arguments.text({"FOLDER", "Height files below it; without it the sample terrain"}, folder);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  std::printf("%-16s %8s %9s %10s %10s\n", "bytes of", "planes", "RMSE", "whole", "closure");
  const auto add = [](const std::string& name, const tools::HeightFile& file) {
    const Result<Raster> raster = heightRaster(file);
    if (!raster.ok() || !raster->real.empty() || std::min(raster->width, raster->height) < kSide)
      std::fprintf(stderr, "left out: %s has voids or is smaller than 257 x 257\n", name.c_str());
    else
      measure(name, mirrorTo(*raster, kSide, kSide));
  };
  if (folder.empty()) add("sample", tools::synthesize({}).heights);
  for (const auto& path :
       folder.empty() ? std::vector<std::filesystem::path>() : heightFilesBelow(folder, {}))
    if (const auto file = tools::readHeights(path.string()); file.ok())
      add(path.stem() == "height" ? path.parent_path().filename().string() : path.stem().string(),
          *file);
  return 0;
}
