#include "honesty/rows_study.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "core/format.h"
#include "core/parallel.h"
#include "honesty/single_tile.h"

namespace ifov::benchmarks {

namespace {

constexpr double kFirstPitch_px = 0.2, kLastPitch_px = 40.0;
constexpr double kPrecision = 1e-5;
constexpr std::size_t kWorstShown = 10;

struct Judged {
  std::string document, description, rows;
  std::int64_t pixels = 0, outside = 0, converged = 0, outside_converged = 0, lies = 0, rays = 0;
  double worst_z = 0.0;
};

Judged judge(const RowsScene& scene, const std::string& name, std::uint64_t seed, const RowsStudy& study) {
  const std::filesystem::path file = study.work / (name + ".json");
  const std::string text = scene.write(study.work, name);
  std::ofstream(file) << text;
  const session::Session session = load_text(text, file);
  const sampling::TileResult result = render_tile(session, seed);
  const std::vector<double> truth = scene.radiance();

  Judged judged{file.string(), format("{}, seed {}", scene.description(), seed), {}};
  for (std::size_t p = 0; p < truth.size(); ++p) {
    const double error = std::abs(static_cast<double>(result.mean[p]) - truth[p]);
    const double half_width = static_cast<double>(result.half_width[p]);
    const double sigma = std::sqrt(static_cast<double>(result.variance_geometry[p]) +
                                   static_cast<double>(result.variance_path[p]));
    const bool wrong = error > kPrecision * truth[p], outside = wrong && error > half_width;
    ++judged.pixels;
    judged.outside += outside;
    judged.rays += static_cast<std::int64_t>(result.samples[p]);
    if (result.converged(p)) {
      ++judged.converged;
      judged.outside_converged += outside;
      judged.lies += wrong && error > 5.0 * half_width;
      if (wrong) judged.worst_z = std::max(judged.worst_z, sigma > 0.0 ? error / sigma : HUGE_VAL);
    }
    if (!study.rows.empty())
      judged.rows +=
          format("{},{},{},{},{:.8g},{:.8g},{:.4g},{:.4g},{},{}\n", name, seed,
                 p % static_cast<std::size_t>(scene.size_px), p / static_cast<std::size_t>(scene.size_px),
                 result.mean[p], truth[p], half_width, sigma, result.reasons[p], result.samples[p]);
  }
  return judged;
}

RowsOutcome summed(RowsScene::Form form, const std::vector<Judged>& scenes) {
  RowsOutcome outcome;
  outcome.form = form;
  Judged sum;
  for (const Judged& scene : scenes) {
    sum.pixels += scene.pixels;
    sum.outside += scene.outside;
    sum.converged += scene.converged;
    sum.outside_converged += scene.outside_converged;
    sum.lies += scene.lies;
    sum.rays += scene.rays;
    outcome.worst_z = std::max(outcome.worst_z, scene.worst_z);
    outcome.poor_scenes += scene.outside_converged * 10 > scene.converged;
    const double share = scene.converged > 0 ? static_cast<double>(scene.outside_converged) /
                                                   static_cast<double>(scene.converged)
                                             : 0.0;
    if (scene.outside_converged > 0)
      outcome.worst.push_back({scene.document, scene.description, share, scene.worst_z});
  }
  const auto all = static_cast<double>(sum.pixels), sure = std::max(1.0, static_cast<double>(sum.converged));
  outcome.pixels = sum.pixels;
  outcome.outside = static_cast<double>(sum.outside) / all;
  outcome.converged = static_cast<double>(sum.converged) / all;
  outcome.outside_converged = static_cast<double>(sum.outside_converged) / sure;
  outcome.lies = static_cast<double>(sum.lies) / sure;
  outcome.rays = static_cast<double>(sum.rays) / all;
  std::stable_sort(outcome.worst.begin(), outcome.worst.end(), [](const auto& a, const auto& b) {
    return a.outside != b.outside ? a.outside > b.outside : a.worst_z > b.worst_z;
  });
  if (outcome.worst.size() > kWorstShown) outcome.worst.resize(kWorstShown);
  return outcome;
}

}  // namespace

std::vector<RowsOutcome> run_rows_study(const RowsStudy& study) {
  std::filesystem::create_directories(study.work);
  std::ofstream rows;
  if (!study.rows.empty()) {
    rows.open(study.rows);
    rows << "scene,seed,x,y,mean,truth,half_width,sigma,reasons,samples\n";
  }
  std::vector<RowsOutcome> outcomes;
  for (const RowsScene::Form form : {RowsScene::Form::map, RowsScene::Form::boxes, RowsScene::Form::mesh}) {
    std::vector<Judged> judged(static_cast<std::size_t>(study.steps));
    parallel_for(study.steps, study.threads, [&](std::int64_t k) {
      const double step = study.steps > 1 ? static_cast<double>(k) / (study.steps - 1) : 0.5;
      RandomStream random(study.first_seed,
                          static_cast<std::uint64_t>(k) * 3 + static_cast<std::uint64_t>(form));
      const RowsScene scene =
          rows_at_random(form, kFirstPitch_px * std::pow(kLastPitch_px / kFirstPitch_px, step), random);
      judged[static_cast<std::size_t>(k)] = judge(
          scene, format("rows_{}_{}_{}", name_of(form), study.first_seed, k), random.bits() >> 12, study);
    });
    for (const Judged& scene : judged) rows << scene.rows;
    outcomes.push_back(summed(form, judged));
  }
  if (!study.rows.empty() && !rows.flush()) throw std::runtime_error("cannot write " + study.rows.string());
  return outcomes;
}

}  // namespace ifov::benchmarks
