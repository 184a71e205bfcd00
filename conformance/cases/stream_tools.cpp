// SPDX-License-Identifier: Apache-2.0
#include "conformance/cases/stream_tools.hpp"

#include <utility>

namespace tetrakis::conformance {
namespace {

/// A tool, and whether a stream has it.
using Had = std::pair<const char*, bool>;

void addWavelet(const WaveletHeader& wavelet, Tools& tools) {
  for (const Had& had :
       {Had{"levels of several filters",
            wavelet.filters[0] != wavelet.filters[1] || wavelet.filters[1] != wavelet.filters[2]},
        Had{"fraction bits", wavelet.fraction_bits > 0},
        Had{"doubled low bands", wavelet.first_doubled > 0}, Had{"wide sums", wavelet.bits > 20}})
    if (had.second) tools.insert(had.first);
}

const char* correctionsOf(const GeometryLayers& layers) {
  switch (layers.corrections) {
    case CorrectionKind::kNone:
      return "";
    case CorrectionKind::kSteps:
      return layers.correction_step == 1 ? "exact corrections" : "corrections of steps";
    case CorrectionKind::kSamples:
      return "corrections of samples";
    case CorrectionKind::kRelative:
      return "relative steps";
    case CorrectionKind::kFacets:
      return "facets";
  }
  return "";
}

void addHeights(const GeometryHeader& heights, const GeometryLayers& layers, Tools& tools) {
  tools.insert(heights.stored() ? "stored heights"
               : heights.drawn  ? "drawn heights"
                                : "heights by wavelet");
  if (!heights.direct()) addWavelet(heights.wavelet, tools);
  if (const char* kind = correctionsOf(layers); *kind != 0) tools.insert(kind);
  for (const Had& had :
       {Had{"repeated lines", !heights.repeats.none()},
        Had{"priorities of heights", !heights.priorities.none()},
        Had{"regions of heights", heights.regions.side_log2 > 0},
        Had{"voids", layers.validity_bytes > 0}, Had{"masks of regions", layers.region_masks},
        Had{"nodata", layers.has_nodata != 0}, Had{"bridged voids", layers.bridge > 0},
        Had{"late mask", layers.late_mask}, Had{"opening of a late mask", layers.lifted_bytes > 0},
        Had{"flat areas", layers.flat_bytes > 0}, Had{"table of values", layers.table_bytes > 0},
        Had{"stand-in knots", !layers.table_knots.empty()}})
    if (had.second) tools.insert(had.first);
}

void addTexture(const TextureHeader& texture, Tools& tools) {
  tools.insert(texture.stored    ? "stored texture"
               : texture.drawn() ? "drawn texture"
                                 : "texture by wavelet");
  if (!texture.direct()) addWavelet(texture.wavelet, tools);
  for (const Had& had :
       {Had{"repeated texels", !texture.repeats.none()},
        Had{"priorities of texels", !texture.priorities.none()},
        Had{"regions of texels", texture.regions.side_log2 > 0},
        Had{"weights of bands", texture.weights.levels > 0},
        Had{"cut-out", texture.alpha_bytes > 0}, Had{"hidden colours", texture.hidden != 0},
        Had{"overlay", texture.overlay_bytes > 0}, Had{"bridged texels", texture.bridge > 0},
        Had{"tables of channels", texture.tables.present},
        Had{"shears of coefficients", texture.colour_shears.size() > 1},
        Had{"further colour", texture.opaque}, Had{"white level", texture.white_level > 0}})
    if (had.second) tools.insert(had.first);
}

}  // namespace

Tools toolsOf(std::span<const uint8_t> stream) {
  const Result<ParsedHeader> parsed = readHeader(stream);
  if (!parsed.ok()) return {};
  const StreamHeader& header = parsed->header;
  Tools tools;
  if (header.geometry) addHeights(*header.geometry, header.layers, tools);
  if (header.texture) addTexture(*header.texture, tools);
  if (header.geometry && !header.geometry->frames.none()) tools.insert("frames of heights");
  if (header.texture && !header.texture->frames.none()) tools.insert("frames of texels");
  if (header.geometry && !header.geometry->frames.scales.empty()) tools.insert("scales of frames");
  if (header.geometry && header.geometry->wavelet.ring) tools.insert("cylinder of heights");
  if (header.texture && header.texture->wavelet.ring) tools.insert("cylinder of texels");
  if (header.geometry && header.geometry->wavelet.forest) tools.insert("forest of heights");
  if (header.texture && header.texture->wavelet.forest) tools.insert("forest of texels");
  if (header.geometry && !header.geometry->base_mesh.none()) tools.insert("base mesh");
  if (!header.triangle_mesh.none()) tools.insert("triangle mesh");
  if (header.triangle_mesh.texcoord_bits > 0) tools.insert("texcoords");
  if (!header.sketch.empty()) tools.insert("sketch");
  if (!header.index.empty()) tools.insert("index");
  if (!header.pages.empty()) tools.insert("index pages");
  if (header.georeference.heights.has_transform || header.georeference.texture.has_transform)
    tools.insert("georeference");
  if (!header.height_positions.empty() || !header.texture_positions.empty())
    tools.insert("positions");
  for (const ListedComponent& one : header.components) {
    const bool known = one.isHeights() || one.isTexture();
    if (known && one.component == Component::kOther) tools.insert("further components");
    if (!one.details.none()) tools.insert("details");
  }
  return tools;
}

Tools allTools() {
  return {"base mesh",
          "bridged texels",
          "bridged voids",
          "corrections of samples",
          "corrections of steps",
          "cut-out",
          "cylinder of heights",
          "cylinder of texels",
          "details",
          "doubled low bands",
          "drawn heights",
          "drawn texture",
          "exact corrections",
          "facets",
          "flat areas",
          "forest of heights",
          "forest of texels",
          "fraction bits",
          "frames of heights",
          "frames of texels",
          "further colour",
          "further components",
          "georeference",
          "heights by wavelet",
          "hidden colours",
          "index",
          "index pages",
          "late mask",
          "levels of several filters",
          "masks of regions",
          "nodata",
          "opening of a late mask",
          "positions",
          "overlay",
          "priorities of heights",
          "priorities of texels",
          "regions of heights",
          "regions of texels",
          "relative steps",
          "repeated lines",
          "repeated texels",
          "scales of frames",
          "shears of coefficients",
          "sketch",
          "stand-in knots",
          "stored heights",
          "stored texture",
          "table of values",
          "tables of channels",
          "texcoords",
          "texture by wavelet",
          "triangle mesh",
          "voids",
          "weights of bands",
          "white level",
          "wide sums"};
}

Status checkTools(const std::string& name, std::span<const uint8_t> stream) {
  const Tools has = toolsOf(stream), stated = toolsStatedFor(name);
  std::string wrong;
  for (const std::string& tool : stated)
    if (!has.contains(tool)) wrong += " lacks \"" + tool + "\";";
  for (const std::string& tool : has)
    if (!stated.contains(tool)) wrong += " has \"" + tool + "\";";
  if (wrong.empty()) return {};
  wrong.back() = '.';
  return {TKS_MISMATCH, "The stream of " + name + wrong};
}

}  // namespace tetrakis::conformance
