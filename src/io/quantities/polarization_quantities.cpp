#include "io/quantities/polarization_quantities.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "render/polarized/stokes_columns.h"
#include "render/tile_sink.h"
#include "render/tolerance/degree_limits.h"

namespace ifov::io::quantities {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr float kGap = std::numeric_limits<float>::quiet_NaN();

/// A layer of floats; empty where a tile has none (a gap of the image).
std::span<const float> floats(const FinishedTile& of, const char* name) {
  const sampling::TileLayer* const layer = of.tile.layer(name);
  return layer == nullptr ? std::span<const float>{} : layer->values<float>();
}

/// I before Q, U and V: [pixel][component][channel].
std::vector<float> joined(const FinishedTile& of, const std::vector<float>& i,
                          std::span<const float> others) {
  const std::size_t channels = of.image.channels.size(), pixels = of.tile.samples.size();
  if (others.empty() || i.empty()) return std::vector<float>(4 * channels * pixels, kGap);
  std::vector<float> values;
  values.reserve(4 * channels * pixels);
  for (std::size_t p = 0; p < pixels; ++p) {
    values.insert(values.end(), i.begin() + static_cast<std::ptrdiff_t>(p * channels),
                  i.begin() + static_cast<std::ptrdiff_t>((p + 1) * channels));
    const auto from = others.subspan(3 * p * channels, 3 * channels);
    values.insert(values.end(), from.begin(), from.end());
  }
  return values;
}

void put_stokes(const FinishedTile& of, ValueSink& sink) {
  sink.put(joined(of, of.tile.mean, floats(of, render::StokesLayers::kMean)));
}

void put_stokes_error(const FinishedTile& of, ValueSink& sink) {
  const std::span<const float> errors = floats(of, render::StokesLayers::kStandardError);
  if (!errors.empty()) return sink.put(errors);
  sink.put(std::vector<float>(4 * of.image.channels.size() * of.tile.samples.size(), kGap));
}

void put_stokes_half_width(const FinishedTile& of, ValueSink& sink) {
  sink.put(joined(of, of.tile.half_width, floats(of, render::StokesLayers::kHalfWidth)));
}

/// One number of each pixel and channel.
void put_each(const FinishedTile& of, ValueSink& sink, double (StokesEstimate::*value)() const) {
  const std::size_t channels = of.image.channels.size(), pixels = of.tile.samples.size();
  const std::span<const float> others = floats(of, render::StokesLayers::kMean),
                               errors = floats(of, render::StokesLayers::kStandardError);
  std::vector<float> values(channels * pixels, kGap);
  for (std::size_t p = 0; p < pixels && !others.empty(); ++p)
    for (std::size_t c = 0; c < channels; ++c) {
      const auto error = [&](std::size_t component) {
        return errors.empty() ? 0.0 : static_cast<double>(errors[(4 * p + component) * channels + c]);
      };
      const StokesEstimate light{static_cast<double>(of.tile.mean[p * channels + c]),
                                 static_cast<double>(others[3 * p * channels + c]),
                                 static_cast<double>(others[(3 * p + 1) * channels + c]),
                                 error(0),
                                 error(1),
                                 error(2)};
      if (std::isfinite(light.i)) values[p * channels + c] = static_cast<float>((light.*value)());
    }
  sink.put(values);
}

void put_dolp_half_width(const FinishedTile& of, ValueSink& sink) {
  const std::size_t channels = of.image.channels.size(), pixels = of.tile.samples.size();
  const std::span<const float> others = floats(of, render::StokesLayers::kMean),
                               widths = floats(of, render::StokesLayers::kHalfWidth);
  std::vector<float> values(channels * pixels, kGap);
  for (std::size_t p = 0; p < pixels && !others.empty() && !widths.empty(); ++p)
    for (std::size_t c = 0; c < channels; ++c) {
      const std::size_t i = p * channels + c, q = 3 * p * channels + c, u = q + channels;
      const auto number = [](float value) { return static_cast<double>(value); };
      if (std::isfinite(of.tile.mean[i]))
        values[i] = static_cast<float>(
            render::degree_half_width(number(of.tile.mean[i]), number(others[q]), number(others[u]),
                                      number(of.tile.half_width[i]), number(widths[q]), number(widths[u])));
    }
  sink.put(values);
}

constexpr Quantity by_channel(std::string_view name, std::string_view what, std::string_view unit,
                              Quantity::Role role, Quantity::Statistic statistic, bool errors,
                              void (*values)(const FinishedTile&, ValueSink&)) {
  return {.name = name,
          .what = what,
          .unit = unit,
          .role = role,
          .statistic = statistic,
          .type = EnviType::float32,
          .bands = Quantity::Bands::channels,
          .band_names = {},
          .usual = Quantity::Usual::yes,
          .needs = {.errors = errors, .stokes = true},
          .values = values};
}

constexpr Quantity of_stokes(std::string_view name, std::string_view what, Quantity::Role role,
                             Quantity::Statistic statistic, bool errors,
                             void (*values)(const FinishedTile&, ValueSink&)) {
  Quantity quantity = by_channel(name, what, "", role, statistic, errors, values);
  quantity.bands = Quantity::Bands::stokes;
  return quantity;
}

}  // namespace

double StokesEstimate::dolp() const { return i > 0.0 ? std::hypot(q, u) / i : 0.0; }

double StokesEstimate::dolp_error() const {
  if (!(i > 0.0)) return 0.0;
  const double linear = std::hypot(q, u);
  // Of light whose direction noise may turn anywhere, the worst direction.
  const double along = linear > std::hypot(q_error, u_error)
                           ? (std::abs(q) * q_error + std::abs(u) * u_error) / linear
                           : std::hypot(q_error, u_error);
  return (along + dolp() * i_error) / i;
}

double StokesEstimate::dolp_bias() const {
  if (!(i > 0.0)) return 0.0;
  const double p = dolp(), s = std::max(q_error, u_error) / i;
  return p > s ? p - std::sqrt(p * p - s * s) : p;
}

double StokesEstimate::aop_deg() const {
  const double angle = 0.5 * std::atan2(u, q) / kDegree;
  return angle < 0.0 ? angle + 180.0 : angle;
}

double StokesEstimate::aop_error_deg() const {
  const double any = 180.0 / std::sqrt(12.0), linear = std::hypot(q, u), noise = std::max(q_error, u_error);
  // Noise alone has a direction, too: what is left without it turns the error.
  if (!(linear > noise)) return any;
  const double across = (std::abs(u) * q_error + std::abs(q) * u_error) / linear;
  return std::min(any, 0.5 * across / std::sqrt(linear * linear - noise * noise) / kDegree);
}

constinit const Quantity kStokes = of_stokes("stokes", "Stokes vector", Quantity::Role::radiance,
                                             Quantity::Statistic::mean, false, put_stokes);
constinit const Quantity kStokesStandardError =
    of_stokes("stokes_standard_error", "standard error of the Stokes vector", Quantity::Role::error,
              Quantity::Statistic::standard_error, true, put_stokes_error);
constinit const Quantity kStokesHalfWidth =
    of_stokes("stokes_half_width", "half-width of the Stokes vector's intervals", Quantity::Role::error,
              Quantity::Statistic::half_width, true, put_stokes_half_width);
constinit const Quantity kDolp = by_channel(
    "dolp", "degree of linear polarization", "1", Quantity::Role::radiance, Quantity::Statistic::mean, false,
    [](const FinishedTile& of, ValueSink& sink) { put_each(of, sink, &StokesEstimate::dolp); });
constinit const Quantity kDolpStandardError = by_channel(
    "dolp_standard_error", "standard error of the degree of linear polarization, at most", "1",
    Quantity::Role::error, Quantity::Statistic::standard_error, true,
    [](const FinishedTile& of, ValueSink& sink) { put_each(of, sink, &StokesEstimate::dolp_error); });
constinit const Quantity kDolpHalfWidth =
    by_channel("dolp_half_width", "half-width of the interval of the degree of linear polarization", "1",
               Quantity::Role::error, Quantity::Statistic::half_width, true, put_dolp_half_width);
constinit const Quantity kDolpBias = by_channel(
    "dolp_bias", "by how much noise makes the degree of linear polarization too high", "1",
    Quantity::Role::error, Quantity::Statistic::standard_error, true,
    [](const FinishedTile& of, ValueSink& sink) { put_each(of, sink, &StokesEstimate::dolp_bias); });
constinit const Quantity kAop = by_channel(
    "aop", "angle of linear polarization", "deg", Quantity::Role::radiance, Quantity::Statistic::mean, false,
    [](const FinishedTile& of, ValueSink& sink) { put_each(of, sink, &StokesEstimate::aop_deg); });
constinit const Quantity kAopStandardError = by_channel(
    "aop_standard_error", "standard error of the angle of linear polarization, at most", "deg",
    Quantity::Role::error, Quantity::Statistic::standard_error, true,
    [](const FinishedTile& of, ValueSink& sink) { put_each(of, sink, &StokesEstimate::aop_error_deg); });

}  // namespace ifov::io::quantities
