#include <cmath>

#include "core/format.h"
#include "io/document/document.h"
#include "radiometry/planck.h"
#include "studies/common/study_document.h"
#include "studies/sensor/sensor_checks.h"

namespace ifov::studies {
namespace {

constexpr double kPlane_um = 10.0, kPlane_k = 300.0;

}  // namespace

NoisyPlane noisy_plane(int pixels, double nedt_k, const StudyOptions& options) {
  io::Document document = nadir_document(nadir_camera(pixels, pixels, 0.0, 0.0), "thermal", kPlane_um,
                                         single_sampling(), options.seed);
  document.sensor.channels[0].noise_k = nedt_k;
  document.scene.materials = {black("ground", {kPlane_k, {}})};
  document.scene.objects = {level_ground("ground")};
  ask_for(document, {"samples"});
  const std::filesystem::path folder = run_sensor(document, "plane", options);
  draw_noise(folder, folder, 1, options.threads, options);
  std::vector<double> kelvin;
  for (const float radiance : read_product(folder, format("noisy_{}", options.seed)).values)
    kelvin.push_back(radiometry::brightness_temperature_k(kPlane_um, static_cast<double>(radiance)));
  const auto n = static_cast<double>(kelvin.size());
  double mean = 0.0, squares = 0.0;
  for (const double value : kelvin) mean += value / n;
  for (const double value : kelvin) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (n - 1.0)), kelvin.size()};
}

}  // namespace ifov::studies
