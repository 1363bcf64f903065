#include "io/product_parts/product_headers.h"

#include <cmath>

#include "core/format.h"
#include "io/product_parts/map_info.h"

namespace ifov::io {
namespace {

void add_acquisition(EnviHeader& header, const Acquisition& acquisition) {
  if (!acquisition.time.empty()) header.other["acquisition time"] = acquisition.time;
  if (!acquisition.light || acquisition.light->is_moon) return;
  header.other["sun elevation"] = format("{:.6g}", 90.0 - acquisition.light->zenith_deg);
  header.other["sun azimuth"] = format("{:.6g}", acquisition.light->azimuth_deg);
}

/// The corners of an image that no map info fits, as ENVI's "geo points": x, y, latitude, longitude.
void add_corners(EnviHeader& header, const Acquisition& acquisition) {
  const double right = header.samples + 1, low = header.lines + 1,
               corners[][2] = {{1, 1}, {right, 1}, {right, low}, {1, low}};
  std::string points;
  for (std::size_t k = 0; k < acquisition.footprint.size() && k < 4; ++k) {
    const auto& corner = acquisition.footprint[k];
    if (!corner || !corner->position) return;
    points += format("{}{:g}, {:g}, {:.9f}, {:.9f}", k > 0 ? ", " : "", corners[k][0], corners[k][1],
                     corner->position->latitude_deg, corner->position->longitude_deg);
  }
  if (!points.empty()) header.other["geo points"] = points;
}

}  // namespace

EnviHeader image_header(std::string_view what, const render::ImageInfo& info, const RunIdentity& identity,
                        const std::string& statement) {
  EnviHeader header;
  header.samples = info.width_px;
  header.lines = info.height_px;
  header.description = format("{}, made by ifov {} from {}\nseed {}, sampler {}", what, identity.version,
                              identity.document_path, identity.seed, identity.sampler);
  if (!identity.accuracy_asked.empty()) header.description += "\naccuracy asked: " + identity.accuracy_asked;
  if (!statement.empty()) header.description += "\naccuracy reached: " + statement;
  if (info.has_map) {
    header.map_info = envi_map_info(info);
    header.coordinate_system = esri_coordinate_system_text(info);
  }
  if (!info.has_map) add_corners(header, identity.acquisition);
  add_acquisition(header, identity.acquisition);
  return header;
}

void add_channels(EnviHeader& header, const render::ImageInfo& info) {
  header.bands = static_cast<int>(info.channels.size());
  header.wavelength_units = "Micrometers";
  for (const auto& channel : info.channels) {
    header.band_names.push_back(channel.name);
    header.wavelength.push_back(channel.centre_um);
    header.fwhm.push_back(channel.fwhm_um);
  }
  for (const int channel : picture_channels(info)) header.default_bands.push_back(channel + 1);
}

void add_stokes(EnviHeader& header, const render::ImageInfo& info) {
  header.bands = static_cast<int>(4 * info.channels.size());
  header.wavelength_units = "Micrometers";
  for (const char* component : {"I", "Q", "U", "V"})
    for (const auto& channel : info.channels) {
      header.band_names.push_back(format("{} {}", component, channel.name));
      header.wavelength.push_back(channel.centre_um);
      header.fwhm.push_back(channel.fwhm_um);
    }
}

std::string stokes_convention() {
  return "Q = |E_x|^2 - |E_y|^2 U = 2 Re(E_x E_y*) V = -2 Im(E_x E_y*) with fields as exp(i(kr - wt)); x is the direction of rising "
         "columns in the focal plane and y that of falling lines, so that angles of polarization count from the image's right "
         "counterclockwise as the image is looked at; away from the optical axis the axes are carried along great circles";
}

void add_stokes_convention(EnviHeader& header, const Acquisition::Camera& camera) {
  header.other["stokes convention"] = stokes_convention();
  const auto text = [](math::Vec3 v) { return format("{:.9g}, {:.9g}, {:.9g}", v.x, v.y, v.z); };
  header.other["camera right (east, north, up)"] = text(camera.right);
  header.other["camera down (east, north, up)"] = text(camera.down);
  header.other["camera forward (east, north, up)"] = text(camera.forward);
}

std::string shown_unit(const std::string& unit) {
  return unit == "W m-2 sr-1 um-1" ? "W/(m\u00b2 sr \u00b5m)" : unit;
}

std::vector<int> picture_channels(const render::ImageInfo& info) {
  std::vector<int> chosen;
  for (const double wanted_um : {0.66, 0.56, 0.48}) {
    int best = -1;
    double distance_um = 0.06;
    for (std::size_t c = 0; c < info.channels.size(); ++c) {
      const double d = std::abs(info.channels[c].centre_um - wanted_um);
      if (d < distance_um) best = static_cast<int>(c), distance_um = d;
    }
    if (best >= 0 && (chosen.empty() || chosen.back() != best)) chosen.push_back(best);
  }
  if (chosen.size() == 3) return chosen;
  return {static_cast<int>(info.channels.size()) / 2};
}

}  // namespace ifov::io
