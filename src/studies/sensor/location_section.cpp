#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/shapes/flat_primitives.h"
#include "studies/common/study_document.h"
#include "studies/sensor/sensor_checks.h"
#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {
namespace {

constexpr double kThermal_um = 10.0;
constexpr double kFacet_m = 8.0;

io::ObjectDocument facet(std::vector<math::Point3> corners) {
  io::PolygonPrimitive polygon;
  polygon.vertices_m = std::move(corners);
  return object_of(polygon, "ground");
}

double corner_m(int i, int j) { return 10.0 + 6.0 * std::sin(1.3 * i) + 4.0 * std::cos(0.9 * i + 1.7 * j); }

/// A document that tells places, over objects of the material "ground".
io::Document place_document(io::CameraDocument camera, std::vector<io::ObjectDocument> objects,
                            const StudyOptions& options) {
  io::Document document =
      nadir_document(std::move(camera), "thermal", kThermal_um, single_sampling(), options.seed);
  document.scene.materials = {black("ground", {300.0, {}})};
  document.scene.objects = std::move(objects);
  ask_for(document, {"location"});
  return document;
}

}  // namespace

double facet_height_m(double x_m, double y_m) {
  const int i = static_cast<int>(std::floor(x_m / kFacet_m)),
            j = static_cast<int>(std::floor(y_m / kFacet_m));
  const double u = x_m / kFacet_m - i, v = y_m / kFacet_m - j;
  const double a = corner_m(i, j), b = corner_m(i + 1, j), c = corner_m(i + 1, j + 1), d = corner_m(i, j + 1);
  return u >= v ? a + u * (b - a) + v * (c - b) : a + u * (c - d) + v * (d - a);
}

double rays_from_orbit_m(const StudyOptions& options, double focal_length_error) {
  constexpr int kPixels = 40;
  constexpr double kFocal_m = 7.0, kPitch_m = 1e-5, kUp_m = 7e5;
  double worst_m = 0.0;
  for (const bool aslant : {false, true})
    for (const bool sloping : {false, true}) {
      const math::Point3 from = aslant ? math::Point3{2.4e5, -1.3e5, kUp_m} : math::Point3{0.0, 0.0, kUp_m};
      const double slope = sloping ? 0.3 : 0.0;
      std::vector<io::ObjectDocument> ground = {facet({{-90.0, -90.0, -90.0 * slope},
                                                       {90.0, -90.0, 90.0 * slope},
                                                       {90.0, 90.0, 90.0 * slope},
                                                       {-90.0, 90.0, -90.0 * slope}})};
      const io::Document document =
          place_document(frame_looking(kPixels, from, kFocal_m, kPitch_m), std::move(ground), options);
      const CubeValues told =
          read_product(run_sensor(document, format("orbit_{}{}", aslant, sloping), options), "location");
      const math::Vec3 forward = math::normalized(math::Point3{} - from);
      const math::Vec3 right = math::normalized(math::cross(forward, {0.0, 1.0, 0.0}));
      const math::Vec3 down = math::cross(forward, right);
      const double step = kPitch_m / (kFocal_m * (1.0 + focal_length_error));
      for (int y = 0; y < kPixels; ++y)
        for (int x = 0; x < kPixels; ++x) {
          const math::Vec3 ray = forward + ((x + 0.5 - 0.5 * kPixels) * step) * right +
                                 ((y + 0.5 - 0.5 * kPixels) * step) * down;
          const double along = (slope * from.x - from.z) / (ray.z - slope * ray.x);
          const math::Point3 meets = from + along * ray;
          const math::Point3 found{told.at(x, y, 0), told.at(x, y, 1), told.at(x, y, 2)};
          worst_m = std::max(worst_m, math::length(found - meets));
        }
    }
  return worst_m;
}

PlacesOff places_off(bool rough, const StudyOptions& options, double late_s) {
  ScannerFlight flight;
  flight.height_m = 500.0;
  flight.step = 1e-2;
  flight.speed_m_s = 500.0;
  flight.roll_rad = 5e-3;
  std::vector<io::ObjectDocument> ground;
  if (!rough) ground.push_back(level_ground("ground"));
  for (int i = -12; i < 12 && rough; ++i)
    for (int j = -4; j < 26; ++j) {
      const auto at = [&](int di, int dj) {
        return math::Point3{kFacet_m * (i + di), kFacet_m * (j + dj), corner_m(i + di, j + dj)};
      };
      ground.push_back(facet({at(0, 0), at(1, 0), at(1, 1)}));
      ground.push_back(facet({at(0, 0), at(1, 1), at(0, 1)}));
    }
  io::Document document = place_document(nadir_camera(1, 1, 0.0, 0.0), std::move(ground), options);
  fly(flight, document, options);
  const CubeValues told =
      read_product(run_sensor(document, rough ? "places_rough" : "places_flat", options), "location");
  PlacesOff off;
  for (int y = 0; y < told.height; ++y)
    for (int x = 0; x < told.width; ++x) {
      const math::Point3 place{told.at(x, y, 0), told.at(x, y, 1) - flight.speed_m_s * late_s,
                               told.at(x, y, 2)};
      const auto image = flight.image_px(place);
      off.image_px = std::max(off.image_px, std::hypot(image[0] - (x + 0.5), image[1] - (y + 0.5)));
      off.ground_m = std::max(off.ground_m,
                              std::abs(place.z - (rough ? facet_height_m(place.x, told.at(x, y, 1)) : 0.0)));
    }
  return off;
}

ReportSection location_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "Where pixels look";
  section.text =
      "A frame camera 700 km up whose pixels are 1 m, straight down and 21 degrees aslant, on level ground and on a slope of 0.3: places "
      "that are told of pixels against where the rays of that perspective meet the ground. And a scanner 500 m up, 24 pixels of 5 m "
      "across, that rolls by 5 mrad nine times a second: rays from the told places to where it flies arrive in the middle of their "
      "pixels, on level ground and on facets of 8 m that are up to 20 m high.";
  section.figures.at_most("rays_700_km", rays_from_orbit_m(options.study), 0.01, "m",
                          "pixels of 1 m seen from 700 km: largest distance of a place from its ray");
  for (const bool rough : {false, true}) {
    const PlacesOff off = places_off(rough, options.study);
    const char* name = rough ? "rough" : "flat";
    section.figures.at_most(
        format("places_{}", name), off.image_px, 0.01, "px",
        format("rolling scanner, {} ground: largest distance of a place's image from its pixel's middle",
               rough ? "rough" : "level"));
    section.figures.report(format("places_{}_ground", name), off.ground_m, "m",
                           "and of a place from the ground itself");
  }
  return section;
}

}  // namespace ifov::studies
