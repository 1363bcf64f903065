#pragma once

#include <string>
#include <vector>

#include "studies/resolution_chart.h"

namespace ifov::io {
struct Document;
struct SamplingDocument;
}  // namespace ifov::io

namespace ifov::studies {

/// Study 1: a black and white USAF-1951 chart under the Sun at the zenith, 128 x 128 pixels. Group -2 has
/// bars of 2.6 pixels, group 3 of 0.05.
class ChartScene {
 public:
  static constexpr int kWidth_px = 128;
  static constexpr double kWhite = 0.9, kBlack = 0.05;  // reflectances

  /// `angle_rad` of the chart against the pixels; its centre is shifted by up to half a pixel from (seed).
  ChartScene(double angle_rad, std::uint64_t seed);

  io::Document document(io::SamplingDocument sampling, std::uint64_t seed) const;
  /// Exact share of black in every pixel.
  const std::vector<double>& black_fraction() const { return black_; }

 private:
  std::vector<Outline> bars_;
  std::vector<double> black_;
};

}  // namespace ifov::studies
