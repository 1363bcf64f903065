#pragma once

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <gdal_alg.h>
#include <gdal_frmts.h>
#include <gdal_vrt.h>
#include <ogr_srs_api.h>

#include "core/late_library.h"

/// The functions of GDAL that ifov calls. GDAL is loaded at the first call of one, and nothing is linked with it.
namespace ifov::io::late {

inline constinit LateLibrary gdal{IFOV_LATE_GDAL};

// What the compiler is told of a function beside its type (printf's formats) is not a part of the type.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wignored-attributes"
#define IFOV_GDAL(name) inline constinit LateFunction<decltype(&::name)> name{gdal, #name};
IFOV_GDAL(CPLError)
IFOV_GDAL(CPLErrorReset)
IFOV_GDAL(CPLGetErrorHandlerUserData)
IFOV_GDAL(CPLGetLastErrorMsg)
IFOV_GDAL(CPLPopErrorHandler)
IFOV_GDAL(CPLPushErrorHandler)
IFOV_GDAL(CPLPushErrorHandlerEx)
IFOV_GDAL(CPLQuietErrorHandler)
IFOV_GDAL(CPLSetThreadLocalConfigOption)
IFOV_GDAL(CSLDestroy)
IFOV_GDAL(CSLSetNameValue)
IFOV_GDAL(GDALAddBand)
IFOV_GDAL(GDALClose)
IFOV_GDAL(GDALCreate)
IFOV_GDAL(GDALCreateCopy)
IFOV_GDAL(GDALCreateDriver)
IFOV_GDAL(GDALDataTypeIsComplex)
IFOV_GDAL(GDALDatasetGetRootGroup)
IFOV_GDAL(GDALDimensionGetSize)
IFOV_GDAL(GDALExtendedDataTypeCreate)
IFOV_GDAL(GDALExtendedDataTypeRelease)
IFOV_GDAL(GDALFillNodata)
IFOV_GDAL(GDALGetBlockSize)
IFOV_GDAL(GDALGetColorEntry)
IFOV_GDAL(GDALGetColorEntryCount)
IFOV_GDAL(GDALGetDataTypeName)
IFOV_GDAL(GDALGetDataTypeSizeBytes)
IFOV_GDAL(GDALGetDatasetDriver)
IFOV_GDAL(GDALGetDriverByName)
IFOV_GDAL(GDALGetDriverShortName)
IFOV_GDAL(GDALGetGeoTransform)
IFOV_GDAL(GDALGetMetadataItem)
IFOV_GDAL(GDALGetProjectionRef)
IFOV_GDAL(GDALGetRasterBand)
IFOV_GDAL(GDALGetRasterColorTable)
IFOV_GDAL(GDALGetRasterCount)
IFOV_GDAL(GDALGetRasterDataType)
IFOV_GDAL(GDALGetRasterNoDataValue)
IFOV_GDAL(GDALGetRasterOffset)
IFOV_GDAL(GDALGetRasterScale)
IFOV_GDAL(GDALGetRasterUnitType)
IFOV_GDAL(GDALGetRasterXSize)
IFOV_GDAL(GDALGetRasterYSize)
IFOV_GDAL(GDALGroupOpenMDArray)
IFOV_GDAL(GDALGroupRelease)
IFOV_GDAL(GDALMDArrayGetDimensions)
IFOV_GDAL(GDALMDArrayRead)
IFOV_GDAL(GDALMDArrayRelease)
IFOV_GDAL(GDALOpenEx)
IFOV_GDAL(GDALRasterIO)
IFOV_GDAL(GDALRegisterDriver)
IFOV_GDAL(GDALReleaseDimensions)
IFOV_GDAL(GDALSetCacheMax64)
IFOV_GDAL(GDALSetDescription)
IFOV_GDAL(GDALSetGeoTransform)
IFOV_GDAL(GDALSetMetadataItem)
IFOV_GDAL(GDALSetProjection)
IFOV_GDAL(GDALSetRasterColorInterpretation)
IFOV_GDAL(GDALSetRasterNoDataValue)
IFOV_GDAL(GDALSetRasterUnitType)
IFOV_GDAL(OCTDestroyCoordinateTransformation)
IFOV_GDAL(OCTNewCoordinateTransformation)
IFOV_GDAL(OCTTransformEx)
IFOV_GDAL(OSRDestroySpatialReference)
IFOV_GDAL(OSRExportToWkt)
IFOV_GDAL(OSRExportToWktEx)
IFOV_GDAL(OSRGetAttrValue)
IFOV_GDAL(OSRGetAuthorityCode)
IFOV_GDAL(OSRGetInvFlattening)
IFOV_GDAL(OSRGetLinearUnits)
IFOV_GDAL(OSRGetName)
IFOV_GDAL(OSRGetNormProjParm)
IFOV_GDAL(OSRGetSemiMajor)
IFOV_GDAL(OSRGetUTMZone)
IFOV_GDAL(OSRImportFromEPSG)
IFOV_GDAL(OSRImportFromWkt)
IFOV_GDAL(OSRIsGeographic)
IFOV_GDAL(OSRIsProjected)
IFOV_GDAL(OSRIsSame)
IFOV_GDAL(OSRNewSpatialReference)
IFOV_GDAL(OSRSetAxisMappingStrategy)
IFOV_GDAL(OSRSetFromUserInput)
IFOV_GDAL(OSRSetPROJEnableNetwork)
IFOV_GDAL(OSRSetProjCS)
IFOV_GDAL(OSRSetTM)
IFOV_GDAL(OSRSetWellKnownGeogCS)
IFOV_GDAL(VRTCreate)
IFOV_GDAL(VSIAllocFilesystemPluginCallbacksStruct)
IFOV_GDAL(VSIFCloseL)
IFOV_GDAL(VSIFileFromMemBuffer)
IFOV_GDAL(VSIFree)
IFOV_GDAL(VSIFreeFilesystemPluginCallbacksStruct)
IFOV_GDAL(VSIInstallPluginHandler)
IFOV_GDAL(VSIUnlink)
#undef IFOV_GDAL
#pragma GCC diagnostic pop

}  // namespace ifov::io::late
