// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/meshes/material.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/tools/files/text.hpp"

namespace tetrakis::tools {
namespace {

using nlohmann::json;

/// Longer texts are none that encoders write.
constexpr size_t kMostBytes = 1 << 16;

/// Files have factors of 32 bits: the shortest decimal of one, as a double.
double asWritten(double factor) {
  return std::stod(shortest(static_cast<float>(factor)));
}

void put(json& at, const char* name, double factor, double usual) {
  if (factor != usual) at[name] = asWritten(factor);
}

/// The number at a place, if it is one from `least` to `most`.
void take(const json& text, const json::json_pointer& at, double least, double most,
          double& factor) {
  if (!text.contains(at) || !text[at].is_number()) return;
  const auto number = text[at].get<double>();
  if (number >= least && number <= most) factor = number;
}

}  // namespace

std::string materialText(const Material& material) {
  const auto& [metallic, roughness, emissive, scale, strength, is_double_sided, colour, alpha_mode,
               alpha_cutoff] = material.factors;
  json text = json::object(), surface = json::object();
  put(surface, "metallicFactor", metallic, 1);
  put(surface, "roughnessFactor", roughness, 1);
  if (colour != MaterialFactors().colour)
    for (const double part : colour) surface["baseColorFactor"].push_back(asWritten(part));
  if (!surface.empty()) text["pbrMetallicRoughness"] = surface;
  if (emissive != MaterialFactors().emissive)
    for (const double part : emissive) text["emissiveFactor"].push_back(asWritten(part));
  if (scale != 1) text["normalTexture"] = {{"scale", asWritten(scale)}};
  if (material.occlusion_is_red) text["occlusionTexture"] = json::object();
  if (strength != 1) text["occlusionTexture"] = {{"strength", asWritten(strength)}};
  if (is_double_sided) text["doubleSided"] = true;
  if (alpha_mode != AlphaMode::kOpaque) text["alphaMode"] = nameOf(alpha_mode);
  if (alpha_mode == AlphaMode::kMask) put(text, "alphaCutoff", alpha_cutoff, 0.5);
  return text.empty() ? "" : text.dump(-1, ' ', true);
}

Material materialOf(std::string_view text) {
  Material material;
  if (text.size() > kMostBytes) return material;
  const json parsed = json::parse(text, nullptr, false);
  if (!parsed.is_object()) return material;
  MaterialFactors& factors = material.factors;
  const auto part = [&](const char* place, double& factor) {
    take(parsed, json::json_pointer(place), 0, 1, factor);
  };
  part("/pbrMetallicRoughness/metallicFactor", factors.metallic);
  part("/pbrMetallicRoughness/roughnessFactor", factors.roughness);
  part("/occlusionTexture/strength", factors.occlusion_strength);
  for (const char axis : {'0', '1', '2'})
    if (const auto light = parsed.find("emissiveFactor");
        light != parsed.end() && light->is_array())
      part((std::string("/emissiveFactor/") + axis).c_str(),
           factors.emissive[static_cast<size_t>(axis - '0')]);
  const json::json_pointer colour("/pbrMetallicRoughness/baseColorFactor");
  for (const char channel : {'0', '1', '2', '3'})
    if (parsed.contains(colour) && parsed[colour].is_array())
      part((colour.to_string() + '/' + channel).c_str(),
           factors.colour[static_cast<size_t>(channel - '0')]);
  constexpr double kMostScale = 1e6;
  take(parsed, json::json_pointer("/normalTexture/scale"), -kMostScale, kMostScale,
       factors.normal_scale);
  const auto two = parsed.find("doubleSided");
  factors.is_double_sided = two != parsed.end() && two->is_boolean() && two->get<bool>();
  material.occlusion_is_red = parsed.contains("occlusionTexture");
  part("/alphaCutoff", factors.alpha_cutoff);
  const auto mode = parsed.find("alphaMode");
  if (mode != parsed.end() && mode->is_string())
    factors.alpha_mode = alphaModeOf(mode->get<std::string>());
  return material;
}

void dropFactorsOf(MapKind map, MaterialFactors& factors) {
  if (map == MapKind::kMetallicRoughness) {
    factors.metallic = 0;
    factors.roughness = 1;
  }
  if (map == MapKind::kEmissive) factors.emissive = {0, 0, 0};
}

}  // namespace tetrakis::tools
