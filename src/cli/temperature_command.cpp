#include <CLI/CLI.hpp>
#include <numbers>

#include "cli/command.h"
#include "cli/inputs_below.h"
#include "cli/terminal/say.h"
#include "core/error.h"
#include "core/format.h"
#include "ifov/products.h"
#include "ifov/temperature.h"

namespace ifov::cli {
namespace {

struct TemperatureArguments {
  std::string document, plot, csv;
  std::vector<std::string> set, only;
  std::vector<double> at_m, along;
  std::string object;
  double slope_deg = 0.0, azimuth_deg = 180.0, height_m = 0.0;
  bool materials = false, quiet = false;
};

PointQuestion point_of(const TemperatureArguments& arguments) {
  PointQuestion question;
  question.object = arguments.object;
  question.above_object = arguments.at_m.empty();
  if (!arguments.at_m.empty()) {
    question.x_m = arguments.at_m[0];
    question.y_m = arguments.at_m[1];
    if (arguments.at_m.size() > 2) question.z_m = arguments.at_m[2];
  }
  if (!arguments.along.empty()) {
    if (arguments.at_m.size() < 3) throw InputError("ifov: --along wants to know from where: --at X Y Z");
    question.along_x = arguments.along[0], question.along_y = arguments.along[1],
    question.along_z = arguments.along[2];
  }
  return question;
}

TemperatureReport report_of(const TemperatureArguments& arguments) {
  const Document document = Document::read(arguments.document, arguments.set);
  const bool of_point = !arguments.at_m.empty() || !arguments.object.empty();
  if (of_point && (arguments.materials || !arguments.only.empty()))
    throw InputError(
        "ifov: temperature tells of materials (--materials, --only) or of a point (--at, --object), not of both");
  if (of_point) return point_temperature(document, point_of(arguments));
  constexpr double kDegree = std::numbers::pi / 180.0;
  TemperatureQuestion question;
  question.materials = arguments.only;
  question.slope_rad = arguments.slope_deg * kDegree;
  question.azimuth_rad = arguments.azimuth_deg * kDegree;
  question.height_m = arguments.height_m;
  return survey_temperatures(document, question);
}

ExitCode run_temperature(const TemperatureArguments& arguments) {
  if (!arguments.along.empty() && arguments.at_m.size() < 3)
    throw InputError("ifov: --along wants to know from where: --at X Y Z");
  if (!arguments.materials && arguments.only.empty() && arguments.at_m.empty() && arguments.object.empty())
    throw InputError(
        "ifov: temperature wants --materials, the day of every material in the Sun and in the shade, or a point of the scene: --at X Y Z, "
        "--object NAME");
  const TemperatureReport report = report_of(arguments);
  if (arguments.plot.empty() && arguments.csv.empty()) say(report.table());
  if (!arguments.plot.empty()) {
    write_file(arguments.plot, report.figure());
    if (!arguments.quiet)
      complain(format("{}  (curves of {} material{}, PNG)", arguments.plot, report.materials.size(),
                      report.materials.size() == 1 ? "" : "s"));
  }
  if (!arguments.csv.empty()) {
    write_file(arguments.csv, report.csv());
    if (!arguments.quiet)
      complain(format("{}  (temperatures and fluxes of {} material{})", arguments.csv,
                      report.materials.size(), report.materials.size() == 1 ? "" : "s"));
  }
  return ExitCode::ok;
}

}  // namespace

Command add_temperature_command(CLI::App& app) {
  auto arguments = std::make_shared<TemperatureArguments>();
  CLI::App* parser =
      app.add_subcommand("temperature", "Show how warm materials get under the document's weather");
  parser->add_option("FILE", arguments->document, "The document (JSON)")->required();
  parser->add_flag("--materials", arguments->materials,
                   "The day of every material that has \"thermal\" or a reflectance of the library");
  parser->add_option("--only", arguments->only, "This material alone; may be given several times")
      ->type_name("NAME")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  parser
      ->add_option("--slope", arguments->slope_deg,
                   "Of the surfaces, in degrees: 0 is level, 90 a wall (default: 0)")
      ->check(CLI::Range(0.0, 180.0))
      ->type_name("DEG");
  parser
      ->add_option("--azimuth", arguments->azimuth_deg,
                   "That a slope faces, in degrees clockwise from north (default: 180)")
      ->check(CLI::Range(0.0, 360.0))
      ->type_name("DEG");
  parser->add_option("--height", arguments->height_m, "Above ground, in metres, for the wind (default: 0)")
      ->check(CLI::Range(0.0, 1000.0))
      ->type_name("M");
  parser
      ->add_option(
          "--at", arguments->at_m,
          "A point of the scene: the first surface straight below, in metres; without Z from above everything")
      ->type_name("X Y [Z]")
      ->expected(2, 3);
  parser
      ->add_option("--along", arguments->along,
                   "In this direction from --at X Y Z in place of down: 0 1 0 is northwards")
      ->type_name("X Y Z")
      ->expected(3);
  parser
      ->add_option("--object", arguments->object,
                   "The point is of this object: from above its middle, or the first of it from --at")
      ->type_name("NAME");
  parser->add_option("--plot", arguments->plot, "Draw the curves into this file (PNG)")->type_name("PNG");
  parser->add_option("--csv", arguments->csv, "Write all temperatures and fluxes into this file")
      ->type_name("CSV");
  parser
      ->add_option("--set", arguments->set,
                   "A value of the document in place of its own: --set time=2026-06-21T14:00Z")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_inputs_below(*parser);
  parser->add_flag("-q,--quiet", arguments->quiet, "Print nothing but errors and tables");
  parser->footer(
      "Solves the heat balance of a surface of each material over the 24 hours before the document's time, once\n"
      "always in the Sun and once never, and says when one becomes warmer than another. The document needs\n"
      "\"time\", \"weather\" and a place; \"temperatures\" says how it is solved. A point of the scene (--at, --object), whose\n"
      "temperature is \"solved\", is told as the Sun and the sky reached it, with all fluxes.\n\n"
      "Examples:\n"
      "  ifov temperature scene.json --materials\n"
      "  ifov temperature scene.json --materials --csv day.csv --plot day.png\n"
      "  ifov temperature scene.json --only wall --slope 90 --azimuth 180 --height 3\n"
      "  ifov temperature scene.json --at 3 -2 --plot point.png\n"
      "  ifov temperature scene.json --at 0 -20 1.5 --along 0 1 0\n"
      "  ifov temperature scene.json --object car");
  return {parser, [arguments] { return run_temperature(*arguments); }};
}

}  // namespace ifov::cli
