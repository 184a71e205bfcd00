// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/aux_xml.hpp"

#include <algorithm>

#include <cpl_conv.h>
#include <cpl_error.h>
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

constexpr char kChecksum[] = "TKSStream";

bool isSubdataset(const CPLXMLNode* node) {
  return isElement(node, "Subdataset");
}

bool isChecksum(const CPLXMLNode* node) {
  return isElement(node, kChecksum);
}

CPLXMLTreeCloser parsed(const char* file) {
  VSIStatBufL stat;
  const bool there = file != nullptr && VSIStatL(file, &stat) == 0;
  const CPLErrorStateBackuper errors;
  const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
  return CPLXMLTreeCloser(there ? CPLParseXMLFile(file) : nullptr);
}

/// What the file says of a subdataset, or of the rest.
std::string checksumOf(const CPLXMLNode* all, const char* subdataset) {
  if (*subdataset == '\0') return CPLGetXMLValue(all, kChecksum, "");
  for (const CPLXMLNode* child = all->psChild; child != nullptr; child = child->psNext)
    if (isSubdataset(child) && EQUAL(CPLGetXMLValue(child, "name", ""), subdataset))
      return CPLGetXMLValue(child, CPLSPrintf("PAMDataset.%s", kChecksum), "");
  return "";
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

/// Where the part says nothing, the rest speaks for it.
bool isOfAnother(const CPLXMLNode* all, const char* subdataset, const std::string& checksum) {
  std::string told = checksumOf(all, subdataset);
  if (told.empty()) told = checksumOf(all, "");
  return !told.empty() && told != checksum;
}

}  // namespace

bool lacks(char** siblings, const std::string& name, const char* file) {
  const std::string folder = CPLGetPath(name.c_str());
  const bool listed = siblings != nullptr && folder == CPLGetPath(file);
  return listed && CSLFindString(siblings, CPLGetFilename(file)) < 0;
}

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

CPLXMLNode* withSubdatasets(CPLXMLNode* tree, const char* file, const std::string& checksum) {
  const CPLXMLTreeCloser kept = parsed(file);
  const CPLXMLNode* const all = CPLGetXMLNode(kept.get(), "=PAMDataset");
  if (all == nullptr) return tree;
  if (tree != nullptr) dropChildren(tree, isSubdataset);
  for (const CPLXMLNode* child = all->psChild; child != nullptr; child = child->psNext) {
    if (!isSubdataset(child)) continue;
    if (isOfAnother(all, CPLGetXMLValue(child, "name", ""), checksum)) continue;
    if (tree == nullptr) tree = CPLCreateXMLNode(nullptr, CXT_Element, "PAMDataset");
    CPLXMLNode alone = *child;
    alone.psNext = nullptr;
    CPLXMLNode* const copy = CPLCloneXMLTree(&alone);
    tellChecksum(CPLGetXMLNode(copy, "PAMDataset"), checksum);
    CPLAddXMLChild(tree, copy);
  }
  return tree;
}

void tellChecksum(CPLXMLNode* tree, const std::string& checksum) {
  if (tree == nullptr) return;
  dropChildren(tree, isChecksum);
  CPLCreateXMLElementAndValue(tree, kChecksum, checksum.c_str());
}

bool isOfAnotherStream(const char* file, const char* subdataset, const std::string& checksum) {
  const CPLXMLTreeCloser kept = parsed(file);
  const CPLXMLNode* const all = CPLGetXMLNode(kept.get(), "=PAMDataset");
  return all != nullptr && isOfAnother(all, subdataset, checksum);
}

}  // namespace tetrakis::gdal
