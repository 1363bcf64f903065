#include "session/detection/seen_light.h"

#include <algorithm>
#include <cmath>

#include "io/products/envi_reader.h"
#include "session/detection/detection.h"

namespace ifov::session {

SeenLight::SeenLight(const SignalSource& source, const sensor::SignalMemory& memory, int channel, int from,
                     int to, double most_radiance_w_m2_sr_um)
    : source_(source), memory_(memory), channel_(channel), from_(from), most_(most_radiance_w_m2_sr_um) {
  if (!memory.none() && source.read_out.kind == sensor::ReadOut::Kind::lines) read_lines(to);
}

/// Lines before the first are as the first.
void SeenLight::read_lines(int to) {
  const auto width = static_cast<std::size_t>(source_.radiance->header().samples);
  const std::span<const double> weights = memory_.weights();
  const int first = std::max(0, from_ - static_cast<int>(weights.size()) + 1);
  std::vector<float> seen(static_cast<std::size_t>(to - first) * width);
  const auto row = [&](int line) {
    return std::span(seen).subspan(static_cast<std::size_t>(std::max(line, 0) - first) * width, width);
  };
  for (int line = first; line < to; ++line) {
    source_.radiance->read(line, channel_, row(line));
    for (float& one : row(line)) one = std::min(one, static_cast<float>(most_));
  }
  lines_.resize(static_cast<std::size_t>(to - from_) * width);
  std::vector<double> sum(width);
  for (int line = from_; line < to; ++line) {
    std::fill(sum.begin(), sum.end(), 0.0);
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const std::span<const float> of = row(line - static_cast<int>(k));
      for (std::size_t x = 0; x < width; ++x) sum[x] += weights[k] * static_cast<double>(of[x]);
    }
    float* const to_line = lines_.data() + static_cast<std::size_t>(line - from_) * width;
    for (std::size_t x = 0; x < width; ++x) to_line[x] = static_cast<float>(sum[x]);
  }
}

/// Frames before the first are as the first.
void SeenLight::read_frames(int line, std::span<float> radiance) const {
  const std::span<const double> weights = memory_.weights();
  std::vector<double> sum(radiance.size(), 0.0);
  for (std::size_t frame = 0; frame <= source_.before.size(); ++frame) {
    double weight = frame < weights.size() ? weights[frame] : 0.0;
    if (frame == source_.before.size())
      for (std::size_t k = frame + 1; k < weights.size(); ++k) weight += weights[k];
    (frame == 0 ? source_.radiance : source_.before[frame - 1])->read(line, channel_, radiance);
    for (std::size_t x = 0; x < radiance.size(); ++x)
      sum[x] += weight * std::min(static_cast<double>(radiance[x]), most_);
  }
  for (std::size_t x = 0; x < radiance.size(); ++x) radiance[x] = static_cast<float>(sum[x]);
}

void SeenLight::read(int line, std::span<float> radiance) const {
  if (!lines_.empty()) {
    std::copy_n(lines_.begin() +
                    static_cast<std::ptrdiff_t>(static_cast<std::size_t>(line - from_) * radiance.size()),
                radiance.size(), radiance.begin());
    return;
  }
  if (memory_.none() || (source_.read_out.kind == sensor::ReadOut::Kind::frame && source_.before.empty()))
    return source_.radiance->read(line, channel_, radiance);
  if (source_.read_out.kind == sensor::ReadOut::Kind::frame) return read_frames(line, radiance);
  source_.radiance->read(line, channel_, radiance);
  for (float& one : radiance) one = std::min(one, static_cast<float>(most_));
  sensor::remember_along(memory_, source_.read_out.runs_backwards(line), radiance);
}

}  // namespace ifov::session
