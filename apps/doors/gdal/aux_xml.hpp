// SPDX-License-Identifier: Apache-2.0
// GDAL's file beside a stream (name.aux.xml) holds what the stream does not say. GDAL would write
// all that a dataset says into it, and what is there precedes: it would outlive a stream that is
// replaced, and name the file as it was called before it was moved. So only the rest is written,
// with the checksum of the stream that it is about.
#pragma once

#include <array>
#include <string>

#include <cpl_minixml.h>

namespace tetrakis::gdal {

/// Domains of metadata in which only the stream speaks.
inline constexpr std::array kOwnDomains = {"IMAGE_STRUCTURE", "SUBDATASETS", "TKS"};

/// What a stream says in places where others may say something else.
struct StreamTexts {
  std::string registration;  ///< AREA_OR_POINT
  std::string description;   ///< of its bands
};

/// Drops what the stream says from what is to be written. Null if nothing else is left.
CPLXMLNode* withoutStreamTexts(CPLXMLNode* tree, const StreamTexts& stream);

/// Adds what the file holds of subdatasets of this stream, which GDAL 3.6 drops when it writes the
/// whole. `tree` may be null, and so may be what is returned.
CPLXMLNode* withSubdatasets(CPLXMLNode* tree, const char* file, const std::string& checksum);

/// Binds what is to be written to its stream. `tree` may be null.
void tellChecksum(CPLXMLNode* tree, const std::string& checksum);

/// Whether the list of the folder of `name`, which may be null, lacks a file there: GDAL does not
/// open it then.
bool lacks(char** siblings, const std::string& name, const char* file);

/// Whether the file says that it is about another stream: of a subdataset, or with "" of the rest.
/// What other programs write says nothing of that.
bool isOfAnotherStream(const char* file, const char* subdataset, const std::string& checksum);

}  // namespace tetrakis::gdal
