// SPDX-License-Identifier: Apache-2.0
// The GDAL driver TKS, which GDAL finds as gdal_TKS.so in its folder of plugins.
#include <gdal_frmts.h>
#include "apps/doors/gdal/create.hpp"
#include "apps/doors/gdal/create_copy.hpp"
#include "apps/doors/gdal/dataset.hpp"
#include "apps/doors/gdal/settings.hpp"

CPL_C_START
void CPL_DLL GDALRegister_TKS();
CPL_C_END

void GDALRegister_TKS() {
  using namespace tetrakis::gdal;
  if (!GDAL_CHECK_VERSION("TKS") || GDALGetDriverByName("TKS") != nullptr) return;
  auto* const driver = new GDALDriver;
  driver->SetDescription("TKS");
  const auto set = [driver](const char* key, const char* value) {
    driver->SetMetadataItem(key, value);
  };
  set(GDAL_DCAP_RASTER, "YES");
  set(GDAL_DCAP_VIRTUALIO, "YES");
  set(GDAL_DMD_LONGNAME, "Tetrakis progressive terrain");
  set(GDAL_DMD_EXTENSION, "tks");
  set(GDAL_DMD_EXTENSIONS, "tks");
  set(GDAL_DMD_SUBDATASETS, "YES");
#if GDAL_VERSION_NUM >= 3070000
  set(GDAL_DMD_CREATIONDATATYPES, "Byte Int8 UInt16 Int16 UInt32 Int32 Float32");
#else
  set(GDAL_DMD_CREATIONDATATYPES, "Byte UInt16 Int16 UInt32 Int32 Float32");
#endif
  set(GDAL_DMD_OPENOPTIONLIST, kOpenOptions);
  set(GDAL_DMD_CREATIONOPTIONLIST, kCreationOptions);
  driver->pfnIdentify = Dataset::Identify;
  driver->pfnOpen = Dataset::Open;
  driver->pfnCreate = create;
  driver->pfnCreateCopy = createCopy;
  GetGDALDriverManager()->RegisterDriver(driver);
}
