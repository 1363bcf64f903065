#include "sampling/accuracy/probing.h"

#include <algorithm>
#include <numeric>

namespace ifov::sampling {

/// One batch of points; the model is refined until it agrees with all of them. Tells which ones contradicted
/// it.
std::vector<std::uint8_t> Prober::look(const std::vector<FocalPoint>& points, Purpose purpose) {
  std::vector<std::uint32_t> labels;
  tracer_.ask_at(points, labels, purpose);
  std::vector<std::uint8_t> contradicted(points.size(), 0);
  std::vector<std::uint32_t> in_question(points.size());
  std::iota(in_question.begin(), in_question.end(), 0u);
  for (int level = 0; level <= 2 * kMaxLevel; ++level) {
    tracer_.forget_changes();
    bool any = false;
    for (std::uint32_t i : in_question)
      if (tracer_.contradict(points[i], labels[i])) contradicted[i] = any = true;
    if (!any) break;
    tracer_.settle();
    // Where the model is the same it still agrees.
    in_question.clear();
    for (std::uint32_t i = 0; i < points.size(); ++i)
      if (tracer_.changed(static_cast<std::uint32_t>(tracer_.lattice().pixel_at(points[i]))))
        in_question.push_back(i);
  }
  return contradicted;
}

void Prober::follow_seeds(std::span<const FocalPoint> seeds, std::span<const std::uint32_t> objects) {
  const std::vector<std::uint32_t> met =
      objects.empty() ? std::vector<std::uint32_t>{} : ledger_.objects_met();
  const PixelRect& domain = tracer_.lattice().domain();
  std::vector<FocalPoint> points;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const FocalPoint p = seeds[i];
    if (p.x_px < domain.x0 || p.x_px >= domain.x1 || p.y_px < domain.y0 || p.y_px >= domain.y1) continue;
    const bool known = !objects.empty() && objects[i] != Field::kNoObject &&
                       std::binary_search(met.begin(), met.end(), objects[i]);
    if (!known) points.push_back(p);
  }
  if (points.empty()) return;
  // A known object that shows up where it was expected is no sign of unknown ones beside it.
  const std::vector<std::uint8_t> suspects = tracer_.suspects();
  look(points, Purpose::seed);
  tracer_.suspects() = suspects;
}

void Prober::probe_until_clean(const std::vector<std::uint8_t>& worth) {
  const Lattice& lattice = tracer_.lattice();
  const PixelRect& domain = lattice.domain();
  const int width = domain.width(), height = domain.height(), side = options_.probes_per_side;
  if (side <= 0) return;
  std::vector<std::uint8_t> cause(static_cast<std::size_t>(domain.count())), flagged(cause.size());
  for (std::size_t p = 0; p < cause.size(); ++p) cause[p] = tracer_.suspect(static_cast<std::uint32_t>(p));

  for (int round = 0; round < options_.max_probe_rounds; ++round) {
    std::vector<int> probed;
    std::vector<FocalPoint> points;
    std::fill(flagged.begin(), flagged.end(), std::uint8_t{0});
    for (auto p = std::find(cause.begin(), cause.end(), std::uint8_t{1}); p != cause.end();
         p = std::find(p + 1, cause.end(), std::uint8_t{1})) {
      const int x = static_cast<int>(p - cause.begin()) % width, y = static_cast<int>(p - cause.begin()) / width;
      for (int j = std::max(0, y - 1); j <= std::min(height - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(width - 1, x + 1); ++i) flagged[j * width + i] = 1;
    }
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const int pixel = y * width + x;
        if (!flagged[pixel] || !worth[pixel] || tracer_.abandoned(static_cast<std::uint32_t>(pixel))) continue;
        probed.push_back(pixel);
        for (int j = 0; j < side; ++j)
          for (int i = 0; i < side; ++i) {
            const std::uint64_t key =
                hash(seed_, 0x70726f6265, domain.x0 + x, domain.y0 + y, round, j * side + i);
            points.push_back({domain.x0 + x + (i + unit_double(key)) / side,
                              domain.y0 + y + (j + unit_double(mix(key))) / side});
          }
      }
    if (points.empty()) return;
    const std::vector<std::uint8_t> contradicted = look(points, Purpose::probe);
    std::fill(cause.begin(), cause.end(), std::uint8_t{0});
    const std::size_t per_pixel = static_cast<std::size_t>(side * side);
    bool any = false;
    for (std::size_t n = 0; n < probed.size(); ++n) {
      bool dirty = false;
      for (std::size_t i = 0; i < per_pixel; ++i) dirty |= contradicted[n * per_pixel + i] != 0;
      if (dirty)
        cause[probed[n]] = any = true;
      else
        ++clean_rounds_[probed[n]];
    }
    if (!any) return;
  }
}

}  // namespace ifov::sampling
