#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/psf_document.h"
#include "io/document/samplers/error_size.h"
#include "io/files/input_file.h"
#include "session/session.h"
#include "studies/common/study_document.h"
#include "studies/common/study_files.h"
#include "studies/common/suburb_scene.h"
#include "studies/sensor/sensor_checks.h"
#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {
namespace {

/// A loaded document that is rendered again and again.
class TimedRun {
 public:
  TimedRun(const io::Document& document, std::string name, const StudyOptions& options)
      : session_(session::Session::load(document, nullptr)), name_(std::move(name)), options_(options) {
    write_file(options.output_folder / (name_ + ".json"), study_text(document));
  }
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

/// Processor times by turns, of what costs more over what is plain; sorted.
std::vector<double> cost_ratios(const io::Document& plain, const io::Document& more, const std::string& name,
                                const StudyOptions& options) {
  const TimedRun before_and_after(plain, name + "_plain", options), between(more, name, options);
  std::vector<double> ratios;
  for (int k = 0; k < (options.is_quick() ? 1 : 5); ++k) {
    const double before = before_and_after.seconds(), found = between.seconds(),
                 after = before_and_after.seconds();
    ratios.push_back(found / std::sqrt(before * after));
  }
  std::sort(ratios.begin(), ratios.end());
  return ratios;
}

std::string spread_text(const std::vector<double>& ratios) {
  return format("processor time on top, median of {}, {:.1f} to {:.1f}", ratios.size(),
                100.0 * (ratios.front() - 1.0), 100.0 * (ratios.back() - 1.0));
}

/// The suburb in a few channels, without air.
io::Document timed_suburb(const StudyOptions& options, std::size_t channels, bool truth) {
  io::Document document = suburb_document(options, true);
  const std::vector<io::ChannelDocument> all = document.sensor.channels;
  document.sensor.channels.clear();
  for (std::size_t k = 0; k < channels; ++k)
    document.sensor.channels.push_back(all[k * all.size() / channels]);
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

void add_truth(const SectionOptions& options, ReportSection& section) {
  const std::vector<double> ratios =
      cost_ratios(timed_suburb(options.study, 4, false), timed_suburb(options.study, 4, true), "cost_truth",
                  options.study);
  section.figures.at_most(
      "truth_cost", 100.0 * (ratios[ratios.size() / 2] - 1.0), 10.0, "%",
      format(
          "12 bands of truth (places, normals, slopes, sizes, angles) of a suburb at {:g} % in 4 channels: {}",
          options.study.is_quick() ? 20.0 : 5.0, spread_text(ratios)));
}

/// Six channels of the suburb through optics: of one footprint, or of one each.
io::Document blurred_suburb(const StudyOptions& options, bool by_wavelength, bool groups) {
  io::Document document = timed_suburb(options, 6, false);
  if (!by_wavelength) {
    document.sensor.psf = std::make_shared<const io::PsfDocument>(io::PsfDocument{{io::GaussianPsf{0.4}}});
    for (std::size_t k = 0; groups && k < document.sensor.channels.size(); ++k)
      document.sensor.channels[k].shift_px = {{0.15 * static_cast<double>(k), -0.1 * static_cast<double>(k)}};
    return document;
  }
  constexpr double kUp_m = 2000.0, kGsd_m = 1.0, kPitchOverFocal = kGsd_m / kUp_m;
  constexpr int kPixels = 60;
  document.sensor.camera = frame_above(kPixels, kPixels, kUp_m, 1.0, kPitchOverFocal);
  io::AiryPsf airy;
  airy.aperture_m = 1e-6 / (0.5 * kPitchOverFocal);  // half a pixel in a micrometre
  if (!groups) airy.wavelength_um = 1.2;
  document.sensor.psf = std::make_shared<const io::PsfDocument>(io::PsfDocument{{airy}});
  return document;
}

void add_groups(const SectionOptions& options, ReportSection& section) {
  for (const bool by_wavelength : {true, false}) {
    const std::vector<double> ratios =
        cost_ratios(blurred_suburb(options.study, by_wavelength, false),
                    blurred_suburb(options.study, by_wavelength, true),
                    by_wavelength ? "cost_diffraction" : "cost_shifts", options.study);
    section.figures.at_most(
        by_wavelength ? "footprint_groups_cost" : "footprint_shifts_cost",
        100.0 * (ratios[ratios.size() / 2] - 1.0), 30.0, "%",
        format("6 footprints of 6 channels of the suburb, {}, over one: {}",
               by_wavelength ? "diffraction by wavelength" : "shifted Gaussians", spread_text(ratios)));
  }
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

ReportSection cost_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "What it costs";
  section.text =
      "Noise on a rendered cube, files and all; and truth beside the radiance, and footprints by channel, as ratios of processor times of one thread, by turns.";
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
  add_groups(options, section);
  return section;
}

}  // namespace ifov::studies
