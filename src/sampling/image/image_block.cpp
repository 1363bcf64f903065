#include "sampling/image/image_block.h"

#include <algorithm>
#include <cmath>

#include "sampling/hash.h"
#include "sampling/image/like_pixels.h"

namespace ifov::sampling {

namespace {

constexpr std::uint64_t kPilotPaths = 0x70696c6f74ull, kMainPaths = 0x6d61696eull;
constexpr double kPilotFours = Allocation::kPilotAcross * Allocation::kPilotDown / 4.0;

}  // namespace

ImageBlock::ImageBlock(const TileProblem& problem, const ImagePlan& plan, Field& field, double trust)
    : problem_(problem),
      plan_(plan),
      field_(field),
      trust_(trust),
      columns_(static_cast<std::size_t>(field.columns())),
      stride_(static_cast<std::size_t>(field.stride())),
      footprints_(problem.footprints(field)),
      student_(confidence_of(problem)) {}

void ImageBlock::find_parts() {
  bright_.clear();
  parts_.clear();
  for (std::size_t k = 0; k < places_.size(); ++k) {
    bright_.push_back(bright_shares(problem_, footprints_, places_[k].i, places_[k].j));
    for (std::size_t n = 0; n < bright_.back().parts.size(); ++n) parts_.push_back({k, n});
  }
}

std::span<const double> ImageBlock::shares(std::size_t unit) const {
  if (!is_part(unit)) return bright_[unit].left;
  const PartOfPixel& part = parts_[unit - places_.size()];
  return bright_[part.pixel].parts[part.number].share;
}

std::span<SampledPixel> ImageBlock::sample(std::span<const Place> places) {
  places_ = places;
  find_parts();
  pixels_.assign(places.size(), {});
  draw(
      kPilotPaths, [](std::size_t) { return Allocation::pilot(); }, pilot_);
  choose();
  draw(
      kMainPaths, [&](std::size_t unit) { return plans_[unit]; }, main_);
  for (std::vector<float>* rows : {&direct_, &rest_, &rest_variance_}) rows->assign(units() * stride_, 0.0f);
  std::size_t label = 0;
  for (std::size_t unit = 0; unit < units(); ++unit) {
    take_materials(unit, label);
    label += plans_[unit].count();
    take_means(unit);
    take_rest(unit);
  }
  if (plan_.rest_model() != nullptr) pool();
  for (std::size_t k = 0; k < places.size(); ++k) estimate(k);
  return pixels_;
}

template <class PlanOf>
void ImageBlock::draw(std::uint64_t purpose, PlanOf plan_of, LevelSums& sums) {
  points_.clear();
  for (std::size_t unit = 0; unit < units(); ++unit) {
    const std::size_t k = pixel_of(unit);
    const auto [i, j] = places_[k];
    if (!is_part(unit)) {
      points_.add(problem_, bright_[k], i, j, hash(problem_.seed, i, j, purpose), plan_of(unit));
      continue;
    }
    const std::size_t number = parts_[unit - places_.size()].number;
    points_.add(problem_, bright_[k].parts[number].where, i, j, hash(problem_.seed, i, j, purpose, number),
                plan_of(unit));
  }
  field_.levels({points_.requests, points_.whole, points_.counts, points_.importance, &footprints_}, sums);
}

std::span<const Label> ImageBlock::pilot_labels(std::size_t unit) const {
  const std::size_t count = Allocation::pilot().count();
  return std::span<const Label>(pilot_.labels).subspan(unit * count, count);
}

void ImageBlock::choose() {
  const Allocation& allocation = plan_.allocation();
  const bool pooled = plan_.rest_model() != nullptr;
  plans_.clear();
  materials_.clear();
  std::vector<Allocation::Sizes> sizes;
  std::vector<double> own, of_kind;
  std::vector<std::map<std::uint32_t, double>> shares(places_.size());
  LevelVariances variances;
  variances.direct.resize(columns_);
  variances.rest.resize(columns_);
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const std::span<const Label> labels = pilot_labels(k);
    materials_.push_back(main_material(field_, labels));
    const bool mixed = shows_several(field_, labels);
    for (std::size_t c = 0; c < columns_; ++c) {
      variances.direct[c] =
          plan_.direct_factor(mixed, c) * static_cast<double>(pilot_.direct_variance[k * stride_ + c]);
      variances.rest[c] = plan_.rest_factor(c) * static_cast<double>(pilot_.rest_variance[k * stride_ + c]);
    }
    if (pooled) {
      own.push_back(allocation.sizes(variances).direct);
      of_kind.push_back(allocation.sizes(plan_.kind(materials_.back()).mean).direct);
      for (const Label label : labels)
        shares[k][field_.material_of(label)] += 1.0 / static_cast<double>(labels.size());
    }
    plan_.moderate_pilot(variances, materials_.back());
    for (std::size_t c = 0; c < columns_; ++c) {
      const double squared = share(k, c) * share(k, c);
      variances.direct[c] *= squared;
      variances.rest[c] *= squared;
    }
    sizes.push_back(allocation.sizes(variances));
  }
  if (pooled) {
    // Neighbours that show the same tell more of a pixel's borders than all pixels of its kind.
    const std::vector<double> smoothed = LikePixels(places_, shares).smoothed(own, of_kind);
    for (std::size_t k = 0; k < places_.size(); ++k)
      sizes[k].direct = ImagePlan::moderated(own[k], kPilotFours, smoothed[k], ImagePlan::kDirectPrior);
  }
  variances.between.clear();
  for (std::size_t unit = places_.size(); unit < units(); ++unit) {
    for (std::size_t c = 0; c < columns_; ++c) {
      const double squared = share(unit, c) * share(unit, c);
      variances.direct[c] = squared * plan_.bright_direct_factor(c) *
                            static_cast<double>(pilot_.direct_variance[unit * stride_ + c]);
      variances.rest[c] = squared * static_cast<double>(pilot_.rest_variance[unit * stride_ + c]);
    }
    plan_.moderate_bright_pilot(variances);
    sizes.push_back(allocation.sizes(variances));
  }
  for (std::size_t unit = 0; unit < units(); ++unit) {
    plans_.push_back(allocation.plan(sizes[unit]));
    SampledPixel& pixel = pixels_[pixel_of(unit)];
    pixel.cut = pixel.cut || allocation.is_cut(sizes[unit]);
    pixel.samples += plans_[unit].count() + Allocation::pilot().count();
  }
}

void ImageBlock::take_materials(std::size_t unit, std::size_t first_label) {
  const double weight = plan_.allocation().pilot_direct_weight(), of_pixel = shares(unit).front();
  const std::uint32_t count = plans_[unit].count();
  const std::span<const Label> pilot = pilot_labels(unit),
                               main = std::span<const Label>(main_.labels).subspan(first_label, count);
  std::map<std::uint32_t, double> fractions;
  const auto counts_for = [](const LevelSums& sums, std::size_t at) {
    return sums.label_weights.empty() ? 1.0 : static_cast<double>(sums.label_weights[at]);
  };
  for (std::size_t n = 0; n < pilot.size(); ++n)
    fractions[field_.material_of(pilot[n])] +=
        counts_for(pilot_, unit * pilot.size() + n) * weight / static_cast<double>(pilot.size());
  for (std::size_t n = 0; n < main.size(); ++n)
    fractions[field_.material_of(main[n])] += counts_for(main_, first_label + n) * (1.0 - weight) / count;
  auto& materials = pixels_[pixel_of(unit)].estimate.materials;
  for (const auto& [material, fraction] : fractions) {
    const double of_one = std::max(0.0, fraction * (1.0 - fraction));
    auto& share = materials[material];
    share.fraction += of_pixel * fraction;
    share.variance +=
        of_pixel * of_pixel * of_one *
        (weight * weight / static_cast<double>(pilot.size()) + (1.0 - weight) * (1.0 - weight) / count);
  }
}

void ImageBlock::take_means(std::size_t unit) {
  const Allocation& allocation = plan_.allocation();
  const double direct = allocation.pilot_direct_weight(), rest = allocation.pilot_rest_weight();
  for (std::size_t at = unit * stride_; at < unit * stride_ + columns_; ++at) {
    const auto mean = [at](double weight, const std::vector<float>& pilot, const std::vector<float>& main) {
      return static_cast<float>(weight * static_cast<double>(pilot[at]) +
                                (1.0 - weight) * static_cast<double>(main[at]));
    };
    direct_[at] = mean(direct, pilot_.direct, main_.direct);
    rest_[at] = mean(rest, pilot_.rest, main_.rest);
  }
}

void ImageBlock::take_rest(std::size_t unit) {
  const double whole = plans_[unit].whole, freedom = whole + Allocation::kPilotWhole - 2.0;
  for (std::size_t c = 0; c < columns_; ++c) {
    const std::size_t at = unit * stride_ + c;
    const double found = ((whole - 1.0) * static_cast<double>(main_.rest_variance[at]) +
                          (Allocation::kPilotWhole - 1.0) * static_cast<double>(pilot_.rest_variance[at])) /
                         freedom;
    const double own = is_part(unit) ? found : plan_.rest_factor(c) * found,
                 of_kind = is_part(unit) ? own : plan_.kind(materials_[unit]).mean.rest[c],
                 of_one = ImagePlan::moderated(own, freedom, of_kind, ImagePlan::kRestPrior);
    rest_variance_[at] =
        static_cast<float>(plan_.allocation().rest_variance(of_one, of_one, plans_[unit].whole));
  }
}

void ImageBlock::pool() {
  std::vector<std::map<std::uint32_t, double>> shares(places_.size());
  std::vector<float> predicted(rest_.size(), 0.0f), pooled = rest_, variance = rest_variance_;
  std::vector<double> between(columns_, 0.0);
  for (std::size_t k = 0; k < places_.size(); ++k) {
    for (const auto& [material, share] : pixels_[k].estimate.materials) shares[k][material] = share.fraction;
    plan_.rest_model()->predict(shares[k], direct_.data() + k * stride_, predicted.data() + k * stride_);
    for (std::size_t c = 0; c < columns_; ++c)
      between[c] += plan_.kind(materials_[k]).mean.between[c] / static_cast<double>(places_.size());
  }
  const std::vector<std::size_t>& leaders = plan_.leaders();
  LikePixels(places_, shares)
      .shrink({columns_, stride_, predicted, between, trust_, leaders}, pooled, variance);
  // Columns that are not judged tell other things than light: shares of mixtures, light that may not be found.
  for (std::size_t k = 0; k < places_.size(); ++k)
    for (std::size_t c = 0; c < columns_; ++c) {
      if (!std::isfinite(plan_.limits()[leaders[c]])) continue;
      const std::size_t at = k * stride_ + c;
      rest_[at] = pooled[at];
      rest_variance_[at] = variance[at];
    }
}

void ImageBlock::estimate(std::size_t k) {
  PixelEstimate& estimate = pixels_[k].estimate;
  estimate.mean.assign(columns_, 0.0);
  estimate.variance_geometry.assign(columns_, 0.0);
  estimate.variance_path.assign(columns_, 0.0);
  Spread spread;
  const bool mixed = estimate.materials.size() > 1;
  add_unit(k, mixed, estimate, spread);
  const auto first =
      std::lower_bound(parts_.begin(), parts_.end(), k,
                       [](const PartOfPixel& part, std::size_t of) { return part.pixel < of; });
  for (auto part = first; part != parts_.end() && part->pixel == k; ++part)
    add_unit(places_.size() + static_cast<std::size_t>(part - parts_.begin()), mixed, estimate, spread);
  const double freedom = spread.over_freedom > 0.0 ? spread.size * spread.size / spread.over_freedom
                                                   : plans_[k].count() / 4.0 + kPilotFours;
  estimate.quantile = student_(std::max(1, static_cast<int>(freedom)));
}

void ImageBlock::add_unit(std::size_t unit, bool mixed, PixelEstimate& estimate, Spread& spread) const {
  const PixelPlan& plan = plans_[unit];
  const Allocation& allocation = plan_.allocation();
  const double count = plan.count(), fours = count / 4.0;
  // A value of the pilot's strata varies more than one of finer strata.
  const double finer = std::pow(Allocation::pilot().count() / count, Allocation::kExponent - 1.0);
  double direct_size = 0.0, rest_size = 0.0;
  for (std::size_t c = 0; c < columns_; ++c) {
    const std::size_t at = unit * stride_ + c;
    const double of_pixel = share(unit, c), squared = of_pixel * of_pixel;
    estimate.mean[c] += of_pixel * (static_cast<double>(direct_[at]) + static_cast<double>(rest_[at]));
    const double found = (fours * static_cast<double>(main_.direct_variance[at]) +
                          kPilotFours * finer * static_cast<double>(pilot_.direct_variance[at])) /
                         (fours + kPilotFours);
    // Of bright places a kind knows what their shares of the pixel's response make of them.
    const double own = is_part(unit) ? squared * plan_.bright_direct_factor(c) * found
                                     : plan_.direct_factor(mixed, c) * found,
                 of_kind = is_part(unit) ? plan_.bright().mean.direct[c]
                                         : plan_.kind(materials_[unit]).mean.direct[c],
                 fine =
                     ImagePlan::moderated(own, fours + kPilotFours, finer * of_kind, ImagePlan::kDirectPrior),
                 direct_variance = (is_part(unit) ? 1.0 : squared) *
                                   allocation.direct_variance(fine / finer, fine, plan.count()),
                 rest_variance = squared * static_cast<double>(rest_variance_[at]), limit = plan_.limits()[c];
    (mixed ? estimate.variance_geometry : estimate.variance_path)[c] += direct_variance;
    estimate.variance_path[c] += rest_variance;
    if (!(limit > 0.0) || !std::isfinite(limit)) continue;
    direct_size += direct_variance / (limit * limit);
    rest_size += rest_variance / (limit * limit);
  }
  spread.add(direct_size, fours + kPilotFours + ImagePlan::kDirectPrior);
  spread.add(rest_size, plan.whole + Allocation::kPilotWhole - 2.0 + ImagePlan::kRestPrior);
}

}  // namespace ifov::sampling
