#include <CLI/CLI.hpp>

#include "cli/command.h"
#include "cli/terminal/say.h"
#include "core/error.h"
#include "core/names.h"
#include "ifov/materials.h"
#include "ifov/products.h"

namespace ifov::cli {
namespace {

struct Options {
  std::string words, curve, plot;
  bool csv = false, indices = false;
};

ExitCode run_materials(const Options& options) {
  if (options.indices) {
    if (!options.words.empty() || !options.curve.empty() || !options.plot.empty() || options.csv)
      throw InputError("ifov: --indices lists all refractive indices and stands alone");
    say(refractive_indices_list(refractive_indices()));
    return ExitCode::ok;
  }
  const bool one = !options.curve.empty() || !options.plot.empty() || options.csv;
  const std::vector<Material> found = search_materials(options.words);
  if (found.size() > 1) {
    if (one) {
      std::vector<std::string> names;
      for (const Material& material : found) names.push_back(material.name);
      throw InputError(format("--plot, --csv and --curve want one material; '{}' finds {}: {}", options.words,
                              found.size(), list_names(names, "and", 12)));
    }
    say(materials_list(found));
    return ExitCode::ok;
  }
  const Material& material = found.front();
  const std::vector<std::size_t> curves = curves_of(material, options.curve);
  if (!options.plot.empty()) {
    write_file(options.plot, material_figure(material, curves));
    complain(format("{}  (figure of '{}', PNG)", options.plot, material.name));
  }
  if (options.csv)
    say(material_csv(material, curves));
  else if (options.plot.empty())
    say(material_text(material, curves));
  return ExitCode::ok;
}

}  // namespace

Command add_materials_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* parser = app.add_subcommand("materials", "List, search and show the spectral library");
  parser->add_option("NAME", options->words, "A material, or words to search for; without it all are listed");
  parser->add_option("--curve", options->curve, "One curve alone, by its number or name");
  parser->add_option("--plot", options->plot, "Draw the curves into this file (PNG)");
  parser->add_flag("--csv", options->csv, "Print the figures as a table");
  parser->add_flag("--indices", options->indices,
                   "List the complex refractive indices that scattering models know by name");
  parser->footer(
      "Examples:\n"
      "  ifov materials\n"
      "  ifov materials asphalt\n"
      "  ifov materials --indices\n"
      "  ifov materials \"grass, lawn\" --plot lawn.png\n"
      "  ifov materials \"leaf, aspen\" --csv > aspen.csv");
  return {parser, [options] { return run_materials(*options); }};
}

}  // namespace ifov::cli
