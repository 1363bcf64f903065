#include "honesty/rows_scene.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "core/format.h"

namespace ifov::benchmarks {

namespace {

constexpr int kCellsOfPitch = 20;  // of a map: duties are multiples of 5 %
constexpr double kSun_w_m2_um = 1200.0, kSky_w_m2_um = 150.0, kSunZenith_deg = 30.0;
constexpr double kFrom_um = 10.5, kTo_um = 11.5;

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Mean of Planck's law over the thermal channel: Gauss-Legendre's two points in each of many steps.
double blackbody(double temperature_k) {
  constexpr double kFirst = 1.191042972397188e8, kSecond_um_k = 14387.768775039337;  // CODATA 2018
  constexpr int kSteps = 200;
  const double step = (kTo_um - kFrom_um) / kSteps;
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k)
    for (const double side : {-1.0, 1.0}) {
      const double um = kFrom_um + (k + 0.5 + side * 0.5 / std::numbers::sqrt3) * step;
      sum += kFirst / (std::pow(um, 5) * std::expm1(kSecond_um_k / (um * temperature_k)));
    }
  return sum / (2 * kSteps);
}

/// Integral of the distribution function of a standard normal, from minus infinity.
double normal_ramp(double z) {
  return z * 0.5 * std::erfc(-z / std::numbers::sqrt2) +
         std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
}

/// G(t), whose second derivative is the density of a Gaussian of standard deviation `sigma`; 0: of a point.
double second_integral(double t, double sigma) {
  return sigma > 0.0 ? sigma * normal_ramp(t / sigma) : std::max(0.0, t);
}

/// First integral of G.
double third_integral(double t, double sigma) {
  if (!(sigma > 0.0)) return t > 0.0 ? 0.5 * t * t : 0.0;
  const double z = t / sigma;
  const double cdf = 0.5 * std::erfc(-z / std::numbers::sqrt2);
  const double pdf = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
  return sigma * sigma * 0.5 * ((z * z + 1.0) * cdf + z * pdf);
}

/// Distribution function at t of the sum of two uniform numbers of widths a >= b >= 0 about 0 and a Gaussian one.
/// Convolution with a box of width w is a central difference of the integral over w.
double distribution(double t, double a, double b, double sigma) {
  if (b < 1e-9 * a) return (second_integral(t + 0.5 * a, sigma) - second_integral(t - 0.5 * a, sigma)) / a;
  return (third_integral(t + 0.5 * (a + b), sigma) - third_integral(t + 0.5 * (a - b), sigma) -
          third_integral(t - 0.5 * (a - b), sigma) + third_integral(t - 0.5 * (a + b), sigma)) /
         (a * b);
}

void save(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace

const char* name_of(RowsScene::Form form) {
  switch (form) {
    case RowsScene::Form::map: return "map";
    case RowsScene::Form::boxes: return "boxes";
    default: return "mesh";
  }
}

std::string RowsScene::description() const {
  return format(
      "{}{}, pitch {:.6g} px ({:.6g} m), duty {:.4g}, {:.4g} deg, GSD {:.6g} m, phase {:.6g} px, {}, {:.4g} and {:.4g}{}{}",
      name_of(form), tiled ? " that repeats" : "", pitch_m / gsd_m, pitch_m, duty, angle_deg, gsd_m,
      phase_m / gsd_m, across_east ? "rows north-south" : "rows east-west", row, between, lit ? "" : " K",
      psf_sigma_px > 0.0 ? format(", PSF of {} px", psf_sigma_px) : "");
}

std::string RowsScene::write(const std::filesystem::path& folder, const std::string& name) const {
  // Rows reach beyond all that the pixels, their blur and the halo of tiles see.
  const double reach_m = (0.75 * size_px + 8.0) * gsd_m;
  const double middle_m = across_east ? centre_m[0] : centre_m[1],
               along_m = across_east ? centre_m[1] : centre_m[0];
  const auto first = static_cast<long>(std::floor((middle_m - reach_m - phase_m) / pitch_m));
  const auto last = static_cast<long>(std::ceil((middle_m + reach_m - phase_m) / pitch_m));
  const auto place = [&](double across, double along) {
    return across_east ? format("\"{} m\", \"{} m\"", across, along)
                       : format("\"{} m\", \"{} m\"", along, across);
  };
  const double low = along_m - reach_m, high = along_m + reach_m;

  std::string objects;
  if (form == Form::map) {
    const long pitches = tiled ? 1 : last - first;
    const long cells = pitches * kCellsOfPitch;
    const auto rows_of_pitch = std::lround(duty * kCellsOfPitch);
    std::string map = format("ncols {}\nnrows {}\nxllcorner 0\nyllcorner 0\ncellsize 1\n",
                             across_east ? cells : 1, across_east ? 1 : cells);
    for (long k = 0; k < cells; ++k) {  // the first line of a raster is its northernmost
      const long cell = across_east ? k : cells - 1 - k;
      map += format("{}{}", cell % kCellsOfPitch < rows_of_pitch ? 1 : 0, across_east ? " " : "\n");
    }
    save(folder / (name + ".asc"), map + "\n");
    objects = format(
        R"({{"plane": {{}}, "material": {{"map": {{"file": "{}.asc", "low_left": [{}], "size": [{}], "tiling": "{}", "classes": {{"0": "between", "1": "row"}}}}}}}})",
        name, place(phase_m + static_cast<double>(first) * pitch_m, low),
        place(static_cast<double>(pitches) * pitch_m, high - low), tiled ? "repeat" : "edge");
  } else {
    // Level with what lies between them (which is then made of strips too), or on a ground below.
    std::string mesh;
    int corner = 0;
    const auto strip = [&](double from, double to, const char* material) {
      if (form == Form::boxes) {
        objects += format(R"({}{{"box": {{"low": [{}, "{} m"], "high": [{}, "{} m"]}}, "material": "{}"}})",
                          objects.empty() ? "" : ",\n      ", place(from, low), lit ? -gsd_m : 0.0,
                          place(to, high), height_m, material);
        return;
      }
      mesh += format("usemtl {}\n", material);
      const double sides[4][2] = {{from, low}, {to, low}, {to, high}, {from, high}};
      for (const auto& [across, along] : sides)
        mesh += format("v {} {} {}\n", across_east ? across : along, across_east ? along : across, height_m);
      if (across_east)
        mesh += format("f {} {} {} {}\n", corner + 1, corner + 2, corner + 3, corner + 4);
      else
        mesh += format("f {} {} {} {}\n", corner + 4, corner + 3, corner + 2, corner + 1);
      corner += 4;
    };
    for (long k = first; k < last; ++k) {
      const double begin = phase_m + static_cast<double>(k) * pitch_m;
      strip(begin, begin + duty * pitch_m, "row");
      if (lit) strip(begin + duty * pitch_m, phase_m + static_cast<double>(k + 1) * pitch_m, "between");
    }
    if (form == Form::mesh) {
      save(folder / (name + ".obj"), mesh);
      objects = format(R"({{"mesh": {{"file": "{}.obj"}}, "material": {{"slots": {{"row": "row"{}}}}}}})",
                       name, lit ? R"(, "between": "between")" : "");
    }
    if (!lit)
      objects += R"(,
      {"plane": {}, "material": "between"})";
  }
  const auto material = [&](const char* what, double value) {
    return lit ? format(R"("{}": {{"reflectance": {}}})", what, value)
               : format(R"("{}": {{"emissivity": 1, "temperature": "{} K"}})", what, value);
  };
  const std::string light =
      lit ? format(
                R"("light": {{"sun": {{"point": {{"zenith": "{} deg", "azimuth": "140 deg"}}}}}},
  "atmosphere": {{"uniform": {{"direct": "{} W m-2 um-1", "diffuse": "{} W m-2 um-1"}}}},)",
                kSunZenith_deg, kSun_w_m2_um, kSky_w_m2_um)
          : std::string(R"("light": {"sky": {"temperature": "250 K"}},)");
  return format(
      R"({{
  // {}
  "ifov": 1,
  "scene": {{
    "materials": {{{}, {}}},
    "objects": [
      {}
    ]
  }},
  {}
  "sensor": {{
    "camera": {{"orthographic": {{"gsd": "{} m", "pixels": [{}, {}], "center": ["{} m", "{} m"], "rotation": "{} deg"}}}},
    "channels": [{{"name": "1", "top_hat": {{"from": "{} um", "to": "{} um"}}}}]{}
  }}
}}
)",
      description(), material("row", row), material("between", between), objects, light, gsd_m, size_px,
      size_px, centre_m[0], centre_m[1], angle_deg, lit ? 0.63 : kFrom_um, lit ? 0.68 : kTo_um,
      psf_sigma_px > 0.0 ? format(",\n    \"psf\": {{\"gaussian\": {{\"sigma\": \"{} px\"}}}}", psf_sigma_px)
                         : "");
}

std::vector<double> RowsScene::shares() const {
  const double c = std::cos(radians(angle_deg)), s = std::sin(radians(angle_deg));
  // World axis across the rows, of one pixel to the right and one down (docs/theory/sensor.md).
  const double right = gsd_m * (across_east ? c : -s), down = gsd_m * (across_east ? -s : -c);
  const double a = std::max(std::abs(right), std::abs(down)), b = std::min(std::abs(right), std::abs(down));
  const double sigma = psf_sigma_px * gsd_m, middle_m = across_east ? centre_m[0] : centre_m[1];
  const double reach = 0.5 * (a + b) + 10.0 * sigma;
  std::vector<double> shares;
  for (int j = 0; j < size_px; ++j)
    for (int i = 0; i < size_px; ++i) {
      const double t =
          middle_m + (i + 0.5 - 0.5 * size_px) * right + (j + 0.5 - 0.5 * size_px) * down - phase_m;
      double share = 0.0;
      for (auto k = static_cast<long>(std::floor((t - reach) / pitch_m));
           static_cast<double>(k) * pitch_m < t + reach; ++k) {
        const double begin = static_cast<double>(k) * pitch_m - t;
        share += distribution(begin + duty * pitch_m, a, b, sigma) - distribution(begin, a, b, sigma);
      }
      shares.push_back(share);
    }
  return shares;
}

std::vector<double> RowsScene::radiance() const {
  const double light = (kSun_w_m2_um * std::cos(radians(kSunZenith_deg)) + kSky_w_m2_um) / std::numbers::pi;
  const double of_row = lit ? row * light : blackbody(row),
               of_ground = lit ? between * light : blackbody(between);
  std::vector<double> radiance = shares();
  for (double& share : radiance) share = of_ground + share * (of_row - of_ground);
  return radiance;
}

RowsScene rows_at_random(RowsScene::Form form, double pitch_px, RandomStream& random) {
  RowsScene scene;
  scene.form = form;
  scene.gsd_m =
      random.with(0.5) ? random.one_of({0.25, 0.5, 1.0, 2.0, 3.0, 10.0, 30.0}) : random.magnitude(0.1, 60.0);
  if (random.with(0.5)) {
    const double part = random.one_of({1.0, 2.0, 3.0, 4.0, 6.0});
    pitch_px = std::max(1.0, std::round(pitch_px * part)) / part;
  }
  scene.pitch_m = pitch_px * scene.gsd_m;
  scene.duty = 0.05 * static_cast<double>(1 + random.index(19));
  scene.across_east = random.with(0.5);
  const double turned = random.uniform();
  scene.angle_deg = turned < 1.0 / 3.0   ? 0.0
                    : turned < 2.0 / 3.0 ? random.magnitude(0.001, 2.0)
                                         : random.between(0.0, 2.0);
  scene.phase_m = random.with(0.5) ? 0.0 : random.uniform() * scene.pitch_m;
  if (random.with(0.5))
    for (double& centre : scene.centre_m) centre = random.between(-100.0, 100.0);
  scene.lit = form == RowsScene::Form::map ? random.with(0.8) : random.with(0.5);
  if (scene.lit) {
    scene.row = random.between(0.02, 0.6);
    scene.between = random.between(0.02, 0.6);
  } else {
    scene.row = random.between(270.0, 340.0);
    scene.between = random.between(270.0, 340.0);
    if (form != RowsScene::Form::map) scene.height_m = scene.gsd_m * random.magnitude(0.01, 2.0);
  }
  scene.tiled = form == RowsScene::Form::map && random.with(0.5);
  return scene;
}

}  // namespace ifov::benchmarks
