#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "sensor/along_track.h"
#include "sensor/psf.h"

namespace ifov::sensor {
namespace {

/// Where the looks of an element are that a motion of the pixel's own is not, and what share they have: as far apart as matters to
/// what has been averaged over that motion.
std::vector<std::pair<double, double>> looks(const AlongTrack& along) {
  constexpr double kApart_px = 1.0 / 8.0;
  const int parts = std::max(1, static_cast<int>(std::ceil(along.element_px / kApart_px)));
  std::map<long, double> shares;
  for (int s = 0; s < along.stages; ++s)
    for (int k = 0; k < parts; ++k) {
      const double at =
          (s - 0.5 * (along.stages - 1)) * along.stage_px + ((k + 0.5) / parts - 0.5) * along.element_px;
      // Between two places of the grid, so that the middle stays where it is.
      const double place = at / kApart_px, low = std::floor(place);
      const double share = 1.0 / (along.stages * parts);
      shares[static_cast<long>(low)] += share * (1.0 - (place - low));
      shares[static_cast<long>(low) + 1] += share * (place - low);
    }
  std::vector<std::pair<double, double>> found;
  for (const auto& [place, share] : shares)
    if (share > 0.0) found.emplace_back(static_cast<double>(place) * kApart_px, share);
  return found;
}

class SpreadCut final : public Psf {
 public:
  SpreadCut(std::shared_ptr<const Psf> psf, const AlongTrack& along, bool along_x)
      : psf_(std::move(psf)), looks_(looks(along)), along_x_(along_x) {}

  double half_width_px() const override { return psf_->half_width_px(); }
  double detail_px() const override { return psf_->detail_px(); }
  double energy(double x0_px, double y0_px, double x1_px, double y1_px) const override {
    return psf_->energy(x0_px, y0_px, x1_px, y1_px);
  }
  double kept() const override { return psf_->kept(); }
  double cut_density(double dx_px, double dy_px, bool smooth) const override {
    // A mean over some pixels of what falls as 1/r^3 is there within 1 % of its middle.
    constexpr double kFar_px = 24.0;
    if (std::max(std::abs(dx_px), std::abs(dy_px)) > kFar_px) return psf_->cut_density(dx_px, dy_px, smooth);
    double sum = 0.0;
    for (const auto& [at, share] : looks_)
      sum += share * psf_->cut_density(dx_px - (along_x_ ? at : 0.0), dy_px - (along_x_ ? 0.0 : at), smooth);
    return sum;
  }
  bool has_wings() const override { return psf_->has_wings(); }
  bool round() const override { return false; }
  bool mirrored() const override { return psf_->mirrored(); }
  std::string description() const override { return psf_->description(); }

 private:
  std::shared_ptr<const Psf> psf_;
  std::vector<std::pair<double, double>> looks_;
  bool along_x_;
};

}  // namespace

std::shared_ptr<const Psf> spread_cut(std::shared_ptr<const Psf> psf, const AlongTrack& along, bool along_x) {
  return std::make_shared<SpreadCut>(std::move(psf), along, along_x);
}

}  // namespace ifov::sensor
