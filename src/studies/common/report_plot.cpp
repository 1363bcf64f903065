#include "studies/common/report_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "io/figures/axes.h"
#include "io/figures/colour_scale.h"
#include "io/figures/words.h"

namespace ifov::studies {
namespace {

constexpr double kWidth = 860.0, kHeight = 540.0, kLeft = 92.0, kRight = 28.0, kBottom = 62.0;
constexpr double kTitle = 17.0, kLabel = 15.0, kNumber = 13.0, kLegend = 14.0, kRow = 21.0;
constexpr double kRoom = 0.04;  // of an axis, between what is shown and the frame

io::Ink ink_of(const std::string& colour) {
  const auto digit = [&](std::size_t at) {
    return static_cast<double>(std::stoi(colour.substr(at, 1), nullptr, 16));
  };
  if (colour.size() == 4 && colour[0] == '#') return {digit(1) / 15.0, digit(2) / 15.0, digit(3) / 15.0};
  if (colour.size() != 7 || colour[0] != '#')
    throw std::logic_error("colours are #rgb or #rrggbb: " + colour);
  const auto byte = [&](std::size_t at) { return (16.0 * digit(at) + digit(at + 1)) / 255.0; };
  return {byte(1), byte(3), byte(5)};
}

/// What an axis has to show.
struct Extent {
  bool logarithmic;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  bool shows(double v) const { return std::isfinite(v) && (!logarithmic || v > 0.0); }
  void add(double v) {
    if (!shows(v)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  io::Axis axis(double room) const {
    double first = low, last = high;
    if (!(first <= last)) first = 1.0, last = 2.0;
    if (first == last) {
      const double around = logarithmic ? 0.0 : std::max(0.05 * std::abs(first), 1e-3);
      first = logarithmic ? first / 1.2 : first - around;
      last = logarithmic ? last * 1.2 : last + around;
    }
    const double margin = room * (logarithmic ? std::log(last / first) : last - first);
    if (logarithmic) return {first * std::exp(-margin), last * std::exp(margin), true};
    return {first - margin, last + margin, false};
  }
};

struct Entry {
  std::string name;
  io::Ink ink;
  bool marker, dashed;
};

/// The names of what is shown, in rows from (kLeft, y); where the rows end.
double draw_legend(io::Canvas& canvas, const std::vector<Entry>& entries, double y) {
  constexpr double kSample = 26.0, kGap = 20.0;
  double x = kLeft;
  for (const Entry& entry : entries) {
    const double width = kSample + 6.0 + canvas.text_width(entry.name, kLegend);
    if (x > kLeft && x + width > kWidth - kRight) x = kLeft, y += kRow;
    const double middle = y - 0.35 * kLegend;
    if (entry.marker)
      canvas.disc({x + 0.5 * kSample, middle}, 4.0, entry.ink);
    else
      canvas.line(std::vector<io::CanvasPoint>{{x, middle}, {x + kSample, middle}}, entry.ink, 2.2,
                  entry.dashed);
    canvas.text({x + kSample + 6.0, y}, entry.name, kLegend);
    x += width + kGap;
  }
  return entries.empty() ? y - kRow : y;
}

void draw_levels(io::Canvas& canvas, const Plot& plot, const io::Plot& frame) {
  for (const PlotLevel& level : plot.levels) {
    io::Ink ink = ink_of(level.colour);
    const double right = frame.x + frame.width, y = frame.to_y(level.value);
    if (level.half_width > 0.0) {
      const double top = frame.to_y(level.value + level.half_width),
                   bottom = frame.to_y(level.value - level.half_width);
      ink.alpha = 0.2;
      canvas.fill_rectangle(frame.x, top, frame.width, bottom - top, ink);
      ink.alpha = 1.0;
    }
    canvas.line(std::vector<io::CanvasPoint>{{frame.x, y}, {right, y}}, ink, 1.4, true);
  }
}

void draw_series(io::Canvas& canvas, const PlotSeries& series, const io::Plot& frame, const Extent& x,
                 const Extent& y) {
  const io::Ink ink = ink_of(series.colour);
  std::vector<io::CanvasPoint> line;
  for (std::size_t k = 0; k < series.x.size(); ++k) {
    if (!x.shows(series.x[k]) || !y.shows(series.y[k])) continue;
    line.push_back({frame.to_x(series.x[k]), frame.to_y(series.y[k])});
    if (series.markers_only) canvas.disc(line.back(), 4.0, ink);
  }
  if (!series.markers_only && line.size() > 1) canvas.line(line, ink, 1.8);
}

void draw_frame(io::Canvas& canvas, const Plot& plot, const io::Plot& frame) {
  const double right = frame.x + frame.width, bottom = frame.y + frame.height;
  for (const double tick : frame.across.ticks(7)) {
    const double x = frame.to_x(tick);
    canvas.line(std::vector<io::CanvasPoint>{{x, frame.y}, {x, bottom}}, io::kGridInk, 0.9);
    canvas.text({x, bottom + 19.0}, io::tick_label(tick, frame.across), kNumber, io::Anchor::centre);
  }
  for (const double tick : frame.up.ticks(6)) {
    const double y = frame.to_y(tick);
    canvas.line(std::vector<io::CanvasPoint>{{frame.x, y}, {right, y}}, io::kGridInk, 0.9);
    canvas.text({frame.x - 8.0, y + 4.5}, io::tick_label(tick, frame.up), kNumber, io::Anchor::right);
  }
  canvas.text({0.5 * (frame.x + right), kHeight - 14.0}, plot.x_label, kLabel, io::Anchor::centre);
  canvas.upright_text({24.0, 0.5 * (frame.y + bottom)}, plot.y_label, kLabel);
}

}  // namespace

DrawnFigure draw(const Plot& plot) {
  Extent x{plot.x_log}, y{plot.y_log};
  bool markers = false;
  for (const PlotSeries& s : plot.series) {
    for (const double v : s.x) x.add(v);
    for (const double v : s.y) y.add(v);
    markers = markers || s.markers_only;
  }
  for (const PlotLevel& level : plot.levels) y.add(level.value);

  io::Canvas canvas(kWidth, kHeight);
  double at = 26.0;
  for (const std::string& line : io::wrapped(canvas, plot.title, kTitle, kWidth - kLeft - kRight, true)) {
    canvas.text({kLeft, at}, line, kTitle, io::Anchor::left, true);
    at += kRow;
  }
  std::vector<Entry> entries;
  for (const PlotSeries& s : plot.series)
    if (!s.name.empty()) entries.push_back({s.name, ink_of(s.colour), s.markers_only, false});
  for (const PlotLevel& level : plot.levels)
    if (!level.name.empty()) entries.push_back({level.name, ink_of(level.colour), false, true});
  at = draw_legend(canvas, entries, at + 2.0) + 12.0;

  io::Plot frame;
  frame.x = kLeft, frame.y = at;
  frame.width = kWidth - kLeft - kRight, frame.height = kHeight - kBottom - at;
  frame.across = x.axis(markers ? kRoom : 0.0);
  frame.up = plot.y_low < plot.y_high ? io::Axis{plot.y_low, plot.y_high, plot.y_log} : y.axis(kRoom);
  draw_frame(canvas, plot, frame);
  canvas.begin_clip(frame.x, frame.y, frame.width, frame.height);
  draw_levels(canvas, plot, frame);
  for (const PlotSeries& s : plot.series) draw_series(canvas, s, frame, x, y);
  canvas.end_clip();
  canvas.frame(frame.x, frame.y, frame.width, frame.height, io::kBlackInk, 1.1);
  return {canvas.svg(), canvas.pdf()};
}

DrawnFigure draw(const ImagePanel& panel) {
  constexpr double kSide = 400.0, kBar = 12.0;
  const int unit = std::max(1, static_cast<int>(kSide) / std::max(panel.width, panel.height));
  const int columns = unit * panel.width, rows = unit * panel.height;
  const double width = std::max<double>(columns, 0.75 * kSide), height = rows;
  const io::ColourMap& colours = panel.heat ? io::heat_colours() : io::sequential_colours();
  const auto colour_of = [&](double share) {
    return io::colour_at(colours, std::isfinite(share) ? share : 0.0);
  };
  const io::Canvas measure(1.0, 1.0);
  const std::vector<std::string> title = io::wrapped(measure, panel.title, kLabel, width, true);
  const double top = 8.0 + kRow * static_cast<double>(title.size());
  io::Canvas canvas(width, top + height + kBar + 36.0);
  for (std::size_t k = 0; k < title.size(); ++k)
    canvas.text({1.0, 18.0 + kRow * static_cast<double>(k)}, title[k], kLabel, io::Anchor::left, true);
  // Each pixel as so many: viewers of SVG would blur what they enlarge.
  std::vector<io::Canvas::Pixel> pixels;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const double value = panel.values[static_cast<std::size_t>(y / unit * panel.width + x / unit)];
      pixels.push_back({colour_of((value - panel.low) / (panel.high - panel.low)), true});
    }
  canvas.picture(0.0, top, 1.0, columns, rows, pixels);
  const double under = top + height + 8.0;
  for (int k = 0; k < 256; ++k) {
    const io::Rgb c = colour_of(k / 255.0);
    canvas.fill_rectangle(k * width / 256.0, under, width / 256.0 + 0.5, kBar,
                          {c.r / 255.0, c.g / 255.0, c.b / 255.0});
  }
  const io::Axis scale{panel.low, panel.high, false};
  canvas.text({1.0, under + kBar + 16.0}, io::tick_label(panel.low, scale), kNumber);
  canvas.text({width - 1.0, under + kBar + 16.0},
              io::tick_label(panel.high, scale) + (panel.unit.empty() ? "" : " " + panel.unit), kNumber,
              io::Anchor::right);
  return {canvas.svg(), canvas.pdf()};
}

}  // namespace ifov::studies
