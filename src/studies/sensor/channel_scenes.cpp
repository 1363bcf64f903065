#include "studies/sensor/channel_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/psf_document.h"
#include "io/document/samplers/error_size.h"
#include "io/document/shapes/flat_primitives.h"
#include "math/angle.h"
#include "radiometry/planck.h"
#include "sensor/mtf.h"
#include "studies/common/study_document.h"
#include "studies/sensor/modulation_scenes.h"
#include "studies/sensor/sensor_rendering.h"

namespace ifov::studies {
namespace {

constexpr double kAbove_all_m = 1000.0, kLens_m = 1.0, kElement_m = 20e-6,
                 kSeen_m = kAbove_all_m * kElement_m / kLens_m;
constexpr double kDark_k = 150.0;

/// Something hot on cold black ground, seen at these wavelengths through the aperture. `error`: of the faintest channel's light.
io::Document channels_document(int width_px, int height_px, io::ObjectDocument thing, double hot_k,
                               const std::vector<double>& wavelength_um, double error,
                               const ChannelOptics& optics, const StudyOptions& options) {
  double faintest = INFINITY;
  for (const double um : wavelength_um)
    faintest = std::min(faintest, radiometry::planck_w_m2_sr_um(um, hot_k));
  const double limit = std::stod(format("{:.4g}", error * faintest));
  io::Document document =
      nadir_document(frame_above(width_px, height_px, kAbove_all_m, kLens_m, kElement_m), "", 1.0,
                     accuracy_sampling({limit, io::ErrorSize::Unit::radiance}), options.seed);
  document.sensor.channels.clear();
  for (const double um : wavelength_um)
    document.sensor.channels.push_back({format("um_{:g}", um), io::MonochromaticChannel{um}, {}, {}, {}});
  io::AiryPsf airy;
  airy.aperture_m = 1e-6 * kLens_m / (optics.q_px_um * kElement_m);
  if (optics.one_footprint) airy.wavelength_um = wavelength_um.front();
  document.sensor.psf = std::make_shared<const io::PsfDocument>(io::PsfDocument{{airy}});
  document.sensor.fill_factor = optics.fill_factor;
  document.scene.materials = {black("cold", {kDark_k, {}}), black("hot", {hot_k, {}})};
  document.scene.objects = {object_of(io::PlanePrimitive(), "cold"), std::move(thing)};
  ask_for(document, {"half_width"});
  return document;
}

SensorImage band_of(const CubeValues& cube, int band) {
  SensorImage image{cube.width, cube.height, {}, {}, 0};
  for (int y = 0; y < cube.height; ++y)
    for (int x = 0; x < cube.width; ++x) image.radiance.push_back(cube.at(x, y, band));
  return image;
}

/// Where the modulation of the optics falls below a half.
double mtf50(const EdgeResponse& edge, const ChannelOptics& seen) {
  const auto optics = [&](std::size_t k) {
    return edge.modulation[k] / square_across(seen, edge.cycles_px[k]);
  };
  for (std::size_t k = 1; k < edge.cycles_px.size(); ++k) {
    const double before = optics(k - 1), here = optics(k);
    if (here < 0.5)
      return edge.cycles_px[k - 1] +
             (before - 0.5) / (before - here) * (edge.cycles_px[k] - edge.cycles_px[k - 1]);
  }
  return std::nan("");
}

}  // namespace

double square_across(const ChannelOptics& optics, double cycles_px) {
  const double angle = kEdgeAngle_deg * math::kDegree, side_px = std::sqrt(optics.fill_factor);
  return sensor::square_mtf(side_px, cycles_px * std::cos(angle)) *
         sensor::square_mtf(side_px, cycles_px * std::sin(angle));
}

ChannelEdges channel_edges(const ChannelOptics& optics, const StudyOptions& options, int width_px) {
  const double size_m = 1e3 * kSeen_m, lean_m = size_m * std::tan(kEdgeAngle_deg * math::kDegree);
  constexpr double kAbove_m = 1e-6, kHot_k = 3000.0;
  io::PolygonPrimitive half;
  half.vertices_m = {{-lean_m, -size_m, kAbove_m},
                     {2.0 * size_m, -size_m, kAbove_m},
                     {2.0 * size_m, size_m, kAbove_m},
                     {lean_m, size_m, kAbove_m}};
  ChannelEdges found{{0.45, 2.2}, {}, {}};
  const io::Document document = channels_document(width_px, width_px / 4, object_of(half, "hot"), kHot_k,
                                                  found.wavelength_um, 5e-4, optics, options);
  const CubeValues cube = read_product(run_sensor(document, "channel_edges", options), "radiance");
  EdgeChoices choices;
  choices.highest_cycles_px = 0.9;
  for (int band = 0; band < cube.bands; ++band) {
    found.edges.push_back(edge_response(band_of(cube, band), choices));
    found.mtf50_cycles_px.push_back(mtf50(found.edges.back(), optics));
  }
  return found;
}

std::vector<double> channel_points_off(const ChannelOptics& optics, double x_px, double y_px,
                                       const StudyOptions& options) {
  constexpr double kRadius_px = 0.02, kHot_k = 600.0, kArea_px2 = std::numbers::pi * kRadius_px * kRadius_px;
  constexpr int kPixels = PointShares::kPixels, kMiddle = kPixels / 2;
  const std::vector<double> wavelength_um{4.0, 7.0, 11.0};
  io::DiskPrimitive disk;
  disk.centre_m = {x_px * kSeen_m, -y_px * kSeen_m, 1e-6};
  disk.normal = {0.0, 0.0, 1.0};
  disk.radius_m = kRadius_px * kSeen_m;
  const io::Document document = channels_document(kPixels, kPixels, object_of(disk, "hot"), kHot_k,
                                                  wavelength_um, 2e-3 * kArea_px2, optics, options);
  const CubeValues cube = read_product(run_sensor(document, "channel_points", options), "radiance");
  std::vector<double> off;
  for (int band = 0; band < cube.bands; ++band) {
    const double um = wavelength_um[static_cast<std::size_t>(band)];
    const double cold = radiometry::planck_w_m2_sr_um(um, kDark_k);
    const double whole = (radiometry::planck_w_m2_sr_um(um, kHot_k) - cold) * kArea_px2;
    double most = 0.0;
    for (int y = 0; y < kPixels; ++y)
      for (int x = 0; x < kPixels; ++x) {
        const double dx = x - kMiddle - x_px, dy = y - kMiddle - y_px;
        if (std::hypot(dx, dy) > 4.5) continue;
        const double share = (cube.at(x, y, band) - cold) / whole;
        most = std::max(most, std::abs(share - airy_energy(optics.q_px_um * um, dx, dy)));
      }
    off.push_back(most);
  }
  return off;
}

}  // namespace ifov::studies
