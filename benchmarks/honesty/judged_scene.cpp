#include "honesty/judged_scene.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include "core/format.h"
#include "honesty/plain_truth.h"
#include "honesty/single_tile.h"
#include "sensor/camera.h"

namespace ifov::benchmarks {

namespace {

constexpr double kPrecision = 1e-5;
constexpr double kFloor = 0.003;  // of the value: a third of it is what a reference need not be better than

struct Value {
  double mean = 0.0, half_width = 0.0, sigma = 0.0;
  bool converged = false;
};

Value value_of(const sampling::TileResult& result, PixelIndex pixel, std::size_t channel) {
  const auto p = static_cast<std::size_t>(pixel.y * result.tile.width() + pixel.x);
  const std::size_t k = p * static_cast<std::size_t>(result.columns) + channel;
  return {static_cast<double>(result.mean[k]), static_cast<double>(result.half_width[k]),
          std::sqrt(static_cast<double>(result.variance_geometry[k]) +
                    static_cast<double>(result.variance_path[k])),
          result.converged(p)};
}

std::vector<PixelIndex> chosen_pixels(const PlainTruth* truth, int width, int height, int count,
                                      std::uint64_t key) {
  std::vector<std::size_t> order(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (count > 0 && static_cast<std::size_t>(count) < order.size()) {
    const auto half = static_cast<std::size_t>(count / 2);
    if (truth != nullptr) {
      const std::vector<double> spread = truth->spread(key);
      std::stable_sort(order.begin(), order.end(),
                       [&](std::size_t a, std::size_t b) { return spread[a] > spread[b]; });
    }
    RandomStream random(key, 0x706978656c73);
    const std::size_t first = truth != nullptr ? half : 0;
    for (std::size_t k = first; k < static_cast<std::size_t>(count); ++k)
      std::swap(order[k], order[k + random.index(order.size() - k)]);
    order.resize(static_cast<std::size_t>(count));
    std::sort(order.begin(), order.end());
  }
  std::vector<PixelIndex> pixels;
  for (const std::size_t k : order)
    pixels.push_back({static_cast<int>(k) % width, static_cast<int>(k) / width});
  return pixels;
}

double error_of(const Value& value, const PlainTruthPixel& truth, std::size_t channel) {
  const double low = truth.mean[channel], high = low + truth.above[channel];
  const double error = std::max({0.0, low - value.mean, value.mean - high});
  return error > kPrecision * low ? error : 0.0;
}

bool is_confidently_wrong(const Value& value, const PlainTruthPixel& truth, std::size_t channel) {
  const double error = error_of(value, truth, channel), reference = truth.error[channel];
  return value.converged && error > 5.0 * value.half_width && error > 5.0 * reference;
}

}  // namespace

std::string summary(const JudgedScene& s) {
  return format(
      "{}: coverage {:.3f} of {} converged values, {:.1f} % converged, {} off by more than 5 half-widths, worst z {:.3g}, "
      "reference {:.2f} of the half-width, left out {}, {:.0f} rays a pixel; {}",
      s.name, s.coverage(), s.converged(),
      s.values > 0 ? 100.0 * static_cast<double>(s.converged()) / static_cast<double>(s.values) : 0.0, s.lies,
      s.worst_z, s.reference, s.left_out, s.rays, s.worst);
}

JudgedScene judge_scene(const WildScene& scene, const std::filesystem::path& folder, const Judging& judging) {
  const session::Session session = load_text(scene.document, folder / (scene.name + ".json"));
  const auto& parts = session.parts();
  const int width = parts.camera->width_px(), height = parts.camera->height_px();
  const std::size_t channels = parts.channels.size();
  const std::uint64_t key = judging.first_seed * 7919u + 13u;
  JudgedScene judged;
  judged.kind = scene.kind;
  judged.name = scene.name;
  judged.exact = !scene.exact.empty();

  std::unique_ptr<PlainTruth> tracer;
  if (!judged.exact) tracer = std::make_unique<PlainTruth>(session, scene.hints);
  const std::vector<PixelIndex> pixels =
      chosen_pixels(tracer.get(), width, height, judged.exact ? 0 : judging.pixels, key);

  std::vector<sampling::TileResult> results;
  for (int k = 0; k < judging.seeds; ++k) {
    sampling::TileResult& result =
        results.emplace_back(render_tile(session, judging.first_seed + static_cast<std::uint64_t>(k)));
    for (float& half_width : result.half_width) half_width *= static_cast<float>(judging.boast);
    for (auto* variances : {&result.variance_geometry, &result.variance_path})
      for (float& variance : *variances) variance *= static_cast<float>(judging.boast * judging.boast);
    for (const std::uint32_t samples : results.back().samples)
      judged.rays += samples / (static_cast<double>(results.back().samples.size()) * judging.seeds);
  }

  const auto wanted = [&](std::span<const PixelIndex> of) {
    return [&results, of, channels](std::size_t p, std::span<const double> means) {
      std::vector<double> errors(channels);
      for (std::size_t c = 0; c < channels; ++c) {
        double least = HUGE_VAL;
        for (const auto& result : results) {
          const Value value = value_of(result, of[p], c);
          if (value.converged) least = std::min(least, value.half_width);
        }
        // Nothing is sure of itself here: nothing to judge.
        errors[c] = least < HUGE_VAL ? std::max(least, kFloor * means[c]) / 3.0 : HUGE_VAL;
      }
      return errors;
    };
  };
  std::vector<PlainTruthPixel> truth;
  if (judged.exact)
    for (const PixelIndex& pixel : pixels)
      truth.push_back({{scene.exact[static_cast<std::size_t>(pixel.y * width + pixel.x)]}, {0.0}, {0.0}});
  else
    truth = tracer->pixels(pixels, wanted(pixels), judging.most_paths, judging.most_photons, key);

  if (tracer) {  // a second opinion where it matters
    std::vector<PixelIndex> again;
    std::vector<std::size_t> places;
    for (std::size_t p = 0; p < pixels.size(); ++p)
      for (const auto& result : results)
        for (std::size_t c = 0; c < channels; ++c)
          if (is_confidently_wrong(value_of(result, pixels[p], c), truth[p], c) &&
              (places.empty() || places.back() != p)) {
            places.push_back(p);
            again.push_back(pixels[p]);
          }
    if (!again.empty()) {
      const auto usual = wanted(again);
      const auto finer = [&](std::size_t p, std::span<const double> means) {
        std::vector<double> errors = usual(p, means);
        for (double& error : errors) error *= 0.5;
        return errors;
      };
      const std::vector<PlainTruthPixel> second =
          tracer->pixels(again, finer, 4.0 * judging.most_paths, judging.most_photons, key + 1);
      for (std::size_t k = 0; k < again.size(); ++k) truth[places[k]] = second[k];
    }
  }

  std::ofstream rows;
  if (!judging.rows.empty()) {
    rows.open(judging.rows);
    rows << "seed,x,y,channel,mean,truth,reference_error,above,half_width,sigma,reasons\n";
  }
  std::int64_t compared = 0;
  for (std::size_t s = 0; s < results.size(); ++s)
    for (std::size_t p = 0; p < pixels.size(); ++p)
      for (std::size_t c = 0; c < channels; ++c) {
        const Value value = value_of(results[s], pixels[p], c);
        const double error = error_of(value, truth[p], c), reference = truth[p].error[c];
        if (rows.is_open())
          rows << format("{},{},{},{},{:.8g},{:.8g},{:.3g},{:.3g},{:.4g},{:.4g},{}\n", s, pixels[p].x,
                         pixels[p].y, c, value.mean, truth[p].mean[c], reference, truth[p].above[c],
                         value.half_width, value.sigma,
                         results[s].reasons[static_cast<std::size_t>(pixels[p].y * width + pixels[p].x)]);
        const bool lie = is_confidently_wrong(value, truth[p], c);
        const double bound = std::max(value.half_width, kFloor * truth[p].mean[c]) / 3.0;
        // A little more than what was aimed at is borne.
        if (value.converged && !lie && (reference > 1.2 * bound || truth[p].above[c] > bound)) {
          ++judged.left_out;
          continue;
        }
        ++judged.values;
        if (!value.converged) {
          ++judged.honest;
          judged.wrong_unsure += error > value.half_width + 2.0 * reference;
          continue;
        }
        judged.right += error <= value.half_width + 2.0 * reference;
        judged.lies += lie;
        const double sigma = std::hypot(value.sigma, reference);
        const double z = error == 0.0 ? 0.0 : sigma > 0.0 ? error / sigma : HUGE_VAL;
        const double ratio = error == 0.0             ? 0.0
                             : value.half_width > 0.0 ? error / value.half_width
                                                      : HUGE_VAL;
        judged.far += z > 4.0;
        judged.worst_ratio = std::max(judged.worst_ratio, ratio);
        if (value.half_width > 0.0) {
          judged.reference += reference / value.half_width;
          ++compared;
        }
        if (z > judged.worst_z || (z == judged.worst_z && z > 0.0 && judged.worst.empty())) {
          judged.worst_z = z;
          judged.worst = format("pixel ({}, {}) seed {}: {:.5g} +- {:.2g}, truly {:.5g} +- {:.1g}",
                                pixels[p].x, pixels[p].y, judging.first_seed + s, value.mean,
                                value.half_width, truth[p].mean[c], reference);
        }
      }
  if (compared > 0) judged.reference /= static_cast<double>(compared);
  return judged;
}

}  // namespace ifov::benchmarks
