#include "honesty/plain_surfaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/world.h"

namespace ifov::benchmarks {

namespace {

using materials::BsdfEvent;
using materials::Passage;
using materials::Side;

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

math::Vec3 side_of(const geometry::SurfacePoint& hit) {
  return (hit.front ? hit.geometric_normal : -hit.geometric_normal).as_vector();
}

PlainSurfaces::PlainSurfaces(const scene::Scene& scene, const PlainSpectra& spectra)
    : scene_(scene), columns_(spectra.columns()) {
  for (std::uint32_t m = 0; m < scene.materials.size(); ++m) {
    std::vector<std::vector<float>>& values = values_.emplace_back();
    absorption_.emplace_back();
    parameters_.emplace_back();
    if (is_plain(m)) continue;
    for (const radiometry::Spectrum& spectrum : bsdf(m).spectra()) {
      const std::vector<double> columns = spectra.columns_of(spectrum);
      values.emplace_back(columns.begin(), columns.end());
    }
    if (const radiometry::Spectrum* absorbed = bsdf(m).absorption())
      absorption_.back() = spectra.columns_of(*absorbed);
    any_pane_ = any_pane_ || bsdf(m).passage() == Passage::straight;
  }
  for (std::size_t m = 0; m < values_.size(); ++m)
    for (const std::vector<float>& row : values_[m]) parameters_[m].push_back(row.data());
}

BsdfEvent PlainSurfaces::view(std::uint32_t material, math::Vec3 outgoing, math::Vec3 side) const {
  BsdfEvent event{outgoing, {}, math::as_normal(side), {}, Side::reflected};
  if (!bsdf(material).is_isotropic()) {  // east, or north
    const math::Vec3 along = std::abs(side.x) < 0.999 ? math::Vec3{1.0, 0.0, 0.0} : math::Vec3{0.0, 1.0, 0.0};
    event.tangent = math::normalized(along - math::dot(along, side) * side);
  }
  return event;
}

std::vector<double> PlainSurfaces::evaluate(std::uint32_t material, const BsdfEvent& event) const {
  std::vector<float> found(columns_);
  bsdf(material).evaluate(event, parameters_[material], columns_, found.data());
  return {found.begin(), found.end()};
}

double PlainSurfaces::reflected_share(std::uint32_t material, const BsdfEvent& view) const {
  const materials::Bsdf& model = bsdf(material);
  if (!model.may_transmit()) return 1.0;
  if (!model.is_delta()) {
    const double through = model.through_share(view);
    return through < 0.0 ? 0.5 : 1.0 - through;
  }
  BsdfEvent through = view;
  through.side = Side::transmitted;
  const double back = mean(evaluate(material, view)), on = mean(evaluate(material, through));
  if (on <= 0.0) return 1.0;
  return std::clamp(back / (back + on), 0.05, 0.95);
}

bool PlainSurfaces::step(std::uint32_t material, BsdfEvent view, RandomStream& random, Step& step) const {
  const materials::Bsdf& model = bsdf(material);
  const double reflected = reflected_share(material, view);
  view.side = random.uniform() < reflected ? Side::reflected : Side::transmitted;
  const double chosen = view.side == Side::reflected ? reflected : 1.0 - reflected;
  const double u1 = random.uniform(), u2 = random.uniform();
  const materials::BsdfSample sample = model.sample(view, u1, u2);
  if (!(sample.weight > 0.0)) return false;
  view.incoming = sample.incoming;
  step.event = view;
  step.factors = evaluate(material, view);
  for (double& factor : step.factors) factor *= sample.weight / chosen;
  step.pdf = model.is_delta() ? 0.0 : sample.pdf * chosen;
  return *std::max_element(step.factors.begin(), step.factors.end()) > 0.0;
}

double PlainSurfaces::pdf(std::uint32_t material, const BsdfEvent& event) const {
  const double reflected = reflected_share(material, event);
  return bsdf(material).pdf(event) * (event.side == Side::reflected ? reflected : 1.0 - reflected);
}

const std::vector<double>* PlainSurfaces::medium_after(std::uint32_t material, Side side,
                                                       const std::vector<double>* before) const {
  if (side == Side::reflected) return before;
  switch (bsdf(material).passage()) {
    case Passage::into: return absorption_[material].empty() ? nullptr : &absorption_[material];
    case Passage::out_of: return nullptr;
    case Passage::none:
    case Passage::straight: break;
  }
  return before;
}

bool PlainSurfaces::comes_through(math::Ray ray, std::vector<double>& share) const {
  share.assign(columns_, 1.0);
  if (!any_pane_) {
    std::uint8_t blocked = 0;
    scene_.world->occluded({&ray, 1}, {&blocked, 1});
    return blocked == 0;
  }
  constexpr int kMostPanes = 64;
  for (int k = 0; k < kMostPanes; ++k) {
    geometry::SurfacePoint hit;
    scene_.world->intersect({&ray, 1}, {&hit, 1});
    if (!hit.hit()) return true;
    const std::uint32_t material = scene_.resolve(hit).constituents[0].material;
    if (is_plain(material) || bsdf(material).passage() != Passage::straight) return false;
    BsdfEvent passing = view(material, -ray.direction, side_of(hit));
    passing.side = Side::transmitted;
    passing.incoming = ray.direction;
    const std::vector<double> through = evaluate(material, passing);
    for (std::size_t c = 0; c < columns_; ++c) share[c] *= through[c];
    ray = ray.onward(hit.position_m - hit.offset_m * side_of(hit), ray.direction);
  }
  return false;
}

}  // namespace ifov::benchmarks
