#include "honesty/image_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "core/format.h"
#include "core/parallel.h"
#include "honesty/plain_reference.h"
#include "honesty/random_stream.h"
#include "honesty/scene_run.h"
#include "honesty/single_tile.h"
#include "io/document/cameras/orthographic_camera.h"
#include "io/document/document.h"
#include "io/document/samplers/accuracy_sampling.h"
#include "render/field/scene_field.h"
#include "render/image_renderer.h"
#include "sampling/image/audit.h"
#include "sampling/image/audited_sampler.h"
#include "sampling/image/image_sampler.h"
#include "sensor/camera.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "transport/spectral_scene.h"

namespace ifov::benchmarks {

namespace {

constexpr int kSide_px = 36, kJudged = 240;
constexpr double kOfProducts = 1e-5;  // of products
constexpr std::size_t kFewest = 30;   // pixels that tell the coverage of a class
constexpr std::uint32_t kMostSamples = 100000;

session::Session load_image(const ImageCase& which, const std::filesystem::path& work) {
  io::Document document = read_scene(which.scene, work);
  const auto* camera = dynamic_cast<const io::OrthographicCamera*>(document.sensor.camera.settings.get());
  const auto* accuracy = dynamic_cast<const io::AccuracySampling*>(document.sampling.method.get());
  if (camera == nullptr || accuracy == nullptr)
    throw std::runtime_error(which.scene + " has no orthographic camera, or asks for no accuracy");
  io::OrthographicCamera finer = *camera;
  finer.gsd_m *= 0.5;
  finer.size = {kSide_px, kSide_px};
  document.sensor.camera.settings = std::make_shared<const io::OrthographicCamera>(finer);
  io::AccuracySampling of_image = *accuracy;
  of_image.of = io::AccuracySampling::Of::image;
  of_image.pooling = true;
  of_image.audit = which.audited;
  of_image.lattice.reset();
  document.sampling.method = std::make_shared<const io::AccuracySampling>(of_image);
  return session::Session::load(document, nullptr);
}

std::vector<PixelIndex> judged_pixels() {
  std::vector<int> order(static_cast<std::size_t>(kSide_px) * kSide_px);
  std::iota(order.begin(), order.end(), 0);
  RandomStream random(77, 0x696d616765);
  std::vector<PixelIndex> pixels;
  for (std::size_t k = 0; k < kJudged; ++k) {
    std::swap(order[k], order[k + random.index(order.size() - k)]);
    pixels.push_back({order[k] % kSide_px, order[k] / kSide_px});
  }
  return pixels;
}

}  // namespace

ImageOutcome run_image_case(const ImageCase& which, const std::filesystem::path& work) {
  const session::Session session = load_image(which, work);
  const session::Session::Parts& parts = session.parts();
  const sampling::AuditedSampler planted(
      std::make_unique<sampling::ImageSampler>(kMostSamples,
                                               sampling::ImageSampler::Pooling{true, which.trust}),
      which.audited);
  std::vector<sampling::TileResult> results(static_cast<std::size_t>(which.seeds));
  parallel_for(which.seeds, 0, [&](std::int64_t k) {
    const render::RenderJob plan = parts.job();
    render::RenderJob job{plan.scene, plan.camera, plan.footprint,
                          which.trust < 1.0 ? planted : plan.sampler};
    job.tolerance = plan.tolerance;
    job.transport = plan.transport;
    job.label_detail = plan.label_detail;
    job.tile_px = plan.tile_px;
    job.steering_channels = plan.steering_channels;
    job.seed = which.first_seed + static_cast<std::uint64_t>(k);
    results[static_cast<std::size_t>(k)] = render_tile(job);
  });

  const std::vector<PixelIndex> pixels = judged_pixels();
  const std::size_t columns = parts.channels.size();
  const auto place = [](const PixelIndex& pixel) {
    return static_cast<std::size_t>(pixel.y) * kSide_px + static_cast<std::size_t>(pixel.x);
  };
  // To an eighth of the half-width, or of half the mean one where a pixel's own is smaller still.
  std::vector<double> wanted(pixels.size() * columns), mean(columns);
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    wanted[k] =
        static_cast<double>(results[0].half_width[place(pixels[k / columns]) * columns + k % columns]);
    mean[k % columns] += wanted[k] / static_cast<double>(pixels.size());
  }
  for (std::size_t k = 0; k < wanted.size(); ++k)
    wanted[k] = std::max(wanted[k], 0.5 * mean[k % columns]) / 8.0;
  const PlainMeans reference = plain_means(
      [&parts] {
        return std::make_unique<render::SceneField>(*parts.spectral_scene, *parts.camera,
                                                    parts.job().transport, render::LabelDetail::material,
                                                    parts.job().polarimetry);
      },
      static_cast<int>(columns), *parts.footprint, {}, pixels, wanted, 4096, std::int64_t{1} << 21, 78, 0);

  ImageOutcome out;
  struct Sums {
    std::array<double, 2> count{}, held{};
    double unaudited = 0.0, exact = 0.0, squares = 0.0, own = 0.0, stated = 0.0;
  };
  std::vector<Sums> sums(columns);
  for (const sampling::TileResult& result : results) {
    const std::vector<sampling::Audit::PixelClass> classes = sampling::classes_of(result);
    for (std::size_t c = 0; c < columns; ++c) {
      const sampling::ColumnError& told = result.column_errors[c];
      sums[c].stated += told.variance_sum * (told.audited > 0.0f ? static_cast<double>(told.audited) : 1.0) /
                        static_cast<double>(result.samples.size());
    }
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      const std::size_t p = place(pixels[k]);
      out.samples_per_pixel += result.samples[p] / static_cast<double>(pixels.size() * results.size());
      for (std::size_t c = 0; c < columns; ++c) {
        Sums& sum = sums[c];
        const std::size_t at = p * columns + c, of = k * columns + c;
        const double error = std::abs(static_cast<double>(result.mean[at]) - reference.mean[of]),
                     slack = 2.0 * reference.standard_error[of],
                     sigma = std::sqrt(static_cast<double>(result.variance_geometry[at]) +
                                       static_cast<double>(result.variance_path[at]));
        sum.count[classes[p]] += 1.0;
        sum.held[classes[p]] += error <= std::hypot(static_cast<double>(result.half_width[at]), slack);
        sum.unaudited += error <= std::hypot(1.96 * sigma, slack);
        sum.exact += error <= kOfProducts * reference.mean[of];
        sum.squares += error * error;
        sum.own += reference.standard_error[of] * reference.standard_error[of];
      }
    }
  }
  for (std::size_t c = 0; c < columns; ++c) {
    const Sums& sum = sums[c];
    const double count = sum.count[0] + sum.count[1], seeds = static_cast<double>(results.size());
    ImageOutcome::Channel channel;
    channel.name = parts.info.channels[c].name;
    for (const std::size_t k : {0, 1})
      channel.of_class[k] = sum.count[k] >= kFewest * seeds ? sum.held[k] / sum.count[k]
                                                            : std::numeric_limits<double>::quiet_NaN();
    channel.coverage = (sum.held[0] + sum.held[1]) / count;
    channel.unaudited = sum.unaudited / count;
    channel.exact = sum.exact / count;
    channel.stated_to_true =
        std::sqrt((sum.stated / seeds) / std::max(1e-300, (sum.squares - sum.own) / count));
    out.channels.push_back(channel);
  }
  return out;
}

namespace {

void print_image(const std::string& name, const ImageOutcome& outcome) {
  for (const ImageOutcome::Channel& c : outcome.channels)
    std::printf(
        "    %-20s %-9s coverage %.4f (one material %.3f, several %.3f)  1.96 sigma %.3f  stated/true RMS %.2f  exact %.2f\n",
        name.c_str(), c.name.c_str(), c.coverage, c.of_class[0], c.of_class[1], c.unaudited, c.stated_to_true,
        c.exact);
  std::printf("    %-20s %.0f samples a pixel\n", "", outcome.samples_per_pixel);
  std::fflush(stdout);
}

}  // namespace

std::vector<FigureRow> report_images(const std::string& only, int seeds, std::uint64_t first_seed,
                                     const std::filesystem::path& work) {
  // Of 200 audited pixels the quantile is known to a coverage of 0.016, and as much is allowed to few seeds twice.
  const double slack = 0.02 + 2.0 * 0.016 / std::sqrt(static_cast<double>(seeds)), low = 0.95 - slack,
               high = 0.95 + slack;
  const std::string must = format("{:.3f} to {:.3f}", low, high);
  std::vector<FigureRow> rows;
  for (const char* scene :
       {"penumbra", "leaf_crown", "wall_foot", "gable_roof", "texture", "mirror", "street_canyon",
        "glossy_car", "waves", "glass_front", "wet_road", "fences", "patchwork", "aligned_edge"}) {
    if (!only.empty() && only != scene) continue;
    const ImageOutcome outcome = run_image_case({scene, seeds, first_seed}, work);
    print_image(scene, outcome);
    double worst = 0.95, stated = std::numeric_limits<double>::infinity();
    bool held = true;
    for (const ImageOutcome::Channel& c : outcome.channels) {
      // Pixels without an error hold it.
      held = held && c.coverage >= low && c.coverage <= std::max(high, low + c.exact);
      if (std::abs(c.coverage - 0.95) >= std::abs(worst - 0.95)) worst = c.coverage;
      if (std::isfinite(c.stated_to_true)) stated = std::min(stated, c.stated_to_true);
    }
    const std::string name = std::string("image_") + scene;
    rows.push_back({name, format("{:.5f}", worst), "coverage", must, held});
    rows.push_back({name + "_stated", format("{:.4f}", stated), "of true RMS", "", true});
  }
  if (only.empty() || only == "fault") {
    ImageCase fault{"leaf_crown", seeds, first_seed};
    fault.trust = 0.01;
    const ImageOutcome outcome = run_image_case(fault, work);
    print_image("fault", outcome);
    // The audit sees through what the samples believe of themselves.
    double believed = 1.0, audited = 1.0;
    for (const ImageOutcome::Channel& c : outcome.channels) {
      believed = std::min(believed, c.unaudited);
      audited = std::min(audited, c.coverage);
    }
    rows.push_back({"image_fault_pooled_too_much", format("{:.5f}", audited), "coverage",
                    format("{:.3f} or more, where without an audit it is less than {:.2f}", low, 0.93),
                    audited >= low && believed < 0.93});
  }
  return rows;
}

}  // namespace ifov::benchmarks
