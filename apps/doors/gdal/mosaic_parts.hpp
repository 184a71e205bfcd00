// SPDX-License-Identifier: Apache-2.0
// The parts of a mosaic in one file on disk, which loses its name at once where the system allows
// that, so that it goes with the process, however that ends.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include <cpl_vsi.h>
#include "tetrakis/mosaic.h"

namespace tetrakis::gdal {

class MosaicParts {
 public:
  /// In the folder that the configuration option CPL_TMPDIR names, else beside `name`, or where
  /// GDAL keeps temporary files if that is no place on a disk. Null after a reported error.
  static std::unique_ptr<MosaicParts> beside(const std::string& name);
  ~MosaicParts();
  MosaicParts(const MosaicParts&) = delete;
  MosaicParts& operator=(const MosaicParts&) = delete;

  /// For as long as this lives.
  tks_mosaic_files files();

 private:
  struct Place {
    uint64_t offset, size;
  };

  MosaicParts(std::string file_name, VSILFILE* file);
  static int read(void* user, const char* name, uint64_t offset, uint64_t bytes, void* out,
                  uint64_t* done);
  static int length(void* user, const char* name, uint64_t* size);
  static int write(void* user, const char* name, const void* data, size_t size);

  std::string file_name_;
  VSILFILE* file_;
  uint64_t end_ = 0;
  std::map<std::string, Place> places_;
};

}  // namespace tetrakis::gdal
