#include "sampling/accuracy/radiance/source_pixels.h"

#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/radiance/nearby_spread.h"
#include "sampling/accuracy/radiance/spread.h"
#include "sampling/accuracy/weights/leaf_integrator.h"

namespace ifov::sampling {

void SourcePixels::add(int first, int last, const LeafIntegrator& integrator) {
  std::vector<int> others;
  for (int source = first; source < last; ++source) {
    PlainPixel plain{source, 0, 0, 0.0};
    if (!traced_.abandoned(static_cast<std::uint32_t>(source)) &&
        integrator.plain(source, plain.output, plain.label, plain.weight) && spread_.constant(plain.label))
      plain_.push_back(plain);
    else
      others.push_back(source);
  }
  others_.reserve(others_.size() + others.size());
  for (const int source : others) {
    others_.emplace_back().source = source;
    fill(others_.back(), integrator);
  }
  find_neighbours();
}

void SourcePixels::find_neighbours() {
  constexpr int kBeside = 2;  // how far around
  if (others_.empty()) return;
  const int first = others_.front().source, last = others_.back().source;
  std::vector<const SourcePixel*> at(static_cast<std::size_t>(last - first) + 1, nullptr);
  for (const SourcePixel& pixel : others_) at[static_cast<std::size_t>(pixel.source - first)] = &pixel;
  for (SourcePixel& pixel : others_) {
    const int column = pixel.source % width_;
    for (int dy = -kBeside; dy <= kBeside; ++dy)
      for (int dx = -kBeside; dx <= kBeside; ++dx) {
        const int source = pixel.source + dy * width_ + dx;
        if ((dx == 0 && dy == 0) || column + dx < 0 || column + dx >= width_ || source < first ||
            source > last)
          continue;
        if (const SourcePixel* other = at[static_cast<std::size_t>(source - first)]; other != nullptr)
          pixel.beside.push_back(other);
      }
  }
}

bool SourcePixels::refresh(const LeafIntegrator& integrator) {
  for (const PlainPixel& pixel : plain_)
    if (traced_.changed(static_cast<std::uint32_t>(pixel.source))) return false;
  for (SourcePixel& pixel : others_)
    if (traced_.changed(static_cast<std::uint32_t>(pixel.source))) fill(pixel, integrator);
  return true;
}

void SourcePixels::fill(SourcePixel& pixel, const LeafIntegrator& integrator) const {
  pixel.cluttered = traced_.abandoned(static_cast<std::uint32_t>(pixel.source));
  integrator.pixel(pixel.source, pixel.model);
  pixel.strata.clear();
  if (pixel.cluttered) {
    pixel.strata.resize(1);
    pixel.strata.front().deviation = nearby_.deviation(pixel, kNoLabel);
  } else {
    pixel.strata.resize(pixel.model.labels.size());
    for (std::size_t s = 0; s < pixel.strata.size(); ++s) {
      pixel.strata[s].label = pixel.model.labels[s];
      pixel.strata[s].deviation = nearby_.deviation(pixel, pixel.strata[s].label);
    }
  }
}

void SourcePixels::turn_to_clutter(std::size_t p) {
  SourcePixel& pixel = others_[p];
  pixel.cluttered = true;
  Stratum whole;
  for (const Stratum& stratum : pixel.strata) {
    if (stratum.strays == 0.0) continue;
    whole.strays += stratum.strays;
    whole.stray_squares.resize(stratum.stray_squares.size(), 0.0);
    for (std::size_t c = 0; c < whole.stray_squares.size(); ++c)
      whole.stray_squares[c] += stratum.stray_squares[c];
  }
  pixel.strata.assign(1, std::move(whole));
  pixel.strata.front().deviation = nearby_.deviation(pixel, kNoLabel);
}

}  // namespace ifov::sampling
