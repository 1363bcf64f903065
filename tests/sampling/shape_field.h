#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sampling/field.h"

namespace ifov::test {

/// A scene given as functions on the focal plane: what a point's label is, and what radiance a column sees
/// there.
class ShapeField : public sampling::Field {
 public:
  using LabelAt = std::function<sampling::Label(double x_px, double y_px)>;
  using ValueAt = std::function<float(sampling::Label label, double x_px, double y_px, int column)>;

  ShapeField(LabelAt label_at, ValueAt value_at, int columns = 1)
      : label_at_(std::move(label_at)), value_at_(std::move(value_at)), columns_(columns) {}

  int columns() const override { return columns_; }
  void labels(std::span<const sampling::FocalPoint> points, std::span<sampling::Label> labels) override {
    for (std::size_t k = 0; k < points.size(); ++k) labels[k] = label_at_(points[k].x_px, points[k].y_px);
    counts_.primary += points.size();
  }
  void values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const double x = requests[k].point.x_px, y = requests[k].point.y_px;
      labels[k] = label_at_(x, y);
      for (int c = 0; c < columns_; ++c)
        values[k * static_cast<std::size_t>(stride()) + static_cast<std::size_t>(c)] =
            value_at_(labels[k], x, y, c);
      seen.push_back(requests[k]);
    }
    counts_.primary += requests.size();
  }
  std::uint32_t material_of(sampling::Label label) const override {
    return static_cast<std::uint32_t>(label);
  }
  sampling::RayCounts counts() const override { return counts_; }

  std::vector<sampling::PathRequest> seen;  ///< every path asked for

 private:
  LabelAt label_at_;
  ValueAt value_at_;
  int columns_;
  sampling::RayCounts counts_;
};

/// A disc of radiance 1 (label 1) on 0 (label 0).
inline ShapeField disc_field(double x_px, double y_px, double radius_px) {
  return {[=](double x, double y) {
            return static_cast<sampling::Label>((x - x_px) * (x - x_px) + (y - y_px) * (y - y_px) <
                                                radius_px * radius_px);
          },
          [](sampling::Label label, double, double, int) { return static_cast<float>(label); }};
}

/// One radiance everywhere.
inline ShapeField uniform_field(float value) {
  return {[](double, double) { return sampling::Label{7}; },
          [=](sampling::Label, double, double, int) { return value; }};
}

}  // namespace ifov::test
