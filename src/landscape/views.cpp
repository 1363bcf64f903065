#include "landscape/views.h"

#include <cmath>
#include <memory>

#include "core/error.h"
#include "core/format.h"
#include "io/document/aerosol_document.h"
#include "io/document/cameras/frame_camera.h"
#include "io/document/cameras/orthographic_camera.h"
#include "io/document/document.h"
#include "io/document/samplers/accuracy_sampling.h"
#include "io/document/samplers/plain_sampling.h"
#include "landscape/output/library_spectrum.h"
#include "math/angle.h"

namespace ifov::landscape {
namespace {

constexpr double kZero_k = 273.15;  // of 0 degC

template <class Camera>
io::CameraDocument camera_of(Camera camera) {
  return {std::string(Camera::kModel.key), std::make_shared<const Camera>(std::move(camera)), {}};
}

io::CameraDocument nadir(double gsd_m, int pixels) {
  io::OrthographicCamera camera;
  camera.gsd_m = to_millimetre(gsd_m);
  camera.size = {pixels, pixels};
  return camera_of(camera);
}

void add_channel(io::Document& document, std::string name, decltype(io::ChannelDocument::response) response) {
  io::ChannelDocument channel;
  channel.name = std::move(name);
  channel.response = std::move(response);
  document.sensor.channels.push_back(std::move(channel));
}

/// In four bands, with a grid of so many rays along each side of a pixel.
io::Document colour_picture(io::CameraDocument camera, int rays) {
  io::Document document;
  document.sensor.camera = std::move(camera);
  add_channel(document, "blue", io::GaussianChannel{0.48, 0.06});
  add_channel(document, "green", io::GaussianChannel{0.56, 0.06});
  add_channel(document, "red", io::GaussianChannel{0.65, 0.06});
  add_channel(document, "near infrared", io::GaussianChannel{0.85, 0.06});
  document.sampling.method = std::make_shared<const io::GridSampling>(rays, rays);
  for (const char* channel : {"red", "green", "blue"})
    document.output.quicklook_channels.push_back({channel, {}});
  return document;
}

/// From above at 1 m, sampled until each pixel is within an error.
io::Document accurate_picture(double size_m, io::ErrorSize error) {
  io::Document document;
  document.sensor.camera = nadir(1.0, static_cast<int>(std::lround(size_m)));
  io::AccuracySampling sampling;
  sampling.error = error;
  document.sampling.method = std::make_shared<const io::AccuracySampling>(sampling);
  return document;
}

/// A document that includes the scene's: what looks at it, and how.
struct View {
  std::string file;       ///< such as "render_vswir.json"
  std::string purpose;    ///< a comment at its top; lines without "//"
  io::Document document;  ///< its sensor, sampling and output
};

View quick_look(double size_m) {
  constexpr int kPixels = 400;
  return {"quicklook.json", "A quick look from above in four bands: seconds to a minute.",
          colour_picture(nadir(size_m / kPixels, kPixels), 2)};
}

View oblique(double size_m, const ViewChoice& choice) {
  const double azimuth = choice.eye_azimuth_deg * M_PI / 180.0, away = 0.75 * std::min(size_m, 250.0);
  io::FrameCamera camera;
  camera.focal_length_m = 35.0 * 1e-3;
  camera.pitch_m = 45.0 * 1e-6;
  camera.size = {640, 420};
  camera.position_m = to_millimetre(math::Point3{away * std::sin(azimuth), away * std::cos(azimuth),
                                                 choice.eye_height_share * std::min(size_m, 250.0)});
  camera.orientation = io::LookAt{{}, {}};
  return {"oblique.json", "A view at an angle, in four bands.", colour_picture(camera_of(camera), 3)};
}

View imaging_spectrometer(double size_m) {
  io::Document document = accurate_picture(size_m, {0.05, io::ErrorSize::Unit::fraction});
  constexpr int kChannels = 210;
  constexpr double kFirst_um = 0.4, kLast_um = 2.5;
  for (int k = 0; k < kChannels; ++k) {
    const double centre_um = kFirst_um + static_cast<double>(k) / (kChannels - 1) * (kLast_um - kFirst_um);
    add_channel(document, format("S {:.6g} nm", 1e3 * centre_um), io::GaussianChannel{centre_um, 0.01});
  }
  return {
      "render_vswir.json",
      "An imaging spectrometer: 210 Gaussian channels of 10 nm from 400 to 2500 nm, 1 m on the ground, no noise.\n"
      "Each pixel to 5 % of its value in all channels.",
      std::move(document)};
}

View thermal_imager(double size_m) {
  io::Document document = accurate_picture(size_m, {1.0, io::ErrorSize::Unit::kelvin});
  add_channel(document, "T1", io::TopHatChannel{8.2, 9.2});
  add_channel(document, "T2", io::TopHatChannel{10.3, 11.3});
  add_channel(document, "T3", io::TopHatChannel{11.5, 12.5});
  return {"render_thermal.json", "A thermal imager: three bands, 1 m on the ground, each pixel to 1 K.",
          std::move(document)};
}

std::string view_text(const View& view, std::string_view title) {
  return io::document_text(view.document, view.file,
                           {.comment = format("{}\n{}", title, view.purpose),
                            .include = {kSceneFile},
                            .sections = {"sensor", "sampling", "output"}});
}

}  // namespace

io::LightDocument clear_day(const ViewChoice& choice, SceneFolder& folder) {
  io::LightDocument light;
  light.sun.emplace();
  light.sun->direction = io::CelestialDirection{35.0 * math::kDegree, 140.0 * math::kDegree};
  light.sun->diameter_rad = 0.53 * math::kDegree;
  light.surroundings.emplace();
  light.surroundings->spectrum = library_spectrum(choice.surroundings, 1, folder);
  light.surroundings->temperature_k = choice.surroundings_c + kZero_k;
  return light;
}

io::AtmosphereDocument clear_air(const ViewChoice& choice) {
  io::AtmosphereDocument atmosphere;
  atmosphere.modelled.emplace();
  atmosphere.modelled->description.air.model = choice.air;
  atmosphere.modelled->interval =
      "numerical";  // made scenes are nowhere: there is no air to be compared with
  io::AerosolDocument haze;
  haze.tables.type = choice.haze;
  haze.tables.visibility_km = 23.0;
  atmosphere.modelled->aerosol = std::make_shared<const io::AerosolDocument>(haze);
  return atmosphere;
}

void check_size(double size_m) {
  if (!(size_m >= kSmallest_m && size_m <= kLargest_m))
    throw InputError(format("ifov: a scene can be {:g} m to {:g} m wide; --size asks for {:g} m", kSmallest_m,
                            kLargest_m, size_m));
}

MadeScene finish_scene(const MakeOptions& options, const ViewChoice& choice, const SceneMaker& scene,
                       SceneFolder& folder, std::vector<std::string> contents) {
  MadeScene made;
  made.contents = std::move(contents);
  made.contents.push_back(format("{} materials", scene.material_count()));
  folder.add_text(kSceneFile, scene.document(choice.title, clear_day(choice, folder), clear_air(choice)));
  for (const View& view : {quick_look(options.size_m), oblique(options.size_m, choice),
                           imaging_spectrometer(options.size_m), thermal_imager(options.size_m)}) {
    folder.add_text(view.file, view_text(view, choice.title));
    made.documents.push_back(folder.folder() / view.file);
  }
  folder.publish();
  made.files = folder.files().size();
  made.triangles = folder.triangles();
  made.bytes = folder.bytes();
  return made;
}

}  // namespace ifov::landscape
