#include "honesty/wild_draft.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "core/format.h"

namespace ifov::benchmarks {

WildDraft::WildDraft(RandomStream& numbers, Light which, std::string scene, std::filesystem::path into)
    : random(numbers), regime(which), name(std::move(scene)), folder(std::move(into)) {
  gsd_m =
      random.with(0.5) ? random.one_of({0.25, 0.5, 1.0, 2.0, 3.0, 10.0, 30.0}) : random.magnitude(0.1, 30.0);
  size_px = static_cast<int>(12 + 2 * random.index(4));
  if (random.with(0.5)) centre_m = {gsd_m * random.between(-40.0, 40.0), gsd_m * random.between(-40.0, 40.0)};
  const double turned = random.uniform();
  angle_deg = turned < 0.4   ? 0.0
              : turned < 0.7 ? random.magnitude(0.001, 2.0)
              : turned < 0.9 ? random.between(0.0, 2.0)
                             : random.between(0.0, 90.0);
  std::string aslant;
  if (random.with(0.3)) {
    view_zenith_deg = random.between(2.0, 65.0), view_azimuth_deg = random.between(0.0, 360.0);
    aslant = format(R"(, "view_zenith": "{:.3f} deg", "view_azimuth": "{:.3f} deg")", view_zenith_deg,
                    view_azimuth_deg);
  }
  camera = format(
      R"("camera": {{"orthographic": {{"gsd": "{} m", "pixels": [{}, {}], "center": ["{} m", "{} m"], "rotation": "{} deg"{}}}}})",
      gsd_m, size_px, size_px, centre_m[0], centre_m[1], angle_deg, aslant);
  if (random.with(0.35))
    psf = format(R"("psf": {{"gaussian": {{"sigma": "{:.3f} px"}}}})", random.between(0.25, 0.9));
  const bool air = random.with(0.25);
  const double transmittance = random.between(0.4, 0.95);
  if (regime == Light::solar) {
    const double zenith = random.between(15.0, 65.0), azimuth = random.between(0.0, 360.0);
    const double sine = std::sin(zenith * std::numbers::pi / 180.0),
                 bearing = azimuth * std::numbers::pi / 180.0;
    towards_sun = {sine * std::sin(bearing), sine * std::cos(bearing),
                   std::cos(zenith * std::numbers::pi / 180.0)};
    light = format(
        R"("light": {{"sun": {{"{}": {{"zenith": "{} deg", "azimuth": "{} deg"}}}}, "sky": {{"radiance": "{:.1f} W m-2 sr-1 um-1"}}}})",
        random.with(0.8) ? "disc" : "point", zenith, azimuth, random.between(20.0, 120.0));
    channels =
        random.one_of({R"({"name": "red", "top_hat": {"from": "0.63 um", "to": "0.68 um"}})",
                       R"({"name": "infrared", "gaussian": {"center": "0.865 um", "fwhm": "0.02 um"}})",
                       R"({"name": "pan", "top_hat": {"from": "0.45 um", "to": "0.9 um"}})"});
    if (air)
      atmosphere = format(
          R"("atmosphere": {{"tabulated": {{"transmittance": {:.3f}, "path_radiance": "{:.2f} W m-2 sr-1 um-1"}}}})",
          transmittance, random.between(1.0, 30.0));
  } else {
    light = format(R"("light": {{"sky": {{"temperature": "{:.1f} K"}}}})", random.between(200.0, 280.0));
    channels = random.one_of({R"({"name": "11 um", "top_hat": {"from": "10.5 um", "to": "11.5 um"}})",
                              R"({"name": "8 to 12 um", "top_hat": {"from": "8 um", "to": "12 um"}})",
                              R"({"name": "4 um", "top_hat": {"from": "3.5 um", "to": "4.1 um"}})"});
    if (air)
      atmosphere = format(
          R"("atmosphere": {{"tabulated": {{"transmittance": {:.3f}, "path_radiance": "{:.3f} W m-2 sr-1 um-1"}}}})",
          transmittance, random.between(0.01, 1.0));
  }
  if (random.with(0.3))
    sampling = format(R"("sampling": {{"accuracy": {{"error": "{}"}}}})",
                      random.one_of({"0.5 %", "2 %", regime == Light::solar ? "5 %" : "0.2 K"}));
}

void WildDraft::look_from_near(RandomStream& chance) {
  constexpr double kRadians = std::numbers::pi / 180.0;
  const double away_m = size_px * gsd_m * chance.magnitude(0.8, 20.0);
  const double sine = std::sin(view_zenith_deg * kRadians);
  const std::array<double, 3> at{centre_m[0] + away_m * sine * std::sin(view_azimuth_deg * kRadians),
                                 centre_m[1] + away_m * sine * std::cos(view_azimuth_deg * kRadians),
                                 away_m * std::cos(view_zenith_deg * kRadians)};
  camera = format(
      R"("camera": {{"frame": {{"focal_length": "{} um", "pitch": "10 um", "pixels": [{}, {}], "position": ["{} m", "{} m", "{} m"], "look_at": ["{} m", "{} m", "0 m"], "up": [{}, {}, {}]}}}})",
      10.0 * away_m / gsd_m, size_px, size_px, at[0], at[1], at[2], centre_m[0], centre_m[1],
      -std::sin(angle_deg * kRadians), std::cos(angle_deg * kRadians), sine);
}

std::string WildDraft::length(double px) const { return format("\"{} m\"", px * gsd_m); }

math::Point3 WildDraft::place(double x_px, double y_px, double z_px) const {
  return {centre_m[0] + x_px * gsd_m, centre_m[1] + y_px * gsd_m, z_px * gsd_m};
}

std::string WildDraft::point(double x_px, double y_px, double z_px) const {
  const math::Point3 p = place(x_px, y_px, z_px);
  return format(R"(["{} m", "{} m", "{} m"])", p.x, p.y, p.z);
}

void WildDraft::material(const std::string& what, const std::string& body) {
  materials.push_back(format(R"("{}": {{{}}})", what, body));
}

void WildDraft::grey(const std::string& what, double reflectance) {
  material(what, format(R"("reflectance": {:.4f})", reflectance));
}

void WildDraft::warm(const std::string& what, double emissivity, double temperature_k) {
  material(what, format(R"("emissivity": {:.4f}, "temperature": "{:.2f} K")", emissivity, temperature_k));
}

void WildDraft::surface(const std::string& what) {
  if (regime == Light::solar)
    grey(what, random.between(0.02, 0.7));
  else
    warm(what, random.one_of({1.0, random.between(0.7, 1.0)}), random.between(270.0, 330.0));
}

void WildDraft::ground() {
  surface("ground");
  objects.push_back(R"({"plane": {}, "material": "ground"})");
}

void WildDraft::box(std::array<double, 3> low, std::array<double, 3> high, const std::string& what) {
  objects.push_back(format(R"({{"box": {{"low": {}, "high": {}}}, "material": "{}"}})",
                           point(low[0], low[1], low[2]), point(high[0], high[1], high[2]), what));
}

void WildDraft::sphere(std::array<double, 3> centre, double radius, const std::string& what,
                       const char* shape) {
  objects.push_back(format(R"({{"{}": {{"center": {}, "radius": {}}}, "material": "{}"}})", shape,
                           point(centre[0], centre[1], centre[2]), length(radius), what));
}

void WildDraft::polygon(const std::vector<std::array<double, 3>>& corners, const std::string& what) {
  std::string vertices;
  for (const auto& corner : corners)
    vertices += (vertices.empty() ? "" : ", ") + point(corner[0], corner[1], corner[2]);
  objects.push_back(format(R"({{"polygon": {{"vertices": [{}]}}, "material": "{}"}})", vertices, what));
}

double WildDraft::in_step(double px) {
  if (random.with(0.5)) return px;
  const double part = random.one_of({1.0, 2.0, 3.0, 6.0});
  return std::max(1.0, std::round(px * part)) / part;
}

void WildDraft::raster(const std::string& file, int columns, int rows,
                       const std::vector<float>& values) const {
  std::ofstream data(folder / file, std::ios::binary);
  data.write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(float)));
  std::ofstream header(folder / (file + ".hdr"));
  header << format(
      "ENVI\nsamples = {}\nlines = {}\nbands = {}\nheader offset = 0\ndata type = 4\ninterleave = bsq\nbyte order = 0\n",
      columns, rows, values.size() / static_cast<std::size_t>(columns * rows));
  if (!data.flush() || !header.flush()) throw std::runtime_error("cannot write " + (folder / file).string());
}

std::string WildDraft::text(const std::string& kind) const {
  std::string text = format(
      "{{\n  // {}, {} ({} px of {:.4g} m, {:.4g} deg)\n  \"ifov\": 1,\n  \"scene\": {{\n    \"materials\": {{\n      ",
      name, kind, size_px, gsd_m, angle_deg);
  for (const std::string& m : materials) text += (&m == materials.data() ? "" : ",\n      ") + m;
  text += "\n    },\n    ";
  if (!prototypes.empty()) text += "\"prototypes\": {\n      ";
  for (const std::string& p : prototypes) text += (&p == prototypes.data() ? "" : ",\n      ") + p;
  if (!prototypes.empty()) text += "\n    },\n    ";
  text += "\"objects\": [\n      ";
  for (const std::string& o : objects) text += (&o == objects.data() ? "" : ",\n      ") + o;
  text += "\n    ]\n  },\n  " + light + ",\n  ";
  if (!atmosphere.empty()) text += atmosphere + ",\n  ";
  text += format("\"sensor\": {{\n    {},\n    \"channels\": [{}]{}\n  }}", camera, channels,
                 psf.empty() ? "" : ",\n    " + psf);
  if (!sampling.empty()) text += ",\n  " + sampling;
  return text + "\n}\n";
}

}  // namespace ifov::benchmarks
