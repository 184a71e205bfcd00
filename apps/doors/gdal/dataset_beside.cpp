// SPDX-License-Identifier: Apache-2.0
// What a dataset takes of the file beside its stream (name.aux.xml), and what it writes there.
#include <string>
#include <vector>

#include <cpl_conv.h>
#include <cpl_string.h>
#include "apps/doors/gdal/dataset.hpp"

namespace tetrakis::gdal {
namespace {

/// What a copy has kept beside of its rounding, by the checksum of the stream that it is of.
constexpr char kRoundingDomain[] = "TKS_ROUNDING";

}  // namespace

void Dataset::loadBeside(char** siblings) {
  std::vector<CPLStringList> own;
  for (const char* const domain : kOwnDomains)
    own.emplace_back(CSLDuplicate(GDALDataset::GetMetadata(domain)));
  CPLStringList of_bands(CSLDuplicate(GetRasterBand(1)->GetMetadata("IMAGE_STRUCTURE")));
  if (isBesideOfAnother(siblings)) {
    CPLError(CE_Warning, CPLE_AppDefined,
             "%s: The file .aux.xml beside it is about another stream that had this name, and is "
             "not used.",
             source_->name().c_str());
    return;
  }
  TryLoadXML(siblings);
  for (size_t i = 0; i < own.size(); ++i)
    if (GDALDataset::GetMetadata(kOwnDomains[i]) != nullptr)
      GDALDataset::SetMetadata(own[i].List(), kOwnDomains[i]);
  for (auto&& band : GetBands())
    if (band->GetMetadata("IMAGE_STRUCTURE") != nullptr)
      band->GDALRasterBand::SetMetadata(of_bands.List(), "IMAGE_STRUCTURE");
  // GDAL empties it where the file says nothing.
  for (auto&& band : GetBands())
    if (isHeights() && *band->GetDescription() == '\0')
      band->GDALRasterBand::SetDescription(texts_.description.c_str());
  takeRounding();
}

bool Dataset::isBesideOfAnother(char** siblings) {
  PamInitialize();
  const char* const file = BuildPamFilename();
  if (file == nullptr || lacks(siblings, source_->name(), file)) return false;
  return isOfAnotherStream(file, GetSubdatasetName(), source_->checksum());
}

void Dataset::takeRounding() {
  const char* const kept = GetMetadataItem(source_->checksum().c_str(), kRoundingDomain);
  if (kept == nullptr || !isHeights()) return;
  GDALDataset::SetMetadataItem("COMPRESSION_REVERSIBILITY", "LOSSY", "IMAGE_STRUCTURE");
  const char* const promised = GetMetadataItem("MAX_ERROR", "TKS");
  if (promised == nullptr) return;
  const std::string error = CPLSPrintf("%.17g", CPLAtof(promised) + CPLAtof(kept));
  GDALDataset::SetMetadataItem("MAX_ERROR", error.c_str(), "TKS");
}

void Dataset::tellRounding(double rounding) {
  const std::string text = CPLSPrintf("%.17g", rounding);
  SetMetadataItem(source_->checksum().c_str(), text.c_str(), kRoundingDomain);
  takeRounding();
}

CPLXMLNode* Dataset::SerializeToXML(const char* path) {
  CPLXMLNode* tree = withoutStreamTexts(GDALPamDataset::SerializeToXML(path), texts_);
  const std::string checksum = source_->checksum();
  if (*GetSubdatasetName() == '\0') {
    tree = withSubdatasets(tree, BuildPamFilename(), checksum);
  } else if (tree == nullptr) {
    // For null GDAL would remove the file, and with it what belongs to others.
    tree = CPLCreateXMLNode(nullptr, CXT_Element, "PAMDataset");
  }
  tellChecksum(tree, checksum);
  return tree;
}

}  // namespace tetrakis::gdal
