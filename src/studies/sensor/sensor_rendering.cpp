#include "studies/sensor/sensor_rendering.h"

#include <cmath>
#include <memory>
#include <numbers>

#include "core/format.h"
#include "ifov/detect.h"
#include "io/document/cameras/frame_camera.h"
#include "io/document/cameras/pushbroom_camera.h"
#include "io/document/document.h"
#include "io/document/platform_document.h"
#include "io/document/shapes/flat_primitives.h"
#include "io/products/envi_reader.h"
#include "io/quantities/quantity.h"
#include "session/session.h"
#include "studies/common/image_store.h"
#include "studies/common/study_document.h"
#include "studies/common/study_files.h"
#include "studies/common/study_rendering.h"

namespace ifov::studies {

SensorImage render_sensor(const io::Document& document, const StudyOptions& options) {
  ImageStore image;
  RenderChoices choices;
  choices.threads = options.threads;
  choices.cancel = options.cancel;
  render_document(study_text(document), options.output_folder, choices, image);
  SensorImage result{image.width(), image.height(), {}, {}, 0};
  result.radiance.assign(image.mean().begin(), image.mean().end());
  result.half_width.assign(image.half_width().begin(), image.half_width().end());
  for (const std::uint32_t samples : image.samples()) result.samples += samples;
  return result;
}

std::filesystem::path run_sensor(const io::Document& document, const std::string& name,
                                 const StudyOptions& options) {
  const std::filesystem::path folder = options.output_folder / name;
  std::filesystem::remove_all(folder);
  const std::string text = study_text(document);
  write_file(options.output_folder / (name + ".json"), text);
  const io::Document read = io::parse_document(text, (options.output_folder / (name + ".json")).string());
  session::RunOptions run;
  run.threads = options.threads;
  run.output_folder = folder;
  run.cancel = options.cancel;
  session::Session::load(read, nullptr).render(run);
  return folder;
}

CubeValues read_product(const std::filesystem::path& folder, const std::string& quantity) {
  const io::EnviReader reader(folder / format("image_{}.img", quantity));
  CubeValues cube{reader.header().samples, reader.header().lines, reader.header().bands, {}};
  const auto width = static_cast<std::size_t>(cube.width), bands = static_cast<std::size_t>(cube.bands);
  cube.values.resize(width * bands * static_cast<std::size_t>(cube.height));
  std::vector<float> line(width);
  for (int y = 0; y < cube.height; ++y)
    for (std::size_t b = 0; b < bands; ++b) {
      reader.read(y, static_cast<int>(b), line);
      for (std::size_t x = 0; x < width; ++x)
        cube.values[(static_cast<std::size_t>(y) * width + x) * bands + b] = line[x];
    }
  return cube;
}

std::vector<std::filesystem::path> draw_noise(const std::filesystem::path& run,
                                              const std::filesystem::path& folder, int seeds, int threads,
                                              const StudyOptions& options) {
  DetectOptions detect;
  detect.folder = folder;
  detect.first_seed = options.seed;
  detect.realizations = seeds;
  detect.threads = threads;
  detect.cancel = options.cancel;
  std::filesystem::create_directories(folder);
  return ifov::detect(run, detect).cubes;
}

void ask_for(io::Document& document, std::initializer_list<const char*> products) {
  document.output.formats = {"envi"};
  io::QuantitySet& chosen = document.output.products.emplace();
  for (const char* word : products) chosen.add(*io::find_quantity(word));
}

io::ObjectDocument level_ground(const std::string& material) {
  return object_of(io::PlanePrimitive(), material);
}

io::CameraDocument frame_above(int width_px, int height_px, double height_m, double focal_length_m,
                               double pitch_m, double exposure_s, double row_period_s) {
  io::FrameCamera camera;
  camera.focal_length_m = focal_length_m;
  camera.pitch_m = pitch_m;
  camera.size = {width_px, height_px};
  camera.exposure_s = exposure_s;
  camera.row_period_s = row_period_s;
  camera.position_m = {0.0, 0.0, height_m};
  camera.orientation = geodesy::Attitude{};
  return {std::string(io::FrameCamera::kModel.key), std::make_shared<const io::FrameCamera>(camera), {}};
}

void carry(io::ObjectDocument& object, math::Point3 at_m, math::Vec3 velocity_m_s) {
  io::PlatformDocument motion;
  motion.path = io::StraightPath{{io::PathFrame::scene, {at_m.x, at_m.y, at_m.z}},
                                 {velocity_m_s.x, velocity_m_s.y, velocity_m_s.z}};
  motion.attitude.emplace().from = io::YawFrom::north;
  object.motion = std::make_shared<const io::PlatformDocument>(motion);
}

io::CameraDocument frame_looking(int pixels, math::Point3 from_m, double focal_length_m, double pitch_m) {
  io::FrameCamera camera;
  camera.focal_length_m = focal_length_m;
  camera.pitch_m = pitch_m;
  camera.size = {pixels, pixels};
  camera.position_m = from_m;
  camera.orientation = io::LookAt{{0.0, 0.0, 0.0}, math::Vec3{0.0, 1.0, 0.0}};
  return {std::string(io::FrameCamera::kModel.key), std::make_shared<const io::FrameCamera>(camera), {}};
}

double ScannerFlight::roll_at(double time_s) const {
  return roll_rad * std::sin(2.0 * std::numbers::pi * time_s / kRollPeriod_s);
}

std::array<double, 2> ScannerFlight::ground_m(double x_px, double y_px) const {
  const double time_s = y_px * kPeriod_s;
  return {height_m * std::tan(roll_at(time_s) + std::atan((x_px - 0.5 * width_px) * step)),
          speed_m_s * time_s};
}

std::array<double, 2> ScannerFlight::image_px(math::Point3 point_m) const {
  const double time_s = point_m.y / speed_m_s;
  const double angle = std::atan2(-point_m.x, height_m - point_m.z) - roll_at(time_s);
  return {0.5 * width_px + std::tan(angle) / step, time_s / kPeriod_s};
}

void fly(const ScannerFlight& flight, io::Document& document, const StudyOptions& options) {
  io::PlatformDocument platform;
  if (flight.roll_rad == 0.0) {
    platform.path =
        io::StraightPath{{io::PathFrame::scene, {0.0, 0.0, flight.height_m}}, {0.0, flight.speed_m_s, 0.0}};
  } else {
    std::string rows = "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n";
    const double step_s = ScannerFlight::kRollPeriod_s / 20.0;
    const int last = static_cast<int>(flight.lines * ScannerFlight::kPeriod_s / step_s) + 150;
    for (int k = -150; k <= last; ++k) {
      const double time_s = k * step_s;
      rows += format("{:.9f},0,{:.9f},{},0,0,{:.12f}\n", time_s, flight.speed_m_s * time_s, flight.height_m,
                     flight.roll_at(time_s) * 180.0 / std::numbers::pi);
    }
    const std::string name = format("rolling_{:g}_{:g}.csv", flight.height_m, flight.speed_m_s);
    write_file(options.output_folder / name, rows);
    platform.path = io::TablePath{io::PathFrame::scene, {}, {}, {name, {}}};
  }
  document.platform = std::make_shared<const io::PlatformDocument>(platform);
  io::PushbroomCamera camera;
  camera.size = {flight.width_px, flight.lines};
  camera.focal_length_m = 1.0;
  camera.pitch_m = flight.step;
  camera.line_period_s = ScannerFlight::kPeriod_s;
  if (flight.element_length_px > 0.0) camera.element_length_m = flight.element_length_px * flight.step;
  camera.stages = flight.stages;
  document.sensor.camera = {
      std::string(io::PushbroomCamera::kModel.key), std::make_shared<const io::PushbroomCamera>(camera), {}};
}

}  // namespace ifov::studies
