#include <CLI/CLI.hpp>

#include "cli/command.h"
#include "cli/terminal/say.h"
#include "core/error.h"
#include "core/format.h"
#include "core/names.h"
#include "landscape/landscapes.h"

namespace ifov::cli {
namespace {

struct MakeArguments {
  std::string kind, folder, size = "200 m";
  std::uint64_t seed = 1;
  bool replace = false, quiet = false;
};

const landscape::LandscapeEntry& scene_named(const std::string& name) {
  if (const landscape::LandscapeEntry* entry = landscape::find_landscape(name)) return *entry;
  std::vector<std::string> names;
  for (const landscape::LandscapeEntry& entry : landscape::all_landscapes()) names.emplace_back(entry.name);
  const std::string hint = did_you_mean(name, names);
  throw InputError(format("ifov: there is no scene '{}' to be made{} Scenes: {}", name,
                          hint.empty() ? "." : hint, list_names(names, "and")));
}

ExitCode make(const MakeArguments& arguments) {
  const landscape::LandscapeEntry& entry = scene_named(arguments.kind);
  const landscape::MadeScene made =
      entry.make({arguments.folder, landscape::size_m_of(arguments.size), arguments.seed, arguments.replace});
  if (arguments.quiet) return ExitCode::ok;
  std::string text;
  for (const std::string& line : made.contents) text += line + "\n";
  text += format("{} triangles in {} files, {:.1f} MB\n\n", made.triangles, made.files,
                 1e-6 * static_cast<double>(made.bytes));
  for (const std::filesystem::path& document : made.documents) text += document.string() + "\n";
  text += format("\nTo look at it: ifov render {}\n", made.documents.front().string());
  say(text);
  return ExitCode::ok;
}

}  // namespace

Command add_make_command(CLI::App& app) {
  auto arguments = std::make_shared<MakeArguments>();
  CLI::App* parser =
      app.add_subcommand("make", "Make a scene: a suburb and others, ready to render and to edit");
  parser->add_option("KIND", arguments->kind, "What to make, see below")->required();
  parser->add_option("FOLDER", arguments->folder, "Folder of the scene, which is made")->required();
  parser
      ->add_option("--size", arguments->size,
                   format("Side of the square that the images show, {:g} m to {:g} m", landscape::kSmallest_m,
                          landscape::kLargest_m))
      ->capture_default_str();
  parser
      ->add_option("--seed", arguments->seed,
                   "Another number, another scene; the same number, the same bytes")
      ->capture_default_str();
  parser->add_flag("--force", arguments->replace, "Replace the folder with all that is in it");
  parser->add_flag("-q,--quiet", arguments->quiet, "Print nothing but errors");
  std::string footer = "Scenes:\n";
  for (const landscape::LandscapeEntry& entry : landscape::all_landscapes())
    footer += format("  {:<10} {}\n", entry.name, entry.summary);
  parser->footer(
      footer +
      "\nA scene is a folder of ordinary files: documents (JSON), meshes (OBJ, PLY), lists of instances (CSV)\n"
      "and maps (GeoTIFF), all to be edited. scene.json holds the scene and its light, and the others include it:\n"
      "quicklook.json shows it from above in colour, oblique.json at an angle; render_vswir.json is an imaging\n"
      "spectrometer of 210 channels at 1 m, render_thermal.json a thermal imager.\n\n"
      "Examples:\n"
      "  ifov make suburb --size 200m --seed 7 suburb\n"
      "  ifov render suburb/quicklook.json");
  return {parser, [arguments] { return make(*arguments); }};
}

}  // namespace ifov::cli
