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

std::span<SampledPixel> ImageBlock::sample(std::span<const Place> places) {
  places_ = places;
  pixels_.assign(places.size(), {});
  draw(
      kPilotPaths, [](std::size_t) { return Allocation::pilot(); }, pilot_);
  choose();
  draw(
      kMainPaths, [&](std::size_t k) { return plans_[k]; }, main_);
  for (std::vector<float>* rows : {&direct_, &rest_, &rest_variance_})
    rows->assign(places.size() * stride_, 0.0f);
  std::size_t label = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    take_materials(k, label);
    label += plans_[k].count();
    take_means(k);
    take_rest(k);
  }
  if (plan_.rest_model() != nullptr) pool();
  for (std::size_t k = 0; k < places.size(); ++k) estimate(k);
  return pixels_;
}

template <class PlanOf>
void ImageBlock::draw(std::uint64_t purpose, PlanOf plan_of, LevelSums& sums) {
  points_.clear();
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const auto [i, j] = places_[k];
    points_.add(problem_, i, j, hash(problem_.seed, i, j, purpose), plan_of(k));
  }
  field_.levels({points_.requests, points_.whole, points_.counts, points_.importance, &footprints_}, sums);
}

std::span<const Label> ImageBlock::pilot_labels(std::size_t k) const {
  const std::size_t count = Allocation::pilot().count();
  return std::span<const Label>(pilot_.labels).subspan(k * count, count);
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
    sizes.push_back(allocation.sizes(variances));
  }
  if (pooled) {
    // Neighbours that show the same tell more of a pixel's borders than all pixels of its kind.
    const std::vector<double> smoothed = LikePixels(places_, shares).smoothed(own, of_kind);
    for (std::size_t k = 0; k < places_.size(); ++k)
      sizes[k].direct = ImagePlan::moderated(own[k], kPilotFours, smoothed[k], ImagePlan::kDirectPrior);
  }
  for (std::size_t k = 0; k < places_.size(); ++k) {
    plans_.push_back(allocation.plan(sizes[k]));
    pixels_[k].cut = allocation.is_cut(sizes[k]);
    pixels_[k].samples = plans_[k].count() + Allocation::pilot().count();
  }
}

void ImageBlock::take_materials(std::size_t k, std::size_t first_label) {
  const double weight = plan_.allocation().pilot_direct_weight();
  const std::uint32_t count = plans_[k].count();
  const std::span<const Label> pilot = pilot_labels(k),
                               main = std::span<const Label>(main_.labels).subspan(first_label, count);
  auto& materials = pixels_[k].estimate.materials;
  const auto counts_for = [](const LevelSums& sums, std::size_t at) {
    return sums.label_weights.empty() ? 1.0 : static_cast<double>(sums.label_weights[at]);
  };
  for (std::size_t n = 0; n < pilot.size(); ++n)
    materials[field_.material_of(pilot[n])].fraction +=
        counts_for(pilot_, k * pilot.size() + n) * weight / static_cast<double>(pilot.size());
  for (std::size_t n = 0; n < main.size(); ++n)
    materials[field_.material_of(main[n])].fraction +=
        counts_for(main_, first_label + n) * (1.0 - weight) / count;
  for (auto& [material, share] : materials) {
    const double of_one = std::max(0.0, share.fraction * (1.0 - share.fraction));
    share.variance = of_one * (weight * weight / static_cast<double>(pilot.size()) +
                               (1.0 - weight) * (1.0 - weight) / count);
  }
}

void ImageBlock::take_means(std::size_t k) {
  const Allocation& allocation = plan_.allocation();
  const double direct = allocation.pilot_direct_weight(), rest = allocation.pilot_rest_weight();
  for (std::size_t at = k * stride_; at < k * stride_ + columns_; ++at) {
    const auto mean = [at](double weight, const std::vector<float>& pilot, const std::vector<float>& main) {
      return static_cast<float>(weight * static_cast<double>(pilot[at]) +
                                (1.0 - weight) * static_cast<double>(main[at]));
    };
    direct_[at] = mean(direct, pilot_.direct, main_.direct);
    rest_[at] = mean(rest, pilot_.rest, main_.rest);
  }
}

void ImageBlock::take_rest(std::size_t k) {
  const LevelVariances& kind = plan_.kind(materials_[k]).mean;
  const double whole = plans_[k].whole, freedom = whole + Allocation::kPilotWhole - 2.0;
  for (std::size_t c = 0; c < columns_; ++c) {
    const std::size_t at = k * stride_ + c;
    const double own = plan_.rest_factor(c) *
                       ((whole - 1.0) * static_cast<double>(main_.rest_variance[at]) +
                        (Allocation::kPilotWhole - 1.0) * static_cast<double>(pilot_.rest_variance[at])) /
                       freedom,
                 of_one = ImagePlan::moderated(own, freedom, kind.rest[c], ImagePlan::kRestPrior);
    rest_variance_[at] =
        static_cast<float>(plan_.allocation().rest_variance(of_one, of_one, plans_[k].whole));
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
  const PixelPlan& plan = plans_[k];
  const Allocation& allocation = plan_.allocation();
  const LevelVariances& kind = plan_.kind(materials_[k]).mean;
  const double count = plan.count(), fours = count / 4.0;
  // A value of the pilot's strata varies more than one of finer strata.
  const double finer = std::pow(Allocation::pilot().count() / count, Allocation::kExponent - 1.0);
  PixelEstimate& estimate = pixels_[k].estimate;
  estimate.mean.resize(columns_);
  estimate.variance_geometry.assign(columns_, 0.0);
  estimate.variance_path.assign(columns_, 0.0);
  double direct_size = 0.0, rest_size = 0.0;  // of the pixel's variance, all columns together
  const bool mixed = estimate.materials.size() > 1;
  for (std::size_t c = 0; c < columns_; ++c) {
    const std::size_t at = k * stride_ + c;
    estimate.mean[c] = static_cast<double>(direct_[at]) + static_cast<double>(rest_[at]);
    const double own = plan_.direct_factor(mixed, c) *
                       (fours * static_cast<double>(main_.direct_variance[at]) +
                        kPilotFours * finer * static_cast<double>(pilot_.direct_variance[at])) /
                       (fours + kPilotFours),
                 fine = ImagePlan::moderated(own, fours + kPilotFours, finer * kind.direct[c],
                                             ImagePlan::kDirectPrior),
                 direct_variance = allocation.direct_variance(fine / finer, fine, plan.count()),
                 rest_variance = static_cast<double>(rest_variance_[at]), limit = plan_.limits()[c];
    (mixed ? estimate.variance_geometry : estimate.variance_path)[c] = direct_variance;
    estimate.variance_path[c] += rest_variance;
    if (!(limit > 0.0) || !std::isfinite(limit)) continue;
    direct_size += direct_variance / (limit * limit);
    rest_size += rest_variance / (limit * limit);
  }
  // Degrees of freedom of both levels together (Satterthwaite 1946), columns by what they weigh.
  const double direct_freedom = fours + kPilotFours + ImagePlan::kDirectPrior,
               rest_freedom = plan.whole + Allocation::kPilotWhole - 2.0 + ImagePlan::kRestPrior,
               both = direct_size + rest_size,
               freedom = both > 0.0 ? both * both /
                                          (direct_size * direct_size / direct_freedom +
                                           rest_size * rest_size / rest_freedom)
                                    : direct_freedom;
  estimate.quantile = student_(std::max(1, static_cast<int>(freedom)));
}

}  // namespace ifov::sampling
