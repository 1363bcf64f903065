#include "ifov/sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "core/format.h"
#include "sampling/accuracy/accuracy_sampler.h"
#include "sampling/field.h"
#include "sampling/pixel_footprint.h"
#include "sampling/sequence.h"
#include "sampling/tile.h"
#include "sampling/tolerance.h"

namespace ifov {
namespace {

constexpr int kIntegratedTile_px = 64;

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

/// A program's picture as samplers see one.
class ProgramField final : public sampling::Field {
 public:
  explicit ProgramField(FieldFunction& function)
      : function_(function), columns_(function.columns()), numbers_(function.random_numbers()) {}

  int columns() const override { return columns_; }

  void labels(std::span<const sampling::FocalPoint> points, std::span<sampling::Label> labels) override {
    place(points.size(), [&](std::size_t k) { return points[k]; });
    function_.labels(x_, y_, labels);
  }

  void values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
              std::span<float> values) override {
    place(requests.size(), [&](std::size_t k) { return requests[k].point; });
    random_.resize(requests.size() * std::size_t(numbers_));
    for (std::size_t k = 0; k < requests.size(); ++k)
      for (int d = 0; d < numbers_; d += 2) {  // pair 0 of the sequence is the place's
        const sampling::Point2 pair =
            sampling::sequence_point(requests[k].sequence, requests[k].index, std::uint32_t(1 + d / 2));
        random_[k * std::size_t(numbers_) + std::size_t(d)] = pair.x;
        if (d + 1 < numbers_) random_[k * std::size_t(numbers_) + std::size_t(d) + 1] = pair.y;
      }
    told_.assign(requests.size() * std::size_t(columns_), 0.0);
    function_.values(x_, y_, random_, labels, told_);
    for (std::size_t k = 0; k < requests.size(); ++k)
      for (int c = 0; c < columns_; ++c) {
        const double value = told_[k * std::size_t(columns_) + std::size_t(c)];
        require(std::abs(value) <= std::numeric_limits<float>::max(),
                format("field: found {} at x = {}, y = {}; expected a finite number", value, x_[k], y_[k]));
        values[k * std::size_t(stride()) + std::size_t(c)] = static_cast<float>(value);
      }
  }

  std::uint32_t material_of(sampling::Label) const override { return 0; }
  bool may_be_shaded(sampling::Label) const override { return true; }
  sampling::RayCounts counts() const override { return counts_; }

 private:
  template <class PointOf>
  void place(std::size_t count, PointOf point_of) {
    x_.resize(count);
    y_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const sampling::FocalPoint point = point_of(k);
      x_[k] = point.x_px;
      y_[k] = point.y_px;
    }
    counts_.primary += count;
  }

  FieldFunction& function_;
  int columns_, numbers_;
  std::vector<double> x_, y_, random_, told_;
  sampling::RayCounts counts_;
};

class Limits final : public sampling::Tolerance {
 public:
  explicit Limits(const IntegrationOptions& options) : options_(options) {}
  void limits(std::span<const double> mean, std::span<double> limit) const override {
    // Single precision tells nothing finer.
    for (std::size_t c = 0; c < mean.size(); ++c)
      limit[c] = options_.relative
                     ? std::max(options_.error * std::max(std::abs(mean[c]), options_.floor), 1e-30)
                     : options_.error;
  }
  double confidence() const override { return options_.confidence; }

 private:
  const IntegrationOptions& options_;
};

void require_sense(const FieldFunction& field, int width, int height, const IntegrationOptions& options) {
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  require(within(width, 1, 1 << 20) && within(height, 1, 1 << 20),
          format("shape: found {} x {} pixels; expected 1 to 1048576 each", width, height));
  require(within(field.columns(), 1, 64),
          format("field: found {} numbers in a value; expected 1 to 64", field.columns()));
  require(within(field.random_numbers(), 0, 64),
          format("random: found {}; expected 0 to 64", field.random_numbers()));
  require(options.error > 0 && std::isfinite(options.error),
          format("error: found {}; expected a number above 0", options.error));
  require(options.floor >= 0 && std::isfinite(options.floor),
          format("floor: found {}; expected a number of at least 0", options.floor));
  require(within(options.confidence, 0.5, 1.0 - 1e-9),
          format("confidence: found {}; expected 0.5 to 1 (excluded)", options.confidence));
  require(within(options.lattice, 1, 32), format("lattice: found {}; expected 1 to 32", options.lattice));
  require(options.max_samples >= 1, "max_samples: found 0; expected at least 1");
}

}  // namespace

IntegratedImage integrate(FieldFunction& function, int width, int height, const IntegrationOptions& options) {
  require_sense(function, width, height, options);
  IntegratedImage image;
  image.width = width;
  image.height = height;
  image.columns = function.columns();
  const std::size_t pixels = std::size_t(width) * std::size_t(height), columns = std::size_t(image.columns);
  image.mean.resize(pixels * columns);
  image.half_width.resize(pixels * columns);
  image.samples.resize(pixels);
  image.reasons.resize(pixels);
  image.missable_fraction.resize(pixels);

  sampling::AccuracyOptions how;
  how.lattice = options.lattice;
  how.max_samples_per_pixel = options.max_samples;
  const sampling::AccuracySampler sampler(how);
  const Limits limits(options);
  const auto footprint = sampling::PixelFootprint::box(1.0);
  std::vector<int> steering(columns);
  std::iota(steering.begin(), steering.end(), 0);

  sampling::TileProblem problem;
  problem.image = {0, 0, width, height};
  problem.seed = options.seed;
  problem.footprint = &footprint;
  problem.tolerance = &limits;
  problem.steering_channels = steering;
  problem.cancel = options.cancel;
  for (int y0 = 0; y0 < height; y0 += kIntegratedTile_px)
    for (int x0 = 0; x0 < width; x0 += kIntegratedTile_px) {
      problem.tile = {x0, y0, std::min(x0 + kIntegratedTile_px, width),
                      std::min(y0 + kIntegratedTile_px, height)};
      ProgramField field(function);
      sampling::TileResult tile;
      sampler.sample(problem, field, tile);
      std::size_t from = 0;
      for (int y = problem.tile.y0; y < problem.tile.y1; ++y)
        for (int x = problem.tile.x0; x < problem.tile.x1; ++x, ++from) {
          const std::size_t to = std::size_t(y) * std::size_t(width) + std::size_t(x);
          std::copy_n(&tile.mean[from * columns], columns, &image.mean[to * columns]);
          std::copy_n(&tile.half_width[from * columns], columns, &image.half_width[to * columns]);
          image.samples[to] = tile.samples[from];
          image.reasons[to] = tile.reasons[from];
          image.missable_fraction[to] = tile.missable_fraction[from];
        }
    }
  return image;
}

}  // namespace ifov
