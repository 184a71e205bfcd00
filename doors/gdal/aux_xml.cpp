// SPDX-License-Identifier: Apache-2.0
#include "doors/gdal/aux_xml.hpp"

#include <algorithm>

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>

namespace tetrakis::gdal {
namespace {

bool isElement(const CPLXMLNode* node, const char* name) {
  return node->eType == CXT_Element && EQUAL(node->pszValue, name);
}

bool hasElements(const CPLXMLNode* node) {
  for (const CPLXMLNode* child = node->psChild; child != nullptr; child = child->psNext)
    if (child->eType == CXT_Element) return true;
  return false;
}

template <class Predicate>
void dropChildren(CPLXMLNode* parent, const Predicate& predicate) {
  for (CPLXMLNode* child = parent->psChild; child != nullptr;) {
    CPLXMLNode* const next = child->psNext;
    if (predicate(child)) {
      CPLRemoveXMLChild(parent, child);
      CPLDestroyXMLNode(child);
    }
    child = next;
  }
}

bool isOwnDomain(const CPLXMLNode* node) {
  const char* const domain = CPLGetXMLValue(node, "domain", "");
  return isElement(node, "Metadata") &&
         std::any_of(kOwnDomains.begin(), kOwnDomains.end(),
                     [domain](const char* own) { return EQUAL(domain, own); });
}

/// Of the dataset's metadata without a domain.
void dropRegistration(CPLXMLNode* metadata, const std::string& registration) {
  dropChildren(metadata, [&](const CPLXMLNode* item) {
    return EQUAL(CPLGetXMLValue(item, "key", ""), GDALMD_AREA_OR_POINT) &&
           registration == CPLGetXMLValue(item, "", "");
  });
}

void dropOfBand(CPLXMLNode* band, const std::string& description) {
  dropChildren(band, [&](const CPLXMLNode* child) {
    return isOwnDomain(child) ||
           (isElement(child, "Description") && description == CPLGetXMLValue(child, "", ""));
  });
}

}  // namespace

CPLXMLNode* withoutStreamTexts(CPLXMLNode* tree, const StreamTexts& stream) {
  if (tree == nullptr) return nullptr;
  dropChildren(tree, [&](CPLXMLNode* child) {
    if (isOwnDomain(child)) return true;
    const bool plain = isElement(child, "Metadata") && CPLGetXMLNode(child, "domain") == nullptr;
    const bool band = isElement(child, "PAMRasterBand");
    if (plain) dropRegistration(child, stream.registration);
    if (band) dropOfBand(child, stream.description);
    return (plain || band) && !hasElements(child);
  });
  if (hasElements(tree)) return tree;
  CPLDestroyXMLNode(tree);
  return nullptr;
}

CPLXMLNode* withSubdatasets(CPLXMLNode* tree, const char* file) {
  const auto is_subdataset = [](const CPLXMLNode* node) { return isElement(node, "Subdataset"); };
  VSIStatBufL stat;
  if (file == nullptr || VSIStatL(file, &stat) != 0) return tree;
  const CPLXMLTreeCloser kept(CPLParseXMLFile(file));
  const CPLXMLNode* const all = CPLGetXMLNode(kept.get(), "=PAMDataset");
  if (all == nullptr) return tree;
  if (tree != nullptr) dropChildren(tree, is_subdataset);
  for (const CPLXMLNode* child = all->psChild; child != nullptr; child = child->psNext) {
    if (!is_subdataset(child)) continue;
    if (tree == nullptr) tree = CPLCreateXMLNode(nullptr, CXT_Element, "PAMDataset");
    CPLXMLNode alone = *child;
    alone.psNext = nullptr;
    CPLAddXMLChild(tree, CPLCloneXMLTree(&alone));
  }
  return tree;
}

}  // namespace tetrakis::gdal
