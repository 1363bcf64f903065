#include "studies/sensor/scanning_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "io/document/cameras/orthographic_camera.h"
#include "io/document/document.h"
#include "io/document/samplers/error_size.h"
#include "io/document/shapes/flat_primitives.h"
#include "studies/common/study_document.h"

namespace ifov::studies {
namespace {

/// x, y, radius, metres.
constexpr std::array<double, 3> kDiscs[] = {{2.1, 3.3, 1.7},  {-3.4, 8.2, 2.4},  {1.2, 11.7, 0.6},
                                            {4.1, 14.9, 1.1}, {-1.3, 21.0, 3.1}, {0.4, 33.0, 2.9},
                                            {3.3, 41.3, 1.9}};
constexpr double kGround = 10.0, kDisc = 30.0;  // W m-2 sr-1 um-1

io::Document disc_document(const StudyOptions& options) {
  io::Document document =
      nadir_document(nadir_camera(1, 1, 0.0, 0.0), "red", 0.65,
                     accuracy_sampling({0.01, io::ErrorSize::Unit::fraction}), options.seed);
  document.scene.materials = {grey("dark", kGround / 100.0), grey("bright", kDisc / 100.0)};
  document.scene.objects = {object_of(io::PlanePrimitive(), "dark")};
  for (const auto& [x, y, radius] : kDiscs) {
    io::DiskPrimitive disk;
    disk.centre_m = {x, y, 1e-3};
    disk.normal = {0.0, 0.0, 1.0};
    disk.radius_m = radius;
    document.scene.objects.push_back(object_of(disk, "bright"));
  }
  io::SpectrumDocument radiance{io::ConstantSpectrum{100.0}, io::SpectrumOf::radiance, {}, {}, {}};
  document.light.sky = io::SkyRadiance{radiance};
  return document;
}

HeldShares held_of(const std::vector<double>& off, const std::vector<double>& allowed,
                   const std::vector<double>& truth) {
  HeldShares shares;
  double edges = 0.0;
  for (std::size_t p = 0; p < off.size(); ++p) {
    const bool held = off[p] <= allowed[p] + 2e-4 * kDisc;  // errors of the means over cells
    const bool edge = truth[p] > kGround + 1e-6 && truth[p] < kDisc - 1e-6;
    shares.all += held ? 1.0 / static_cast<double>(off.size()) : 0.0;
    edges += edge, shares.edges += edge && held;
    shares.worst = std::max(shares.worst, (off[p] - allowed[p]) / (kDisc - kGround));
  }
  shares.edges /= edges;
  return shares;
}

}  // namespace

SensorImage scan_discs(const ScannerFlight& flight, const StudyOptions& options) {
  io::Document document = disc_document(options);
  fly(flight, document, options);
  return render_sensor(document, options);
}

SensorImage discs_from_above(const ScannerFlight& flight, const StudyOptions& options) {
  io::Document document = disc_document(options);
  io::OrthographicCamera camera;
  camera.gsd_m = flight.height_m * flight.step;
  camera.size = {flight.width_px, flight.lines};
  camera.centre_m = {0.0, 0.5 * flight.lines * camera.gsd_m};
  camera.rotation_rad = std::numbers::pi;
  document.sensor.camera = {std::string(io::OrthographicCamera::kModel.key),
                            std::make_shared<const io::OrthographicCamera>(camera),
                            {}};
  return render_sensor(document, options);
}

std::vector<double> discs_by_geometry(const ScannerFlight& flight, int cells) {
  std::vector<double> image;
  for (int j = 0; j < flight.lines; ++j)
    for (int i = 0; i < flight.width_px; ++i) {
      int covered = 0;
      for (int v = 0; v < cells; ++v)
        for (int u = 0; u < cells; ++u) {
          const auto [west, north] = flight.ground_m(i + (u + 0.5) / cells, j + (v + 0.5) / cells);
          covered += std::any_of(std::begin(kDiscs), std::end(kDiscs), [&](const auto& disc) {
            return std::hypot(-west - disc[0], north - disc[1]) < disc[2];
          });
        }
      image.push_back(kGround + (kDisc - kGround) * covered / (cells * cells));
    }
  return image;
}

HeldShares held_shares(const SensorImage& image, const std::vector<double>& truth) {
  std::vector<double> off(truth.size());
  for (std::size_t p = 0; p < off.size(); ++p) off[p] = std::abs(image.radiance[p] - truth[p]);
  return held_of(off, image.half_width, truth);
}

HeldShares held_shares(const SensorImage& one, const SensorImage& other, const std::vector<double>& truth) {
  std::vector<double> off(truth.size()), allowed(truth.size());
  for (std::size_t p = 0; p < off.size(); ++p) {
    off[p] = std::abs(one.radiance[p] - other.radiance[p]);
    allowed[p] = std::hypot(one.half_width[p], other.half_width[p]);
  }
  return held_of(off, allowed, truth);
}

}  // namespace ifov::studies
