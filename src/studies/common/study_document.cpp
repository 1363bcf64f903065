#include "studies/common/study_document.h"

#include "io/document/cameras/orthographic_camera.h"
#include "io/document/document.h"
#include "io/document/samplers/accuracy_sampling.h"
#include "io/document/samplers/plain_sampling.h"

namespace ifov::studies {

std::string study_text(const io::Document& document) { return io::document_text(document, "study.json"); }

io::Document nadir_document(io::CameraDocument camera, const std::string& channel, double wavelength_um,
                            io::SamplingDocument sampling, std::uint64_t seed) {
  io::Document document;
  document.seed = seed;
  document.sensor.camera = std::move(camera);
  document.sensor.channels.push_back({channel, io::MonochromaticChannel{wavelength_um}, {}, {}, {}});
  document.sampling = std::move(sampling);
  return document;
}

io::CameraDocument nadir_camera(int width_px, int height_px, double west_m, double north_m) {
  io::OrthographicCamera camera;
  camera.gsd_m = 1.0;
  camera.size = {width_px, height_px};
  camera.centre_m = {west_m + 0.5 * width_px, north_m - 0.5 * height_px};
  return {std::string(io::OrthographicCamera::kModel.key),
          std::make_shared<const io::OrthographicCamera>(camera),
          {}};
}

io::SamplingDocument single_sampling() { return sampling_of(io::SingleSampling()); }

io::SamplingDocument grid_sampling(int n) { return sampling_of(io::GridSampling(n, n)); }

io::SamplingDocument adaptive_sampling(int sub_elements, int max_samples, io::ErrorSize allowed_difference) {
  io::AdaptiveSampling adaptive;
  adaptive.sub_columns = adaptive.sub_rows = sub_elements;
  adaptive.max_samples = max_samples;
  adaptive.allowed_difference = allowed_difference;
  return sampling_of(std::move(adaptive));
}

io::SamplingDocument accuracy_sampling(io::ErrorSize error,
                                       const std::function<void(io::AccuracySampling&)>& more) {
  io::AccuracySampling accuracy;
  accuracy.error = error;
  if (more) more(accuracy);
  return sampling_of(std::move(accuracy));
}

io::MaterialDocument grey(const std::string& name, double reflectance) {
  io::MaterialDocument material;
  material.name = name;
  material.spectrum.source = io::ConstantSpectrum{reflectance};
  return material;
}

io::MaterialDocument black(const std::string& name, io::TemperatureDocument temperature) {
  io::MaterialDocument material = grey(name, 1.0);
  material.is_emissivity = true;
  material.temperature = std::move(temperature);
  return material;
}

}  // namespace ifov::studies
