#include "sampling/image/image_plan.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "core/run_control.h"
#include "sampling/footprint_groups.h"
#include "sampling/hash.h"
#include "sampling/image/bright_places.h"
#include "sampling/image/levels.h"
#include "sampling/image/spread_places.h"
#include "sampling/tolerance.h"

namespace ifov::sampling {

namespace {

constexpr std::uint64_t kSurveyPaths = 0x737572766579ull, kSurveyPlaces = 0x706c61636573ull,
                        kBrightPlaces = 0x627269676874ull;
constexpr std::size_t kSurveyChunk = 32;
/// What a kind's few pilots tell of it is put together with so many that tell what all do.
constexpr double kPilotsOfAll = 2.0;

}  // namespace

std::uint32_t main_material(const Field& field, std::span<const Label> labels) {
  std::map<std::uint32_t, int> counts;
  for (const Label label : labels) ++counts[field.material_of(label)];
  return std::max_element(counts.begin(), counts.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

const ImagePlan::Kind& ImagePlan::kind(std::uint32_t material) const {
  const auto found = kinds_.find(material);
  return found == kinds_.end() ? all_ : found->second;
}

bool shows_several(const Field& field, std::span<const Label> labels) {
  const std::uint32_t first = field.material_of(labels.front());
  return std::any_of(labels.begin(), labels.end(),
                     [&](Label label) { return field.material_of(label) != first; });
}

namespace {

std::vector<std::size_t> leaders_of(const Field& field) {
  std::vector<std::size_t> leaders;
  for (int c = 0; c < field.columns(); ++c) leaders.push_back(static_cast<std::size_t>(field.leader(c)));
  return leaders;
}

/// What two pilots tell of a pixel, or of a bright place of one.
struct Pilots {
  // Means, and half their difference.
  std::vector<double> direct, rest, direct_apart, rest_apart;
  std::array<LevelVariances, 2> variances;

  /// Of groups `a` and the next; `scale`: of values, by column.
  template <class Scale>
  void take(const LevelSums& sums, std::size_t a, std::size_t columns, std::size_t stride,
            const Scale& scale) {
    for (std::vector<double>* row : {&direct, &rest, &direct_apart, &rest_apart, &variances[0].direct,
                                     &variances[0].rest, &variances[1].direct, &variances[1].rest})
      row->resize(columns);
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t at[2] = {a * stride + c, (a + 1) * stride + c};
      const double of = scale(c);
      const auto half_sum = [&](const std::vector<float>& x) {
        return 0.5 * of * (static_cast<double>(x[at[0]]) + static_cast<double>(x[at[1]]));
      };
      const auto half_difference = [&](const std::vector<float>& x) {
        return 0.5 * of * (static_cast<double>(x[at[0]]) - static_cast<double>(x[at[1]]));
      };
      direct[c] = half_sum(sums.direct);
      rest[c] = half_sum(sums.rest);
      direct_apart[c] = half_difference(sums.direct);
      rest_apart[c] = half_difference(sums.rest);
      for (const std::size_t h : {0, 1}) {
        variances[h].direct[c] = of * of * static_cast<double>(sums.direct_variance[at[h]]);
        variances[h].rest[c] = of * of * static_cast<double>(sums.rest_variance[at[h]]);
      }
    }
  }
};

/// A pixel of the survey; of one with bright places what lies beside them.
struct Surveyed : Pilots {
  std::uint32_t material = 0;
  bool mixed = false;
  std::map<std::uint32_t, double> shares;
  std::vector<double> left;  // of its response, by column
};

void look(const SurveyRequest& request, std::span<const Place> places, Field& field,
          std::span<Surveyed> found) {
  const TileProblem& image = request.image;
  PixelPoints points;
  const ColumnFootprints footprints = image.footprints(field);
  std::vector<BrightShares> bright;
  for (const Place& place : places) {
    bright.push_back(bright_shares(image, footprints, place.i, place.j));
    for (const int half : {0, 1})
      points.add(image, bright.back(), place.i, place.j,
                 hash(image.seed, place.i, place.j, kSurveyPaths, half), Allocation::pilot());
  }
  LevelSums sums;
  field.levels({points.requests, points.whole, points.counts, points.importance, &footprints}, sums);
  const std::size_t columns = static_cast<std::size_t>(field.columns()),
                    stride = static_cast<std::size_t>(field.stride()),
                    labels = 2 * Allocation::pilot().count();
  for (std::size_t p = 0; p < places.size(); ++p) {
    Surveyed& pixel = found[p];
    const std::span<const Label> own = std::span<const Label>(sums.labels).subspan(p * labels, labels);
    pixel.material = main_material(field, own);
    pixel.mixed = shows_several(field, own);
    for (const Label label : own) pixel.shares[field.material_of(label)] += 1.0 / static_cast<double>(labels);
    for (std::size_t c = 0; c < columns; ++c) pixel.left.push_back(bright[p].left[footprints.group_of(c)]);
    pixel.take(sums, 2 * p, columns, stride, [](std::size_t) { return 1.0; });
  }
}

/// What bright places bring to pixels: two pilots of each place of each.
struct BrightSurvey {
  std::vector<Pilots> found;
  double of_pixels = 0.0;  ///< share of the image's pixels that a pixel looked at stands for
  RayCounts rays;
};

BrightSurvey look_at_bright(const SurveyRequest& request) {
  constexpr std::size_t kMostPixels = 1024, kChunk = 8;
  const TileProblem& image = request.image;
  BrightSurvey survey;
  if (image.bright == nullptr || image.bright->empty()) return survey;
  std::unique_ptr<Field> any = request.field();
  const ColumnFootprints footprints = image.footprints(*any);
  const int reach = footprints.reach();
  std::set<std::pair<int, int>> reached;  // row and column
  image.bright->visit_pixels([&](int i, int j) {
    for (int y = std::max(image.image.y0, j - reach); y <= std::min(image.image.y1 - 1, j + reach); ++y)
      for (int x = std::max(image.image.x0, i - reach); x <= std::min(image.image.x1 - 1, i + reach); ++x)
        reached.emplace(y, x);
  });
  // Of many, those at equal steps through them.
  const std::size_t step = (reached.size() + kMostPixels - 1) / kMostPixels;
  if (step == 0) return survey;
  std::vector<Place> places;
  std::size_t number = hash(image.seed, kBrightPlaces) % step;
  for (const auto& [y, x] : reached)
    if (number++ % step == 0) places.push_back({x, y});
  survey.of_pixels = static_cast<double>(reached.size()) / static_cast<double>(places.size()) /
                     static_cast<double>(image.image.count());
  const std::size_t chunks = (places.size() + kChunk - 1) / kChunk;
  std::vector<std::vector<Pilots>> of_chunk(chunks);
  std::vector<RayCounts> rays(chunks);
  parallel_for(static_cast<std::int64_t>(chunks), request.threads, [&](std::int64_t chunk) {
    if (image.cancel != nullptr && image.cancel->cancelled()) throw Cancelled();
    const std::unique_ptr<Field> field = request.field();
    const std::size_t first = static_cast<std::size_t>(chunk) * kChunk;
    PixelPoints points;
    std::vector<BrightShares::Part> parts;
    for (std::size_t p = first; p < std::min(places.size(), first + kChunk); ++p) {
      const auto [i, j] = places[p];
      std::size_t n = 0;
      for (BrightShares::Part& part : bright_shares(image, footprints, i, j).parts) {
        for (const int half : {0, 1})
          points.add(image, part.where, i, j, hash(image.seed, i, j, kBrightPlaces, n, half),
                     Allocation::pilot());
        parts.push_back(std::move(part));
        ++n;
      }
    }
    LevelSums sums;
    if (!parts.empty())
      field->levels({points.requests, points.whole, points.counts, points.importance, &footprints}, sums);
    for (std::size_t n = 0; n < parts.size(); ++n)
      of_chunk[static_cast<std::size_t>(chunk)].emplace_back().take(
          sums, 2 * n, static_cast<std::size_t>(field->columns()), static_cast<std::size_t>(field->stride()),
          [&](std::size_t c) { return parts[n].share[footprints.group_of(c)]; });
    rays[static_cast<std::size_t>(chunk)] = field->counts();
  });
  for (std::vector<Pilots>& pilots : of_chunk)
    survey.found.insert(survey.found.end(), std::make_move_iterator(pilots.begin()),
                        std::make_move_iterator(pilots.end()));
  for (const RayCounts& counts : rays) survey.rays += counts;
  return survey;
}

/// True over told by column: sums of squares, twice the square of half a difference being the variance. What few pixels tell of one
/// column is put together with what they tell of all.
class Factor {
 public:
  /// `leaders`: Field::leader() by column; what follows tells nothing of the others.
  explicit Factor(std::span<const std::size_t> leaders)
      : leaders_(leaders), found_(leaders.size(), 0.0), told_(leaders.size(), 0.0) {}
  void add(std::size_t c, double found, double told) {
    found_[c] += found;
    told_[c] += told;
  }
  void count() { ++pixels_; }
  std::vector<double> of(std::vector<double> otherwise) const {
    constexpr int kFewest = 30;
    constexpr double kOfAll = 60.0;  // pixels
    double sum = 0.0;
    int columns = 0;
    for (std::size_t c = 0; c < told_.size(); ++c)
      if (told_[c] > 0.0 && leaders_[c] == c) sum += found_[c] / told_[c], ++columns;
    if (pixels_ < kFewest || columns == 0) return otherwise;
    for (std::size_t c = 0; c < told_.size(); ++c) {
      const double all = sum / columns, own = told_[c] > 0.0 ? found_[c] / told_[c] : all;
      otherwise[c] = std::clamp((pixels_ * own + kOfAll * all) / (pixels_ + kOfAll), kLeast, kMost);
    }
    return otherwise;
  }

 private:
  static constexpr double kLeast = 0.2, kMost = 4.0;
  std::span<const std::size_t> leaders_;
  std::vector<double> found_, told_;
  int pixels_ = 0;
};

RestModel model_of(std::span<const Surveyed> found, std::span<const std::size_t> leaders) {
  std::vector<RestModel::Pixel> pixels;
  for (const Surveyed& pixel : found) pixels.push_back({pixel.shares, pixel.direct, pixel.rest});
  return RestModel(pixels, leaders);
}

/// What pixels differ by from the model: the product of what two pilots do, whose noise is not the same.
void add_between(std::span<const Surveyed> found, ImagePlan::Kind& all,
                 std::map<std::uint32_t, ImagePlan::Kind>& kinds, const RestModel& model) {
  const std::size_t columns = found.front().direct.size();
  struct Sum {
    std::vector<double> products;
    double pixels = 0.0;
  };
  Sum of_all{std::vector<double>(columns, 0.0)};
  std::map<std::uint32_t, Sum> of_kind;
  std::vector<double> predicted(columns);
  for (const Surveyed& pixel : found) {
    model.predict(pixel.shares, pixel.direct.data(), predicted.data());
    Sum& own = of_kind.try_emplace(pixel.material, Sum{std::vector<double>(columns, 0.0)}).first->second;
    for (Sum* sum : {&own, &of_all}) sum->pixels += 1.0;
    for (std::size_t c = 0; c < columns; ++c) {
      const double away = pixel.rest[c] - predicted[c],
                   product = away * away - pixel.rest_apart[c] * pixel.rest_apart[c];
      own.products[c] += product;
      of_all.products[c] += product;
    }
  }
  // Kinds of few pixels are told by all of them.
  constexpr double kPrior = 16.0;
  all.mean.between.resize(columns);
  for (std::size_t c = 0; c < columns; ++c)
    all.mean.between[c] = ImagePlan::kNearShare * std::max(0.0, of_all.products[c] / of_all.pixels);
  for (auto& [material, kind] : kinds) {
    const Sum& own = of_kind.at(material);
    kind.mean.between.resize(columns);
    for (std::size_t c = 0; c < columns; ++c)
      kind.mean.between[c] =
          std::max(0.0, (ImagePlan::kNearShare * own.products[c] + kPrior * all.mean.between[c]) /
                            (own.pixels + kPrior));
  }
}

}  // namespace

void ImagePlan::moderate_pilot(LevelVariances& own, std::uint32_t material) const {
  const LevelVariances& of_kind = kind(material).mean;
  for (std::size_t c = 0; c < own.direct.size(); ++c) {
    own.direct[c] =
        moderated(own.direct[c], Allocation::pilot().count() / 4.0, of_kind.direct[c], kDirectPrior);
    own.rest[c] = moderated(own.rest[c], Allocation::kPilotWhole - 1.0, of_kind.rest[c], kRestPrior);
  }
  own.between = of_kind.between;
}

void ImagePlan::moderate_bright_pilot(LevelVariances& own) const {
  for (std::size_t c = 0; c < own.direct.size(); ++c)
    own.direct[c] =
        moderated(own.direct[c], Allocation::pilot().count() / 4.0, bright_.mean.direct[c], kDirectPrior);
}

std::unique_ptr<const ImagePlan> ImagePlan::find(const SurveyRequest& request, std::uint32_t most_samples,
                                                 bool pooling) {
  const TileProblem& image = request.image;
  const std::int64_t wanted = std::clamp<std::int64_t>(image.image.count() / 8, kLeastPixels, kMostPixels);
  const std::vector<Place> places =
      spread_places(image.image, static_cast<std::size_t>(wanted), hash(image.seed, kSurveyPlaces));
  std::vector<Surveyed> found(places.size());
  const std::size_t chunks = (places.size() + kSurveyChunk - 1) / kSurveyChunk;
  std::vector<RayCounts> rays(chunks);
  parallel_for(static_cast<std::int64_t>(chunks), request.threads, [&](std::int64_t chunk) {
    if (image.cancel != nullptr && image.cancel->cancelled()) throw Cancelled();
    const std::unique_ptr<Field> field = request.field();
    const std::size_t first = static_cast<std::size_t>(chunk) * kSurveyChunk,
                      count = std::min(kSurveyChunk, places.size() - first);
    look(request, std::span(places).subspan(first, count), *field, std::span(found).subspan(first, count));
    rays[static_cast<std::size_t>(chunk)] = field->counts();
  });

  std::unique_ptr<ImagePlan> plan(new ImagePlan());
  for (const RayCounts& count : rays) plan->rays += count;
  const std::uint64_t scattered = plan->rays.continuation;
  BrightSurvey bright = look_at_bright(request);
  plan->rays += bright.rays;
  const std::size_t columns = found.front().direct.size();
  plan->leaders_ = leaders_of(*request.field());
  std::vector<double> mean(columns, 0.0);
  Factor pure(plan->leaders_), mixed(plan->leaders_), all(plan->leaders_), rest(plan->leaders_),
      of_bright(plan->leaders_);
  // By what the first level differs by between two pilots, and what it tells of that; with it goes what the two levels have in common.
  const auto direct_found = [](const Pilots& pilots, std::size_t c) {
    return 2.0 * pilots.direct_apart[c] * (pilots.direct_apart[c] + 2.0 * pilots.rest_apart[c]);
  };
  const auto direct_told = [](const Pilots& pilots, std::size_t c) {
    return 0.5 * (pilots.variances[0].direct[c] + pilots.variances[1].direct[c]) /
           Allocation::pilot().count();
  };
  for (const Surveyed& pixel : found) {
    Factor& own = pixel.mixed ? mixed : pure;
    for (Factor* factor : {&own, &all, &rest}) factor->count();
    for (std::size_t c = 0; c < columns; ++c) {
      mean[c] += pixel.left[c] * (pixel.direct[c] + pixel.rest[c]) / static_cast<double>(found.size());
      const double beyond = pixel.rest_apart[c],
                   rest_told = 0.5 * (pixel.variances[0].rest[c] + pixel.variances[1].rest[c]) /
                               Allocation::kPilotWhole;
      own.add(c, direct_found(pixel, c), direct_told(pixel, c));
      all.add(c, direct_found(pixel, c), direct_told(pixel, c));
      rest.add(c, 2.0 * beyond * beyond, rest_told);
    }
  }
  for (const Pilots& place : bright.found) {
    of_bright.count();
    for (std::size_t c = 0; c < columns; ++c) {
      mean[c] += bright.of_pixels * (place.direct[c] + place.rest[c]);
      of_bright.add(c, direct_found(place, c), direct_told(place, c));
    }
  }
  const std::vector<double> one(columns, 1.0), of_direct = all.of(one);
  plan->direct_factor_ = {pure.of(of_direct), mixed.of(of_direct)};
  plan->rest_factor_ = rest.of(one);
  plan->bright_direct_factor_ = of_bright.of(one);

  const auto add = [&](Kind& kind, const LevelVariances& pixel) {
    kind.mean.direct.resize(columns, 0.0);
    kind.mean.rest.resize(columns, 0.0);
    for (std::size_t c = 0; c < columns; ++c) {
      kind.mean.direct[c] += pixel.direct[c];
      kind.mean.rest[c] += pixel.rest[c];
    }
    kind.pixels += 1.0;
  };
  for (Surveyed& pixel : found)
    for (LevelVariances& variances : pixel.variances) {
      for (std::size_t c = 0; c < columns; ++c) {
        variances.direct[c] *= plan->direct_factor(pixel.mixed, c);
        variances.rest[c] *= plan->rest_factor(c);
      }
      add(plan->all_, variances);
      add(plan->kinds_[pixel.material], variances);
    }
  plan->bright_.mean.direct.assign(columns, 0.0);
  for (Pilots& place : bright.found)
    for (LevelVariances& variances : place.variances) {
      for (std::size_t c = 0; c < columns; ++c) {
        variances.direct[c] *= plan->bright_direct_factor(c);
        plan->bright_.mean.direct[c] +=
            variances.direct[c] / (2.0 * static_cast<double>(bright.found.size()));
      }
    }
  // A tree in a street of lawns is met by few pilots and varies as nothing else does.
  const double of_all = plan->all_.pixels;
  for (auto& [material, kind] : plan->kinds_)
    for (const auto member : {&LevelVariances::direct, &LevelVariances::rest})
      for (std::size_t c = 0; c < columns; ++c)
        (kind.mean.*member)[c] =
            ((kind.mean.*member)[c] + kPilotsOfAll / of_all * (plan->all_.mean.*member)[c]) /
            (kind.pixels + kPilotsOfAll);
  for (std::vector<double>* values : {&plan->all_.mean.direct, &plan->all_.mean.rest})
    for (double& value : *values) value /= of_all;
  if (pooling) {
    plan->rest_model_ = std::make_unique<const RestModel>(model_of(found, plan->leaders_));
    add_between(found, plan->all_, plan->kinds_, *plan->rest_model_);
  }

  // What is asked of a pixel like the image's mean is asked of the image.
  plan->limits_.assign(columns, std::numeric_limits<double>::infinity());
  image.tolerance->limits(mean, plan->limits_);
  // Each pilot chooses, as it will in tiles, and the pixel's other one judges.
  std::vector<SurveyedPixel> pixels;
  for (const Surveyed& pixel : found)
    for (const std::size_t h : {0, 1}) {
      SurveyedPixel surveyed{pixel.variances[h], pixel.variances[1 - h],
                             0.5 / static_cast<double>(found.size())};
      plan->moderate_pilot(surveyed.chosen_by, pixel.material);
      surveyed.judged_by.between = surveyed.chosen_by.between;
      pixels.push_back(std::move(surveyed));
    }
  for (const Pilots& place : bright.found)
    for (const std::size_t h : {0, 1}) {
      SurveyedPixel surveyed{place.variances[h], place.variances[1 - h], 0.5 * bright.of_pixels};
      plan->moderate_bright_pilot(surveyed.chosen_by);
      pixels.push_back(std::move(surveyed));
    }
  std::vector<double> squares(columns);
  for (std::size_t c = 0; c < columns; ++c) squares[c] = plan->limits_[c] * plan->limits_[c];
  // Both levels send as many rays to light from each surface that they meet: the first one surface, the second so many. Those of the
  // second go all ways, and bring the sky's spectra: 2.2 us a path where a direct value took 1.0, and met 1.15 surfaces.
  constexpr double kOfSurface = 2.0, kLeastCost = 0.5, kMostCost = 8.0;
  const double followed = 2.0 * Allocation::kPilotWhole * static_cast<double>(found.size());
  const double rest_cost =
      std::clamp(kOfSurface * static_cast<double>(scattered) / followed, kLeastCost, kMostCost);
  plan->allocation_ = std::make_unique<const Allocation>(pixels, std::move(squares), rest_cost, most_samples);
  return plan;
}

}  // namespace ifov::sampling
