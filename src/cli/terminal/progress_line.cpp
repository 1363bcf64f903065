#include "cli/terminal/progress_line.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"

namespace ifov::cli {
namespace {

constexpr int kLongestBar = 24, kShortestBar = 4;

/// "[####----] " of `width` columns; nothing where there is too little room.
std::string bar(double done, int width) {
  const int inside = std::min(width - 3, kLongestBar);
  if (inside < kShortestBar) return {};
  const int filled = static_cast<int>(std::floor(done * inside));
  return format("[{:#<{}}{:-<{}}] ", "", filled, "", inside - filled);
}

}  // namespace

std::string short_count(double count) {
  const char* const suffixes[] = {"", " k", " M", " G", " T"};
  int step = 0;
  while (count >= 999.5 && step < 4) {
    count /= 1000.0;
    ++step;
  }
  const int decimals = step == 0 || count >= 99.95 ? 0 : count >= 9.995 ? 1 : 2;
  return format("{:.{}f}{}", count, decimals, suffixes[step]);
}

std::string short_duration(double seconds) {
  const long whole = std::lround(std::clamp(seconds, 0.0, 3.6e8));
  const long hours = whole / 3600, minutes = whole / 60 % 60;
  return hours > 0 ? format("{}:{:02}:{:02}", hours, minutes, whole % 60)
                   : format("{}:{:02}", minutes, whole % 60);
}

std::string progress_line(const Progress& progress, int width) {
  const double total = static_cast<double>(std::max<std::int64_t>(progress.pixels_total, 1));
  const double done = std::clamp(static_cast<double>(progress.pixels_done) / total, 0.0, 1.0);
  std::string line = format("{:5.1f} %", std::floor(1000.0 * done) / 10.0);
  if (done > 0.0) line += format("  {} left", short_duration(progress.elapsed_s * (1.0 - done) / done));
  if (progress.elapsed_s > 0.0 && progress.rays > 0) {
    line += format("  {} rays/s", short_count(static_cast<double>(progress.rays) / progress.elapsed_s));
  }
  if (progress.worst_error_ratio > 0.0 && progress.pixels_done > 0) {
    const double converged =
        static_cast<double>(progress.pixels_converged) / static_cast<double>(progress.pixels_done);
    line += format("  {:.1f} % converged  worst {:.2f} x limit", std::floor(1000.0 * converged) / 10.0,
                   progress.worst_error_ratio);
  }
  line = bar(done, width - static_cast<int>(line.size())) + line;
  return line.substr(0, static_cast<std::size_t>(std::max(width, 1)));
}

}  // namespace ifov::cli
