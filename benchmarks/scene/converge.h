#pragma once

#include <filesystem>
#include <string>

namespace ifov::benchmarks {

/// A close view of the forest for comparisons with other renderers: Sun, sky and all scattering.
struct CloseView {
  int bands = 3;
  int pixels = 128;
  double side_m = 128.0;
};
inline constexpr double kCloseViewSky_w_m2_sr_um = 30.0;

/// Renders the view to the document's accuracy `error` ("30 %") and by a grid of 6 x 6 paths a pixel, each
/// three times with different seeds, and once by a fine grid of `reference_samples` paths a pixel that serves
/// as the reference. JSON: {"accuracy": run, "grid": run, "mean": [by band]}, a run being {"seconds": median,
/// "rms": [by band], "samples": and "paths": per pixel}. The reference's own variance is removed from the RMS
/// errors.
std::string converge(const std::filesystem::path& folder, const CloseView& view, const std::string& error,
                     int reference_samples);

/// The same scene as numbers, for other programs: reflectance by material and band, light, view.
std::string describe(const CloseView& view);

}  // namespace ifov::benchmarks
