#include "honesty/wild_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <mutex>
#include <stdexcept>

#include "core/format.h"
#include "core/parallel.h"

namespace ifov::benchmarks {

namespace {

constexpr std::size_t kWorstShown = 12;
constexpr double kPoorCoverage = 0.9;

struct Totals {
  int scenes = 0, poor = 0;
  std::int64_t values = 0, converged = 0, right = 0, lies = 0, far = 0, left_out = 0, wrong_unsure = 0;
  double worst_z = 0.0;

  void add(const JudgedScene& scene) {
    ++scenes;
    poor += scene.coverage() < kPoorCoverage;
    values += scene.values;
    converged += scene.converged();
    right += scene.right;
    lies += scene.lies;
    far += scene.far;
    left_out += scene.left_out;
    wrong_unsure += scene.wrong_unsure;
    worst_z = std::max(worst_z, scene.worst_z);
  }
  double share(std::int64_t count, std::int64_t of) const {
    return of > 0 ? static_cast<double>(count) / static_cast<double>(of) : 0.0;
  }
};

void print(const std::string& name, const Totals& t) {
  std::printf(
      "    %-12s %4d scenes, coverage below 0.9 in %3d; %6lld values, converged %6.2f %%, of them held %6.2f %%, off by more "
      "than 5 half-widths %6.3f %%, |z| > 4 %6.3f %%, worst z %-7.3g; left out %lld\n",
      name.c_str(), t.scenes, t.poor, static_cast<long long>(t.values),
      100.0 * t.share(t.converged, t.values), 100.0 * t.share(t.right, t.converged),
      100.0 * t.share(t.lies, t.converged), 100.0 * t.share(t.far, t.converged), t.worst_z,
      static_cast<long long>(t.left_out));
}

bool suspicious(const JudgedScene& scene) {
  return scene.lies > 0 || scene.far > 0 || scene.coverage() < kPoorCoverage;
}

bool worse(const JudgedScene& a, const JudgedScene& b) {
  if (a.lies != b.lies) return a.lies > b.lies;
  if (a.coverage() != b.coverage()) return a.coverage() < b.coverage();
  return a.worst_z > b.worst_z;
}

std::vector<std::uint64_t> numbers_of(const WildRun& run) {
  for (const std::string& kind : run.kinds)
    if (std::find(wild_kinds().begin(), wild_kinds().end(), kind) == wild_kinds().end()) {
      std::string all;
      for (const std::string_view known : wild_kinds()) all += (all.empty() ? "" : ", ") + std::string(known);
      throw std::runtime_error(format("no kind of scene '{}': choose from {}", kind, all));
    }
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t number = run.first_seed; numbers.size() < static_cast<std::size_t>(run.scenes); ++number)
    if (run.kinds.empty() || std::find(run.kinds.begin(), run.kinds.end(),
                                       wild_kinds()[number % wild_kinds().size()]) != run.kinds.end())
      numbers.push_back(number);
  return numbers;
}

}  // namespace

std::vector<FigureRow> report_wild_run(const WildRun& run) {
  std::filesystem::create_directories(run.work);
  const std::vector<std::uint64_t> numbers = numbers_of(run);
  std::vector<JudgedScene> judged(numbers.size());
  std::vector<std::string> failures;
  std::mutex mutex;
  parallel_for(static_cast<std::int64_t>(numbers.size()), run.threads, [&](std::int64_t k) {
    const auto place = static_cast<std::size_t>(k);
    const WildScene scene = wild_scene(numbers[place], run.work);
    Judging judging = run.judging;
    judging.first_seed = numbers[place] * 1000u + 1u;
    if (!judging.rows.empty()) judging.rows /= scene.name + ".csv";
    try {
      judged[place] = judge_scene(scene, run.work, judging);
      if (suspicious(judged[place])) {  // long runs may be ended before their time
        const std::scoped_lock lock(mutex);
        std::fprintf(stderr, "found: %s\n", summary(judged[place]).c_str());
      }
    } catch (const std::runtime_error& error) {  // a document that the program refuses is a finding too
      const std::scoped_lock lock(mutex);
      failures.push_back(scene.name + ": " + error.what());
    }
  });
  std::erase_if(judged, [](const JudgedScene& scene) { return scene.name.empty(); });

  std::map<std::string, Totals> kinds;
  Totals all;
  for (const JudgedScene& scene : judged) {
    kinds[scene.kind].add(scene);
    all.add(scene);
  }
  for (const auto& [kind, totals] : kinds) print(kind, totals);
  print("all", all);
  std::stable_sort(judged.begin(), judged.end(), worse);
  for (std::size_t k = 0; k < std::min(kWorstShown, judged.size()); ++k) {
    const JudgedScene& scene = judged[k];
    if (!suspicious(scene)) break;
    std::printf("      %s\n", summary(scene).c_str());
    std::ofstream(run.work / (scene.name + ".json"), std::ios::app) << "// Found: " << summary(scene) << '\n';
  }
  for (const std::string& failure : failures) std::printf("      does not run: %s\n", failure.c_str());
  std::fflush(stdout);

  const double poor = static_cast<double>(all.poor) / std::max(1, all.scenes);
  return {
      {"wild_poor_scenes", json_number(poor), "share with coverage below 0.9", "<= 0.01", poor <= 0.01},
      {"wild_lies", json_number(all.share(all.lies, all.converged)),
       "share of converged off by 5 half-widths", "<= 1e-5",
       static_cast<double>(all.lies) <= 1e-5 * static_cast<double>(all.converged)},
      {"wild_converged", json_number(all.share(all.converged, all.values)), "share", ">= 0.8",
       all.share(all.converged, all.values) >= 0.8},
      {"wild_failures", json_number(static_cast<double>(failures.size())), "scenes", "0", failures.empty()}};
}

}  // namespace ifov::benchmarks
