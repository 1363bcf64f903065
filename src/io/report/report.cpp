#include "io/report/report.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "io/json/json_writer.h"
#include "io/product_parts/picture.h"
#include "io/product_parts/product_headers.h"
#include "io/report/report_data.h"
#include "io/report/report_page.h"
#include "io/report/report_reasons.h"
#include "io/report/report_words.h"
#include "sampling/means/region_interval.h"

namespace ifov::io {
namespace {

void write_histogram(JsonWriter& json, const Histogram& h) {
  json.member("edges", h.edges);
  json.member("counts", h.counts);
  json.member("logarithmic", h.logarithmic);
}

/// JSON inside a script element must not close it.
std::string embedded(const std::string& json) {
  std::string safe;
  for (const char c : json) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

std::string data_element(const std::string& id, std::string_view bytes) {
  return format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, base64(bytes));
}

std::string colour_element(const std::string& id, const ColourMap& map) {
  std::string bytes;
  for (const Rgb c : map)
    for (const std::uint8_t part : {c.r, c.g, c.b}) bytes += static_cast<char>(part);
  return data_element(id, bytes);
}

class Page {
 public:
  Page(const RunRecord& record, const ReportInput& input, std::size_t embed_limit_bytes)
      : record_(record), input_(input), bands_(static_cast<int>(record.image.channels.size())) {
    // Samplers without an error estimate write half-widths that are no numbers.
    const auto& figures = record.statistics.channels;
    if (std::none_of(figures.begin(), figures.end(),
                     [](const ChannelStatistics& s) { return std::isfinite(s.largest_half_width); }))
      input_.half_width = {};
    const std::size_t per_pixel = 2 * (static_cast<std::size_t>(bands_) * (input_.half_width ? 2 : 1) + 6);
    step_ = thinning_step(record.image.width_px, record.image.height_px, per_pixel, embed_limit_bytes);
    picture_ = input.picture.empty() ? picture_channels(record.image) : input.picture;
    judged_ = !record.identity.accuracy_asked.empty() && static_cast<bool>(input_.quality);
  }

  std::string text() {
    const std::string title = title_text();
    std::string page =
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n";
    page += format("<title>{}</title>\n<style>{}</style></head>\n<body><main>\n", escape_html(title),
                   kReportStyle);
    page += heading(title) + statements() + tiles() + viewer() + maps() + reasons() + channel_table() +
            cost() + provenance();
    page += "</main>\n" + data();
    page += format("<script>{}{}{}</script>\n</body></html>\n", kReportScript, kReportQualityScript,
                   kReportBeginScript);
    return page;
  }

 private:
  std::string title_text() const {
    const std::filesystem::path document = record_.identity.document_path;
    return document.empty() ? "Synthetic image" : document.stem().string();
  }

  std::string heading(const std::string& title) const {
    const auto& image = record_.image;
    std::string meta = format("{} \u00d7 {} pixels, {} channel{}", image.width_px, image.height_px, bands_,
                              bands_ == 1 ? "" : "s");
    if (image.has_map && image.gsd_m > 0.0) meta += format(", {:g} m per pixel", image.gsd_m);
    meta += format(" \u00b7 sampler {} \u00b7 seed {} \u00b7 ifov {}", record_.identity.sampler,
                   record_.identity.seed, record_.identity.version);
    return format("<h1>{}</h1>\n<p class=\"meta\">{}</p>\n", escape_html(title), escape_html(meta));
  }

  std::string statements() const {
    const auto& o = record_.outcome;
    std::string html;
    const auto one = [&](const char* name, const std::string& words, const std::string& more) {
      if (words.empty()) return;
      html +=
          format("<section class=\"statement\"><h2>{}</h2><p>{}</p>{}</section>\n", name, escape_html(words),
                 more.empty() ? "" : format("<p class=\"soft\">{}</p>", escape_html(more)));
    };
    const std::string& asked = record_.identity.accuracy_asked;
    const bool said = asked.empty() || o.accuracy_statement.find(asked) != std::string::npos;
    one("Accuracy", o.accuracy_statement, said ? "" : format("Asked for: {}.", asked));
    one("Detection", o.detection_statement, "");
    return html.empty() ? html : format("<div class=\"two\">{}</div>\n<p></p>\n", html);
  }

  std::string tiles() const {
    const auto& s = record_.statistics;
    const double pixels = static_cast<double>(std::max<std::uint64_t>(s.pixels, 1));
    std::string html = "<div class=\"tiles\">";
    const auto tile = [&](const std::string& value, const char* what) {
      html += format("<div><b>{}</b><span>{}</span></div>", value, what);
    };
    if (judged_)
      tile(format("{:.2f} %", 100.0 * static_cast<double>(s.converged) / pixels), "of pixels converged");
    if (judged_) tile(figure(s.worst_ratio), "worst half-width over its limit");
    tile(format("{:.4g}", static_cast<double>(s.samples) / pixels), "samples per pixel, mean");
    tile(short_count(static_cast<double>(s.rays.total())), "rays in all");
    tile(duration(record_.outcome.elapsed_s), record_.outcome.threads == 1 ? "on 1 thread" : "of wall time");
    return html + "</div>\n";
  }

  std::string viewer() const {
    const bool colour = picture_.size() == 3;
    std::string html = "<section><h2>Image and spectrum</h2>";
    html += "<div class=\"viewer\"><div><div class=\"controls\"><span class=\"tabs\" id=\"views\">";
    if (colour) html += "<button data-view=\"colour\">Colour</button>";
    html += "<button data-view=\"channel\">Channel</button>";
    if (input_.half_width) html += "<button data-view=\"width\">Half-width</button>";
    html += format(
        "</span><input id=\"band\" type=\"range\" min=\"0\" max=\"{}\" step=\"1\" aria-label=\"channel\"{}>"
        "<span id=\"band-name\" class=\"soft\"></span></div>",
        bands_ - 1, bands_ == 1 ? " hidden" : "");
    html +=
        "<div class=\"stage\"><canvas id=\"image\"></canvas><svg id=\"mark\"></svg></div>"
        "<svg class=\"bar\" id=\"image-bar\"></svg></div>";
    html += format(
        "<figure><svg id=\"spectrum\" width=\"100%\"></svg><figcaption><span id=\"pixel\"></span><br>Click "
        "the image to choose a pixel, drag to choose a region.{}</figcaption></figure></div>",
        input_.half_width ? format(" Bars are {:g} % intervals.", 100.0 * record_.identity.confidence) : "");
    if (step_ > 1)
      html += format(
          "<p class=\"note\">Preview: every {} pixel of every {} line is shown here; all figures and "
          "histograms are of "
          "the whole image.</p>",
          ordinal(step_), ordinal(step_));
    return html + "</section>\n";
  }

  std::string maps() const {
    std::string html;
    const auto map = [&](const char* id, const char* name, const std::string& note) {
      html += format(
          "<section><h2>{}</h2><div class=\"stage\"><canvas id=\"map-{}\" "
          "style=\"cursor:default\"></canvas></div>"
          "<svg class=\"bar\" id=\"map-{}-bar\"></svg><svg id=\"hist-{}\" width=\"100%\"></svg>{}</section>\n",
          name, id, id, id, note);
    };
    const std::string seams =
        record_.statistics.halo_samples == 0
            ? std::string()
            : format(
                  "<p class=\"note\">Lines along the edges of tiles are no fault of the image: points that a tile queries outside "
                  "its own pixels, {} in all, are in no pixel's count, and pixels at an edge need fewer of their own.</p>",
                  short_count(static_cast<double>(record_.statistics.halo_samples)));
    if (input_.samples) map("samples", "Where the samples went", seams);
    if (judged_) map("error", "Error reached, in units of its limit", "");
    return html.empty() ? html : format("<div class=\"two\">{}</div>\n<p></p>\n", html);
  }

  std::string reasons() const {
    return judged_ && input_.reasons && record_.statistics.converged < record_.statistics.pixels
               ? reasons_section(record_)
               : std::string();
  }

  std::string channel_table() const {
    const auto& figures = record_.statistics.channels;
    const bool split = std::any_of(figures.begin(), figures.end(),
                                   [](const ChannelStatistics& s) { return s.parts.has_value(); });
    std::string html = format(
        "<section><h2>Channels</h2><div class=\"scroll\"><table><thead><tr><th>Channel</th><th>Centre, "
        "\u00b5m</th>"
        "<th>FWHM, \u00b5m</th><th>Mean</th><th>Std. dev.</th><th>Minimum</th><th>Maximum</th>"
        "<th>Half-width, mean</th><th>largest</th>{}</tr></thead><tbody>",
        split
            ? "<th>Mean by sampling</th><th>by the air</th><th>by nodes</th><th>by the model of the air</th>"
            : "");
    for (std::size_t c = 0; c < record_.image.channels.size(); ++c) {
      const auto& channel = record_.image.channels[c];
      const auto& s = record_.statistics.channels.at(c);
      html += format("<tr><td>{}</td>", escape_html(channel.name));
      for (const double v : {channel.centre_um, channel.fwhm_um, s.mean, s.standard_deviation, s.minimum,
                             s.maximum, s.mean_half_width, s.largest_half_width})
        html += format("<td>{}</td>", figure(v));
      if (split)
        for (const double HalfWidthParts::*part : {&HalfWidthParts::sampling, &HalfWidthParts::air,
                                                   &HalfWidthParts::nodes, &HalfWidthParts::model})
          html += format("<td>{}</td>", s.parts ? figure(*s.parts.*part) : "");
      html += "</tr>";
    }
    return html +
           format(
               "</tbody></table></div><p class=\"soft\">Radiances in {}.{}</p></section>\n",
               escape_html(shown_unit(record_.image.radiance_unit)),
               split
                   ? " More rays narrow the part of sampling alone; that of the air, of how it was computed, and that of "
                     "the nodes, few wavelengths that stand for a channel, are of the mean radiance, and are bounds, so that the whole is less than the sum; so is that of the model of the "
                     "air, 0 where intervals are of the numbers alone."
                   : "");
  }

  std::string cost() const {
    const auto& s = record_.statistics;
    std::string html = "<div class=\"two\"><section><h2>Samples</h2><table><tbody>";
    const auto row = [&](const char* name, std::uint64_t value) {
      html += format("<tr><td>{}</td><td>{}</td></tr>", name, count(value));
    };
    row("All points queried", s.samples);
    row("Fewest in a pixel", s.fewest_samples);
    row("Most in a pixel", s.most_samples);
    row("Label rays", s.label_rays);
    row("Radiance evaluations", s.radiance_evaluations);
    row("Pilot rays at small objects", s.pilot_samples);
    row("Probes", s.probe_samples);
    row("In halos of tiles", s.halo_samples);
    html += "</tbody></table></section><section><h2>Rays</h2><table><tbody>";
    row("From the camera", s.rays.primary);
    row("To the Sun", s.rays.shadow);
    row("Leaving surfaces", s.rays.continuation);
    row("All", s.rays.total());
    const double time = record_.outcome.elapsed_s;
    html += format("<tr><td>Wall time</td><td>{}</td></tr><tr><td>Threads</td><td>{}</td></tr>",
                   duration(time), record_.outcome.threads);
    if (time > 0.0)
      html += format("<tr><td>Rays per second</td><td>{}</td></tr>",
                     short_count(static_cast<double>(s.rays.total()) / time));
    return html + "</tbody></table></section></div>\n<p></p>\n";
  }

  std::string provenance() const {
    std::string html;
    if (!record_.outcome.notes.empty()) {
      html += "<section><h2>Notes</h2><ul>";
      for (const auto& note : record_.outcome.notes) html += format("<li>{}</li>", escape_html(note));
      html += "</ul></section>\n";
    }
    if (!record_.files.empty()) {
      html +=
          "<section><details><summary>Files</summary><table class=\"files\"><thead><tr><th>File</th><th "
          "style=\"text-align:left\">What</th><th>Bytes</th><th>SHA-256</th></tr></thead><tbody>";
      for (const auto& file : record_.files)
        html += format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
                       escape_html(file.path.filename().string()), escape_html(file.what), count(file.bytes),
                       file.sha256);
      html += "</tbody></table></details></section>\n";
    }
    if (!record_.identity.document_text.empty())
      html += format("<section><details><summary>Document</summary><pre>{}</pre></details></section>\n",
                     escape_html(record_.identity.document_text));
    return html;
  }

  std::string data() const {
    std::string elements;
    JsonWriter json(JsonWriter::Layout::compact);
    json.object([&] { write_members(json, elements); });
    return format("<script type=\"application/json\" id=\"meta\">{}</script>\n", embedded(json.written())) +
           elements + colour_element("colours-seq", sequential_colours()) +
           colour_element("colours-heat", heat_colours());
  }

  void write_members(JsonWriter& json, std::string& elements) const {
    int width = 0, height = 0;
    json.object("rasters", [&] {
      const auto embed = [&](const char* id, const RasterView& raster, int bands) {
        if (!raster) return;
        const QuantisedRaster q = quantise(raster, bands, step_);
        width = q.width;
        height = q.height;
        json.object(id, [&] {
          json.member("low", q.low);
          json.member("high", q.high);
        });
        elements += data_element(id, q.codes);
      };
      embed("radiance", input_.radiance, bands_);
      embed("half_width", input_.half_width, bands_);
      embed("samples", input_.samples, 1);
      embed("quality", input_.quality, 4);
      embed("reasons", input_.reasons, 1);
    });
    json.member("width", width);
    json.member("height", height);
    json.member("step", step_);
    write_reasons(json);
    json.member("unit", shown_unit(record_.image.radiance_unit));
    json.member("judged", judged_);
    const sampling::RegionRule rule = record_.identity.sampler == "accuracy"
                                          ? sampling::RegionRule::of_accuracy(record_.image.footprint_px)
                                          : sampling::RegionRule::all_common();
    json.object("region", [&] {
      json.member("shared", rule.shared);
      json.member("commonBorders", rule.common_borders);
      json.member("commonPaths", rule.common_paths);
    });
    json.list("channels", [&] {
      for (int c = 0; c < bands_; ++c) json.object([&] { write_channel(json, c); });
    });
    write_picture(json);
    constexpr int kBins = 40;
    json.object("histograms", [&] {
      json.object("samples", [&] {
        write_histogram(json, input_.samples ? histogram(input_.samples, 0, kBins, true) : Histogram());
      });
      json.object("error", [&] {
        write_histogram(json, judged_ ? histogram(input_.quality, 1, kBins) : Histogram());
      });
    });
  }

  void write_channel(JsonWriter& json, int c) const {
    const auto& channel = record_.image.channels[static_cast<std::size_t>(c)];
    json.member("name", channel.name);
    json.member("um", channel.centre_um);
    json.member("thermal", is_thermal(record_.image, c));
    if (!channel.air) return;
    json.object("air", [&] {
      json.member("path", channel.air->path);
      json.member("surface", channel.air->surface);
      json.member("sky", channel.air->sky);
      json.member("path_radiance", channel.air->path_radiance);
      json.member("white_in_sky", channel.air->white_in_sky);
      if (!(channel.air->model_counted > 0.0)) return;
      json.object("model", [&] {
        json.member("surface", channel.air->model_surface);
        json.member("sunlight", channel.air->model_sunlight);
        json.member("emission", channel.air->model_emission);
        json.member("path", channel.air->model_path);
        json.member("sky", channel.air->model_sky);
      });
    });
  }

  void write_picture(JsonWriter& json) const {
    json.member("first", picture_.front());
    const bool is_rgb = picture_.size() == 3;
    json.member("rgb", is_rgb ? picture_ : std::vector<int>());
    json.list("rgbRanges", [&] {
      if (!is_rgb) return;
      for (const Range& range : colour_ranges(input_.radiance, record_.image, picture_))
        json.value(std::vector<double>{range.low, range.high});
    });
  }

  const RunRecord& record_;
  ReportInput input_;
  int bands_;
  int step_ = 1;
  bool judged_ = false;
  std::vector<int> picture_;  ///< channels, three or one
};

}  // namespace

std::string make_report(const RunRecord& record, const ReportInput& input, std::size_t embed_limit_bytes) {
  return Page(record, input, embed_limit_bytes).text();
}

}  // namespace ifov::io
