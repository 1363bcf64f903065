#include <CLI/CLI.hpp>
#include <charconv>
#include <numbers>

#include "cli/command.h"
#include "cli/inputs_below.h"
#include "cli/terminal/say.h"
#include "core/error.h"
#include "core/format.h"
#include "ifov/brdf.h"
#include "ifov/products.h"

namespace ifov::cli {
namespace {

struct BrdfArguments {
  std::string subject, material, at, reflectance, light, plot, csv;
  std::vector<std::string> set;
  int curve = 1;
  bool list = false, markdown = false, quiet = false;
};

/// "0,30,60", degrees from the normal, in radians.
std::vector<double> angles(const std::string& text) {
  std::vector<double> found;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    double deg = 0.0;
    const auto [stop, error] = std::from_chars(text.data() + at, text.data() + end, deg);
    if (error != std::errc() || stop != text.data() + end || !(deg >= 0.0 && deg <= 89.0))
      throw InputError(format(
          "ifov: --light is '{}', expected zenith angles from 0 to 89 degrees, such as 0,30,60", text));
    found.push_back(deg * std::numbers::pi / 180.0);
    at = end + 1;
  }
  constexpr std::size_t kMost = 6;
  if (found.size() > kMost)
    throw InputError(format("ifov: --light has {} angles; at most {} are shown", found.size(), kMost));
  return found;
}

BrdfReport ask(const BrdfArguments& arguments) {
  BrdfQuestion question;
  if (!arguments.at.empty()) question.wavelength_um = wavelength_um_of(arguments.at);
  if (!arguments.light.empty()) question.light_rad = angles(arguments.light);
  question.curve = arguments.curve;
  question.figure = !arguments.plot.empty();
  // A document without a material is asked for its materials.
  const bool is_file = arguments.subject.find_first_of("./") != std::string::npos;
  if (is_file || !arguments.material.empty()) {
    if (!arguments.reflectance.empty())
      throw InputError("ifov: --reflectance is of a model; a material has its own");
    return survey_brdf(Document::read(arguments.subject, arguments.set), arguments.material, question);
  }
  return survey_model(arguments.subject, arguments.set, arguments.reflectance, question);
}

ExitCode run_brdf(const BrdfArguments& arguments) {
  if (arguments.list) {
    say(arguments.markdown ? scattering_models_reference() : scattering_models_list());
    return ExitCode::ok;
  }
  if (arguments.subject.empty())
    throw InputError("ifov: brdf wants a model, or a document and a material; --list names the models");
  const BrdfReport report = ask(arguments);
  if (arguments.plot.empty() && arguments.csv.empty()) say(report.table());
  if (report.is_delta && !arguments.plot.empty() && !arguments.quiet)
    complain(
        format("'{}' sends all light in one direction: there is no BRDF to draw, and the figure shows its "
               "reflectance",
               report.name));
  if (!arguments.plot.empty()) {
    write_file(arguments.plot, report.figure());
    if (!arguments.quiet) complain(format("{}  (figure of '{}', PNG)", arguments.plot, report.name));
  }
  if (!arguments.csv.empty()) {
    write_file(arguments.csv, report.csv());
    if (!arguments.quiet) complain(format("{}  (numbers of '{}')", arguments.csv, report.name));
  }
  return ExitCode::ok;
}

}  // namespace

Command add_brdf_command(CLI::App& app) {
  auto arguments = std::make_shared<BrdfArguments>();
  CLI::App* parser =
      app.add_subcommand("brdf", "Show how a scattering model, or a material, reflects and emits");
  parser->add_option("MODEL|FILE", arguments->subject, "A scattering model, or a document (JSON)");
  parser->add_option("MATERIAL", arguments->material, "A material of the document");
  CLI::Option* list = parser->add_flag("--list", arguments->list, "The models and their parameters");
  parser->add_flag("--markdown", arguments->markdown, "The list as tables in Markdown")->needs(list);
  parser
      ->add_option(
          "--set", arguments->set,
          "A parameter of the model: --set slope=\"20 deg\"; of a document, a value in place of its own")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  parser
      ->add_option("--reflectance", arguments->reflectance,
                   "Of a model: a number, or a spectrum in JSON (default: 0.3, or 1 where it is a factor)")
      ->type_name("VALUE");
  parser
      ->add_option(
          "--at", arguments->at,
          "At which wavelength, where spectra differ: 0.55um, \"550 nm\" (default: of a model 0.55um)")
      ->type_name("WAVELENGTH");
  parser->add_option("--light", arguments->light, "Zenith angles of the light, in degrees (default: 0,30,60)")
      ->type_name("ANGLES");
  parser->add_option("--curve", arguments->curve, "Of a material with several reflectances, counted from 1")
      ->type_name("N");
  parser->add_option("--plot", arguments->plot, "Draw it into this file (PNG)")->type_name("PNG");
  parser->add_option("--csv", arguments->csv, "Write all numbers into this file")->type_name("CSV");
  add_inputs_below(*parser);
  parser->add_flag("-q,--quiet", arguments->quiet, "Print nothing but errors and tables");
  parser->footer(
      "Prints the BRDF in the plane of the normal and the light by zenith angle of the view (above 0 on the side\n"
      "of the light), directional-hemispherical reflectance and emissivity by angle. The figure has both, the\n"
      "BRDF over the hemisphere, and reflectance and emissivity by wavelength where they differ.\n\n"
      "Examples:\n"
      "  ifov brdf --list\n"
      "  ifov brdf oren_nayar --set slope=\"20 deg\"\n"
      "  ifov brdf rpv --set k=0.65 --set asymmetry=-0.3 --reflectance 0.08 --plot field.png\n"
      "  ifov brdf scene.json plaster --at 0.55um --plot plaster.png\n"
      "  ifov brdf scene.json plaster --at 10um --light 0,45,75 --csv plaster.csv");
  return {parser, [arguments] { return run_brdf(*arguments); }};
}

}  // namespace ifov::cli
