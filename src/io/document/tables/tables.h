#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/document/schema/schema_type.h"

namespace ifov::atmosphere {
struct GasRequests;
}
namespace ifov::geodesy {
struct UtcTime;
}

namespace ifov::io {

struct AerosolDocument;
struct AtmosphereDocument;
struct CameraDocument;
struct ChannelDocument;
struct CloudDocument;
struct DetectorDocument;
struct Document;
struct ImportedDocument;
struct LampDocument;
struct LightDocument;
struct MaterialDocument;
struct ObjectDocument;
struct OpticsDocument;
struct OutputDocument;
struct PlatformDocument;
struct SamplingDocument;
struct ScatteringDocument;
struct SceneDocument;
struct SensorDocument;
struct SnrDocument;
struct SpectrumDocument;
struct TemperatureDocument;
struct TemperaturesDocument;
struct ThermalDocument;
struct WeatherDocument;
enum class SpectrumOf;

/// The tables of keys, one function for each section of a document and for each part that sections share.

SchemaType<SpectrumDocument> spectrum_type(SpectrumOf quantity);
SchemaType<double> um_per_unit_type();     ///< "um" or "nm", as micrometres per unit
SchemaType<geodesy::UtcTime> time_type();  ///< ISO 8601 with a zone, or a day
SchemaType<std::string> word_type(const std::vector<std::string>& words);  ///< one of these

SchemaType<std::vector<std::pair<std::string, MaterialDocument>>> materials_type();
SchemaType<TemperatureDocument> temperature_type();
SchemaType<ThermalDocument> thermal_type();
SchemaType<TemperaturesDocument> temperatures_type();
SchemaType<ScatteringDocument> scattering_type();
/// Whether its model takes the material's reflectance as a factor alone, which may be left out.
bool reflects_by_itself(const ScatteringDocument& scattering);
SchemaType<std::vector<ObjectDocument>> objects_type();
SchemaType<SceneDocument> scene_type();

SchemaType<LightDocument> light_type();
SchemaType<std::vector<LampDocument>> lamps_type();
SchemaType<AtmosphereDocument> atmosphere_type();
SchemaType<AerosolDocument> aerosol_type();
SchemaType<std::vector<CloudDocument>> clouds_type();
SchemaType<atmosphere::GasRequests> gases_type();
SchemaType<ImportedDocument> imported_type();
SchemaType<WeatherDocument> weather_type();
SchemaType<PlatformDocument> platform_type();
SchemaType<std::shared_ptr<const PlatformDocument>> motion_type();  ///< of something in the scene
SchemaType<CameraDocument> camera_type();
SchemaType<std::vector<ChannelDocument>> channels_type();
SchemaType<SensorDocument> preset_type();  ///< an instrument by its name: all but its camera
SchemaType<OpticsDocument> optics_type();
SchemaType<DetectorDocument> detector_type();
SchemaType<SnrDocument> snr_type();
SchemaType<SensorDocument> sensor_type();
SchemaType<SamplingDocument> sampling_type();
SchemaType<OutputDocument> output_type();
SchemaType<Document> document_type();

}  // namespace ifov::io
