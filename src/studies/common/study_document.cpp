#include "studies/common/study_document.h"

#include <chrono>
#include <system_error>

#include "core/error.h"
#include "core/format.h"
#include "io/document/document.h"
#include "io/files/own_files.h"
#include "render/image_renderer.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::studies {

std::string StudyDocument::text() const {
  std::string out = title.empty() ? "" : format("// {}\n", title);
  out += format("{{\n  \"ifov\": 1,\n  \"seed\": {},\n", seed);
  out += format("  \"scene\": {{\n    \"materials\": {},\n    \"objects\": {}\n  }},\n", materials, objects);
  if (!light.empty()) out += format("  \"light\": {},\n", light);
  out += format("  \"sensor\": {{\n    \"camera\": {},\n    \"channels\": {}", camera, channels);
  if (!psf.empty()) out += format(",\n    \"psf\": {}", psf);
  return out + format("\n  }},\n  \"sampling\": {}\n}}\n", sampling);
}

std::string metres(double value_m) { return format("\"{} m\"", value_m); }

std::string point_text(double x_m, double y_m, double z_m) {
  return format("[{}, {}, {}]", metres(x_m), metres(y_m), metres(z_m));
}

std::string nadir_camera(int width_px, int height_px, double west_m, double north_m) {
  return format("{{\"orthographic\": {{\"gsd\": \"1 m\", \"pixels\": [{}, {}], \"center\": [{}, {}]}}}}",
                width_px, height_px, metres(west_m + 0.5 * width_px), metres(north_m - 0.5 * height_px));
}

std::string single_sampling() { return "{\"single\": {}}"; }

std::string grid_sampling(int n) { return format("{{\"grid\": {{\"elements\": [{}, {}]}}}}", n, n); }

std::string adaptive_sampling(int sub_elements, int max_samples, std::string_view allowed_difference) {
  return format(
      "{{\"adaptive\": {{\"sub_elements\": [{}, {}], \"max_samples\": {}, \"allowed_difference\": \"{}\"}}}}",
      sub_elements, sub_elements, max_samples, allowed_difference);
}

std::string accuracy_sampling(std::string_view error, std::string_view more) {
  return format("{{\"accuracy\": {{\"error\": \"{}\", \"confidence\": 0.95{}}}}}", error, more);
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
  render::RenderJob job{own.scene,        own.camera,
                        own.footprint,    choices.sampler != nullptr ? *choices.sampler : own.sampler,
                        own.tolerance,    own.transport,
                        own.label_detail, own.seed,
                        own.tile_px,      own.seed_objects,
                        own.drivers,      own.air};
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
  if (error)
    throw EnvironmentError(format("cannot make the folder '{}': {}", folder.string(), error.message()));
}

void write_file(const std::filesystem::path& path, std::string_view content) {
  io::write_new_file(path, content);
}

}  // namespace ifov::studies
