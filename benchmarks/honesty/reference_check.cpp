#include "honesty/reference_check.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/format.h"
#include "honesty/plain_truth.h"
#include "honesty/rows_scene.h"
#include "honesty/single_tile.h"

namespace ifov::benchmarks {

namespace {

constexpr double kMostPaths = 2e5, kMostPhotons = 4e6;

/// A document of given parts, 4 x 4 pixels of 1 m.
std::string document(const std::string& materials, const std::string& objects, const std::string& light,
                     const std::string& channel) {
  return format(
      R"({{"ifov": 1, "scene": {{"materials": {{{}}}, "objects": [{}]}}, "light": {{{}}},
"sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [4, 4], "center": ["0 m", "0 m"]}}}}, "channels": [{}]}}}})",
      materials, objects, light, channel);
}

std::vector<PixelIndex> all_pixels(int size) {
  std::vector<PixelIndex> pixels;
  for (int k = 0; k < size * size; ++k) pixels.push_back({k % size, k / size});
  return pixels;
}

std::vector<PlainTruthPixel> truth_of(const std::string& text, const std::filesystem::path& file,
                                      const PlainHints& hints, int size, double wanted) {
  const session::Session session = load_text(text, file);
  const PlainTruth truth(session, hints);
  const auto errors = [wanted](std::size_t, std::span<const double> means) {
    return std::vector<double>(means.size(), wanted * means[0]);
  };
  return truth.pixels(all_pixels(size), errors, kMostPaths, kMostPhotons, 4711);
}

/// Largest |z| of pixels against their exact values.
double worst_z(const std::vector<PlainTruthPixel>& truth, const std::vector<double>& exact) {
  double worst = 0.0;
  for (std::size_t p = 0; p < exact.size(); ++p) {
    const double error = std::abs(truth[p].mean[0] - exact[p]);
    if (error > 1e-9 * exact[p]) worst = std::max(worst, error / truth[p].error[0]);
  }
  return worst;
}

double planck(double um, double kelvins) {
  return 1.191042972397188e8 / (std::pow(um, 5) * std::expm1(14387.768775039337 / (um * kelvins)));
}

/// Ground of 285 K and emissivity 0.9 under a black sphere and a black sky: the sphere's view factor from a level
/// point is (R/d)^2 cos(theta).
double beneath_sphere(PixelIndex pixel, double radius, double height, double lamp_k) {
  constexpr int kSteps = 40;
  double factor = 0.0;
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i) {
      const double x = pixel.x - 2 + (i + 0.5) / kSteps, y = 2 - pixel.y - (j + 0.5) / kSteps;
      const double squared = x * x + y * y + height * height;
      factor += radius * radius * height / (squared * std::sqrt(squared)) / (kSteps * kSteps);
    }
  // Straight down, the sphere hides a disc of the ground (R = 0.1 m, about the image's middle): those pixels are left out.
  return 0.9 * planck(4.0, 285.0) + 0.1 * factor * planck(4.0, lamp_k);
}

/// What a clear pane of index n reflects at an angle, all reflections between its faces, unpolarized; the rest comes
/// through (Fresnel; Born and Wolf 1999, section 1.5).
double pane_reflectance(double n, double degrees) {
  const double c = std::cos(degrees * std::numbers::pi / 180.0), t = std::sqrt(1.0 - (1.0 - c * c) / (n * n));
  const auto both_faces = [](double amplitude) {
    const double r = amplitude * amplitude;
    return 2.0 * r / (1.0 + r);
  };
  return 0.5 * (both_faces((c - n * t) / (c + n * t)) + both_faces((n * c - t) / (n * c + t)));
}

/// Largest |z| of pixels that ought to be alike.
double worst_z(const std::vector<PlainTruthPixel>& truth, double exact) {
  return worst_z(truth, std::vector<double>(truth.size(), exact));
}

}  // namespace

std::vector<FigureRow> check_reference(const std::filesystem::path& work) {
  std::vector<FigureRow> rows;
  const auto add = [&rows](const std::string& name, double value, const std::string& unit,
                           const std::string& must, bool ok) {
    rows.push_back({"reference_" + name, json_number(value), unit, must, ok});
    std::printf("    %-32s %-10.4g %s (must be %s)%s\n", name.c_str(), value, unit.c_str(), must.c_str(),
                ok ? "" : "  FAILS");
    std::fflush(stdout);
  };
  const auto close = [&add](const std::string& name, double z) { add(name, z, "worst z", "< 4.5", z < 4.5); };
  const auto caught = [&add](const std::string& name, double z) {
    add("fault_" + name, z, "worst z", "> 6", z > 6.0);
  };

  {
    const std::string text = document(R"("ground": {"emissivity": 1, "temperature": "300 K"})",
                                      R"({"plane": {}, "material": "ground"})", "",
                                      R"({"name": "all", "top_hat": {"from": "1 um", "to": "30000 um"}})");
    const double radiance = truth_of(text, work / "check.json", {}, 4, 1e-3)[0].mean[0] * 29999.0;
    const double law = 5.670374419e-8 * std::pow(300.0, 4) / std::numbers::pi;
    add("stefan_boltzmann", radiance / law - 1.0, "relative", "within 1e-5",
        std::abs(radiance / law - 1.0) < 1e-5);
  }
  for (const double psf_px : {0.0, 0.6}) {
    RowsScene scene;
    scene.form = RowsScene::Form::mesh;
    scene.pitch_m = 0.7;
    scene.duty = 0.35;
    scene.phase_m = 0.11;
    scene.angle_deg = 1.7;
    scene.size_px = 4;
    scene.psf_sigma_px = psf_px;
    const std::string text = scene.write(work, "check_rows");
    close(psf_px > 0.0 ? "rows_psf" : "rows",
          worst_z(truth_of(text, work / "check.json", {}, 4, 2e-3), scene.radiance()));
  }
  {
    const double radius = 0.1, height = 2.0, lamp_k = 1200.0;
    const std::string text = document(
        R"("ground": {"emissivity": 0.9, "temperature": "285 K"}, "lamp": {"emissivity": 1, "temperature": "1200 K"})",
        R"({"plane": {}, "material": "ground"}, {"sphere": {"center": ["0 m", "0 m", "2 m"], "radius": "0.1 m"}, "material": "lamp"})",
        "", R"({"name": "4 um", "monochromatic": {"at": "4 um"}})");
    const auto z = [&](double told_radius) {
      PlainHints hints;
      hints.lamps = {{{0.0, 0.0, height}, told_radius}};
      const std::vector<PlainTruthPixel> truth = truth_of(text, work / "check.json", hints, 4, 1e-3);
      double worst = 0.0;
      for (const PixelIndex pixel : all_pixels(4)) {
        if ((pixel.x == 1 || pixel.x == 2) && (pixel.y == 1 || pixel.y == 2)) continue;
        const PlainTruthPixel& p = truth[static_cast<std::size_t>(4 * pixel.y + pixel.x)];
        worst =
            std::max(worst, std::abs(p.mean[0] - beneath_sphere(pixel, radius, height, lamp_k)) / p.error[0]);
      }
      return worst;
    };
    close("sphere_view_factor", z(radius));
    caught("lamp_too_large", z(1.03 * radius));
  }
  const std::string sun =
      R"("sun": {"disc": {"zenith": "40 deg", "azimuth": "180 deg", "spectrum": "1000 W m-2 um-1"}})";
  const std::string red = R"({"name": "red", "top_hat": {"from": "0.63 um", "to": "0.68 um"}})";
  {
    // All of the image before a tall wall of mirror has the Sun twice, the second time by 0.8 of it.
    const std::string text = document(
        R"("ground": {"reflectance": 0.3}, "mirror": {"reflectance": 0.8, "scattering": "mirror"})",
        R"({"plane": {}, "material": "ground"}, {"polygon": {"vertices": [["-5 m", "2.5 m", "0 m"], ["5 m", "2.5 m", "0 m"], ["5 m", "2.5 m", "9 m"], ["-5 m", "2.5 m", "9 m"]]}, "material": "mirror"})",
        sun, red);
    const std::vector<double> exact(
        16, 0.3 / std::numbers::pi * 1000.0 * std::cos(40.0 * std::numbers::pi / 180.0) * 1.8);
    PlainHints hints;
    const std::vector<PlainTruthPixel> without = truth_of(text, work / "check.json", hints, 4, 2e-3);
    hints.around_mirrors = {{{0.0, 2.5, 4.5}, 6.74}};
    close("sun_by_flat_mirror", worst_z(truth_of(text, work / "check.json", hints, 4, 2e-3), exact));
    double z = 0.0;
    for (std::size_t p = 0; p < exact.size(); ++p)
      z = std::max(z, without[p].error[0] > 0.0
                          ? std::abs(without[p].mean[0] - exact[p]) / without[p].error[0]
                          : HUGE_VAL);
    rows.push_back({"reference_fault_mirror_not_told", json_number(z), "worst z", "> 6", z > 6.0});
  }
  const double lambert = 1000.0 * std::cos(40.0 * std::numbers::pi / 180.0) / std::numbers::pi;
  const std::string pane = R"("pane": {"scattering": {"slab": {"n": 1.5, "k": 0, "thickness": "4 mm"}}})";
  {
    // Dark ground under a level pane: what the ground sends back to it returns to less than 2e-4.
    const std::string text = document(
        R"("ground": {"reflectance": 0.001}, )" + pane,
        R"({"plane": {}, "material": "ground"}, {"polygon": {"vertices": [["-50 m", "-50 m", "2 m"], ["50 m", "-50 m", "2 m"], ["50 m", "50 m", "2 m"], ["-50 m", "50 m", "2 m"]]}, "material": "pane"})",
        sun, red);
    const double through = (1.0 - pane_reflectance(1.5, 40.0)) * (1.0 - pane_reflectance(1.5, 0.0));
    close("sun_through_pane",
          worst_z(truth_of(text, work / "check.json", {}, 4, 1e-3), 0.001 * lambert * through));
  }
  {
    // A tall pane sends the Sun to the ground before it, at 50 deg from its normal.
    const std::string text = document(
        R"("ground": {"reflectance": 0.3}, )" + pane,
        R"({"plane": {}, "material": "ground"}, {"polygon": {"vertices": [["-5 m", "2.5 m", "0 m"], ["5 m", "2.5 m", "0 m"], ["5 m", "2.5 m", "9 m"], ["-5 m", "2.5 m", "9 m"]]}, "material": "pane"})",
        sun, red);
    const double exact = 0.3 * lambert * (1.0 + pane_reflectance(1.5, 50.0));
    PlainHints hints;
    caught("pane_not_told", worst_z(truth_of(text, work / "check.json", hints, 4, 1e-3), exact));
    hints.around_mirrors = {{{0.0, 2.5, 4.5}, 6.74}};
    close("sun_by_pane", worst_z(truth_of(text, work / "check.json", hints, 4, 1e-3), exact));
  }
  {
    // Metal that reflects all, of any roughness, under a sky of 1: 1 of it comes back (within the 1e-3 of its model); under the disc
    // Sun as well, at its highlight, as much whichever way the Sun is found.
    for (const double roughness : {0.05, 0.5}) {
      const std::string text = document(
          format(
              R"("metal": {{"scattering": {{"rough_conductor": {{"n": 1, "k": 1000, "roughness": {}}}}}}})",
              roughness),
          R"({"plane": {}, "material": "metal"})", R"("sky": {"radiance": "1 W m-2 sr-1 um-1"})", red);
      double worst = 0.0;
      for (const PlainTruthPixel& pixel : truth_of(text, work / "check.json", {}, 4, 1e-3))
        worst = std::max(worst, std::abs(pixel.mean[0] - 1.0) - 4.5 * pixel.error[0]);
      add(format("white_metal_{:g}", roughness), worst, "off by, beyond 4.5 errors", "< 3e-3", worst < 3e-3);
    }
  }
  {
    // Nothing but the glint of the disc; of all pixels together rho E R^2 / 4.
    const std::string text = document(
        R"("mirror": {"reflectance": 0.8, "scattering": "mirror"}, "black": {"reflectance": 0})",
        R"({"plane": {}, "material": "black"}, {"sphere": {"center": ["0.3 m", "0.2 m", "1 m"], "radius": "0.5 m"}, "material": "mirror"})",
        sun, red);
    const auto z = [&](const PlainHints& hints) {
      double sum = 0.0, variance = 0.0;
      for (const PlainTruthPixel& pixel : truth_of(text, work / "check.json", hints, 4, 2e-3)) {
        sum += pixel.mean[0];
        variance += pixel.error[0] * pixel.error[0];
      }
      const double error = std::abs(sum - 0.8 * 1000.0 * 0.25 / 4.0);
      return variance > 0.0 ? error / std::sqrt(variance) : HUGE_VAL;
    };
    PlainHints hints;
    const double unsought = z(hints);
    hints.mirrors = {{{0.3, 0.2, 1.0}, 0.5}};
    close("glint", z(hints));
    // Few random points meet it: a mean without it, or with far too much.
    rows.push_back({"reference_fault_glint_not_sought", json_number(std::min(unsought, 1e9)),
                    "worst z or nothing found", "> 2", unsought > 2.0});
  }
  return rows;
}

}  // namespace ifov::benchmarks
