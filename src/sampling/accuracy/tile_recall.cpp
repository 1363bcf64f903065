#include "sampling/accuracy/tile_recall.h"

#include <algorithm>
#include <utility>

#include "sampling/accuracy/basis/tile_memory.h"
#include "sampling/accuracy/output_state.h"
#include "sampling/accuracy/radiance/radiance.h"
#include "sampling/accuracy/radiance/radiance_memory.h"
#include "sampling/accuracy/radiance/source_pixels.h"
#include "sampling/tile.h"

namespace ifov::sampling {

namespace {

/// Predictions below this are no better known: a first round has its least size.
constexpr double kLeastPrediction = 64.0;

std::unique_ptr<TileMemory> memory_of(const TileProblem& problem, int columns) {
  if (problem.before != nullptr)
    return std::make_unique<TileMemory>(static_cast<std::size_t>(columns), problem.before->memory);
  if (problem.keep_memory) return std::make_unique<TileMemory>(static_cast<std::size_t>(columns));
  return nullptr;
}

/// Counts of the result so far are of this run alone.
void add_counts(const TileResult& before, TileResult& result) {
  for (std::size_t p = 0; p < result.samples.size(); ++p) {
    result.samples[p] += before.samples[p];
    result.label_rays[p] += before.label_rays[p];
    result.radiance_evaluations[p] += before.radiance_evaluations[p];
  }
  result.halo_samples += before.halo_samples;
  result.pilot_samples += before.pilot_samples;
  result.probe_samples += before.probe_samples;
}

}  // namespace

TileRecall::TileRecall(const TileProblem& problem, int columns)
    : problem_(problem), memory_(memory_of(problem, columns)) {}

TileRecall::~TileRecall() = default;

void TileRecall::recall_tests(std::vector<OutputState>& outputs) const {
  if (!memory_) return;
  const std::vector<std::uint8_t>& tests = memory_->tests_before();
  for (std::size_t o = 0; o < tests.size() && o < outputs.size(); ++o) {
    outputs[o].test = tests[o];
    outputs[o].last_test += outputs[o].test;
  }
}

/// Tests belong to the values they were made of: where some of these are not taken up, the count begins anew.
void TileRecall::recall_values(Radiance& radiance, std::size_t p, std::vector<OutputState>& outputs) const {
  if (problem_.before == nullptr) return;
  SourcePixel& pixel = radiance.pixels().others()[p];
  if (radiance.memory().recall(pixel, *memory_)) return;
  for (int o : pixel.model.outputs) outputs[o].test = 0;
}

void TileRecall::recall_values(Radiance& radiance, std::vector<OutputState>& outputs) const {
  for (std::size_t p = 0; p < radiance.pixels().others().size(); ++p) recall_values(radiance, p, outputs);
}

double TileRecall::clutter_to_come(int source, double predicted) const {
  if (problem_.before == nullptr) return predicted;
  const RadianceMemory::ClutterBefore before = RadianceMemory::clutter_before(*memory_, source);
  const double worse = std::max(1.0, before.values / std::max(before.predicted, kLeastPrediction));
  return worse * predicted - before.values;
}

void TileRecall::remember_values(const Radiance& radiance, std::span<const float> predicted) {
  if (!problem_.keep_memory) return;
  for (const SourcePixel& pixel : radiance.pixels().others())
    radiance.memory().remember(pixel, predicted[pixel.source], *memory_);
}

void TileRecall::finish(const std::vector<OutputState>& outputs, TileResult& result) {
  if (problem_.before != nullptr) add_counts(*problem_.before, result);
  if (!problem_.keep_memory) return;
  std::vector<std::uint8_t> tests;
  for (const OutputState& output : outputs)
    tests.push_back(static_cast<std::uint8_t>(std::min(output.test, 255)));
  memory_->keep_tests(std::move(tests));
  result.memory = memory_->to_bytes();
}

}  // namespace ifov::sampling
