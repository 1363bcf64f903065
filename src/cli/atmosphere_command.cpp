#include <CLI/CLI.hpp>
#include <charconv>
#include <numbers>

#include "cli/command.h"
#include "cli/document_arguments.h"
#include "cli/inputs_below.h"
#include "cli/interrupt.h"
#include "cli/terminal/console.h"
#include "cli/terminal/say.h"
#include "core/error.h"
#include "core/format.h"
#include "ifov/atmosphere.h"
#include "ifov/products.h"

namespace ifov::cli {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLowestSun_deg = 96.0, kLowestView_deg = 80.0;

struct AtmosphereArguments {
  DocumentArguments input;
  std::string document, plot, csv, sky, sun, view, channel, invert, stem, summary, gases, ground;
  std::optional<double> altitude_km;
  int threads = 0;
  bool quiet = false, wants_plot = false, resolved = false;
};

/// None where the text is something else.
std::optional<double> number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "30,135": zenith angle and azimuth in degrees.
AtmosphereQuestion::Direction direction(const std::string& option, const std::string& text,
                                        double lowest_deg) {
  const std::size_t comma = text.find(',');
  const std::string_view all = text;
  const auto zenith = number(all.substr(0, comma));
  const auto azimuth = comma == std::string::npos ? std::optional<double>() : number(all.substr(comma + 1));
  if (!zenith || !azimuth)
    throw InputError(
        format("ifov: {} is '{}', expected ZENITH,AZIMUTH in degrees, such as 30,135", option, text));
  if (!(*zenith >= 0.0 && *zenith <= lowest_deg))
    throw InputError(format("ifov: {} has a zenith angle of {:g} degrees, expected 0 to {:g}", option,
                            *zenith, lowest_deg));
  return {*zenith * kDegree, *azimuth * kDegree};
}

ExitCode invert(const AtmosphereArguments& arguments) {
  Console console(arguments.quiet, "");
  InversionQuestion question;
  question.cube = arguments.invert;
  question.stem = arguments.stem;
  question.threads = arguments.threads;
  question.cancel = &cancel_on_interrupt();
  console.phase("atmosphere");
  question.progress = &console;
  question.log = &console;
  const InversionOutcome outcome = invert_radiance(arguments.input.read(arguments.document), question);
  console.finish();
  if (arguments.quiet) return ExitCode::ok;
  say(format("{}  (surface reflectance, ENVI)\n{}  (half-width of its interval, ENVI)\n",
             outcome.reflectance.string(), outcome.half_width.string()));
  if (!outcome.left_out.empty()) {
    std::string names;
    for (const std::string& name : outcome.left_out) names += (names.empty() ? "'" : ", '") + name + "'";
    say(format(
        "No reflectance (not a number) of {}: no sunlight that ground reflects is seen there, apart from what it "
        "emits.\n",
        names));
  }
  if (outcome.missing > 0)
    say(format("{} of {} values are missing in the cube.\n", outcome.missing, outcome.values));
  if (outcome.negative > 0)
    say(format(
        "{} of {} values are darker than the path alone, most in '{}': their reflectance is negative, and kept.\n",
        outcome.negative, outcome.values, outcome.most_negative));
  return ExitCode::ok;
}

ExitCode survey(const AtmosphereArguments& arguments) {
  Console console(arguments.quiet, "");
  AtmosphereQuestion question;
  if (arguments.sun == "none")
    question.night = true;
  else if (!arguments.sun.empty())
    question.sun = direction("--sun", arguments.sun, kLowestSun_deg);
  if (!arguments.view.empty()) question.view = direction("--view", arguments.view, kLowestView_deg);
  question.sensor_altitude_km = arguments.altitude_km;
  question.gas_model = arguments.gases;
  if (const std::optional<double> reflectance = number(arguments.ground)) {
    if (!(*reflectance >= 0.0 && *reflectance <= 1.0))
      throw InputError(format("ifov: --ground is {:g}, expected a reflectance of 0 to 1", *reflectance));
    question.ground_reflectance = *reflectance;
  } else {
    question.ground_material = arguments.ground;
  }
  if (!arguments.summary.empty()) {
    const std::string ending = std::filesystem::path(arguments.summary).extension().string();
    if (ending != ".csv" && ending != ".nc")
      throw InputError(
          format("ifov: --summary is '{}', expected a name that ends in .csv or .nc", arguments.summary));
  }
  question.sky_channel = arguments.channel;
  question.sky = arguments.wants_plot || !arguments.sky.empty();
  question.spectrum = arguments.wants_plot || !arguments.csv.empty() || arguments.resolved;
  question.threads = arguments.threads;
  question.cancel = &cancel_on_interrupt();
  console.phase("atmosphere");
  question.progress = &console;
  question.log = &console;
  const AtmosphereReport report = survey_atmosphere(arguments.input.read(arguments.document), question);
  console.finish();
  if (!arguments.quiet) say(report.table());
  if (arguments.wants_plot) {
    const std::string path =
        arguments.plot.empty()
            ? std::filesystem::path(arguments.document).replace_extension(".atmosphere.png").string()
            : arguments.plot;
    write_file(path, report.figure());
    if (!arguments.quiet) complain(format("{}  (figure, PNG)", path));
  }
  if (!arguments.csv.empty()) {
    write_file(arguments.csv, report.csv());
    if (!arguments.quiet)
      complain(format("{}  (spectrum, {} steps of {:g} cm-1)", arguments.csv, report.spectrum.size(),
                      report.step_cm1));
  }
  if (!arguments.summary.empty()) {
    report.write_summary(arguments.summary, arguments.resolved);
    if (!arguments.quiet)
      complain(format("{}  (summary, {})", arguments.summary,
                      arguments.resolved
                          ? format("{} steps of {:g} cm-1", report.spectrum.size(), report.step_cm1)
                          : format("{} channels", report.channels.size())));
  }
  if (!arguments.sky.empty()) {
    write_file(arguments.sky, report.sky_csv());
    if (!arguments.quiet)
      complain(format("{}  (sky of '{}' at {:.4g} um)", arguments.sky, report.sky->channel,
                      report.sky->wavelength_um));
  }
  return ExitCode::ok;
}

}  // namespace

Command add_atmosphere_command(CLI::App& app) {
  auto arguments = std::make_shared<AtmosphereArguments>();
  CLI::App* parser =
      app.add_subcommand("atmosphere", "Show what a document's atmosphere does to its channels");
  parser->add_option("FILE", arguments->document, "The document (JSON), with a 'profile' under 'atmosphere'")
      ->required();
  CLI::Option* plot = parser->add_option(
      "--plot", arguments->plot,
      "Draw spectra and sky into this file (PNG); without a name FILE.atmosphere.png beside the document");
  plot->expected(0, 1)->type_name("[PNG]");
  arguments->input.add_to(*parser);
  parser->add_option("--csv", arguments->csv, "Write the spectrum as a table of paths")->type_name("OUT");
  parser->add_option("--sky", arguments->sky, "Write the sky's radiance and polarization by direction as CSV")
      ->type_name("OUT");
  CLI::Option* summary = parser->add_option(
      "--summary", arguments->summary,
      "Write what correction codes ask for, a row for each channel: CSV or NetCDF by the name (.csv, .nc)");
  summary->type_name("OUT");
  parser->add_flag("--resolved", arguments->resolved, "Let --summary have the steps of the spectrum as rows")
      ->needs(summary);
  parser
      ->add_option(
          "--ground", arguments->ground,
          "The ground in fluxes and light at the sensor: a reflectance (default: 0), one of the document's materials, or "
          "'surroundings'")
      ->type_name("REFLECTANCE|MATERIAL");
  parser
      ->add_option("--sun", arguments->sun,
                   "Where the Sun stands instead, in degrees (azimuth from north over east); 'none': night")
      ->type_name("ZENITH,AZIMUTH");
  parser
      ->add_option("--view", arguments->view,
                   "Where the sensor stands instead, seen from the ground, in degrees")
      ->type_name("ZENITH,AZIMUTH");
  parser->add_option("--altitude", arguments->altitude_km, "Of the sensor instead, above mean sea level")
      ->type_name("KM");
  parser
      ->add_option("--gases", arguments->gases,
                   "Terms of gases in place of the built-in bands, from a file as 'ifov gases' makes it")
      ->type_name("FILE");
  parser
      ->add_option("--channel", arguments->channel,
                   "Whose sky is shown (default: the one next to 0.45 um, at night 10 um)")
      ->type_name("NAME");
  CLI::Option* invert_option =
      parser
          ->add_option(
              "--invert", arguments->invert,
              "Turn a radiance cube (ENVI, or a folder of products) into surface reflectance instead")
          ->type_name("RUN_OR_CUBE");
  parser
      ->add_option("--to", arguments->stem,
                   "NAME of the NAME_reflectance.img that --invert writes (default: beside the cube)")
      ->type_name("NAME")
      ->needs(invert_option);
  for (const char* other : {"--plot", "--csv", "--sky", "--sun", "--view", "--altitude", "--channel",
                            "--summary", "--ground", "--gases"})
    invert_option->excludes(parser->get_option(other));
  add_inputs_below(*parser);
  parser->add_option("-j,--threads", arguments->threads, "Threads; 0 takes all cores")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  parser->add_flag("-q,--quiet", arguments->quiet, "Print nothing but errors");
  parser->footer(
      "Prints a row for each channel: direct transmittance from the Sun to the ground and from the ground "
      "to\n"
      "the sensor, radiance of the path (sunlight that it scatters, and its own emission), irradiance of "
      "level\n"
      "ground from Sun and sky, the air's albedo for light from below, and in the thermal infrared the "
      "sky's\n"
      "temperature, over black ground; what correction codes ask for; and over ground of --ground fluxes at the\n"
      "ground and at the sensor, and Q and U there. Meshes and maps of the scene are not read.\n\n"
      "The figure and the table of --csv have the spectrum over the sensor's range at the 20 cm-1 that the "
      "band\n"
      "model resolves. The sky is drawn as seen lying on the back: north up, east on the left;\n"
      "+ marks where it is unpolarized, and a line below the table says where that is.\n\n"
      "Examples:\n"
      "  ifov atmosphere scene.json\n"
      "  ifov atmosphere scene.json --plot air.png --channel blue\n"
      "  ifov atmosphere scene.json --sun 70,120 --view 30,300 --altitude 3 --csv air.csv\n"
      "  ifov atmosphere scene.json --ground 0.3 --summary air.nc\n"
      "  ifov atmosphere scene.json --ground sea\n"
      "  ifov atmosphere scene.json --sky sky.csv --channel blue\n"
      "  ifov atmosphere scene.json --gases swir.gases --csv fine.csv\n"
      "  ifov atmosphere scene.json --sun none\n"
      "  ifov atmosphere scene.json --invert scene.out");
  return {parser, [arguments, plot] {
            arguments->wants_plot = plot->count() > 0;
            return arguments->invert.empty() ? survey(*arguments) : invert(*arguments);
          }};
}

}  // namespace ifov::cli
