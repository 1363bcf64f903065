#include "io/run_state/run_plan.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <sstream>

#include "core/format.h"
#include "io/products/product_writer.h"
#include "io/quantities/radiance_quantities.h"
#include "render/parts/part_columns.h"
#include "render/tolerance/node_budget.h"
#include "render/truth_layers.h"
#include "sampling/tile.h"

namespace ifov::io {
namespace {

constexpr std::size_t kShownOfLine = 70;

std::string shown(std::string line) {
  line.erase(0, std::min(line.size(), line.find_first_not_of(" \t")));
  if (line.size() > kShownOfLine) line = line.substr(0, kShownOfLine) + "...";
  return line;
}

/// "line 4 was '"seed": 1,' and is '"seed": 2,'": the first line that differs.
std::string first_difference(const std::string& was, const std::string& is) {
  std::istringstream a(was), b(is);
  std::string line_a, line_b;
  for (int number = 1;; ++number) {
    const bool has_a = static_cast<bool>(std::getline(a, line_a)),
               has_b = static_cast<bool>(std::getline(b, line_b));
    if (!has_a && !has_b) return "its line ends";
    if (!has_a) return format("line {} is new: '{}'", number, shown(line_b));
    if (!has_b) return format("line {} is gone: '{}'", number, shown(line_a));
    if (line_a != line_b) return format("line {} was '{}' and is '{}'", number, shown(line_a), shown(line_b));
  }
}

void compare_files(const std::vector<FileStamp>& was, const std::vector<FileStamp>& is,
                   std::vector<std::string>& lines) {
  const auto find = [](const std::vector<FileStamp>& files, const std::string& path) {
    return std::find_if(files.begin(), files.end(), [&](const FileStamp& file) { return file.path == path; });
  };
  for (const FileStamp& file : was) {
    const auto now = find(is, file.path);
    if (now == is.end())
      lines.push_back(format("the scene's file '{}' is gone", file.path));
    else if (now->bytes != file.bytes)
      lines.push_back(
          format("the scene's file '{}' had {} bytes and has {}", file.path, file.bytes, now->bytes));
    else if (now->hash != file.hash)
      lines.push_back(format("the scene's file '{}' has other bytes", file.path));
  }
  for (const FileStamp& file : is)
    if (find(was, file.path) == was.end()) lines.push_back(format("the scene's file '{}' is new", file.path));
}

bool any_needs(const QuantitySet& made, bool Quantity::Needs::*what) {
  return std::any_of(made.begin(), made.end(), [&](const Quantity* q) { return q->needs.*what; });
}

}  // namespace

std::vector<sampling::PixelRect> RunPlan::grid() const {
  return render::tile_grid(image.width_px, image.height_px, tile_px, image.sweep_lines);
}

QuantitySet RunPlan::made_cubes() const { return possible_quantities(cubes, image, knows_errors); }

bool RunPlan::tells_parts() const { return any_needs(made_cubes(), &Quantity::Needs::parts); }
bool RunPlan::tells_emissivity() const { return any_needs(made_cubes(), &Quantity::Needs::emissivity); }
bool RunPlan::tells_thermal_errors() const { return any_needs(made_cubes(), &Quantity::Needs::solved); }
bool RunPlan::keeps_variances() const {
  return keeps_memory || any_needs(made_cubes(), &Quantity::Needs::variances);
}

bool RunPlan::leaves_values_to_cubes() const {
  return !keeps_variances() && (!knows_errors || made_cubes().has(quantities::kHalfWidth));
}

sampling::TileResult RunPlan::example_tile(int pixels) const {
  sampling::TileResult tile;
  tile.reset({0, 0, pixels, 1}, static_cast<int>(image.channels.size()), knows_errors);
  if (!keeps_variances()) tile.drop_variances();
  for (const truth::Collector* collector : collectors_of(made_cubes()))
    tile.layers.push_back(render::empty_layer(*collector, static_cast<std::size_t>(pixels)));
  if (tells_emissivity()) render::add_empty_emissivity_layer(image.channels.size(), tile);
  if (tells_thermal_errors()) tile.layers.push_back(render::empty_thermal_layer(image.channels.size(), tile));
  if (tells_parts()) render::add_empty_part_layers(image.channels.size(), tile);
  return tile;
}

ProductOptions RunPlan::products(const std::filesystem::path& folder) const {
  ProductOptions options;
  options.folder = folder;
  options.name = name;
  options.cubes = made_cubes();
  options.interleave = interleave;
  options.formats = formats;
  options.quicklook_channels = quicklook_channels;
  return options;
}

std::uint64_t RunPlan::key() const {
  std::string all =
      format("{}\n{}\n{}\n{} {} {} {} {} {}\n", identity.version, build, instruction_set, identity.seed,
             image.width_px, image.height_px, tile_px, image.channels.size(), image.materials.size());
  for (const FileStamp& file : files)
    all += format("{} {} {} {}\n", file.path, file.bytes, file.hash[0], file.hash[1]);
  all += format("{} {}\n", keeps_memory, base);
  all += identity.document_text;
  return XXH3_64bits(all.data(), all.size());
}

std::vector<std::string> differences(const RunPlan& was, const RunPlan& is) {
  std::vector<std::string> lines;
  if (was.identity.document_text != is.identity.document_text)
    lines.push_back("the document: " +
                    first_difference(was.identity.document_text, is.identity.document_text));
  if (was.identity.seed != is.identity.seed)
    lines.push_back(format("the seed was {} and is {}", was.identity.seed, is.identity.seed));
  compare_files(was.files, is.files, lines);
  if (was.identity.version != is.identity.version)
    lines.push_back(
        format("the program was ifov {} and is ifov {}", was.identity.version, is.identity.version));
  else if (was.build != is.build)
    lines.push_back(format("the program was build {} and is build {} of ifov {}", was.build, is.build,
                           is.identity.version));
  if (was.instruction_set != is.instruction_set)
    lines.push_back(format("the instruction set was {} and is {}", was.instruction_set, is.instruction_set));
  if (was.base != is.base)
    lines.push_back(was.base == 0  ? "the run was to begin from nothing and is to refine another"
                    : is.base == 0 ? "the run was to refine another (--refine) and is to begin from nothing"
                                   : "the run that is refined was another");
  else if (was.keeps_memory != is.keeps_memory)
    lines.push_back(was.keeps_memory ? "the run was to be kept (--keep)"
                                     : "the run was not to be kept and is (--keep)");
  const auto& a = was.image;
  const auto& b = is.image;
  if (lines.empty() && (a.width_px != b.width_px || a.height_px != b.height_px || was.tile_px != is.tile_px ||
                        a.channels.size() != b.channels.size() || a.materials != b.materials))
    lines.push_back(format("the image was {} x {} pixels, {} channels, {} materials and is {} x {}, {}, {}",
                           a.width_px, a.height_px, a.channels.size(), a.materials.size(), b.width_px,
                           b.height_px, b.channels.size(), b.materials.size()));
  return lines;
}

}  // namespace ifov::io
