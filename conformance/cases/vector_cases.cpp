// SPDX-License-Identifier: Apache-2.0
// The conformance vectors: small inputs that together visit every tool of the format.
#include "conformance/cases/vector_cases.hpp"

#include "conformance/cases/cases.hpp"

namespace tetrakis::conformance {

std::vector<VectorCase> vectorCases() {
  std::vector<VectorCase> all = geometryCases();
  for (VectorCase& next : layerCases()) all.push_back(std::move(next));
  for (VectorCase& next : textureCases()) all.push_back(std::move(next));
  for (VectorCase& next : tableCases()) all.push_back(std::move(next));
  for (VectorCase& next : relativeCases()) all.push_back(std::move(next));
  for (VectorCase& next : facetCases()) all.push_back(std::move(next));
  for (VectorCase& next : drawnHeightsCases()) all.push_back(std::move(next));
  for (VectorCase& next : storedCases()) all.push_back(std::move(next));
  for (VectorCase& next : jointCases()) all.push_back(std::move(next));
  for (VectorCase& next : regionCases()) all.push_back(std::move(next));
  for (VectorCase& next : regionMaskCases()) all.push_back(std::move(next));
  for (VectorCase& next : frameCases()) all.push_back(std::move(next));
  for (VectorCase& next : cylinderCases()) all.push_back(std::move(next));
  for (VectorCase& next : forestCases()) all.push_back(std::move(next));
  for (VectorCase& next : dividedForestCases()) all.push_back(std::move(next));
  for (VectorCase& next : objectCases()) all.push_back(std::move(next));
  for (VectorCase& next : triangleCases()) all.push_back(std::move(next));
  for (VectorCase& next : sparseCases()) all.push_back(std::move(next));
  for (VectorCase& next : bridgeCases()) all.push_back(std::move(next));
  for (VectorCase& next : bridgedTextureCases()) all.push_back(std::move(next));
  for (VectorCase& next : copiedCases()) all.push_back(std::move(next));
  for (VectorCase& next : waterCases()) all.push_back(std::move(next));
  for (VectorCase& next : toldCases()) all.push_back(std::move(next));
  for (VectorCase& next : placedCases()) all.push_back(std::move(next));
  for (VectorCase& next : craftedCases()) all.push_back(std::move(next));
  for (VectorCase& next : unusualAndRefusedCases()) all.push_back(std::move(next));
  for (VectorCase& next : listCases()) all.push_back(std::move(next));
  for (VectorCase& next : componentCases()) all.push_back(std::move(next));
  for (VectorCase& next : sketchCases()) all.push_back(std::move(next));
  for (VectorCase& next : damagedCases()) all.push_back(std::move(next));
  return all;
}

}  // namespace tetrakis::conformance
