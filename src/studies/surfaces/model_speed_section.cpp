#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>

#include "core/format.h"
#include "io/document/document.h"
#include "studies/common/image_store.h"
#include "studies/common/scene_renderer.h"
#include "studies/common/study_document.h"
#include "studies/common/suburb_scene.h"
#include "studies/surfaces/surface_sections.h"

namespace ifov::studies {
namespace {

constexpr double kLeastSpeed = 0.6;
constexpr int kSpeedTile_px = 12, kSpeedGrid = 8;

/// The suburb with every material of one model, grey, opaque and without texture, and without air: spectral nodes of the models'
/// parameters would take minutes to find in 210 channels, and what is timed is paths.
io::Document suburb_of(const io::Document& suburb, const StudySurface& surface, bool stokes) {
  io::Document document = suburb;
  const io::ScatteringDocument scattering = material_of(surface).scattering;
  std::size_t number = 0;
  for (io::MaterialDocument& material : document.scene.materials) {
    material.transmittance.reset();
    material.further_curves.clear();
    material.texture.reset();
    material.is_emissivity = false;
    material.spectrum = {};
    material.spectrum.source = io::ConstantSpectrum{0.1 + 0.4 * static_cast<double>(number++ % 7) / 7.0};
    material.spectrum.quantity = io::SpectrumOf::reflectance;
    if (!material.sides) material.scattering = scattering;
  }
  document.sensor.stokes = stokes;
  document.atmosphere = {};
  io::SkyRadiance sky;
  sky.radiance.source = io::ConstantSpectrum{40.0};
  sky.radiance.quantity = io::SpectrumOf::radiance;
  document.light.sky = sky;
  return document;
}

class TimedSuburb {
 public:
  TimedSuburb(const io::Document& document, const StudyOptions& options)
      : renderer_(document, nullptr), options_(options) {
    const render::ImageInfo& info = renderer_.info();
    const int across = (info.width_px + kSpeedTile_px - 1) / kSpeedTile_px,
              down = (info.height_px + kSpeedTile_px - 1) / kSpeedTile_px;
    for (int k = 0; k < across * down; k += 2) tiles_.push_back(k);
  }
  /// Samples in a second of processor time, in one thread.
  double samples_per_s() const {
    ImageStore image;
    const std::clock_t start = std::clock();
    renderer_.render(grid_sampling(kSpeedGrid), {1, kSpeedTile_px, tiles_, options_.cancel, nullptr}, image);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    return static_cast<double>(image.cost().samples) / seconds;
  }

 private:
  SceneRenderer renderer_;
  const StudyOptions& options_;
  std::vector<int> tiles_;
};

struct SpeedRatio {
  double median = 0.0, least = 0.0, most = 0.0;
};
/// Of two, timed by turns.
SpeedRatio ratio_of(const TimedSuburb& one, const TimedSuburb& other, int rounds) {
  std::vector<double> ratios;
  for (int k = 0; k < rounds; ++k) {
    const double before = other.samples_per_s(), found = one.samples_per_s(), after = other.samples_per_s();
    ratios.push_back(found / std::sqrt(before * after));
  }
  std::sort(ratios.begin(), ratios.end());
  return {ratios[ratios.size() / 2], ratios.front(), ratios.back()};
}

}  // namespace

ReportSection model_speed_section(const StudyOptions& options) {
  ReportSection section;
  section.title = "Speed";
  section.text =
      "A suburb of 210 channels, without air, whose materials are all grey, opaque and of one model, against one of Lambertian materials, timed by turns: "
      "samples in a second of processor time, median of the ratios and their range. Below, what the Stokes vector costs.";
  const io::Document suburb = suburb_document(options, true);
  const int rounds = options.is_quick() ? 5 : 15;
  const StudySurface lambert{"lambertian", "lambertian", {}, "0.3"};
  const StudySurface models[] = {
      {"ross_li", "ross_li", {"f_vol=0.01", "f_geo=0.002"}, "0.3"},
      {"rpv", "rpv", {"k=1.02", "asymmetry=-0.01"}, "0.3"},
      {"rough_conductor", "rough_conductor", {"n=1.5", "k=7", "roughness=0.3"}, "0.3"}};
  const TimedSuburb base(suburb_of(suburb, lambert, false), options);
  section.figures.report("lambertian_speed", base.samples_per_s(), "samples/s",
                         "scalar Lambertian suburb of 210 channels: samples in a second of processor time");
  const auto what = [](const SpeedRatio& ratio, const std::string& text) {
    return format("{}: {:.3f}, {:.3f} to {:.3f}", text, ratio.median, ratio.least, ratio.most);
  };
  for (const StudySurface& surface : models) {
    const TimedSuburb scalar(suburb_of(suburb, surface, false), options);
    const SpeedRatio ratio = ratio_of(scalar, base, rounds);
    section.figures.at_least(
        surface.label + "_speed", ratio.median, kLeastSpeed, "times",
        what(ratio, format("samples per second, all {} over all Lambertian", surface.label)));
    if (surface.model != "rough_conductor") continue;
    const SpeedRatio stokes =
        ratio_of(TimedSuburb(suburb_of(suburb, surface, true), options), scalar, rounds);
    section.figures.report(
        "rough_conductor_stokes_speed", stokes.median, "times",
        what(stokes, "samples per second with the Stokes vector over scalar, rough_conductor"));
  }
  const SpeedRatio stokes = ratio_of(TimedSuburb(suburb_of(suburb, lambert, true), options), base, rounds);
  section.figures.report("lambertian_stokes_speed", stokes.median, "times",
                         what(stokes, "samples per second with the Stokes vector over scalar, Lambertian"));
  return section;
}

}  // namespace ifov::studies
