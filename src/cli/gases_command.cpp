#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "cli/inputs_below.h"
#include "cli/interrupt.h"
#include "cli/run_commands.h"
#include "cli/terminal/console.h"
#include "cli/terminal/say.h"
#include "core/error.h"
#include "core/format.h"
#include "ifov/gas_model.h"

namespace ifov::cli {
namespace {

struct GasesArguments {
  std::vector<std::string> spectra, self_broadening, depth_error, continuum;
  std::string to, range;
  GasModelQuestion question;
  bool quiet = false;
};

/// "H2O=lines.csv": what stands before and after the first '='.
std::pair<std::string, std::string> parts(const std::string& text, const std::string& what,
                                          const std::string& example) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw InputError(format("ifov: {} is '{}', expected such as {}", what, text, example));
  return {text.substr(0, at), text.substr(at + 1)};
}

double number(const std::string& text, const std::string& what) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw InputError(format("ifov: {} is '{}', expected a number", what, text));
  return value;
}

GasModelQuestion::Spectra& of_gas(GasModelQuestion& question, const std::string& gas,
                                  const std::string& option) {
  const auto found = std::find_if(question.spectra.begin(), question.spectra.end(),
                                  [&](const GasModelQuestion::Spectra& one) {
                                    return CLI::detail::to_lower(one.gas) == CLI::detail::to_lower(gas);
                                  });
  if (found == question.spectra.end())
    throw InputError(format("ifov: {} names '{}', and no spectra are given of it", option, gas));
  return *found;
}

ExitCode make(const GasesArguments& arguments) {
  GasModelQuestion question = arguments.question;
  for (const std::string& text : arguments.spectra) {
    const auto [gas, file] = parts(text, "GAS=SPECTRA", "CH4=methane.csv");
    question.spectra.push_back({gas, file});
  }
  for (const std::string& text : arguments.self_broadening) {
    const auto [gas, times] = parts(text, "--self-broadening", "H2O=4.9");
    of_gas(question, gas, "--self-broadening").self_broadening = number(times, "--self-broadening");
  }
  for (const std::string& text : arguments.depth_error) {
    const auto [gas, share] = parts(text, "--depth-error", "H2O=0.03");
    of_gas(question, gas, "--depth-error").depth_error = number(share, "--depth-error");
  }
  for (const std::string& gas : arguments.continuum)
    of_gas(question, gas, "--continuum").holds_continuum = true;
  if (!arguments.range.empty()) {
    const std::size_t comma = arguments.range.find(',');
    if (comma == std::string::npos)
      throw InputError(
          format("ifov: --range is '{}', expected FROM,TO in cm-1, such as 4200,4400", arguments.range));
    question.first_cm1 = number(arguments.range.substr(0, comma), "--range");
    question.last_cm1 = number(arguments.range.substr(comma + 1), "--range");
  }
  Console console(arguments.quiet, "");
  question.cancel = &cancel_on_interrupt();
  question.progress = &console;
  console.phase("gas model");
  const GasModelOutcome made = make_gas_model(question, arguments.to);
  console.finish();
  for (const std::string& warning : made.warnings) console.warn(warning);
  const ExitCode done = made.warnings.empty() ? ExitCode::ok : ExitCode::warned;
  if (arguments.quiet) return done;
  say(format("{}  (gas model: {} bins of {:g} cm-1 from {:g} to {:g} cm-1, {:.1f} terms each)\n",
             arguments.to, made.bins, question.step_cm1, made.first_cm1, made.last_cm1, made.terms));
  say(format(
      "Transmittance along paths through six model atmospheres, terms less spectra: rms {:.2g}, largest {:.2g} (at {:g} "
      "cm-1), mean over all bins {:.2g}.\n",
      made.rms_error, made.largest_error, made.largest_error_at_cm1, made.mean_error));
  if (made.between_states > 0.0)
    say(format(
        "Interpolation between the states of the spectra may add {:.2g} at most; bins have both in their error.\n",
        made.between_states));
  if (question.spectra.size() > 1)
    say(format("The gases share their terms; overlapping at random they would be off by {:.2g} (rms).\n",
               made.random_overlap));
  if (made.missed > 0)
    say(format(
        "{} of the bins are off by more than {:g} somewhere with {} terms: --terms lets them have more.\n",
        made.missed, question.error, question.most_terms));
  return done;
}

}  // namespace

Command add_gases_command(CLI::App& app) {
  auto arguments = std::make_shared<GasesArguments>();
  GasModelQuestion& question = arguments->question;
  CLI::App* parser = app.add_subcommand(
      "gases", "Make a gas model: terms for 'gas_model' of a document from spectra line by line");
  parser
      ->add_option("SPECTRA", arguments->spectra,
                   "GAS=FILE: absorption cross sections of each gas by wavenumber, pressure and temperature")
      ->required();
  parser->add_option("-o,--output", arguments->to, "The file to write")->required();
  parser->add_option("--bin", question.step_cm1, "Width of the spectral bins, cm-1")->capture_default_str();
  parser->add_option("--range", arguments->range, "Of the bins, cm-1; without it as far as the spectra reach")
      ->type_name("FROM,TO");
  parser
      ->add_option("--error", question.error,
                   "Of transmittance, that each bin takes as many terms for as it needs")
      ->capture_default_str();
  parser->add_option("--terms", question.most_terms, "Of a bin, at most")->capture_default_str();
  parser->add_option("--source", question.source,
                     "In words: lines, line shape and the program the spectra come from");
  parser
      ->add_option("--self-broadening", arguments->self_broadening,
                   "GAS=TIMES: how much more than air the gas itself broadens its lines")
      ->type_name("GAS=TIMES")
      ->allow_extra_args(false);
  parser
      ->add_option(
          "--depth-error", arguments->depth_error,
          "GAS=SHARE: by what share of itself the depth of the gas may be off by these spectra, such as 0.03; the error "
          "of the model of the air then has this in place of that of the built-in bands")
      ->type_name("GAS=SHARE")
      ->allow_extra_args(false);
  parser
      ->add_option("--continuum", arguments->continuum,
                   "GAS whose spectra hold its continuum, so that the built-in one stays out")
      ->type_name("GAS")
      ->allow_extra_args(false);
  add_inputs_below(*parser);
  parser->add_option("-j,--threads", question.threads, "Threads; 0 takes all cores")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  parser->add_flag("-q,--quiet", arguments->quiet, "Print nothing but errors");
  parser->footer(
      "A table of spectra has a heading 'cm-1, 1013.25 hPa 296 K, ...' and rows of a wavenumber and a cross section\n"
      "(cm2 per molecule) for each state. All gases of a model have the same wavenumbers and states. How far the terms are\n"
      "from the spectra is found along paths through six model atmospheres, and written into the file.\n\n"
      "Examples:\n"
      "  ifov gases CH4=methane.csv -o swir.gases --bin 2\n"
      "  ifov gases H2O=water.csv CH4=methane.csv -o swir.gases --self-broadening H2O=4.9 --source \"HITRAN 2020, Voigt\"\n"
      "  ifov atmosphere scene.json --gases swir.gases");
  return {parser, [arguments] { return make(*arguments); }};
}

}  // namespace ifov::cli
