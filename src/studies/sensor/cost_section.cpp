#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/samplers/error_size.h"
#include "io/files/input_file.h"
#include "session/session.h"
#include "studies/common/study_document.h"
#include "studies/common/suburb_scene.h"
#include "studies/sensor/sensor_checks.h"
#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {
namespace {

/// A loaded document that is rendered again and again.
class TimedRun {
 public:
  TimedRun(const io::Document& document, std::string name, const StudyOptions& options)
      : session_(session::Session::load(document, nullptr)), name_(std::move(name)), options_(options) {}
  /// Seconds of processor time of one thread, products and all.
  double seconds() const {
    session::RunOptions run;
    run.threads = 1;
    run.output_folder = options_.output_folder / name_;
    run.cancel = options_.cancel;
    std::filesystem::remove_all(run.output_folder);
    const std::clock_t start = std::clock();
    session_.render(run);
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }

 private:
  session::Session session_;
  std::string name_;
  const StudyOptions& options_;
};

/// The suburb in four channels, without air.
io::Document timed_suburb(const StudyOptions& options, bool truth) {
  io::Document document = suburb_document(options, true);
  const std::vector<io::ChannelDocument> all = document.sensor.channels;
  document.sensor.channels.clear();
  for (std::size_t k = 0; k < 4; ++k) document.sensor.channels.push_back(all[k * all.size() / 4]);
  document.sampling = accuracy_sampling({options.is_quick() ? 0.2 : 0.05, io::ErrorSize::Unit::fraction});
  document.atmosphere = {};
  io::SkyRadiance sky;
  sky.radiance.source = io::ConstantSpectrum{40.0};
  sky.radiance.quantity = io::SpectrumOf::radiance;
  document.light.sky = sky;
  document.output.quicklook_channels.clear();
  if (truth)
    ask_for(document, {"half_width", "location", "normal", "slope", "gsd", "view_angles"});
  else
    ask_for(document, {"half_width"});
  return document;
}

void add_truth(const SensorOptions& options, ReportSection& section) {
  const TimedRun plain(timed_suburb(options.study, false), "cost_plain", options.study),
      truth(timed_suburb(options.study, true), "cost_truth", options.study);
  std::vector<double> ratios;
  for (int k = 0; k < (options.study.is_quick() ? 1 : 5); ++k) {
    const double before = plain.seconds(), found = truth.seconds(), after = plain.seconds();
    ratios.push_back(found / std::sqrt(before * after));
  }
  std::sort(ratios.begin(), ratios.end());
  section.figures.at_most(
      "truth_cost", 100.0 * (ratios[ratios.size() / 2] - 1.0), 10.0, "%",
      format(
          "12 bands of truth (places, normals, slopes, sizes, angles) of a suburb at {:g} % in 4 channels: "
          "processor time on top, median of {}, {:.1f} to {:.1f}",
          options.study.is_quick() ? 20.0 : 5.0, ratios.size(), 100.0 * (ratios.front() - 1.0),
          100.0 * (ratios.back() - 1.0)));
}

}  // namespace

DetectTime detect_cube(int pixels_across, int channels, int seeds, const StudyOptions& options) {
  io::Document document = nadir_document(nadir_camera(pixels_across, pixels_across, 0.0, 0.0), "", 0.5,
                                         single_sampling(), options.seed);
  document.sensor.channels.clear();
  for (int k = 0; k < channels; ++k) {
    io::ChannelDocument channel{
        format("c{}", k), io::MonochromaticChannel{8.0 + 4.0 * k / channels}, {}, {}, {}};
    channel.noise_k = 0.05;
    document.sensor.channels.push_back(channel);
  }
  document.scene.materials = {black("ground", {300.0, {}})};
  document.scene.objects = {level_ground("ground")};
  ask_for(document, {"samples"});
  const std::filesystem::path folder = run_sensor(document, "cube", options);
  const auto start = std::chrono::steady_clock::now();
  const auto made = draw_noise(folder, folder / "noisy", seeds, options.threads, options);
  DetectTime result;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto again = draw_noise(folder, folder / "one", 1, options.threads == 1 ? 3 : 1, options);
  result.same_bytes = io::read_input(made.front()) == io::read_input(again.front());
  std::filesystem::remove_all(folder);
  return result;
}

ReportSection cost_section(const SensorOptions& options) {
  ReportSection section;
  section.title = "What it costs";
  section.text =
      "Noise on a rendered cube, files and all; and truth beside the radiance, as a ratio of processor times of one thread, by turns.";
  const bool quick = options.study.is_quick();
  const int pixels = quick ? 64 : 512, channels = quick ? 30 : 210, seeds = quick ? 2 : 10;
  const DetectTime time = detect_cube(pixels, channels, seeds, options.study);
  const std::string what = format("noise of {} x {} x {} values, {} seeds", pixels, pixels, channels, seeds);
  if (quick)
    section.figures.report("detect_time", time.seconds, "s", what);
  else
    section.figures.at_most("detect_time", time.seconds, 10.0, "s", what);
  section.figures.between("detect_same_bytes", time.same_bytes ? 1.0 : 0.0, 1.0, 1.0, "",
                          "the same bytes for another number of threads (1: yes)");
  add_truth(options, section);
  return section;
}

}  // namespace ifov::studies
