#include "studies/sensor/modulation_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/format.h"
#include "io/document/carriers_document.h"
#include "io/document/document.h"
#include "io/document/psf_document.h"
#include "io/document/samplers/error_size.h"
#include "math/angle.h"
#include "radiometry/planck.h"
#include "sensor/along_track.h"
#include "sensor/mtf.h"
#include "studies/common/study_document.h"
#include "studies/sensor/sensor_rendering.h"

namespace ifov::studies {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kEdge_um = 10.0, kEdge_k = 300.0, kCold_k = 120.0;
constexpr double kHeight_m = 1000.0, kFocal_m = 1.0, kPitch_m = 20e-6,
                 kPixel_m = kHeight_m * kPitch_m / kFocal_m;

double cold() { return radiometry::planck_w_m2_sr_um(kEdge_um, kCold_k); }
double hot() { return radiometry::planck_w_m2_sr_um(kEdge_um, kEdge_k) - cold(); }

/// Cold ground, and something hot on it.
io::Document hot_document(io::CameraDocument camera, io::ObjectDocument thing, double error_of_hot,
                          const StudyOptions& options) {
  const double error = std::stod(format("{:.4g}", error_of_hot * hot()));
  io::Document document =
      nadir_document(std::move(camera), "thermal", kEdge_um,
                     accuracy_sampling({error, io::ErrorSize::Unit::radiance}), options.seed);
  document.scene.materials = {black("cold", {kCold_k, {}}), black("hot", {kEdge_k, {}})};
  document.scene.objects = {level_ground("cold"), std::move(thing)};
  return document;
}

/// Half of the plane around (0, y): what is to the east of a line that leans to the east, or to the north of one that rises.
io::ObjectDocument half_plane(bool upright, double north_m, double size_m) {
  const double tangent = std::tan(kEdgeAngle_deg * math::kDegree);
  io::PolygonPrimitive polygon;
  constexpr double kAbove_m = 1e-6;
  if (upright)
    polygon.vertices_m = {{-size_m * tangent, north_m - size_m, kAbove_m},
                          {2.0 * size_m, north_m - size_m, kAbove_m},
                          {2.0 * size_m, north_m + size_m, kAbove_m},
                          {size_m * tangent, north_m + size_m, kAbove_m}};
  else
    polygon.vertices_m = {{-size_m, north_m - size_m * tangent, kAbove_m},
                          {size_m, north_m + size_m * tangent, kAbove_m},
                          {size_m, north_m + 2.0 * size_m, kAbove_m},
                          {-size_m, north_m + 2.0 * size_m, kAbove_m}};
  return object_of(polygon, "hot");
}

constexpr double kEdgeError = 5e-4;

double gaussian_energy(double sigma_px, double x_px, double y_px) {
  const auto along = [&](double at) {
    const double scale = sigma_px * std::sqrt(2.0);
    return 0.5 * (std::erf((at + 0.5) / scale) - std::erf((at - 0.5) / scale));
  };
  return along(x_px) * along(y_px);
}

}  // namespace

double airy_energy(double q_px, double x_px, double y_px) {
  constexpr int kCells = 100;
  double sum = 0.0;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const double r = std::hypot(x_px - 0.5 + (i + 0.5) / kCells, y_px - 0.5 + (j + 0.5) / kCells);
      const double v = kPi * r / q_px, amplitude = v < 1e-9 ? 1.0 : 2.0 * std::cyl_bessel_j(1.0, v) / v;
      sum += kPi / (4.0 * q_px * q_px) * amplitude * amplitude / (kCells * kCells);
    }
  return sum;
}

void set_optics(const EdgeOptics& optics, io::SensorDocument& sensor) {
  std::vector<io::PsfPart> parts;
  if (optics.airy_q_px > 0.0)
    parts.emplace_back(io::AiryPsf{kEdge_um * 1e-6 * kFocal_m / (optics.airy_q_px * kPitch_m), kEdge_um,
                                   optics.obscuration});
  if (optics.gaussian_px > 0.0) parts.emplace_back(io::GaussianPsf{optics.gaussian_px});
  if (optics.field_free_px > 0.0) {
    io::DiffusionDocument diffusion;
    diffusion.field_free_m = optics.field_free_px * kPitch_m;
    parts.emplace_back(std::make_shared<const io::DiffusionDocument>(std::move(diffusion)));
  }
  if (optics.crosstalk > 0.0)
    parts.emplace_back(
        std::make_shared<const io::CrosstalkDocument>(io::CrosstalkDocument{optics.crosstalk, {}, {}}));
  if (!parts.empty()) sensor.psf = std::make_shared<const io::PsfDocument>(io::PsfDocument{std::move(parts)});
}

EdgeResponse still_edge(const EdgeOptics& optics, const StudyOptions& options, int pixels) {
  io::Document document = hot_document(frame_above(pixels, pixels, kHeight_m, kFocal_m, kPitch_m),
                                       half_plane(true, 0.0, 1e3 * kPixel_m), kEdgeError, options);
  set_optics(optics, document.sensor);
  return edge_response(render_sensor(document, options));
}

double still_modulation(const EdgeOptics& optics, double cycles_px) {
  const double angle = kEdgeAngle_deg * math::kDegree;
  return sensor::square_mtf(1.0, cycles_px * std::cos(angle)) *
         sensor::square_mtf(1.0, cycles_px * std::sin(angle)) *
         (optics.gaussian_px > 0.0 ? sensor::gaussian_mtf(optics.gaussian_px, cycles_px) : 1.0) *
         (optics.airy_q_px > 0.0 ? sensor::diffraction_mtf(optics.airy_q_px, optics.obscuration, cycles_px)
                                 : 1.0) /
         std::cosh(2.0 * kPi * optics.field_free_px * cycles_px) *
         (1.0 - 4.0 * optics.crosstalk +
          2.0 * optics.crosstalk *
              (std::cos(2.0 * kPi * cycles_px * std::cos(angle)) +
               std::cos(2.0 * kPi * cycles_px * std::sin(angle))));
}

EdgeResponse scanned_edge(double element_length_px, int stages, double mismatch, const StudyOptions& options,
                          int pixels) {
  ScannerFlight flight;
  flight.width_px = flight.lines = pixels;
  flight.speed_m_s = 50.0 * (1.0 + mismatch);
  flight.element_length_px = element_length_px;
  flight.stages = stages;
  const double middle_m = 0.5 * pixels * ScannerFlight::kPeriod_s * flight.speed_m_s;
  io::Document document =
      hot_document(nadir_camera(1, 1, 0.0, 0.0), half_plane(false, middle_m, 1e3), kEdgeError, options);
  fly(flight, document, options);
  const SensorImage image = render_sensor(document, options);
  SensorImage turned{image.height, image.width, std::vector<double>(image.radiance.size()), {}, 0};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      turned.radiance[static_cast<std::size_t>(x) * static_cast<std::size_t>(image.height) +
                      static_cast<std::size_t>(y)] = image.at(x, y);
  return edge_response(turned);
}

double scanned_modulation(double element_length_px, int stages, double mismatch, double cycles_px) {
  const double tangent = std::tan(kEdgeAngle_deg * math::kDegree) / (1.0 + mismatch);  // in lines and pixels
  const double along = cycles_px / std::hypot(1.0, tangent), across = along * tangent;
  // A pitch in lines; what stages are late by, as motion (the sinc form).
  const double pitch = 1.0 / (1.0 + mismatch);
  return sensor::square_mtf(1.0, along) * sensor::square_mtf(element_length_px * pitch, along) *
         sensor::square_mtf(stages * (1.0 - pitch), along) * sensor::square_mtf(1.0, across);
}

double edge_difference(const EdgeResponse& found, const std::function<double(double)>& expected) {
  double most = 0.0;
  for (std::size_t k = 0; k < found.cycles_px.size(); ++k)
    most = std::max(most, std::abs(found.modulation[k] - expected(found.cycles_px[k])));
  return most;
}

PointShares point_shares(const EdgeOptics& optics, double x_px, double y_px, const StudyOptions& options) {
  constexpr double kRadius_px = 0.02;
  io::DiskPrimitive disk;
  disk.centre_m = {x_px * kPixel_m, -y_px * kPixel_m, 1e-6};
  disk.normal = {0.0, 0.0, 1.0};
  disk.radius_m = kRadius_px * kPixel_m;
  const double whole = hot() * kPi * kRadius_px * kRadius_px;
  io::Document document =
      hot_document(frame_above(PointShares::kPixels, PointShares::kPixels, kHeight_m, kFocal_m, kPitch_m),
                   object_of(disk, "hot"), 2e-3 * whole / hot(), options);
  set_optics(optics, document.sensor);
  const SensorImage image = render_sensor(document, options);
  PointShares shares;
  constexpr int kMiddle = PointShares::kPixels / 2;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double dx = x - kMiddle - x_px, dy = y - kMiddle - y_px;
      const double found = (image.at(x, y) - cold()) / whole;
      const double expected = optics.airy_q_px > 0.0         ? airy_energy(optics.airy_q_px, dx, dy)
                              : optics.gaussian_px > 0.0     ? gaussian_energy(optics.gaussian_px, dx, dy)
                              : x == kMiddle && y == kMiddle ? 1.0
                                                             : 0.0;
      shares.distance_px.push_back(std::hypot(dx, dy));
      shares.found.push_back(found);
      shares.expected.push_back(expected);
      if (shares.distance_px.back() <= 4.5)
        shares.largest = std::max(shares.largest, std::abs(found - expected));
    }
  return shares;
}

}  // namespace ifov::studies
