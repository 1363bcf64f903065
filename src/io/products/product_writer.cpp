#include "io/products/product_writer.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "core/error.h"
#include "io/envi/cube_layout.h"
#include "io/product_parts/map_info.h"
#include "io/product_parts/run_json.h"
#include "io/product_parts/run_record.h"
#include "io/product_parts/view_values.h"
#include "io/products/cube_set.h"
#include "io/products/product_format.h"

namespace ifov::io {
namespace {

void add(ImageStatistics& s, const sampling::TileResult& tile) {
  if (s.pixels == 0) s.fewest_samples = tile.samples.front();
  s.pixels += static_cast<std::uint64_t>(tile.tile.count());
  for (std::size_t p = 0; p < tile.samples.size(); ++p) {
    s.converged += tile.converged(p);
    s.samples += tile.samples[p];
    s.label_rays += tile.label_rays[p];
    s.radiance_evaluations += tile.radiance_evaluations[p];
    s.fewest_samples = std::min(s.fewest_samples, tile.samples[p]);
    s.most_samples = std::max(s.most_samples, tile.samples[p]);
    s.worst_ratio = std::max<double>(s.worst_ratio, tile.worst_ratio[p]);
    s.largest_missable_fraction = std::max<double>(s.largest_missable_fraction, tile.missable_fraction[p]);
  }
  sampling::add_reasons(tile.reasons, s.reasons);
  s.halo_samples += tile.halo_samples;
  s.pilot_samples += tile.pilot_samples;
  s.probe_samples += tile.probe_samples;
  s.rays.primary += tile.rays.primary;
  s.rays.shadow += tile.rays.shadow;
  s.rays.continuation += tile.rays.continuation;
}

}  // namespace

struct ProductWriter::State {
  ProductOptions options;
  RunIdentity identity;
  render::ImageInfo info;
  std::unique_ptr<CubeSet> cubes;
  std::mutex mutex;
  ImageStatistics statistics;
  bool finished = false;

  std::filesystem::path path(std::string_view ending) const {
    return options.folder / (options.name + std::string(ending));
  }
  std::uint64_t pixels() const {
    return static_cast<std::uint64_t>(info.width_px) * static_cast<std::uint64_t>(info.height_px);
  }

  std::vector<std::unique_ptr<PartFile>> derive(RunRecord& record, std::optional<SystemError>& failure) const;
  void publish(std::vector<std::unique_ptr<PartFile>>& derived, PartFile& record_file);
};

/// The products that are made from the cubes. One that cannot be written is left away and does not harm the
/// others.
std::vector<std::unique_ptr<PartFile>> ProductWriter::State::derive(
    RunRecord& record, std::optional<SystemError>& failure) const {
  std::vector<std::unique_ptr<PartFile>> files;
  const auto make = [&](const ProductFormat& format, const FormatInput& input) {
    std::unique_ptr<PartFile> file;
    try {
      file = std::make_unique<PartFile>(path(format.ending));
      std::unique_ptr<PartFile> header;
      FormatInput own = input;
      own.put_header = [&](const std::string& text) {
        header = std::make_unique<PartFile>(path(format.ending) += ".hdr");
        write_part(*header, text);
      };
      format.write(*file, own);
      file->sync();
      const std::uint64_t bytes = std::filesystem::file_size(file->part_path());
      record.files.push_back({file->final_path(), std::string(format.what), bytes, checksum(*file, bytes)});
      files.push_back(std::move(file));
      if (header) files.push_back(std::move(header));
    } catch (const SystemError& error) {
      if (file) file->discard();
      if (!failure) failure = error;
    }
  };
  const FormatInput input{record,
                          options.quicklook_channels,
                          [&](const Quantity& quantity) { return cubes->view(quantity); },
                          [&](const Quantity& quantity) { return cubes->wide_view(quantity); },
                          {}};
  for (const ProductFormat* format : options.formats.list())
    if (format->write != nullptr && (format->suits == nullptr || format->suits(info))) make(*format, input);
  return files;
}

void ProductWriter::State::publish(std::vector<std::unique_ptr<PartFile>>& derived, PartFile& record_file) {
  // The old record goes first and the new one comes last: in between nothing looks complete.
  std::error_code ignored;
  std::filesystem::remove(record_file.final_path(), ignored);
  cubes->publish();
  for (auto& file : derived) file->publish();

  // What an earlier run of this name left and this one does not replace would not belong to its cubes.
  auto leftovers = cubes->unselected_files();
  for (const ProductFormat* format : all_product_formats()) {
    if (format->write != nullptr) leftovers.push_back(path(format->ending));
    if (format->has_header) leftovers.push_back(path(format->ending) += ".hdr");
  }
  for (const auto& leftover : leftovers)
    if (std::none_of(derived.begin(), derived.end(),
                     [&](const auto& file) { return file->final_path() == leftover; }))
      std::filesystem::remove(leftover, ignored);
  sync_folder(options.folder);
  record_file.publish();
  sync_folder(options.folder);
}

ProductWriter::ProductWriter(ProductOptions options, RunIdentity identity)
    : state_(std::make_unique<State>()) {
  state_->options = std::move(options);
  state_->identity = std::move(identity);
}

ProductWriter::~ProductWriter() {
  if (!state_->cubes || state_->finished) return;
  try {
    state_->cubes->flush();
  } catch (const std::exception&) {
    // Said already by the write that failed first; what is on disk stays.
  }
}

void ProductWriter::begin(const render::ImageInfo& info) {
  State& s = *state_;
  if (s.cubes) throw std::logic_error("begin() comes once");
  if (info.width_px < 1 || info.height_px < 1 || info.channels.empty())
    throw std::logic_error("an image needs pixels and channels");
  coordinate_system_text(info);  // an unknown system is said now, not after the last ray
  s.info = info;
  const std::uint64_t further_bytes = s.options.formats.bytes(info, s.options.cubes);
  s.cubes =
      std::make_unique<CubeSet>(s.path(""), s.options.cubes, info, s.identity.acquisition, further_bytes,
                                s.options.go_on ? PartFile::Left::go_on : PartFile::Left::replace,
                                interleave_named(s.options.interleave));
}

void ProductWriter::write(const sampling::TileResult& tile) {
  State& s = *state_;
  if (!s.cubes) throw std::logic_error("begin() comes before write()");
  s.cubes->write(tile);
  const std::lock_guard lock(s.mutex);
  add(s.statistics, tile);
}

int ProductWriter::lines_written() const { return state_->cubes->lines_written(); }

bool ProductWriter::read_values(sampling::TileResult& tile, const std::function<bool()>& is_right) const {
  return state_->cubes->read_values(tile, is_right);
}

RunRecord ProductWriter::finish(const RunOutcome& outcome) {
  State& s = *state_;
  if (!s.cubes || s.finished || s.statistics.pixels != s.pixels())
    throw std::logic_error(format("finish() with {} of {} pixels written: the image is not whole",
                                  s.statistics.pixels, s.pixels()));
  RunRecord record{s.identity, outcome, s.info, s.statistics, {}, s.options.interleave};
  if (outcome.threads < 1) record.outcome.threads = static_cast<int>(std::thread::hardware_concurrency());
  s.cubes->complete(record);
  s.cubes->write_headers(s.identity, outcome.accuracy_statement);

  if (s.info.views)
    for (std::string& line : albedo_lines(
             record, view_values(record, [&](const Quantity& quantity) { return s.cubes->view(quantity); })))
      record.outcome.notes.push_back(std::move(line));
  std::optional<SystemError> failure;
  auto derived = s.derive(record, failure);
  if (failure) record.outcome.notes.push_back(failure->what());
  PartFile record_file(s.path("_run.json"));
  const std::string text = to_json(record);
  write_part(record_file, text);
  s.publish(derived, record_file);
  record.files.push_back({record_file.final_path(), "run record", text.size(), ""});
  s.finished = true;
  if (failure)
    throw SystemError(format("{}\nAll other products are complete in {}", failure->what(),
                             s.options.folder.empty() ? "." : s.options.folder.string()));
  return record;
}

std::vector<std::filesystem::path> ProductWriter::part_files() const {
  if (!state_->cubes || state_->finished) return {};
  return state_->cubes->part_files();
}

}  // namespace ifov::io
