#include "studies/common/study_document.h"

#include <chrono>
#include <system_error>

#include "core/error.h"
#include "core/format.h"
#include "io/document/cameras/orthographic_camera.h"
#include "io/document/samplers/plain_sampling.h"
#include "io/files/own_files.h"
#include "render/image_renderer.h"
#include "session/loaded/parts.h"
#include "session/session.h"

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

namespace {

template <class Settings>
io::SamplingDocument sampling_of(Settings settings) {
  io::SamplingDocument sampling;
  sampling.method = std::make_shared<const Settings>(std::move(settings));
  return sampling;
}

}  // namespace

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

RenderTimes render_document(const std::string& text, const std::filesystem::path& folder,
                            const RenderChoices& choices, ImageStore& image) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  const Clock::time_point start = Clock::now();
  const io::Document document = io::parse_document(text, (folder / "study.json").string());
  const session::Session session = session::Session::load(document, nullptr);
  const Clock::time_point loaded = Clock::now();
  const session::Session::Parts& parts = session.parts();
  const render::RenderJob own = parts.job();
  render::RenderJob job{own.scene,
                        own.camera,
                        own.footprint,
                        choices.sampler != nullptr ? *choices.sampler : own.sampler,
                        own.tolerance,
                        own.transport,
                        own.label_detail,
                        own.seed,
                        own.tile_px,
                        own.pilot_rays,
                        own.steering_channels,
                        own.air};
  job.nodes = own.nodes;
  job.wings = own.wings;
  job.cut = own.cut;
  image.begin(parts.info);
  render::RenderControl control;
  control.threads = choices.threads;
  control.cancel = choices.cancel;
  control.tile_order = choices.tile_order;
  render::render_image(job, control, image);
  return {seconds(loaded - start), seconds(Clock::now() - loaded)};
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw SystemError(format("cannot make the folder '{}': {}", folder.string(), error.message()));
}

void write_file(const std::filesystem::path& path, std::string_view content) {
  io::write_new_file(path, content);
}

}  // namespace ifov::studies
