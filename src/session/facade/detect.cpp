#include "ifov/detect.h"

#include <future>
#include <memory>

#include "core/call_scope.h"
#include "core/error.h"
#include "ifov/products.h"
#include "io/products/envi_reader.h"
#include "session/cube_channels.h"
#include "session/facade/access.h"
#include "session/facade/document_inside.h"
#include "session/facade/run_record_file.h"
#include "session/line_cube.h"
#include "session/runs/detection.h"

namespace ifov {
namespace {

constexpr std::string_view kRecordEnding = "_run.json";

std::vector<render::ChannelInfo> channels_of(const Document& document) {
  const auto& inside = FacadeAccess::inside(document);
  const Call call{inside.inputs};
  const CallScope scope(call);
  return session::noisy_channels(inside.document.sources, inside.document.sensor.channels);
}

std::vector<render::ChannelInfo> channels_of(const std::filesystem::path& record) {
  std::vector<render::ChannelInfo> channels;
  bool any = false;
  for (const RunInfo::Channel& channel : run_info(record).channels) {
    channels.push_back({channel.name, channel.centre_um, channel.fwhm_um, {}, channel.noise});
    any = any || channel.noise > 0.0;
  }
  if (!any)
    throw InputError(
        format("{}: {}; or name another document whose channels do", record.string(), session::kNoNoise));
  return channels;
}

}  // namespace

Detection detect(const std::filesystem::path& run, const DetectOptions& options) {
  if (options.realizations < 1)
    throw InputError(format("{} realizations were asked for; at least 1 is", options.realizations));
  if (options.threads < 0)
    throw InputError(format("threads: {} was asked for; 0 takes all cores", options.threads));
  const std::filesystem::path record = record_of(run);
  const std::vector<render::ChannelInfo> channels =
      options.other ? channels_of(*options.other) : channels_of(record);
  std::string name = record.filename().string();
  name.resize(name.size() - kRecordEnding.size());
  const io::EnviReader radiance(record.parent_path() / (name + "_radiance.img"));
  session::require_channels(radiance, channels, render::ImageInfo().radiance_unit,
                            options.other ? options.other->name() : record.string());

  Detection detection;
  for (const render::ChannelInfo& channel : channels)
    detection.channels.push_back({channel.name, channel.noise});
  const std::filesystem::path folder = options.folder.empty() ? record.parent_path() : options.folder;
  const std::uint64_t bytes = 4 * static_cast<std::uint64_t>(radiance.header().samples) *
                              static_cast<std::uint64_t>(radiance.header().lines) *
                              static_cast<std::uint64_t>(radiance.header().bands);
  io::require_space(folder, bytes * static_cast<std::uint64_t>(options.realizations));
  std::future<void> publishing;  // of one cube, while the next is made
  for (int k = 0; k < options.realizations; ++k) {
    const std::uint64_t seed = options.first_seed + static_cast<std::uint64_t>(k);
    detection.cubes.push_back(folder / format("{}_noisy_{}.img", name, seed));
    auto cube = session::noisy_cube(radiance, channels, seed, detection.cubes.back(), options.threads,
                                    options.cancel);
    if (publishing.valid()) publishing.get();
    publishing = std::async(std::launch::async, [made = std::move(cube)] { made->publish(); });
  }
  if (publishing.valid()) publishing.get();
  return detection;
}

}  // namespace ifov
