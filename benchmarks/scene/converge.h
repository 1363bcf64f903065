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

/// Renders the view to the document's accuracy `error` ("2 %") three times with different seeds, and once by a grid of
/// `reference_samples` paths a pixel that serves as the reference. JSON: median time in seconds, RMS error and mean by
/// band, samples and paths per pixel.
std::string converge(const std::filesystem::path& folder, const CloseView& view, const std::string& error,
                     int reference_samples);

/// The same scene as numbers, for other programs: reflectance by material and band, light, view.
std::string describe(const CloseView& view);

}  // namespace ifov::benchmarks
