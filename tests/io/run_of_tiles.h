#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "core/run_control.h"
#include "io/products/geotiff.h"
#include "io/products/report_format.h"
#include "io/run_state/run_plan.h"
#include "io/synthetic_image.h"

/// A run of a synthetic image, and what its kept tiles are compared by.
namespace ifov::test {

inline constexpr int kTile_px = 8;
inline const SyntheticImage kImage{37, 23, 5};

inline io::RunPlan plan_of(const SyntheticImage& image) {
  io::RunPlan plan;
  plan.identity = image.identity();
  plan.build = "0123456789abcdef (glibc 2.36)";
  plan.instruction_set = "x86-64-v3";
  plan.files = {{"city.ply", 100, 7, {1, 2}}, {"spectra/grass.txt", 20, 8, {3, 4}}};
  plan.image = image.info();
  plan.image.map_x_m = 0.1 + 0.2;  // needs all its digits
  plan.tile_px = kTile_px;
  plan.judged = plan.knows_errors = true;
  plan.notes = {"floor of the accuracy: \"0.001\""};
  plan.formats = {&io::formats::kGeotiff, &io::formats::kHtml};
  plan.quicklook_channels = {4, 2, 0};
  return plan;
}

/// What was said.
class Words final : public LogSink {
 public:
  void info(const std::string& message) override { text += "info: " + message + "\n"; }
  void warn(const std::string& message) override { text += "warning: " + message + "\n"; }
  std::string text;
};

template <class Error, class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

inline void expect_same(const sampling::TileResult& a, const sampling::TileResult& b) {
  EXPECT_EQ(a.columns, b.columns);
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.variance_geometry, b.variance_geometry);
  EXPECT_EQ(a.variance_path, b.variance_path);
  EXPECT_EQ(a.half_width, b.half_width);
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.label_rays, b.label_rays);
  EXPECT_EQ(a.radiance_evaluations, b.radiance_evaluations);
  EXPECT_EQ(a.reasons, b.reasons);
  EXPECT_EQ(a.worst_ratio, b.worst_ratio);
  EXPECT_EQ(a.missable_fraction, b.missable_fraction);
  ASSERT_EQ(a.abundances.size(), b.abundances.size());
  EXPECT_EQ(std::memcmp(a.abundances.data(), b.abundances.data(),
                        a.abundances.size() * sizeof(sampling::Abundance)),
            0);
  ASSERT_EQ(a.layers.size(), b.layers.size());
  for (std::size_t k = 0; k < a.layers.size(); ++k) {
    EXPECT_EQ(a.layers[k].name, b.layers[k].name);
    EXPECT_EQ(a.layers[k].value_bytes, b.layers[k].value_bytes);
    EXPECT_EQ(a.layers[k].bands, b.layers[k].bands);
    EXPECT_EQ(a.layers[k].bytes, b.layers[k].bytes);
  }
  EXPECT_EQ(a.halo_samples, b.halo_samples);
  EXPECT_EQ(a.rays.primary, b.rays.primary);
  EXPECT_EQ(a.rays.shadow, b.rays.shadow);
  EXPECT_EQ(a.rays.continuation, b.rays.continuation);
}

}  // namespace ifov::test
