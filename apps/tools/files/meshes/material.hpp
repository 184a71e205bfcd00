// SPDX-License-Identifier: Apache-2.0
// A Material says what a surface is made of beside its colour, as glTF 2.0 has it. materialText()
// writes it as the JSON that streams of objects keep (docs/FORMAT.md, section 2), and materialOf()
// reads that.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace tetrakis::tools {

/// Maps of a material, and what components of a stream are called that hold them. Red of occlusion
/// counts; green of metallic_roughness is roughness, its blue metalness.
enum class MapKind : uint8_t { kNormal, kMetallicRoughness, kOcclusion, kEmissive };
inline constexpr std::array<const char*, 4> kMapNames{"normal", "metallic_roughness", "occlusion",
                                                      "emissive"};
inline constexpr size_t kMapKinds = kMapNames.size();

/// How alpha counts: not at all, by what lies above the cutoff, as a part of what is seen.
enum class AlphaMode : uint8_t { kOpaque, kMask, kBlend };
inline constexpr std::array<const char*, 3> kAlphaModes{"OPAQUE", "MASK", "BLEND"};

inline const char* nameOf(AlphaMode mode) {
  return kAlphaModes[static_cast<size_t>(mode)];
}
/// kOpaque of a name that is none.
inline AlphaMode alphaModeOf(std::string_view name) {
  size_t mode = kAlphaModes.size() - 1;
  while (mode > 0 && name != kAlphaModes[mode]) --mode;
  return static_cast<AlphaMode>(mode);
}

/// What maps are multiplied by; its usual values.
struct MaterialFactors {
  double metallic = 1, roughness = 1;
  std::array<double, 3> emissive{0, 0, 0};
  double normal_scale = 1, occlusion_strength = 1;
  bool is_double_sided = false;
  std::array<double, 4> colour{1, 1, 1, 1};  ///< RGBA; of a texture its colours have RGB already
  AlphaMode alpha_mode = AlphaMode::kOpaque;
  double alpha_cutoff = 0.5;  ///< with kMask
};

struct Material {
  MaterialFactors factors{};
  bool occlusion_is_red = false;  ///< of metallic_roughness: there is no map of its own
};

/// Says nothing of what is usual; "": all is.
std::string materialText(const Material& material);

/// What is not there, or not as glTF has it, is as usual. The text may be any bytes.
Material materialOf(std::string_view text);

/// Metalness, roughness and light of a surface whose maps of these are not there, which the factors
/// were made for: it is matt and dark, as one without them.
void dropFactorsOf(MapKind map, MaterialFactors& factors);

}  // namespace tetrakis::tools
