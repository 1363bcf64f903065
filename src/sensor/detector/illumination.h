#pragma once

#include <array>
#include <memory>
#include <vector>

namespace ifov::sensor {

struct Detector;
struct ReadOut;

/// How much of the light of the middle of the field falls on each element of an image: vignetting, equation (12) of docs/theory/detectors.md.
class Illumination {
 public:
  /// Everywhere as in the middle.
  Illumination() = default;
  /// Of images so many columns wide and lines high; elements of a line scanner have their place in the line alone.
  Illumination(const Detector& detector, int columns, int lines, const ReadOut& read_out);

  bool even() const { return even_; }
  /// At a place of the image, in pixels; never below 0.
  double at(double x_px, double y_px) const;
  /// Of the elements of a line; empty where it is even.
  std::vector<double> of_line(int line) const;

 private:
  bool even_ = true, has_lines_ = false;
  int columns_ = 0, lines_ = 0;
  std::shared_ptr<const std::vector<std::array<double, 2>>> rows_;
  double focal_px_ = 0.0, radius_px_ = 1.0, terms_[3] = {};
};

}  // namespace ifov::sensor
