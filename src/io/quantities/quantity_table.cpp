#include <array>

#include "io/quantities/converted_quantities.h"
#include "io/quantities/geometry_quantities.h"
#include "io/quantities/identity_quantities.h"
#include "io/quantities/location_quantities.h"
#include "io/quantities/mosaic_quantities.h"
#include "io/quantities/part_quantities.h"
#include "io/quantities/polarization_quantities.h"
#include "io/quantities/quality_quantities.h"
#include "io/quantities/quantity_set.h"
#include "io/quantities/radiance_quantities.h"
#include "io/quantities/share_quantities.h"
#include "io/quantities/sunlight_quantities.h"
#include "io/quantities/temperature_quantity.h"

namespace ifov::io {
namespace {

constexpr std::array kQuantities{&quantities::kRadiance,
                                 &quantities::kStandardError,
                                 &quantities::kHalfWidth,
                                 &quantities::kAtmosphereHalfWidth,
                                 &quantities::kAtmosphereModelError,
                                 &quantities::kThermalHalfWidth,
                                 &quantities::kRadiancePerNm,
                                 &quantities::kRadiancePerNmHalfWidth,
                                 &quantities::kBandRadiance,
                                 &quantities::kBandRadianceHalfWidth,
                                 &quantities::kPhotonRadiance,
                                 &quantities::kPhotonRadianceHalfWidth,
                                 &quantities::kToaReflectance,
                                 &quantities::kToaReflectanceHalfWidth,
                                 &quantities::kBrightnessTemperature,
                                 &quantities::kBrightnessTemperatureHalfWidth,
                                 &quantities::kMosaic,
                                 &quantities::kMosaicHalfWidth,
                                 &quantities::kMosaicChannels,
                                 &quantities::kSamples,
                                 &quantities::kQuality,
                                 &quantities::kReasons,
                                 &quantities::kQualityClass,
                                 &quantities::kAbundance,
                                 &quantities::kAbundanceHalfWidth,
                                 &quantities::kLocation,
                                 &quantities::kTrueLocation,
                                 &quantities::kViewAngles,
                                 &quantities::kTemperature,
                                 &quantities::kPixelTemperature,
                                 &quantities::kFluxes,
                                 &quantities::kRange,
                                 &quantities::kNormal,
                                 &quantities::kSlope,
                                 &quantities::kGsd,
                                 &quantities::kTime,
                                 &quantities::kSunAngles,
                                 &quantities::kShadow,
                                 &quantities::kSkyView,
                                 &quantities::kMaterialClass,
                                 &quantities::kDominantMaterial,
                                 &quantities::kMaterialCount,
                                 &quantities::kObjectClass,
                                 &quantities::kInstance,
                                 &quantities::kEmissivity,
                                 &quantities::kEmittedRadiance,
                                 &quantities::kEmittedRadianceError,
                                 &quantities::kSunRadiance,
                                 &quantities::kSunRadianceError,
                                 &quantities::kSkyRadiance,
                                 &quantities::kSkyRadianceError,
                                 &quantities::kSceneRadiance,
                                 &quantities::kSceneRadianceError,
                                 &quantities::kPathRadiance,
                                 &quantities::kPathRadianceError,
                                 &quantities::kTransmittance,
                                 &quantities::kTransmittanceError,
                                 &quantities::kStokes,
                                 &quantities::kStokesStandardError,
                                 &quantities::kStokesHalfWidth,
                                 &quantities::kDolp,
                                 &quantities::kDolpStandardError,
                                 &quantities::kDolpHalfWidth,
                                 &quantities::kDolpBias,
                                 &quantities::kAop,
                                 &quantities::kAopStandardError};

}  // namespace

std::span<const Quantity* const> all_quantities() { return kQuantities; }

}  // namespace ifov::io
