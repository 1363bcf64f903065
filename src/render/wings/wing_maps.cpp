#include "render/wings/wing_maps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sampling/hash.h"
#include "sampling/known_detail.h"
#include "sampling/value_batch.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/shining_parts.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

namespace {

constexpr std::uint64_t kMapPaths = 0x6d617073ull;  // purpose of random numbers
constexpr int kBlock_px = 64;                       // pixels whose maps are looked up together, along a side
/// Small enough for WingSpots::kLargest_px.
constexpr int kParts = 2;  // of a pixel, along a side

/// A pixel with something that shines in it or beside it.
struct Place {
  double contrast = 0.0, own = 0.0;
  sampling::FocalPoint brightest{};  ///< where `own` is not 0
};

bool may_shine(const transport::SpectralScene& scene) {
  const transport::ShiningParts parts(scene);
  const auto& assignments = scene.scene().assignments;
  for (std::uint32_t a = 0; a < assignments.size(); ++a)
    if (parts.wants(a) && !assignments[a].maps().empty()) return true;
  return false;
}

}  // namespace

std::vector<WingSpots::Box> shining_map_places(const transport::SpectralScene& scene,
                                               const sensor::Camera& camera, std::uint64_t seed,
                                               const CancelToken* cancel, sampling::Field& field) {
  std::vector<WingSpots::Box> boxes;
  if (!may_shine(scene)) return boxes;
  const auto columns = static_cast<std::size_t>(field.columns());
  const int outside = static_cast<int>(WingSpots::kOutside_px);
  std::vector<sampling::FocalPoint> points;
  std::vector<float> values;
  sampling::KnownDetail detail;
  std::map<std::pair<int, int>, Place> places;  // by row and column of pixels
  for (int y = -outside; y < camera.height_px() + outside; y += kBlock_px)
    for (int x = -outside; x < camera.width_px() + outside; x += kBlock_px) {
      if (cancel != nullptr && cancel->cancelled()) throw Cancelled();
      field.known_detail({x, y, x + kBlock_px, y + kBlock_px}, detail);
      // What stands out, and the middle of the same pixel.
      points.clear();
      for (const sampling::FocalPoint& p : detail.standouts) {
        points.push_back(p);
        points.push_back({std::floor(p.x_px) + 0.5, std::floor(p.y_px) + 0.5});
      }
      values.resize(points.size() * columns);
      sampling::for_each_value(
          field, cancel, points.size(),
          [&](std::size_t k) {
            return sampling::PathRequest{points[k], sampling::hash(seed, x, y, kMapPaths),
                                         static_cast<std::uint32_t>(k)};
          },
          [&](std::size_t k, sampling::Label, const float* found) {
            std::copy_n(found, columns, values.begin() + static_cast<std::ptrdiff_t>(k * columns));
          });
      for (std::size_t k = 0; k < points.size(); k += 2) {
        double contrast = 0.0;
        for (std::size_t c = 0; c < columns; ++c) {
          const auto own = static_cast<double>(values[k * columns + c]),
                     middle = static_cast<double>(values[(k + 1) * columns + c]);
          if (own > transport::ShiningParts::kContrast * std::max(0.0, middle))
            contrast = std::max(contrast, middle > 0.0 ? own / middle : own);
        }
        if (contrast <= 0.0) continue;
        // Maps that are smooth between their cells shine in the pixels about it, too.
        const int column = static_cast<int>(std::floor(points[k].x_px)),
                  row = static_cast<int>(std::floor(points[k].y_px));
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            Place& place = places[{row + dy, column + dx}];
            if (dx == 0 && dy == 0 && contrast > place.own) place.own = contrast, place.brightest = points[k];
            place.contrast = std::max(place.contrast, contrast);
          }
      }
    }
  for (const auto& [pixel, place] : places)
    for (int part = 0; part < kParts * kParts; ++part) {
      WingSpots::Box& box = boxes.emplace_back();
      box.half_width_px = box.half_height_px = 0.5 / kParts;
      box.centre = {pixel.second + (part % kParts + 0.5) / kParts,
                    pixel.first + (part / kParts + 0.5) / kParts};
      box.across = 16;
      box.strength = place.contrast;
      if (place.own > 0.0 && box.holds(place.brightest)) box.brightest = place.brightest;
    }
  return boxes;
}

}  // namespace ifov::render
