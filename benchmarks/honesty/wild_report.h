#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "honesty/figure_row.h"
#include "honesty/judged_scene.h"

namespace ifov::benchmarks {

struct WildRun {
  int scenes = 0;
  std::uint64_t first_seed = 1;    ///< number of the first scene
  std::vector<std::string> kinds;  ///< numbers of other kinds are passed over; empty: all kinds
  std::filesystem::path work = ".";
  int threads = 0;
  Judging judging;
};

/// Makes scenes by rule and chance, judges them, prints what was found and the worst as documents (in the work folder,
/// with what was found as a comment at the end), and gives what must hold as rows. Throws std::runtime_error for a kind
/// that does not exist.
std::vector<FigureRow> report_wild_run(const WildRun& run);

}  // namespace ifov::benchmarks
