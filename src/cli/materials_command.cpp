#include <CLI/CLI.hpp>
#include <numeric>

#include "cli/command.h"
#include "cli/terminal/say.h"
#include "core/error.h"
#include "core/names.h"
#include "io/figures/material_plot.h"
#include "io/library/material_library.h"
#include "io/library/material_text.h"
#include "io/products/part_file.h"

namespace ifov::cli {
namespace {

struct Options {
  std::string words, curve, plot;
  bool csv = false;
};

std::vector<std::size_t> wanted_curves(const io::LibraryMaterial& material, const std::string& curve) {
  if (curve.empty()) {
    std::vector<std::size_t> all(material.curves.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }
  if (curve.size() < 4 && curve.find_first_not_of("0123456789") == std::string::npos)
    return {material.curve_numbered(std::stoi(curve))};
  return {material.curve_named(curve)};
}

void write_file(const std::string& path, const std::string& content) {
  io::PartFile file(path);
  io::write_part(file, content);
  file.publish();
}

ExitCode run_materials(const Options& options) {
  const io::MaterialLibrary& library = io::material_library();
  const bool one = !options.curve.empty() || !options.plot.empty() || options.csv;
  std::vector<const io::LibraryMaterial*> found;
  if (library.has(options.words))
    found = {&library.find(options.words)};
  else
    found = library.search(options.words);
  if (found.empty()) library.find(options.words);  // says what comes near
  if (found.size() > 1) {
    if (one) {
      std::vector<std::string> names;
      for (const io::LibraryMaterial* material : found) names.push_back(material->name);
      throw InputError(format("--plot, --csv and --curve want one material; '{}' finds {}: {}", options.words,
                              found.size(), list_names(names, "and", 12)));
    }
    say(io::list_materials(found));
    return ExitCode::ok;
  }
  const io::LibraryMaterial& material = *found.front();
  const std::vector<std::size_t> curves = wanted_curves(material, options.curve);
  if (!options.plot.empty()) {
    write_file(options.plot, io::plot_material(material, curves));
    complain(format("{}  (figure of '{}', PNG)", options.plot, material.name));
  }
  if (options.csv)
    say(io::material_csv(material, curves));
  else if (options.plot.empty())
    say(io::describe_material(material, curves));
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
  parser->footer(
      "Examples:\n"
      "  ifov materials\n"
      "  ifov materials asphalt\n"
      "  ifov materials \"grass, lawn\" --plot lawn.png\n"
      "  ifov materials \"leaf, aspen\" --csv > aspen.csv");
  return {parser, [options] { return run_materials(*options); }};
}

}  // namespace ifov::cli
