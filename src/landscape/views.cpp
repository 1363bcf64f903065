#include "landscape/views.h"

#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "landscape/output/library_spectrum.h"

namespace ifov::landscape {
namespace {

constexpr std::string_view kColourChannels =
    R"([
      {"name": "blue", "gaussian": {"center": "0.48 um", "fwhm": "0.06 um"}},
      {"name": "green", "gaussian": {"center": "0.56 um", "fwhm": "0.06 um"}},
      {"name": "red", "gaussian": {"center": "0.65 um", "fwhm": "0.06 um"}},
      {"name": "near infrared", "gaussian": {"center": "0.85 um", "fwhm": "0.06 um"}}
    ])";
constexpr std::string_view kColourPicture = R"({"quicklook": {"channels": ["red", "green", "blue"]}})";

std::string nadir(double gsd_m, int pixels) {
  return format(R"({{"orthographic": {{"gsd": {}, "pixels": [{}, {}]}}}})", metres(gsd_m), pixels, pixels);
}

std::string sensor(const std::string& camera, std::string_view channels) {
  return format("{{\n    \"camera\": {},\n    \"channels\": {}\n  }}", camera, channels);
}

View quick_look(double size_m) {
  constexpr int kPixels = 400;
  return {"quicklook.json", "A quick look from above in four bands: seconds to a minute.",
          sensor(nadir(size_m / kPixels, kPixels), kColourChannels), R"({"grid": {"elements": [2, 2]}})",
          std::string(kColourPicture)};
}

View oblique(double size_m, const ViewChoice& choice) {
  const double azimuth = choice.eye_azimuth_deg * M_PI / 180.0, away = 0.75 * std::min(size_m, 250.0);
  const std::string camera =
      format(R"({{"frame": {{"focal_length": "35 mm", "pitch": "45 um", "pixels": [640, 420],
      "position": {}, "look_at": {}}}}})",
             point_text(away * std::sin(azimuth), away * std::cos(azimuth),
                        choice.eye_height_share * std::min(size_m, 250.0)),
             point_text(0.0, 0.0, 0.0));
  return {"oblique.json", "A view at an angle, in four bands.", sensor(camera, kColourChannels),
          R"({"grid": {"elements": [3, 3]}})", std::string(kColourPicture)};
}

View imaging_spectrometer(double size_m) {
  const int pixels = static_cast<int>(std::lround(size_m));
  return {
      "render_vswir.json",
      "An imaging spectrometer: 210 Gaussian channels of 10 nm from 400 to 2500 nm, 1 m on the ground, no noise.\n"
      "Each pixel to 5 % of its value in all channels.",
      sensor(
          nadir(1.0, pixels),
          R"([{"name": "S", "series": {"gaussian": {"from": "400 nm", "to": "2500 nm", "count": 210, "fwhm": "10 nm"}}}])"),
      R"({"accuracy": {"error": "5 %"}})", ""};
}

View thermal_imager(double size_m) {
  const int pixels = static_cast<int>(std::lround(size_m));
  return {"render_thermal.json", "A thermal imager: three bands, 1 m on the ground, each pixel to 1 K.",
          sensor(nadir(1.0, pixels), R"([
      {"name": "T1", "top_hat": {"from": "8.2 um", "to": "9.2 um"}},
      {"name": "T2", "top_hat": {"from": "10.3 um", "to": "11.3 um"}},
      {"name": "T3", "top_hat": {"from": "11.5 um", "to": "12.5 um"}}
    ])"),
          R"({"accuracy": {"error": "1 K"}})", ""};
}

}  // namespace

SceneLight clear_day(const ViewChoice& choice, SceneFolder& folder) {
  const std::string light = R"({
    "sun": {"disc": {"zenith": "35 deg", "azimuth": "140 deg"}},
    "surroundings": {"reflectance": )" +
                            library_spectrum(choice.surroundings, 1, folder) +
                            format(R"(, "temperature": "{} degC"}}
  }})",
                                   choice.surroundings_c);
  return {light, format(R"({{"profile": "{}", "aerosol": {{"type": "{}", "visibility": "23 km"}}}})",
                        choice.air, choice.haze)};
}

void check_size(double size_m) {
  if (!(size_m >= kSmallest_m && size_m <= kLargest_m))
    throw InputError(format("ifov: a scene can be {:g} m to {:g} m wide; --size asks for {:g} m", kSmallest_m,
                            kLargest_m, size_m));
}

MadeScene finish_scene(const MakeOptions& options, const ViewChoice& choice, const SceneText& text,
                       SceneFolder& folder, std::vector<std::string> contents) {
  MadeScene made;
  made.contents = std::move(contents);
  made.contents.push_back(format("{} materials", text.material_count()));
  folder.add_text(kSceneFile, text.document(choice.title, clear_day(choice, folder)));
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
