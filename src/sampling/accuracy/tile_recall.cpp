// A tile that an earlier run has left at a looser tolerance: what it takes up from there, and leaves in turn.
#include <algorithm>

#include "sampling/accuracy/tile_work.h"

namespace ifov::sampling {

namespace {

/// Predictions below this are no better known: a first round has its least size.
constexpr double kLeastPrediction = 64.0;

}  // namespace

/// Looks belong to the values they were at: where some of these are not taken up, the looks begin anew.
void TileWork::recall_values(std::size_t pixel) {
  if (problem_.before == nullptr || radiance_->recall(pixel, *memory_)) return;
  for (int o : radiance_->pixels()[pixel].model.outputs) outputs_[o].look = 0;
}

void TileWork::remember_values() {
  for (const Radiance::Pixel& pixel : radiance_->pixels())
    radiance_->remember(pixel, predicted_[pixel.source], *memory_);
}

/// Values that clutter still takes by the lattice's prediction, where an earlier run has begun, and has shown
/// what such predictions are worth in the pixel.
double TileWork::clutter_to_come(int source, double predicted) const {
  if (problem_.before == nullptr) return predicted;
  const Radiance::ClutterBefore before = Radiance::clutter_before(*memory_, source);
  const double worse = std::max(1.0, before.values / std::max(before.predicted, kLeastPrediction));
  return worse * predicted - before.values;
}

/// Counts of the result so far are of this run alone.
void TileWork::add_counts_before() {
  const TileResult& before = *problem_.before;
  for (std::size_t p = 0; p < result_.samples.size(); ++p) {
    result_.samples[p] += before.samples[p];
    result_.label_rays[p] += before.label_rays[p];
    result_.radiance_evaluations[p] += before.radiance_evaluations[p];
  }
  result_.halo_samples += before.halo_samples;
  result_.seed_samples += before.seed_samples;
  result_.probe_samples += before.probe_samples;
}

void TileWork::keep_memory() {
  std::vector<std::uint8_t> looks;
  for (const Output& output : outputs_)
    looks.push_back(static_cast<std::uint8_t>(std::min(output.look, 255)));
  memory_->keep_looks(std::move(looks));
  result_.memory = memory_->to_bytes();
}

}  // namespace ifov::sampling
