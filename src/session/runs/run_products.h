#pragma once

#include <filesystem>

#include "io/products/product_writer.h"
#include "sampling/reason_words.h"
#include "session/image_errors.h"
#include "session/session.h"
#include "session/told_tiles.h"

namespace ifov::io {
struct RunPlan;
}

namespace ifov::session {

/// Makes the products of a run out of its tiles, wherever they come from.
class RunProducts final : public render::TileSink {
 public:
  /// Takes the disk space of the products; `go_on` as of io::ProductOptions. Errors as of io::ProductWriter.
  RunProducts(const io::RunPlan& plan, const std::filesystem::path& folder, bool go_on);

  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { image_errors_.write(tile); }

  /// As of io::ProductWriter.
  int lines_written() const { return writer_.lines_written(); }
  bool read_values(sampling::TileResult& tile, const std::function<bool()>& is_right) const {
    return writer_.read_values(tile, is_right);
  }

  /// For pixels that there is no tile of: not a number in every cube, 0 in the counts of samples; and the reason why.
  void write_missing(sampling::PixelRect pixels, sampling::Reason reason);

  /// After the last tile. `reasons` and `why_gaps` as for accuracy_statement().
  RunSummary finish(const Progress& totals, const sampling::ReasonCounts& reasons, int threads,
                    const std::string& why_gaps);

 private:
  const io::RunPlan& plan_;
  std::filesystem::path folder_;
  io::ProductWriter writer_;
  DetectionTally detection_;
  OneValue one_value_;
  ImageErrors image_errors_;
};

}  // namespace ifov::session
