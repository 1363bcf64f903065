#include "studies/clutter_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/psf_document.h"
#include "io/document/shapes/flat_primitives.h"
#include "radiometry/planck.h"
#include "sampling/random.h"
#include "studies/common/study_document.h"
#include "studies/thermal_scene.h"

namespace ifov::studies {

namespace {

constexpr int kMaterials = 6;
constexpr std::uint64_t kClutter = 0x636c7574ull;

double temperature_k(int material) { return kCold_k + 4.0 * material; }

}  // namespace

ClutterScene::ClutterScene(int width_px, double cells_per_px, std::uint64_t seed)
    : width_(width_px), buckets_(width_px + static_cast<int>(2.0 * kMargin_px)) {
  const auto random = [&](int k, int what) {
    return sampling::unit_double(sampling::hash(seed, kClutter, k, what));
  };
  const int count = static_cast<int>(std::lround(cells_per_px * buckets_ * buckets_));
  bucket_cells_.resize(static_cast<std::size_t>(buckets_ * buckets_));
  for (int k = 0; k < count; ++k) {
    const double x = buckets_ * random(k, 0), y = buckets_ * random(k, 1);
    cells_.push_back({{x - kMargin_px, y - kMargin_px}, static_cast<int>(kMaterials * random(k, 2)), {}});
    bucket_cells_[static_cast<std::size_t>(static_cast<int>(y) * buckets_ + static_cast<int>(x))].push_back(
        k);
  }
  // A cell reaches at most half as far as the sites that clip it; nearer ones clip first.
  const double low = -kMargin_px, high = width_ + kMargin_px;
  for (Cell& cell : cells_) {
    std::vector<std::pair<double, const Cell*>> others;
    const int reach = 2 + static_cast<int>(std::ceil(4.0 / std::sqrt(cells_per_px)));
    const int bx = static_cast<int>(cell.site.x_px + kMargin_px),
              by = static_cast<int>(cell.site.y_px + kMargin_px);
    for (int b = std::max(0, by - reach); b <= std::min(buckets_ - 1, by + reach); ++b)
      for (int a = std::max(0, bx - reach); a <= std::min(buckets_ - 1, bx + reach); ++a)
        for (int k : bucket_cells_[static_cast<std::size_t>(b * buckets_ + a)]) {
          const Cell& other = cells_[static_cast<std::size_t>(k)];
          if (&other == &cell) continue;
          others.emplace_back(std::hypot(other.site.x_px - cell.site.x_px, other.site.y_px - cell.site.y_px),
                              &other);
        }
    std::sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    Outline outline{{low, low}, {high, low}, {high, high}, {low, high}};
    for (const auto& [distance, other] : others) {
      double furthest = 0.0;
      for (const sampling::FocalPoint& p : outline)
        furthest = std::max(furthest, std::hypot(p.x_px - cell.site.x_px, p.y_px - cell.site.y_px));
      if (distance > 2.0 * furthest) break;
      const double a = other->site.x_px - cell.site.x_px, b = other->site.y_px - cell.site.y_px;
      const double middle_x = 0.5 * (other->site.x_px + cell.site.x_px),
                   middle_y = 0.5 * (other->site.y_px + cell.site.y_px);
      outline = clip_half_plane(outline, a, b, a * middle_x + b * middle_y);
    }
    cell.outline = std::move(outline);
  }
}

double ClutterScene::radiance(int material) const {
  return radiometry::planck_w_m2_sr_um(kThermalWavelength_um, temperature_k(material));
}

io::Document ClutterScene::document(io::SamplingDocument sampling, double psf_sigma_px,
                                    std::uint64_t seed) const {
  io::Document document = nadir_document(nadir_camera(width_, width_, 0.0, 0.0), "thermal",
                                         kThermalWavelength_um, std::move(sampling), seed);
  if (psf_sigma_px > 0.0)
    document.sensor.psf =
        std::make_shared<const io::PsfDocument>(io::PsfDocument{{io::GaussianPsf{psf_sigma_px}}});
  for (int m = 0; m < kMaterials; ++m)
    document.scene.materials.push_back(black(format("m{}", m), {temperature_k(m), {}}));
  io::PlanePrimitive ground;
  ground.height_m = -0.01;
  document.scene.objects.push_back(object_of(ground, "m0"));
  for (const Cell& cell : cells_) {
    io::PolygonPrimitive polygon;
    // The image's y axis points south: backwards, the corners run counter-clockwise from above.
    for (std::size_t k = cell.outline.size(); k-- > 0;)
      polygon.vertices_m.push_back({cell.outline[k].x_px, -cell.outline[k].y_px, 0.0});
    document.scene.objects.push_back(object_of(std::move(polygon), format("m{}", cell.material)));
  }
  return document;
}

std::vector<double> ClutterScene::pixel_truth() const {
  std::vector<double> truth(static_cast<std::size_t>(width_ * width_), 0.0);
  for (const Cell& cell : cells_) {
    double x0 = width_, y0 = width_, x1 = 0.0, y1 = 0.0;
    for (const sampling::FocalPoint& p : cell.outline) {
      x0 = std::min(x0, p.x_px);
      x1 = std::max(x1, p.x_px);
      y0 = std::min(y0, p.y_px);
      y1 = std::max(y1, p.y_px);
    }
    for (int j = std::max(0, static_cast<int>(std::floor(y0))); j < std::min<double>(width_, y1); ++j)
      for (int i = std::max(0, static_cast<int>(std::floor(x0))); i < std::min<double>(width_, x1); ++i)
        truth[static_cast<std::size_t>(j * width_ + i)] +=
            radiance(cell.material) * area_in_rectangle(cell.outline, i, j, i + 1, j + 1);
  }
  return truth;
}

const ClutterScene::Cell& ClutterScene::nearest(double x, double y) const {
  const int bx = std::clamp(static_cast<int>(x + kMargin_px), 0, buckets_ - 1);
  const int by = std::clamp(static_cast<int>(y + kMargin_px), 0, buckets_ - 1);
  const Cell* best = nullptr;
  double best_distance = std::numeric_limits<double>::infinity();
  // Rings of buckets, until none further out can hold a nearer site.
  for (int ring = 0; ring < buckets_ && ring - 1 <= best_distance; ++ring)
    for (int b = by - ring; b <= by + ring; ++b)
      for (int a = bx - ring; a <= bx + ring; ++a) {
        if (std::max(std::abs(a - bx), std::abs(b - by)) != ring) continue;
        if (a < 0 || b < 0 || a >= buckets_ || b >= buckets_) continue;
        for (int k : bucket_cells_[static_cast<std::size_t>(b * buckets_ + a)]) {
          const Cell& cell = cells_[static_cast<std::size_t>(k)];
          const double distance = std::hypot(cell.site.x_px - x, cell.site.y_px - y);
          if (distance < best_distance) {
            best_distance = distance;
            best = &cell;
          }
        }
      }
  return *best;
}

std::vector<double> ClutterScene::blurred_truth(double sigma, int fine) const {
  const double cut = 4.4 * sigma, reach = cut + 0.5;
  const int margin = static_cast<int>(std::ceil(reach)), side = (width_ + 2 * margin) * fine;
  std::vector<double> picture(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      picture[static_cast<std::size_t>(j) * static_cast<std::size_t>(side) + static_cast<std::size_t>(i)] =
          radiance(nearest((i + 0.5) / fine - margin, (j + 0.5) / fine - margin).material);

  // One dimension of the response at t: what of the cut Gaussian falls on [t - 1/2, t + 1/2].
  const auto gauss = [&](double t) {
    return std::erf(std::clamp(t, -cut, cut) / sigma / std::numbers::sqrt2);
  };
  const int half = static_cast<int>(std::ceil(reach * fine));
  std::vector<double> response;
  double sum = 0.0;
  for (int k = -half; k < half; ++k) {
    const double t = (k + 0.5) / fine;
    response.push_back(gauss(t + 0.5) - gauss(t - 0.5));
    sum += response.back();
  }
  for (double& r : response) r /= sum;

  // Along rows at the columns of pixel centres, then down.
  std::vector<double> rows(static_cast<std::size_t>(side) * static_cast<std::size_t>(width_), 0.0);
  const auto start_of = [&](int pixel) {
    return static_cast<int>(std::lround((pixel + margin + 0.5) * fine)) - half;
  };
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < width_; ++i)
      for (int k = 0; k < 2 * half; ++k)
        rows[static_cast<std::size_t>(j * width_ + i)] +=
            response[static_cast<std::size_t>(k)] *
            picture[static_cast<std::size_t>(j) * static_cast<std::size_t>(side) +
                    static_cast<std::size_t>(start_of(i) + k)];
  std::vector<double> truth(static_cast<std::size_t>(width_ * width_), 0.0);
  for (int j = 0; j < width_; ++j)
    for (int i = 0; i < width_; ++i)
      for (int k = 0; k < 2 * half; ++k)
        truth[static_cast<std::size_t>(j * width_ + i)] +=
            response[static_cast<std::size_t>(k)] *
            rows[static_cast<std::size_t>((start_of(j) + k) * width_ + i)];
  return truth;
}

}  // namespace ifov::studies
