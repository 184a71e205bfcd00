// SPDX-License-Identifier: Apache-2.0
// ViewSynthesis is the inverse wavelet of what a view shows of a plane: coefficients go in, and the
// samples of the view come out. A view of a whole plane, or of one of its levels, is worked out in
// place (plane_synthesis.hpp). A window is worked out from the coefficients that reach it
// (window_synthesis.hpp), and has the same samples that the whole plane has there.
#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "base/view.hpp"
#include "codec/wavelet/synthesis/plane_synthesis.hpp"
#include "codec/wavelet/synthesis/window_synthesis.hpp"

namespace tetrakis::inline synthesis {

class ViewSynthesis {
 public:
  /// The pyramid outlives this object. Its mask says which samples exist.
  ViewSynthesis(const WaveletSpec& spec, const Pyramid& pyramid, const View& view)
      : kernel_(kernelOf(spec, pyramid, view)) {}

  /// Makes room for the coefficients, which are 0 until they are put. Comes before put() and row().
  void allocate() {
    std::visit([](auto& kernel) { kernel.allocate(); }, kernel_);
  }
  /// How many coefficients allocate() makes room for.
  uint64_t coefficients() const {
    return std::visit([](const auto& kernel) { return kernel.coefficients(); }, kernel_);
  }
  /// The bytes that run() allocates at most beside the coefficients. masked: whether the mask of
  /// the pyramid will have bytes.
  uint64_t workBytes(uint32_t threads, bool masked) const {
    return std::visit([&](const auto& kernel) { return kernel.workBytes(threads, masked); },
                      kernel_);
  }

  /// True if samples of the view depend on coefficients of the part.
  bool needs(const BandPart& part) const {
    return std::visit([&](const auto& kernel) { return kernel.needs(part); }, kernel_);
  }
  /// Takes what is known of the coefficients of a part, as far as they are needed, with
  /// `fraction_bits` binary places more than they were coded with. Parts that do not overlap may be
  /// put at the same time.
  void put(const Band& band, int fraction_bits, const BandPart& part) {
    std::visit([&](auto& kernel) { kernel.put(band, fraction_bits, part); }, kernel_);
  }

  /// The coefficients of a subband that are needed: the number of their rows, and each row in
  /// place.
  uint32_t rows(const Subband& subband) const {
    return std::visit([&](const auto& kernel) { return kernel.rows(subband); }, kernel_);
  }
  std::span<int32_t> row(const Subband& subband, uint32_t row) {
    return std::visit([&](auto& kernel) { return kernel.row(subband, row); }, kernel_);
  }

  /// Returns the samples of the view, row by row. Those that do not exist may be anything. Called
  /// once, at the end.
  std::vector<int32_t> run(uint32_t threads) {
    return std::visit([&](auto& kernel) { return kernel.run(threads); }, kernel_);
  }
  /// memory: of this plane; no view is a window.
  std::vector<int32_t> run(uint32_t threads, SynthesisMemory& memory) {
    return std::get<PlaneSynthesis>(kernel_).run(threads, memory);
  }

 private:
  using Kernel = std::variant<PlaneSynthesis, WindowSynthesis>;

  static Kernel kernelOf(const WaveletSpec& spec, const Pyramid& pyramid, const View& view) {
    if (view.window) return WindowSynthesis(spec, pyramid, *view.window);
    return PlaneSynthesis(spec, pyramid, view.level);
  }
  Kernel kernel_;
};

/// The bands of a track with whether the view needs each; none if it needs none. bands: one or more
/// planes of as many parts.
std::vector<BandPlan> withNeeds(const ViewSynthesis& synthesis, std::span<const BandPart> parts,
                                std::vector<BandPlan> bands);

}  // namespace tetrakis::inline synthesis
