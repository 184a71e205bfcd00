// SPDX-License-Identifier: Apache-2.0
// bench_thesis_bits [FOLDER]: section 7.3.1 of the thesis, an open problem: bits, not triangles, as
// the rate of decimation. A mesh is coded vertex by vertex: is it there, where its parents are, and
// by how much is its height off the mesh before. Its bits are those of ideal adaptive arithmetic
// coding, -log2 p, summed up by vertex as costs of decimation; the mesh of these costs gives new
// probabilities, and so on. Judged by bytes at equal error, beside prefixes of streams.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/synth/synth.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/height_files.hpp"
#include "bench/harness/results.hpp"
#include "bench/peers/raster.hpp"
#include "bench/peers/tetrakis_peer.hpp"
#include "codec/mesh/study/study.hpp"

namespace {

using namespace tetrakis;
using namespace tetrakis::bench;

constexpr uint32_t kSide = 257;
constexpr uint32_t kBudgets[] = {200, 800, 3200, 12800};  // triangles
constexpr int kRounds = 3;
constexpr double kUnit = 16;  // costs of decimation are whole: sixteenths of bits
constexpr uint32_t kClasses = 18;

/// An adaptive probability of a bit.
struct BitModel {
  double counts[2] = {0.5, 0.5};

  double cost(bool bit) const { return -std::log2(counts[bit] / (counts[0] + counts[1])); }
  double code(bool bit) {
    const double bits = cost(bit);
    ++counts[bit];
    return bits;
  }
};

struct Surface {
  std::vector<int32_t> heights;
  SurfaceView view() const { return {kSide, kSide, heights}; }
};

/// Codes closed sets of vertices and their heights, level by level.
class MeshCoder {
 public:
  MeshCoder(const Lattice& lattice, const Surface& surface)
      : lattice_(lattice),
        parents_(lattice.vertexCount()),
        classes_(lattice.vertexCount()),
        presence_(size_t{4} * lattice.levelCount()),
        heights_(size_t{kClasses + 1} * kClasses) {
    const std::vector<double> errors = localErrors(lattice, surface.view());
    for (VertexId v = 0; v < lattice.vertexCount(); ++v) {
      lattice.forEachParent(lattice.site(v), [&](Site p) { parents_[v].push_back(lattice.id(p)); });
      classes_[v] = static_cast<uint8_t>(
          std::bit_width(static_cast<uint32_t>(std::lround(std::sqrt(errors[v])))));
    }
  }

  /// Bits of a set, which the models adapt to.
  double code(const std::vector<bool>& in) {
    std::fill(presence_.begin(), presence_.end(), BitModel{});
    std::fill(heights_.begin(), heights_.end(), BitModel{});
    double bits = 0;
    for (VertexId v = 0; v < lattice_.vertexCount(); ++v) {
      if (!asked(v, in)) continue;
      bits += presence_[presenceContext(v, in)].code(in[v]);
      if (in[v]) bits += heightBits(v, [](BitModel& model, bool bit) { return model.code(bit); });
    }
    return bits;
  }

  /// What each vertex adds to the bits of the set that was coded last: its own, and the answers
  /// that its children are not there, shared by their parents.
  std::vector<uint32_t> costs(const std::vector<bool>& in) {
    std::vector<double> bits(lattice_.vertexCount());
    for (VertexId v = 0; v < lattice_.vertexCount(); ++v) {
      const BitModel& presence = presence_[presenceContext(v, in)];
      const double absent = presence.cost(false);
      bits[v] += presence.cost(true) - absent +
                 heightBits(v, [](BitModel& model, bool bit) { return model.cost(bit); });
      for (const VertexId p : parents_[v])
        bits[p] += absent / static_cast<double>(parents_[v].size());
    }
    std::vector<uint32_t> costs;
    for (const double b : bits)
      costs.push_back(static_cast<uint32_t>(std::max(1.0, std::round(kUnit * b))));
    return costs;
  }

 private:
  bool asked(VertexId v, const std::vector<bool>& in) const {
    return std::all_of(parents_[v].begin(), parents_[v].end(), [&](VertexId p) { return in[p]; });
  }

  /// The level, and how many earlier children of the parents are there.
  size_t presenceContext(VertexId v, const std::vector<bool>& in) const {
    uint32_t there = 0;
    for (const VertexId p : parents_[v])
      lattice_.forEachChild(lattice_.site(p), [&](Site child) {
        const VertexId w = lattice_.id(child);
        there += w < v && in[w] ? 1 : 0;
      });
    return 4 * size_t{lattice_.site(v).level} + std::min(there, 3u);
  }

  /// Whole steps that the sample is off: the number of binary digits, known those of the parents,
  /// then the digits below the first, and the sign.
  template <class Bits>
  double heightBits(VertexId v, Bits of) {
    uint32_t known = parents_[v].empty() ? kClasses : 0;
    for (const VertexId p : parents_[v]) known = std::max<uint32_t>(known, classes_[p]);
    double bits = classes_[v];  // digits below the first, and the sign
    for (uint32_t k = 0; k <= classes_[v] && k < kClasses; ++k)
      bits += of(heights_[size_t{known} * kClasses + k], k < classes_[v]);
    return bits;
  }

  const Lattice& lattice_;
  std::vector<std::vector<VertexId>> parents_;
  std::vector<uint8_t> classes_;
  std::vector<BitModel> presence_, heights_;
};

/// The shortest prefix of an order that errs by no more than this, as a set.
std::vector<bool> setFor(const MeshSequence& sequence, double error) {
  size_t count = 0;
  while (count < sequence.order().size() && sequence.squaredError(count) > error) ++count;
  std::vector<bool> in(sequence.order().size());
  for (size_t i = 0; i < count; ++i) in[sequence.order()[i]] = true;
  return in;
}

/// Bytes of the shortest prefix of a stream that errs by no more than this.
Result<double> prefixFor(const Raster& raster, double error) {
  const auto stream = encodeTetrakis({&raster, nullptr}, raster.pixels());
  if (!stream.ok()) return stream.status();
  size_t low = 64, high = stream->size();
  while (low + 1 < high) {
    const size_t middle = (low + high) / 2;
    const auto decoded = decodeTetrakis(std::span(*stream).first(middle));
    if (!decoded.ok()) return decoded.status();
    double sum = 0;
    for (size_t i = 0; i < raster.pixels(); ++i) {
      const double off = double{decoded->surface[i]} - raster.samples[i];
      sum += off * off;
    }
    (sum <= error ? high : low) = middle;
  }
  return static_cast<double>(high);
}

struct Study {
  std::string name;
  const Raster& raster;
  Surface surface;
};

Status measureBudget(const Study& study, const MeshSequence& triangles, uint32_t budget,
                     std::vector<ResultRow>& rows) {
  const Lattice& lattice = triangles.lattice();
  MeshCoder coder(lattice, study.surface);
  const double error = triangles.squaredError(triangles.bestPrefix(budget));
  const auto report = [&](const std::string& codec, double bytes) {
    std::printf(" %9.0f", bytes);
    rows.push_back({study.name, codec, "bytes_" + std::to_string(budget), bytes});
  };
  std::printf("%-18s %6u %8.3f", study.name.c_str(), budget,
              std::sqrt(error / static_cast<double>(lattice.sampleCount())));
  std::vector<bool> in = setFor(triangles, error);
  report("triangles", coder.code(in) / 8);
  for (int round = 1; round <= kRounds; ++round) {
    const std::vector<uint32_t> costs = coder.costs(in);
    const Result<MeshSequence> bits =
        decimate(study.surface.view(), {MeshPolicy::kGeneralDecimation, costs});
    if (!bits.ok()) return bits.status();
    in = setFor(*bits, error);
    report("bits_" + std::to_string(round), coder.code(in) / 8);
  }
  const Result<double> prefix = prefixFor(study.raster, error);
  if (!prefix.ok()) return prefix.status();
  report("prefix", *prefix);
  std::printf("\n");
  std::fflush(stdout);
  return {};
}

Status measureFile(const std::string& name, const Raster& raster, std::vector<ResultRow>& rows) {
  const Study study{name, raster, {{raster.samples.begin(), raster.samples.end()}}};
  const auto triangles = decimate(study.surface.view(), {MeshPolicy::kGeneralDecimation, {}});
  if (!triangles.ok()) return triangles.status();
  for (const uint32_t budget : kBudgets)
    if (Status status = measureBudget(study, *triangles, budget, rows); !status.ok()) return status;
  return {};
}

struct Options {
  std::string folder;  // empty: the sample terrain
  uint32_t most_files = 1000;
  std::string csv;
};

/// Files without voids, and the names that they have in tables.
std::vector<std::pair<std::string, Raster>> readFiles(const Options& options) {
  std::vector<std::pair<std::string, Raster>> files;
  const auto add = [&](const std::string& name, const tools::HeightFile& file) {
    Result<Raster> raster = heightRaster(file);
    if (!raster.ok() || !raster->real.empty() || std::min(raster->width, raster->height) < kSide)
      std::fprintf(stderr, "left out: %s has voids or is smaller than 257 x 257\n", name.c_str());
    else
      files.emplace_back(name, mirrorTo(*raster, kSide, kSide));
  };
  if (options.folder.empty()) {
    add("sample", tools::synthesize({}).heights);
    return files;
  }
  for (const auto& path : heightFilesBelow(options.folder, {})) {
    if (files.size() == options.most_files) break;
    const std::string folder = path.parent_path().filename().string();
    const std::string name = path.stem() == "height" ? folder : path.stem().string();
    if (const auto file = tools::readHeights(path.string()); file.ok()) add(name, *file);
  }
  return files;
}

Status run(const Options& options) {
  std::vector<ResultRow> rows;
  std::printf("%-18s %6s %8s %9s %9s %9s %9s %9s\n", "bytes of", "mesh", "RMSE", "triangles",
              "bits, 1", "bits, 2", "bits, 3", "prefix");
  for (const auto& [name, raster] : readFiles(options))
    if (Status status = measureFile(name, raster, rows); !status.ok()) return status;
  return updateResults(options.csv, "thesis_bits", rows);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Arguments arguments("Section 7.3.1 of the thesis: bits as the rate of decimation");
  arguments.text({"FOLDER", "Height files below it; without it the sample terrain"},
                 options.folder);
  arguments.within({"--files", "Height files at most"}, options.most_files, 1, 1000000);
  arguments.csv(options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return exitCode(run(options));
}
