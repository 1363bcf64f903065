#pragma once

#include "io/document/document.h"
#include "io/document/schema/kind.h"

namespace ifov::io {

/// The tables of keys, one function for each section of a document and for each part that sections share.

Kind<SpectrumDocument> spectrum_kind(SpectrumOf quantity);
Kind<double> um_per_unit_kind();  ///< "um" or "nm", as micrometres per unit

Kind<std::vector<std::pair<std::string, MaterialDocument>>> materials_kind();
Kind<TemperatureDocument> temperature_kind();
Kind<ScatteringDocument> scattering_kind();
Kind<std::vector<ObjectDocument>> objects_kind();
Kind<SceneDocument> scene_kind();

Kind<LightDocument> light_kind();
Kind<AtmosphereDocument> atmosphere_kind();
Kind<ImportedDocument> imported_kind();
Kind<WeatherDocument> weather_kind();
Kind<CameraDocument> camera_kind();
Kind<std::vector<ChannelDocument>> channels_kind();
Kind<SensorDocument> sensor_kind();
Kind<SamplingDocument> sampling_kind();
Kind<OutputDocument> output_kind();
Kind<Document> document_kind();

}  // namespace ifov::io
