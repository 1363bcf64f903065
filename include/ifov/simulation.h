#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ifov/document.h"
#include "ifov/outcome.h"
#include "ifov/run_control.h"
#include "ifov/tile.h"

namespace ifov {

struct FacadeAccess;
class Ranks;

/// How a document is loaded. Pointers may be null, and what they point to must live as long as the call.
struct LoadOptions {
  /// Keep beside the document what is worked out from large files, and use it (.ifovcache).
  bool scene_cache = false;
  int threads = 0;                      ///< for the atmosphere; 0: all cores
  const CancelToken* cancel = nullptr;  ///< asked while files are read, and between pieces of all other work
  ProgressSink* progress = nullptr;     ///< of the atmosphere: solutions instead of pixels
  LogSink* log = nullptr;
  Ranks* ranks = nullptr;  ///< that load as well; without assets
};

/// One of several shares of an image's tiles, from 1: "17/64" is {17, 64}.
struct TileShare {
  int number = 1, count = 1;
};

/// How products are made. Names are those of the command line's options where nothing else is said, and messages speak of
/// those. Pointers as of LoadOptions.
struct RenderOptions {
  std::filesystem::path folder;      ///< --output; empty: as the document says
  int threads = 0;                   ///< 0: all cores; the result is the same for any number
  RunStart start = RunStart::fresh;  ///< --resume, --restart
  bool keep_tiles = true;            ///< false, --no-state: a run that is stopped cannot go on
  bool keep = false;                 ///< leave, beside the products, what `refine` can go on from
  bool refine = false;               ///< take the kept run in the folder to the document's tighter accuracy
  bool anyway = false;               ///< begin also where memory or disk will not do
  TileShare share = {};              ///< --tiles: a share leaves tiles and no products, see merge()
  /// --time-limit: when products are to be whole; pixels not reached by then hold no value.
  std::optional<std::chrono::steady_clock::time_point> deadline = {};
  const CancelToken* cancel = nullptr;  ///< asked between batches of rays
  ProgressSink* progress = nullptr;
  LogSink* log = nullptr;
  Ranks* ranks = nullptr;  ///< those that the scene was loaded with, which share the tiles
};

/// What a run will take.
struct Forecast {
  double rays = 0.0;
  double elapsed_s = 0.0;    ///< from the loaded scene to whole products, where nobody else uses the cores
  double processor_s = 0.0;  ///< of all threads, for the same
  double uncertainty = 0.0;  ///< relative standard error of these, from how unlike the probes are
  std::uint64_t memory_bytes = 0;   ///< at most at a time
  std::uint64_t disk_bytes = 0;     ///< while the run works: products and kept tiles
  std::uint64_t product_bytes = 0;  ///< of which stay
  std::size_t probes = 0;           ///< none where there is too little memory to probe
  double probed_share = 0.0;        ///< of the image
  double probing_s = 0.0;
  std::vector<std::string> shortages;  ///< "out: the run takes 3.1 TB, 0.2 TB are free"; none: it will do
};

struct PreviewOptions {
  /// For paths; every pixel gets one, if that takes longer, unless it takes ten times as long.
  double seconds = 3.0;
  int threads = 0;  ///< 0: all cores
  const CancelToken* cancel = nullptr;
};

/// A picture without a promise.
struct Preview {
  int width_px = 0, height_px = 0;
  std::vector<std::uint32_t> pixels;  ///< 0xRRGGBB, rows from the top
  std::string png;                    ///< the same, with title and range
  std::string statement;              ///< how many paths stand behind it
};

/// How tiles are made that stay in memory; see RenderOptions.
struct TileOptions {
  int threads = 0;
  /// Where not null, its "sampling" and "seed" count in place of the loaded document's: another accuracy, another method. What
  /// the atmosphere was worked out to stays; where that is not enough, pixels are marked ("air").
  const Document* sampling = nullptr;
  std::optional<std::chrono::steady_clock::time_point> deadline = {};  ///< when no more tiles come
  /// What tiles tell of pixels beside what they always do: words of the document's output.products, "abundance". What this
  /// image cannot have, such as errors of single rays, is left out.
  std::vector<std::string> quantities = {};
  const CancelToken* cancel = nullptr;
  ProgressSink* progress = nullptr;
};

/// What a ray meets, in the document's coordinates.
struct RayHit {
  bool hit = false;         ///< else nothing below is told
  double distance_m = 0.0;  ///< from the origin
  std::array<double, 3> position_m{};
  std::array<double, 3> normal{};  ///< of the surface, unit, on the side that the ray comes from
  double u = 0.0, v = 0.0;         ///< texture coordinates
  int object = -1;                 ///< index in the document's scene.objects
  std::string material;            ///< of several the one with the largest share
};

/// A document with all that it names: every file read, the scene built, ready to be rendered. It does not change once it
/// is loaded: several threads may render it at once, each into a folder of its own, and get the same bytes as one.
///
/// Errors of all calls: InputError for what the user wrote; SystemError for files, disk and memory (std::bad_alloc
/// while a scene is loaded); Cancelled. exit_code_of() says what the program would return for each. Nothing is printed.
class IFOV_API Simulation {
 public:
  static Simulation load(const Document& document, const LoadOptions& options = {});
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  /// Size, channels, place and what is asked for.
  ImageDescription image() const;
  /// What was loaded and where it is, as `ifov check` prints it: lines, each with its end.
  std::string description() const;
  /// What was warned of while it was loaded: what is left out, what is most likely not meant.
  const std::vector<std::string>& warnings() const;

  /// Makes the products of `ifov render`, with the run record, in a folder. A run that is stopped leaves what is finished
  /// there, and products under other names (.part).
  Outcome render(const RenderOptions& options = {}) const;

  /// What render() will take: renders a few small pieces spread over the image, at the document's settings, and scales up.
  /// Takes seconds to a minute.
  Forecast forecast(const RenderOptions& options = {}) const;

  /// One path after another at each pixel, coarse first; for a document of Document::for_preview().
  Preview preview(const PreviewOptions& options = {}) const;

  /// What is met by rays from points of the document's coordinates (metres, with the map's easting and northing where it has
  /// them) in directions of any length. Throws InputError where there are not as many of one as of the other, or one is no
  /// direction.
  std::vector<RayHit> cast(std::span<const std::array<double, 3>> origins_m,
                           std::span<const std::array<double, 3>> directions, int threads = 0) const;

  /// Hands finished tiles to `sink`, and writes no file. Values are those of the products, bit for bit.
  Outcome render_tiles(TileSink& sink, const TileOptions& options = {}) const;

 private:
  friend struct FacadeAccess;
  struct Inside;
  explicit Simulation(std::unique_ptr<const Inside> inside);
  std::unique_ptr<const Inside> inside_;
};

}  // namespace ifov
