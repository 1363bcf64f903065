#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/document_arguments.h"
#include "cli/inputs_below.h"
#include "cli/run_commands.h"
#include "cli/terminal/say.h"
#include "core/format.h"
#include "ifov/instruments.h"
#include "ifov/sensor.h"

namespace ifov::cli {
namespace {

void say_camera(const SensorDescription& sensor) {
  std::string text = format("{} x {} pixels", sensor.width_px, sensor.height_px);
  if (sensor.gsd_m) text += format(", GSD {:.4g} m", *sensor.gsd_m);
  if (sensor.swath_m) text += format(", swath {:.5g} m", *sensor.swath_m);
  if (sensor.ifov_rad > 0.0) text += format(", IFOV {:.4g} urad", 1e6 * sensor.ifov_rad);
  if (sensor.f_number) text += format(", f/{:.3g}", *sensor.f_number);
  if (sensor.smear_px) text += format(", smear {:.3g} pixels", *sensor.smear_px);
  if (sensor.row_shift_px) text += format(", {:.3g} pixels from row to row", *sensor.row_shift_px);
  say(text + "\n");
  if (!sensor.mosaic.empty()) say(format("mosaic {}\n", sensor.mosaic));
}

void say_channel(const SensorDescription::Channel& channel) {
  const auto line = [](const char* name, const std::string& text) {
    say(format("  {:<12} {}\n", name, text));
  };
  say(format("{}: {:.5g} um, {:.4g} um wide\n", channel.name, channel.centre_um, channel.fwhm_um));
  if (channel.centres_um)
    line("smile",
         format("{:.6g} to {:.6g} um, {:.4g} to {:.4g} um wide, by column", channel.centres_um->least,
                channel.centres_um->most, channel.fwhms_um->least, channel.fwhms_um->most));
  if (channel.shift_px)
    line("keystone", format("{:.3g} to {:.3g} pixels to the right, by column", channel.shift_px->least,
                            channel.shift_px->most));
  std::string mtf = format("pixel {:.3f}", channel.pixel_mtf);
  if (channel.psf_mtf) mtf += format(", document's PSF {:.3f}", *channel.psf_mtf);
  if (channel.diffraction_mtf) mtf += format(", diffraction {:.3f}", *channel.diffraction_mtf);
  line("MTF at 1/2", mtf);
  if (channel.has_detector) {
    line("radiance", format("{:.4g} W m-2 sr-1 um-1", channel.radiance));
    line("photons", format("{:.4g}", channel.photons));
    line("electrons", format("{:.4g}, of warm optics {:.4g}, of dark current {:.4g}", channel.electrons,
                             channel.background, channel.dark));
    if (channel.well_share)
      line("filled",
           format("{:.3g} %{}", 100.0 * *channel.well_share, *channel.well_share > 1.0 ? ", saturated" : ""));
    if (channel.snr) line("SNR", format("{:.4g}", *channel.snr));
  }
  if (channel.nedl > 0.0) line("NEdL", format("{:.4g} W m-2 sr-1 um-1", channel.nedl));
  if (channel.nedt) line("NEdT", format("{:.4g} K at {:.4g} K", *channel.nedt, *channel.nedt_at_k));
  if (channel.corner_light) {
    std::string corner = format("{:.3g} % of the light", 100.0 * *channel.corner_light);
    if (channel.corner_snr) corner += format(", SNR {:.4g}", *channel.corner_snr);
    if (channel.corner_nedt) corner += format(", NEdT {:.4g} K", *channel.corner_nedt);
    line("at corners", corner);
  }
  if (channel.correction_left)
    line("correction", format("leaves {:.4g} W m-2 sr-1 um-1 from element to element, {:.3g} of the noise",
                              *channel.correction_left, *channel.correction_left / channel.nedl));
  if (!channel.memory_mtf) return;
  std::string memory = format("{:.3g} % of a step in the first exposure, MTF {:.3f} at 1/2 cycle an exposure",
                              100.0 * *channel.step_share, *channel.memory_mtf);
  if (channel.nedt)
    memory += format(": NEdT {:.4g} K of what changes so fast", *channel.nedt / *channel.memory_mtf);
  line("memory", memory);
}

void say_sensor(const Document& document) {
  const SensorDescription sensor = describe_sensor(document);
  say_camera(sensor);
  for (const SensorDescription::Channel& channel : sensor.channels) say_channel(channel);
}

/// Comments of lines that are no longer than a terminal's.
std::string commented(const std::string& text) {
  constexpr std::size_t kWidth = 110;
  std::string lines, line;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    const std::string word = text.substr(from, to - from);
    if (!line.empty() && line.size() + 1 + word.size() > kWidth)
      lines += format("// {}\n", line), line.clear();
    line += line.empty() ? word : " " + word;
    from = to + 1;
  }
  return lines + format("// {}\n", line);
}

void say_preset(const SensorPresetInfo& preset) {
  std::string text = commented(format("{}: {}", preset.name, preset.about));
  for (const std::string& source : preset.sources) text += commented(format("- {}", source));
  text += commented(format(
      "What a document takes by \"sensor\": {{\"preset\": \"{}\"}} is all below 'sensor' but the camera.",
      preset.name));
  say(text + preset.document);
}

ExitCode list_presets(const std::string& name) {
  if (!name.empty()) {
    say_preset(find_sensor_preset(name));
    return ExitCode::ok;
  }
  const auto row = [](const std::string& instrument, const std::string& bands, const std::string& um,
                      const std::string& noise, const std::string& pixel) {
    say(format("{:<22} {:>5}  {:<15} {:<18} {}\n", instrument, bands, um, noise, pixel));
  };
  row("instrument", "bands", "um", "noise", "pixel, or kind");
  for (const SensorPresetInfo& preset : sensor_preset_list())
    row(preset.name, format("{}", preset.bands), format("{:.4g} to {:.4g}", preset.first_um, preset.last_um),
        preset.noise.empty() ? "not told" : preset.noise, preset.ground);
  say("\n'ifov sensors NAME' says what an instrument is and where its figures come from, and prints a document with it.\n");
  return ExitCode::ok;
}

}  // namespace

Command add_sensor_command(CLI::App& app) {
  struct Arguments {
    std::string document;
    DocumentArguments input;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* parser = app.add_subcommand("sensor", "Say what follows of a document's sensor, without a ray");
  parser->add_option("FILE", arguments->document, "The document")->required();
  arguments->input.add_to(*parser);
  add_inputs_below(*parser);
  parser->footer(
      "GSD, swath and IFOV where the middle of the image meets z = 0, and of a frame that flies how far its picture moves; by channel the MTF at half a cycle a pixel, and with a\n"
      "'detector' photons, electrons, how full the well is, SNR, NEdL and NEdT, of one exposure at the detector's 'reference'; of a spectrometer\n"
      "how far smile and keystone take its columns (all other figures are of the channel's own response), and the pattern of a mosaic.\n\n"
      "Examples:\n"
      "  ifov sensor scene.json\n"
      "  ifov sensor scene.json --set sensor.detector.reference='{\"reflectance\": 0.3, \"sun_zenith\": \"40 deg\"}'");
  return {parser, [arguments] {
            const std::vector<std::string> instruments =
                instruments_of(arguments->document, arguments->input.set);
            for (const std::string& name : instruments) {
              say(format("instrument {}\n", name));
              say_sensor(arguments->input.read(arguments->document, name));
            }
            if (instruments.empty()) say_sensor(arguments->input.read(arguments->document));
            return ExitCode::ok;
          }};
}

Command add_sensors_command(CLI::App& app) {
  auto name = std::make_shared<std::string>();
  CLI::App* parser =
      app.add_subcommand("sensors", "List instruments that are known by name, or print one as a document");
  parser->add_option("NAME", *name, "The instrument; without it all are listed");
  parser->footer(
      "A document takes one by its name: \"sensor\": {\"preset\": \"Landsat 8 TIRS\", \"camera\": ...}. What is printed of one is a\n"
      "whole document with land and a lake under it, to be changed.\n\n"
      "Examples:\n"
      "  ifov sensors\n"
      "  ifov sensors \"Landsat 8 TIRS\" > tirs.json");
  return {parser, [name] { return list_presets(*name); }};
}

}  // namespace ifov::cli
