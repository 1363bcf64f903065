#include "ifov/detect.h"

#include <future>
#include <memory>

#include "core/call_scope.h"
#include "ifov/products.h"
#include "io/products/envi_reader.h"
#include "io/products/part_file.h"
#include "session/facade/access.h"
#include "session/facade/document_inside.h"
#include "session/facade/run_record_file.h"
#include "session/runs/detection.h"

namespace ifov {
namespace {

constexpr std::string_view kRecordEnding = "_run.json";

/// That a run was made of, its files about where it lay.
Document document_of(const std::filesystem::path& record) {
  const RunInfo run = run_info(record);
  const std::filesystem::path path = run.document;
  return Document::parse(run.document_text, path.filename().string(), path.parent_path());
}

}  // namespace

Detection detect(const std::filesystem::path& run, const DetectOptions& options) {
  const std::filesystem::path record = record_of(run);
  const Document document = options.other ? *options.other : document_of(record);
  const auto& inside = FacadeAccess::inside(document);
  const Call call{inside.inputs};
  const CallScope scope(call);
  const session::NoisyChannels channels =
      session::noisy_channels(inside.document.sources, inside.document.sensor.channels);
  std::string name = record.filename().string();
  name.resize(name.size() - kRecordEnding.size());
  const io::EnviReader radiance(record.parent_path() / (name + "_radiance.img"));
  session::require_same_channels(radiance, channels, document.name());

  Detection detection;
  for (std::size_t c = 0; c < channels.channels.size(); ++c)
    detection.channels.push_back({channels.channels[c].name, channels.noise[c]});
  const std::filesystem::path folder = options.folder.empty() ? record.parent_path() : options.folder;
  const std::uint64_t bytes = 4 * static_cast<std::uint64_t>(radiance.header().samples) *
                              static_cast<std::uint64_t>(radiance.header().lines) *
                              static_cast<std::uint64_t>(radiance.header().bands);
  io::require_space(folder, bytes * static_cast<std::uint64_t>(options.realizations));
  std::future<void> publishing;  // of one cube, while the next is made
  for (int k = 0; k < options.realizations; ++k) {
    const std::uint64_t seed = options.first_seed + static_cast<std::uint64_t>(k);
    detection.cubes.push_back(folder / format("{}_noisy_{}.img", name, seed));
    auto cube = std::make_unique<session::NoisyCube>(radiance, channels, seed, detection.cubes.back());
    cube->write(options.threads, options.cancel);
    if (publishing.valid()) publishing.get();
    publishing = std::async(std::launch::async, [made = std::move(cube)] { made->publish(); });
  }
  if (publishing.valid()) publishing.get();
  return detection;
}

}  // namespace ifov
