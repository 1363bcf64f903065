#include "io/atmosphere/import_paths.h"

#include "core/error.h"
#include "io/atmosphere/format_guess.h"
#include "io/atmosphere/modtran_channels.h"
#include "io/atmosphere/modtran_csv.h"
#include "io/atmosphere/path_csv.h"
#include "io/atmosphere/uvspec.h"
#include "io/files/inputs.h"

namespace ifov::io {
namespace {

std::vector<atmosphere::ImportedPath> paths_of(std::vector<ModtranRun> runs) {
  std::vector<atmosphere::ImportedPath> paths;
  for (ModtranRun& run : runs) paths.push_back(std::move(run.path));
  return paths;
}

/// The input of uvspec that stands beside its output under the same name; empty without one.
std::filesystem::path input_beside(const std::filesystem::path& output) {
  for (const char* extension : {".inp", ".INP", ".in"}) {
    std::filesystem::path input = output;
    input.replace_extension(extension);
    if (input != output && input_exists(input)) return input;
  }
  return {};
}

}  // namespace

std::vector<atmosphere::ImportedPath> import_paths(const std::filesystem::path& path,
                                                   const ImportOptions& options) {
  const TextFile file(path);
  const AtmosphereFormat format = guess_atmosphere_format(file);
  if (!options.uvspec_input.empty() && format != AtmosphereFormat::uvspec &&
      format != AtmosphereFormat::unknown)
    file.fail(0, 0,
              ifov::format("found {} and an input file of uvspec; expected the output of uvspec",
                           describe(format)));
  switch (format) {
    case AtmosphereFormat::modtran_tape7: return paths_of(parse_modtran_tape7(file, options.unit));
    case AtmosphereFormat::modtran_channels: return parse_modtran_channels(file, options.sun_zenith_rad);
    case AtmosphereFormat::modtran_csv: return paths_of(parse_modtran_csv(file, options.unit));
    case AtmosphereFormat::path_csv: return {parse_path_csv(file)};
    case AtmosphereFormat::modtran_json:
      file.fail(0, 0, "found a MODTRAN 6 input file; expected its output (tape7, .chn or .csv)");
    case AtmosphereFormat::uvspec:
    case AtmosphereFormat::unknown: break;
  }
  std::filesystem::path input = options.uvspec_input;
  if (input.empty() && format == AtmosphereFormat::uvspec) input = input_beside(path);
  if (input.empty())
    file.fail(0, 0,
              format == AtmosphereFormat::uvspec
                  ? ifov::format("found rows of numbers without headings; expected the input file of uvspec "
                                 "beside them, as {}, or under 'uvspec_inputs'",
                                 std::filesystem::path(path.filename()).replace_extension(".inp").string())
                  : "found no file that is known here; expected a MODTRAN tape7 (.tp7, .7sc), channel file "
                    "(.chn) or "
                    "table (.csv), the output of libRadtran's uvspec, or a table of paths (.csv)");
  return parse_uvspec(file, read_uvspec_input(input));
}

}  // namespace ifov::io
