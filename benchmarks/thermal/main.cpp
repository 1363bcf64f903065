// Are solved temperatures right in scenes by chance? Points of each, as images draw them, against each solved in full by itself with many rays.
//   bench_thermal --wild N --work FOLDER [--first-seed N] [--points N] [--rows FILE]

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "core/format.h"
#include "honesty/figure_row.h"
#include "thermal/judged_points.h"

namespace {

using namespace ifov::benchmarks;

struct Totals {
  std::size_t points = 0, covered = 0, faults = 0;
  double squares_k2 = 0.0, sum_k = 0.0, told_k2 = 0.0, scatter_k2 = 0.0;
};

}  // namespace

int main(int argc, char** argv) {
  std::string work = ".", rows_file, document, output;
  double reach_m = 10.0, top_m = 10.0, boast = 1.0;
  int scenes = 10, points = 12, threads = 0;
  std::uint64_t first_seed = 1;
  ThermalEffort effort;
  CLI::App app{"Solved temperatures of scenes by chance against full solutions of their points"};
  app.add_option("--wild", scenes, "scenes")->check(CLI::Range(1, 1000000));
  app.add_option("--first-seed", first_seed, "number of the first; the others follow");
  app.add_option("--document", document,
                 "points of this one, at x and y up to --reach metres and z up to --top");
  app.add_option("--reach", reach_m, "metres")->needs("--document");
  app.add_option("--top", top_m, "metres")->needs("--document");
  app.add_option("--points", points, "of each")->check(CLI::Range(1, 100000));
  app.add_option("--rays", effort.rays_beside, "to what is about a point, of each of its four solutions");
  app.add_option("--depth", effort.depth, "surfaces behind those, in the full solutions");
  app.add_option("--draws", effort.draws, "of images' estimates");
  app.add_option("--work", work, "folder for the documents");
  app.add_option("--boast", boast, "a planted fault: half-widths are taken to be this times what they are")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--output", output, "figures");
  app.add_option("--rows", rows_file, "CSV of all points");
  app.add_option("--threads", threads, "0: all cores");
  CLI11_PARSE(app, argc, argv);
  std::filesystem::create_directories(work);
  std::ofstream rows;
  if (!rows_file.empty()) rows.open(rows_file);
  rows
      << "seed,x,y,z,material,up,from_above,free_sky,sun_share,image_k,full_k,off_k,noise_k,class_off_k,half_width_k,image_error_k,told_error_k,beside_k,linear_k\n";
  Totals all;
  int failed = 0;
  for (std::uint64_t seed = first_seed; seed < first_seed + static_cast<std::uint64_t>(scenes); ++seed) {
    WildThermal wild;
    std::filesystem::path path = document;
    if (document.empty()) {
      wild = wild_thermal(seed, work);
      path = std::filesystem::path(work) / ifov::format("wild_{}.json", seed);
      std::ofstream(path) << wild.text;
    } else {
      std::ostringstream text;
      text << std::ifstream(path).rdbuf();
      wild = {text.str(), document, reach_m, top_m};
    }
    std::vector<JudgedPoint> judged;
    try {
      judged =
          judge_points(wild.text, path.string(), wild.reach_m, wild.top_m, points, seed, effort, threads);
    } catch (const std::exception& error) {
      std::printf("%6llu  FAILED %s\n        %s\n", static_cast<unsigned long long>(seed), error.what(),
                  wild.kind.c_str());
      ++failed;
      continue;
    }
    std::size_t covered = 0;
    double worst_k = 0.0;
    for (JudgedPoint& p : judged) {
      p.half_width_k *= boast;
      const double beyond_k = std::max(0.0, std::abs(p.off_k()) - 2.0 * p.noise_k());
      covered += beyond_k <= p.half_width_k;
      worst_k = std::max(worst_k, std::abs(p.off_k()));
      all.squares_k2 += p.off_k() * p.off_k() - p.noise_k() * p.noise_k();
      all.sum_k += p.off_k();
      all.told_k2 += p.told_error_k * p.told_error_k;
      all.scatter_k2 += p.image_error_k * p.image_error_k;
      rows << ifov::format(
          "{},{:.3f},{:.3f},{:.3f},{},{:.3f},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}\n",
          seed, p.x, p.y, p.z, p.material, p.up, p.from_above ? 1 : 0, p.free_sky, p.sun_share, p.image_k,
          p.full_k, p.off_k(), p.noise_k(), p.class_off_k, p.half_width_k, p.image_error_k, p.told_error_k,
          p.beside_k, p.linear_k);
      if (beyond_k > 3.0 * p.half_width_k || beyond_k > std::max(1.0, p.half_width_k)) {
        ++all.faults;
        std::printf(
            "    !! (%.2f, %.2f, %.2f) %-7s up %+.2f sky %.2f sun %.2f: image %.2f full %.2f off %+.2f +-%.2f (class %+.3f beside %+.2f linear %+.2f) half-width %.2f\n",
            p.x, p.y, p.z, p.material.c_str(), p.up, p.free_sky, p.sun_share, p.image_k, p.full_k, p.off_k(),
            p.noise_k(), p.class_off_k, p.beside_k, p.linear_k, p.half_width_k);
      }
    }
    all.points += judged.size();
    all.covered += covered;
    std::printf("%6llu  %zu points, %zu covered, worst %.2f K  %s\n", static_cast<unsigned long long>(seed),
                judged.size(), covered, worst_k, wild.kind.c_str());
    std::fflush(stdout);
    rows.flush();
  }
  const double count = static_cast<double>(std::max<std::size_t>(all.points, 1));
  std::printf(
      "%zu points: covered %.4f, faults %zu, root mean square %.3f K, mean %+.4f K, told over found scatter %.3f; %d documents failed\n",
      all.points, static_cast<double>(all.covered) / count, all.faults,
      std::sqrt(std::max(0.0, all.squares_k2 / count)), all.sum_k / count,
      std::sqrt(all.told_k2 / std::max(1e-30, all.scatter_k2)), failed);
  const double covered = static_cast<double>(all.covered) / count;
  const double told = std::sqrt(all.told_k2 / std::max(1e-30, all.scatter_k2));
  const std::vector<FigureRow> figures = {
      {"thermal_points", ifov::format("{}", all.points), "points", "", true},
      {"thermal_covered", ifov::format("{:.4f}", covered), "coverage", "0.93 to 1", covered >= 0.93},
      {"thermal_faults", ifov::format("{}", all.faults), "points off by 3 half-widths, or 1 K", "0",
       all.faults == 0},
      {"thermal_scatter", ifov::format("{:.3f}", told), "times what is found", "0.9 to 1.2",
       told > 0.9 && told < 1.2},
      {"thermal_failures", ifov::format("{}", failed), "documents", "0", failed == 0}};
  if (!output.empty()) std::ofstream(output) << json(figures);
  return failed > 0 || all.faults > 0;
}
