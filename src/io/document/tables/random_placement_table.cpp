#include "core/format.h"
#include "io/document/schema/record.h"
#include "io/document/tables/raster_keys.h"
#include "io/document/tables/shape_tables.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostWeighted = 1000;
constexpr int kLastBand = 65535;
constexpr std::int64_t kLargestSeed = 9007199254740991;
constexpr double kFarthest_m = 1e8;

SchemaType<std::vector<RandomPlacement::Weighted>> weighted_type() {
  const SchemaType<DocumentName> name = name_of("a prototype");
  Record<RandomPlacement::Weighted> weighted("weighted prototype",
                                             "One of several prototypes that stand mixed.");
  weighted.required("prototype", &RandomPlacement::Weighted::prototype, name, "what is copied")
      .with_default("weight", &RandomPlacement::Weighted::weight, number(Range::above(0.0)), "1",
                    "how often it comes, beside the weights of the others");
  const auto one = converted<std::vector<RandomPlacement::Weighted>>(
      name,
      [](DocumentName n) {
        return std::vector<RandomPlacement::Weighted>{{std::move(n), 1.0}};
      },
      [](const std::vector<RandomPlacement::Weighted>& of) {
        return of.size() == 1 && of[0].weight == 1.0 ? std::optional(of[0].prototype) : std::nullopt;
      });
  return either(one, list(weighted.type(), 1, kMostWeighted));
}

SchemaType<std::variant<double, DensityMap>> density_type() {
  using Density = std::variant<double, DensityMap>;
  Record<DensityMap> map(
      "density map",
      "Densities from a raster; each holds in its cell. Where it has no number, nothing grows.");
  add_raster_keys(map);
  map.with_default("band", &DensityMap::band, integer(1, kLastBand), "1",
                   "band of the raster, counted from 1")
      .with_default("unit", &DensityMap::density_of_one_m2, quantity(kDensity, Range::above(0.0, "m-2")),
                    "\"1 m-2\"", "density that the number 1 of the raster means")
      .check([](const DensityMap& m, const DocumentNode& node) {
        if (m.raster.by_texture) node.given("by").fail_at_key("a density map lies by place");
      });
  const auto fixed = converted<Density>(
      quantity(kDensity, Range::above(0.0, "m-2")), [](double d) { return Density(d); },
      [](const Density& density) { return target::as<double>(density); });
  return either(fixed, converted<Density>(
                           map.type(), [](DensityMap m) { return Density(std::move(m)); },
                           [](const Density& density) { return target::as<DensityMap>(density); }));
}

struct Area {
  std::array<double, 2> low_m{}, high_m{};
};

SchemaType<Area> area_type() {
  const auto corner = tuple<double, 2>(quantity(kLength, Range::between(-kFarthest_m, kFarthest_m, "m")));
  Record<Area> area("area", "A rectangle on the map.");
  area.required("low", &Area::low_m, corner, "x and y of its lower left corner")
      .required("high", &Area::high_m, corner, "x and y of the opposite corner")
      .check([](const Area& a, const DocumentNode& node) {
        if (!(a.low_m[0] < a.high_m[0] && a.low_m[1] < a.high_m[1]))
          node.given("high").fail(
              format("{} is not above 'low' in both coordinates", node.given("high").title()));
      });
  return area.type();
}

SchemaType<std::array<double, 2>> scale_type() {
  const SchemaType<double> factor = number(Range::above(0.0));
  const auto fixed = converted<std::array<double, 2>>(
      factor,
      [](double s) {
        return std::array<double, 2>{s, s};
      },
      [](const std::array<double, 2>& scale) {
        return scale[0] == scale[1] ? std::optional(scale[0]) : std::nullopt;
      });
  const auto pair = tuple<double, 2>(factor);
  const SchemaType<std::array<double, 2>> range{
      pair.description,
      [read = pair.read](const DocumentNode& node) {
        const std::array<double, 2> scale = read(node);
        if (scale[0] > scale[1]) node.fail(format("{} falls: the smaller factor comes first", node.title()));
        return scale;
      },
      pair.write};
  return either(fixed, range);
}

}  // namespace

SchemaType<RandomPlacement> random_placement_type() {
  Record<RandomPlacement> record("random placement",
                                 "Copies of prototypes at random, with a density and a minimum distance.");
  const SchemaType<std::variant<double, DensityMap>> density = density_type();
  record.required("of", &RandomPlacement::of, weighted_type(), "what is copied")
      .required("density", &RandomPlacement::density_m2, density,
                "copies per area, everywhere the same or from a map")
      .with_default("minimum_distance", &RandomPlacement::minimum_distance_m,
                    quantity(kLength, Range::at_least(0.0, "m")), "\"0 m\"",
                    "of copies from each other, on the map")
      .required("area",
                via(
                    [](RandomPlacement& s, const Area& area) {
                      s.low_m = area.low_m;
                      s.high_m = area.high_m;
                    },
                    [](const RandomPlacement& s) {
                      return Area{s.low_m, s.high_m};
                    }),
                area_type(), "where they stand")
      .at_most_one()
      .one("on", &RandomPlacement::on, name_of("an object"),
           "the objects of this name carry them: each stands on the topmost surface of its place, and where "
           "there is "
           "none, none stands")
      .one("height", &RandomPlacement::height_m, quantity(kLength), "z of all; 0 m without it and 'on'")
      .with_default("scale", &RandomPlacement::scale, scale_type(), "1",
                    "factor, or the lowest and the highest of random ones")
      .with_default("turn", &RandomPlacement::turn, boolean(), "true", "turned at random about the vertical")
      .with_default("seed",
                    via([](RandomPlacement& s, std::int64_t n) { s.seed = static_cast<std::uint64_t>(n); },
                        [](const RandomPlacement& s) { return static_cast<std::int64_t>(s.seed); }),
                    long_integer(0, kLargestSeed), "0", "another one gives other places");
  const SchemaType<RandomPlacement> type = record.type();
  return {type.description,
          [read = type.read](const DocumentNode& node) {
            RandomPlacement placement = read(node);
            placement.density_position = node.given("density").position();
            return placement;
          },
          type.write};
}

}  // namespace ifov::io
