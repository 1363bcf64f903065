#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "sampling/accuracy/accuracy_sampler.h"
#include "sampling/accuracy/borders/polygon.h"
#include "sampling/pixel_footprint.h"
#include "sampling/random.h"
#include "sampling/tolerance.h"
#include "shape_field.h"

namespace ifov::test {

/// Black surfaces at 40 C and 20 C at 8.5 um (Planck, CODATA 2018), W m-2 sr-1 um-1, and kelvins per unit of
/// radiance at their 50 % mix.
constexpr double kHot = 12.113897, kCold = 8.366091, kRadiancePerKelvin = 0.188585;

/// Numbers in [0, 1) for drawing scenes.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : key_(sampling::mix(seed)) {}
  double operator()() { return sampling::unit_double(key_ = sampling::mix(key_)); }

 private:
  std::uint64_t key_;
};

/// Area of a disc in an axis-aligned rectangle, by the exact integral of its half chords.
inline double disc_in_rectangle(double cx, double cy, double r, double x0, double y0, double x1, double y1) {
  const auto below = [&](double x, double y) {  // area of the disc with X < x and Y < y, about its centre
    const auto primitive = [&](double t) {
      t = std::clamp(t, -r, r);
      return 0.5 * (t * std::sqrt(std::max(0.0, r * r - t * t)) + r * r * std::asin(t / r));
    };
    const double right = std::clamp(x, -r, r);
    if (y <= -r || right <= -r) return 0.0;
    if (y >= r) return 2.0 * (primitive(right) - primitive(-r));
    const double half = std::sqrt(std::max(0.0, r * r - y * y));
    double area = 0.0;
    const double to = std::min(right, half);
    if (to > -half) area += y * (to + half) + primitive(to) - primitive(-half);
    if (y >= 0.0) {
      area += 2.0 * (primitive(std::min(right, -half)) - primitive(-r));
      if (right > half) area += 2.0 * (primitive(right) - primitive(half));
    }
    return area;
  };
  return below(x1 - cx, y1 - cy) - below(x0 - cx, y1 - cy) - below(x1 - cx, y0 - cy) +
         below(x0 - cx, y0 - cy);
}

/// A rectangle of the given sides, turned, as a convex polygon.
inline sampling::Polygon turned_rectangle(double cx, double cy, double width, double length, double angle) {
  sampling::Polygon p;
  const double c = std::cos(angle), s = std::sin(angle);
  for (const auto& [u, v] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
    p.add({cx + c * u * length - s * v * width, cy + s * u * length + c * v * width});
  return p;
}

inline double polygon_in_rectangle(const sampling::Polygon& p, double x0, double y0, double x1, double y1) {
  return std::abs(
      p.clipped(-1, 0, -x0).clipped(1, 0, x1).clipped(0, -1, -y0).clipped(0, 1, y1).signed_area());
}

/// Every column may err by the same amount.
class FixedTolerance final : public sampling::Tolerance {
 public:
  explicit FixedTolerance(double half_width) : half_width_(half_width) {}
  void limits(std::span<const double>, std::span<double> limit) const override {
    std::fill(limit.begin(), limit.end(), half_width_);
  }
  double confidence() const override { return 0.95; }

 private:
  double half_width_;
};

template <class Sampler>
std::unique_ptr<sampling::PixelSampler> make_sampler(const sampling::AccuracyOptions& options) {
  return std::make_unique<Sampler>(options);
}

/// One tile of an image of one-column pixels through the accuracy sampler.
struct Rendering {
  sampling::PixelRect tile, image;
  std::uint64_t seed = 0;
  double half_width = 0.1 * kRadiancePerKelvin;
  sampling::PixelFootprint footprint = sampling::PixelFootprint::box(1.0);
  std::vector<sampling::FocalPoint> pilot_points;
  sampling::AccuracyOptions options;
  /// Makes the sampler: the real one, or one with a fault.
  std::unique_ptr<sampling::PixelSampler> (*sampler)(const sampling::AccuracyOptions&) =
      make_sampler<sampling::AccuracySampler>;

  sampling::TileResult operator()(sampling::Field& field) const {
    const FixedTolerance tolerance(half_width);
    const int steering_channels[1] = {0};
    sampling::TileProblem problem;
    problem.tile = tile;
    problem.image = image;
    problem.seed = seed;
    problem.footprint = &footprint;
    problem.tolerance = &tolerance;
    problem.steering_channels = steering_channels;
    problem.pilot_points = pilot_points;
    sampling::TileResult result;
    sampler(options)->sample(problem, field, result);
    return result;
  }
};

/// Errors of the centre pixel of 3 x 3 over many scenes.
struct Trials {
  std::vector<double> error, half_width;
  double samples = 0.0;
  int covered = 0, found = 0;

  void add(const sampling::TileResult& result, double truth, const sampling::Field& field) {
    const double e = std::abs(result.mean[4] - truth), h = result.half_width[4];
    error.push_back(e);
    half_width.push_back(h);
    covered += e <= h + 1e-6;
    found += h > 0.0;
    samples += static_cast<double>(field.counts().primary);
  }
  double mean_samples() const { return samples / static_cast<double>(error.size()); }
  double coverage() const { return covered / static_cast<double>(error.size()); }
  double quantile(double share) const {
    std::vector<double> sorted = error;
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }
  double rms() const {
    double sum = 0.0;
    for (double e : error) sum += e * e;
    return std::sqrt(sum / static_cast<double>(error.size()));
  }
};

inline Rendering three_by_three(std::uint64_t seed) {
  Rendering r;
  r.tile = r.image = {0, 0, 3, 3};
  r.seed = seed;
  return r;
}

/// A Gaussian PSF, cut off.
inline sampling::PixelFootprint gaussian(double sigma_px, double half_width_px) {
  const int n = 64;
  std::vector<double> h;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = (2.0 * (i + 0.5) / n - 1.0) * half_width_px,
                   y = (2.0 * (j + 0.5) / n - 1.0) * half_width_px;
      h.push_back(std::exp(-0.5 * (x * x + y * y) / (sigma_px * sigma_px)));
    }
  return sampling::PixelFootprint::tabulated(half_width_px, n, h);
}

inline ShapeField two_surfaces(ShapeField::LabelAt hot) {
  return ShapeField(std::move(hot), [](sampling::Label l, double, double, int) {
    return static_cast<float>(l != 0 ? kHot : kCold);
  });
}

/// A hot disc and its truth in the centre pixel.
struct DiscScene {
  double x, y, r;
  ShapeField field() const {
    return two_surfaces([*this](double px, double py) {
      return static_cast<sampling::Label>((px - x) * (px - x) + (py - y) * (py - y) < r * r);
    });
  }
  double fraction() const { return disc_in_rectangle(x, y, r, 1, 1, 2, 2); }
  double truth() const { return kCold + (kHot - kCold) * fraction(); }
};

inline double half_pixel_radius() { return std::sqrt(0.5 / std::numbers::pi); }

struct PolygonScene {
  sampling::Polygon shape;
  ShapeField field() const {
    return two_surfaces([*this](double px, double py) {
      return static_cast<sampling::Label>(shape.contains({px, py}));
    });
  }
  double truth() const { return kCold + (kHot - kCold) * polygon_in_rectangle(shape, 1, 1, 2, 2); }
};

/// One percent of every value, at 95 %.
class Percent final : public sampling::Tolerance {
 public:
  void limits(std::span<const double> mean, std::span<double> limit) const override {
    for (std::size_t c = 0; c < mean.size(); ++c) limit[c] = std::max(0.01 * std::abs(mean[c]), 1e-5);
  }
  double confidence() const override { return 0.95; }
};

/// A tile of `side` pixels from (0, 0), at that accuracy, plain pixels; the picture goes on around it.
inline sampling::TileResult sampled_at_a_percent(sampling::Field& field, int side, std::uint64_t seed,
                                                 const sampling::PixelSampler& sampler,
                                                 std::span<const sampling::FocalPoint> pilot_points = {},
                                                 std::span<const std::uint32_t> pilot_objects = {},
                                                 std::span<const sampling::ThinShadow> thin_shadows = {}) {
  const Percent tolerance;
  const sampling::PixelFootprint box = sampling::PixelFootprint::box(1.0);
  const int steering_channels[] = {0};
  sampling::TileProblem problem;
  problem.tile = {0, 0, side, side};
  problem.image = {-4, -4, side + 4, side + 4};
  problem.seed = seed;
  problem.footprint = &box;
  problem.tolerance = &tolerance;
  problem.steering_channels = steering_channels;
  problem.pilot_points = pilot_points;
  problem.pilot_objects = pilot_objects;
  problem.thin_shadows = thin_shadows;
  sampling::TileResult result;
  sampler.sample(problem, field, result);
  return result;
}

}  // namespace ifov::test
