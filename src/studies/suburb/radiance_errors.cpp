#include "studies/suburb/radiance_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "studies/common/image_store.h"

namespace ifov::studies {

namespace {

constexpr double kRounding = 1e-6;  // relative, of radiances in single precision
constexpr double kLeastBright = 1e-3;

}  // namespace

RadianceErrors radiance_errors(const ImageStore& image, const ImageStore& reference) {
  const std::size_t columns = static_cast<std::size_t>(image.columns());
  RadianceErrors out;
  out.rms.assign(columns, 0.0);
  out.mean.assign(columns, 0.0);
  std::size_t pixels = 0, judged = 0, held = 0;
  for (std::size_t p = 0; p < image.samples().size(); ++p) {
    if (reference.samples()[p] == 0) continue;
    ++pixels;
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t k = p * columns + c;
      out.mean[c] += double(reference.mean()[k]);
      const double error = double(image.mean()[k]) - double(reference.mean()[k]);
      out.rms[c] += error * error;
      const double half_width = double(image.half_width()[k]), own = double(reference.half_width()[k]);
      if (!std::isfinite(half_width)) continue;
      ++judged;
      held += std::abs(error) <= std::hypot(half_width, std::isfinite(own) ? own : 0.0);
    }
  }
  for (std::size_t c = 0; c < columns; ++c) {
    out.rms[c] = std::sqrt(out.rms[c] / double(pixels));
    out.mean[c] /= double(pixels);
  }
  out.coverage = judged > 0 ? double(held) / double(judged) : std::numeric_limits<double>::quiet_NaN();
  return out;
}

bool counts(const RadianceErrors& image, std::size_t channel) {
  return image.rms[channel] > kRounding * image.mean[channel] &&
         image.mean[channel] > kLeastBright * *std::max_element(image.mean.begin(), image.mean.end());
}

ErrorRatios error_ratios(const RadianceErrors& image, const RadianceErrors& other) {
  ErrorRatios out;
  double squares = 0.0;
  int counted = 0;
  for (std::size_t c = 0; c < image.rms.size(); ++c) {
    if (!counts(other, c)) continue;
    const double ratio = image.rms[c] / other.rms[c];
    out.worst = std::max(out.worst, ratio);
    squares += ratio * ratio;
    ++counted;
  }
  out.mean = counted > 0 ? std::sqrt(squares / counted) : 0.0;
  out.largest = *std::max_element(image.rms.begin(), image.rms.end()) /
                *std::max_element(other.rms.begin(), other.rms.end());
  return out;
}

double error_quantile(const ImageStore& image, const ImageStore& reference, const RadianceErrors& other,
                      double share) {
  const std::size_t columns = other.rms.size();
  std::vector<double> errors;
  double sum = 0.0;
  int counted = 0;
  for (std::size_t c = 0; c < columns; ++c) {
    if (!counts(other, c)) continue;
    errors.clear();
    for (std::size_t p = 0; p < image.samples().size(); ++p)
      if (reference.samples()[p] != 0)
        errors.push_back(
            std::abs(double(image.mean()[p * columns + c]) - double(reference.mean()[p * columns + c])));
    const auto at = errors.begin() + static_cast<std::ptrdiff_t>(share * double(errors.size() - 1));
    std::nth_element(errors.begin(), at, errors.end());
    sum += *at / other.rms[c];
    ++counted;
  }
  return counted > 0 ? sum / counted : 0.0;
}

}  // namespace ifov::studies
