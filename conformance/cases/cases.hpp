// SPDX-License-Identifier: Apache-2.0
// The functions here list the cases of one area each. vector_cases.cpp puts them in the order of
// the manifest.
#pragma once

#include <vector>

#include "conformance/cases/vector_cases.hpp"

namespace tetrakis::conformance {

// height_cases.cpp
std::vector<VectorCase> geometryCases();
std::vector<VectorCase> layerCases();
std::vector<VectorCase> bridgeCases();
std::vector<VectorCase> sparseCases();

// object_cases.cpp
std::vector<VectorCase> objectCases();
std::vector<VectorCase> triangleCases();

// height_kind_cases.cpp
std::vector<VectorCase> tableCases();
std::vector<VectorCase> relativeCases();
std::vector<VectorCase> facetCases();
std::vector<VectorCase> drawnHeightsCases();
std::vector<VectorCase> copiedCases();
std::vector<VectorCase> waterCases();

// texture_cases.cpp
std::vector<VectorCase> textureCases();
std::vector<VectorCase> bridgedTextureCases();

// stream_cases.cpp
std::vector<VectorCase> jointCases();
std::vector<VectorCase> storedCases();
std::vector<VectorCase> regionCases();
std::vector<VectorCase> cylinderCases();
std::vector<VectorCase> forestCases();
std::vector<VectorCase> dividedForestCases();
std::vector<VectorCase> toldCases();
std::vector<VectorCase> placedCases();
std::vector<VectorCase> damagedCases();

// Streams that are written out (VectorCase::stream).
// region_mask_cases.cpp
std::vector<VectorCase> regionMaskCases();
// component_cases.cpp
std::vector<VectorCase> componentCases();

/// Headers that begin with a stream of their own.
std::vector<VectorCase> sketchCases();
// frame_cases.cpp
std::vector<VectorCase> frameCases();
// crafted_cases.cpp: all of these.
std::vector<VectorCase> craftedCases();
// crafted_correction_cases.cpp
std::vector<VectorCase> correctionCases();
// crafted_wavelet_cases.cpp
std::vector<VectorCase> weightCases();
std::vector<VectorCase> priorityCases();
std::vector<VectorCase> channelTableCases();
std::vector<VectorCase> shearCases();
std::vector<VectorCase> roundedCases();
// crafted_drawing_cases.cpp
std::vector<VectorCase> drawnCases();
// refused_cases.cpp
std::vector<VectorCase> unusualAndRefusedCases();
// list_cases.cpp
std::vector<VectorCase> listCases();

}  // namespace tetrakis::conformance
