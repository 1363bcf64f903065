#include "io/figures/axes.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"

namespace ifov::io {
namespace {

constexpr double kNumbers = 12.0, kLabels = 13.0;

std::string raised(int power) {
  const char* const digits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text = power < 0 ? "\u207b" : "";
  for (const char digit : std::to_string(std::abs(power))) text += digits[digit - '0'];
  return text;
}

}  // namespace

double Axis::position(double value) const {
  return logarithmic ? std::log(value / first) / std::log(last / first) : (value - first) / (last - first);
}

std::vector<double> Axis::ticks(int most) const {
  std::vector<double> found;
  if (logarithmic) {
    const int low = static_cast<int>(std::ceil(std::log10(first) - 1e-9));
    const int high = static_cast<int>(std::floor(std::log10(last) + 1e-9));
    if (high - low < 2) {  // between the powers too
      for (int power = low - 1; power <= high; ++power)
        for (const double m : {1.0, 2.0, 5.0})
          if (const double value = m * std::pow(10.0, power);
              value >= 0.999999 * first && value <= 1.000001 * last)
            found.push_back(value);
      return found;
    }
    const int step = std::max(1, (high - low + most) / most);
    for (int power = low; power <= high; power += step) found.push_back(std::pow(10.0, power));
    return found;
  }
  const double raw = (last - first) / most, power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10.0 * power;
  for (const double m : {5.0, 2.0, 1.0})
    if (m * power >= 0.999999 * raw) step = m * power;
  for (double k = std::ceil(first / step - 1e-9); k * step <= last + 1e-9 * step; k += 1.0)
    found.push_back(k * step);
  return found;
}

std::vector<double> wavelength_ticks(const Axis& axis, double width) {
  constexpr double kNumber = 31.0;
  if (!axis.logarithmic) return axis.ticks(std::clamp(static_cast<int>(width / 75.0), 2, 9));
  std::vector<double> found;
  double last = -1.0;
  for (const double tick : {0.3, 0.35, 0.4, 0.45, 0.5, 0.6, 0.7,  0.8,  1.0,  1.2,  1.5,  2.0,
                            2.5, 3.0,  4.0, 5.0,  6.0, 8.0, 10.0, 12.0, 14.0, 20.0, 30.0, 50.0}) {
    if (tick < axis.first || tick > axis.last) continue;
    if (last > 0.0 && width * (axis.position(tick) - axis.position(last)) < kNumber) continue;
    found.push_back(tick);
    last = tick;
  }
  return found;
}

std::string tick_label(double value, const Axis& axis) {
  if (axis.logarithmic && (value < 0.00999 || value > 1001.0))
    return "10" + raised(static_cast<int>(std::lround(std::log10(value))));
  return format("{:.6g}", std::abs(value) < 1e-9 * std::abs(axis.last) ? 0.0 : value);
}

void draw_axes(Canvas& canvas, const Plot& plot, const std::vector<double>& ticks_across,
               bool numbers_below) {
  const double right = plot.x + plot.width, bottom = plot.y + plot.height;
  for (const double tick : ticks_across) {
    const double x = plot.to_x(tick);
    canvas.line(std::vector<CanvasPoint>{{x, plot.y}, {x, bottom}}, kGridInk, 0.8);
    if (numbers_below) canvas.text({x, bottom + 17.0}, format("{:g}", tick), kNumbers, Anchor::centre);
  }
  for (const double tick : plot.up.ticks(5)) {
    const double y = plot.to_y(tick);
    canvas.line(std::vector<CanvasPoint>{{plot.x, y}, {right, y}}, kGridInk, 0.8);
    canvas.text({plot.x - 8.0, y + 4.5}, tick_label(tick, plot.up), kNumbers, Anchor::right);
  }
  canvas.frame(plot.x, plot.y, plot.width, plot.height, kBlackInk, 1.0);
  canvas.upright_text({plot.x - 52.0, plot.y + 0.5 * plot.height}, plot.label, kLabels);
  if (numbers_below && !plot.label_across.empty())
    canvas.text({plot.x + 0.5 * plot.width, bottom + 38.0}, plot.label_across, kLabels, Anchor::centre);
}

void draw_lines(Canvas& canvas, const Plot& plot, const std::vector<Curve>& curves) {
  canvas.begin_clip(plot.x, plot.y, plot.width, plot.height);
  for (const Curve& curve : curves) {
    std::vector<CanvasPoint> line;
    const auto finish = [&] {
      if (line.size() > 1) canvas.line(line, curve.ink, curve.width, curve.dashed);
      line.clear();
    };
    for (const CanvasPoint& p : curve.points)
      if (plot.up.logarithmic && p.y <= 0.0)
        finish();
      else
        line.push_back({plot.to_x(p.x), plot.to_y(p.y)});
    finish();
  }
  canvas.end_clip();
}

void draw_curves(Canvas& canvas, const Plot& plot, const std::vector<Curve>& curves) {
  draw_lines(canvas, plot, curves);
  double x = plot.x + 2.0;
  const double y = plot.y - 8.0;
  for (const Curve& curve : curves) {
    canvas.line(std::vector<CanvasPoint>{{x, y - 4.0}, {x + 24.0, y - 4.0}}, curve.ink, 2.0, curve.dashed);
    canvas.text({x + 30.0, y}, curve.name, kLabels);
    x += 30.0 + canvas.text_width(curve.name, kLabels) + 22.0;
  }
}

}  // namespace ifov::io
