#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "analysis/spectral_projection.h"
#include "core/error.h"
#include "io/json/json_writer.h"
#include "sampling/intervals/quantiles.h"
#include "viewer/answers/answers.h"
#include "viewer/sources/open_run.h"

namespace ifov::viewer {
namespace {

constexpr int kMostPoints = 1 << 20;
constexpr std::size_t kMostScores = std::size_t{4} << 20;       // 16 MiB of floats
constexpr std::size_t kMostCubeValues = std::size_t{12} << 20;  // 48 MiB of floats
constexpr int kMostAxes = 10;

/// The pixels that Answers::band() takes at this step, of some bands, the bands of a pixel side by side.
std::vector<float> thinned(const io::EnviReader& reader, const std::vector<int>& bands, int step) {
  const io::EnviHeader& header = reader.header();
  std::vector<float> values, line(static_cast<std::size_t>(header.samples));
  const auto apart = static_cast<std::size_t>(step), lines = static_cast<std::size_t>(header.lines);
  const std::size_t columns = (line.size() + apart - 1) / apart, rows = (lines + apart - 1) / apart;
  values.resize(rows * columns * bands.size());
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t b = 0; b < bands.size(); ++b) {
      reader.read(static_cast<int>(thinned_place(y, apart, lines)), bands[b], line);
      for (std::size_t x = 0; x < columns; ++x)
        values[(y * columns + x) * bands.size() + b] = line[thinned_place(x, apart, line.size())];
    }
  return values;
}

/// Pixels of which all bands are numbers, by position, and their values alone.
std::vector<std::size_t> keep_whole(std::vector<float>& values, std::size_t bands) {
  std::vector<std::size_t> kept;
  for (std::size_t p = 0; p < values.size() / bands; ++p) {
    const float* pixel = &values[p * bands];
    if (!std::all_of(pixel, pixel + bands, [](float v) { return std::isfinite(v); })) continue;
    std::copy(pixel, pixel + bands, &values[kept.size() * bands]);
    kept.push_back(p);
  }
  values.resize(kept.size() * bands);
  return kept;
}

/// Mean square of the errors of each band, where they are known.
std::vector<double> mean_squares(const std::vector<float>& values, std::size_t bands) {
  std::vector<double> sums(bands, 0.0), counts(bands, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    sums[i % bands] += double(values[i]) * values[i];
    counts[i % bands] += 1.0;
  }
  for (std::size_t b = 0; b < bands; ++b) sums[b] /= std::max(1.0, counts[b]);
  return sums;
}

struct Noise {
  std::vector<double> variance;
  std::string from;
};

Noise noise_of(const OpenRun& run, const std::vector<int>& bands, int step) {
  double scale = 1.0;
  const OpenRun::Cube* cube = run.cube("standard_error");
  std::string from = "standard errors";
  if (cube == nullptr) {
    cube = run.cube("half_width");
    scale = 1.0 /
            sampling::two_sided_normal(run.confidence > 0.0 && run.confidence < 1.0 ? run.confidence : 0.95);
    from = "half-widths, taken for those of normal errors";
  }
  if (cube == nullptr)
    throw Refused(400, "the run tells no errors (standard_error or half_width), which this transform needs");
  Noise noise{mean_squares(thinned(cube->reader, bands, step), bands.size()), from};
  for (double& variance : noise.variance) variance *= scale * scale;
  if (std::none_of(noise.variance.begin(), noise.variance.end(), [](double v) { return v > 0.0; }))
    throw Refused(400, "all errors of the run are 0 or unknown, and this transform needs them");
  return noise;
}

}  // namespace

Answer Answers::projection(const Query& query) {
  const auto run = this->run(query);
  constexpr std::array<std::string_view, 3> kinds{"bands", "pca", "mnf"};
  const std::string kind = query.choice("kind", kinds);
  const io::EnviReader& reader = run->cubes.front().reader;
  const int all = reader.header().bands;
  std::vector<int> bands;
  if (kind == "bands")
    for (const char* name : {"a", "b", "c"}) bands.push_back(query.integer(name, 0, all - 1));
  else
    for (int b = 0; b < all; ++b) bands.push_back(b);
  const std::size_t most = std::min({static_cast<std::size_t>(query.integer("most", 3, kMostPoints)),
                                     kMostCubeValues / bands.size(),
                                     kMostScores / std::min<std::size_t>(bands.size(), kMostAxes)});
  int step = 1;
  const auto count = [&](int s) {
    return static_cast<std::size_t>((run->width_px + s - 1) / s) *
           static_cast<std::size_t>((run->height_px + s - 1) / s);
  };
  while (count(step) > most) ++step;
  std::vector<float> values = thinned(reader, bands, step);
  const std::size_t all_points = count(step);
  const std::vector<std::size_t> kept = keep_whole(values, bands.size());
  if (kept.size() < 3) throw Refused(400, "fewer than three pixels hold values");

  std::vector<float> scores;
  std::vector<double> strength;
  std::string noise_from;
  std::size_t axis_count = bands.size();
  if (kind == "bands") {
    scores = std::move(values);
  } else {
    const analysis::CubeView view{values, static_cast<int>(kept.size()), 1, static_cast<int>(bands.size())};
    analysis::SpectralAxes axes;
    if (kind == "pca") {
      axes = analysis::principal_axes(view, kMostAxes);
    } else {
      const Noise noise = noise_of(*run, bands, step);
      noise_from = noise.from;
      axes = analysis::minimum_noise_axes(view, noise.variance, kMostAxes);
    }
    scores = analysis::project(axes, view);
    strength = axes.strength;
    axis_count = static_cast<std::size_t>(axes.count());
  }
  // On the whole grid, so that a point's place in the image follows from its number.
  std::vector<float> whole(all_points * axis_count, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t k = 0; k < kept.size(); ++k)
    std::copy_n(&scores[k * axis_count], axis_count, &whole[kept[k] * axis_count]);
  io::JsonWriter about(io::JsonWriter::Layout::compact);
  about.object([&] {
    about.member("step", step);
    about.member("columns", (run->width_px + step - 1) / step);
    about.member("rows", (run->height_px + step - 1) / step);
    about.member("axes", axis_count);
    about.member("strength", strength);
    about.member("noise", noise_from);
  });
  return numbers(whole, about.written());
}

}  // namespace ifov::viewer
