#include "core/format.h"
#include "io/document/schema/record.h"
#include "io/document/tables/raster_keys.h"
#include "io/document/tables/shape_tables.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostKin = 1000;
constexpr int kMostBands = 65535;
constexpr std::int64_t kLargestSeed = 9007199254740991;
constexpr double kFarthest_m = 1e8;

Kind<std::vector<ScatterShape::Kin>> kin_kind() {
  const Kind<DocumentName> name = name_of("a prototype");
  Record<ScatterShape::Kin> kin("scattered prototype", "One of several prototypes that stand mixed.");
  kin.required("prototype", &ScatterShape::Kin::prototype, name, "what is copied")
      .with_default("weight", &ScatterShape::Kin::weight, number(Range::above(0.0)), "1",
                    "how often it comes, beside the weights of the others");
  const auto one = converted<std::vector<ScatterShape::Kin>>(
      name,
      [](DocumentName n) {
        return std::vector<ScatterShape::Kin>{{std::move(n), 1.0}};
      },
      [](const std::vector<ScatterShape::Kin>& of) {
        return of.size() == 1 && of[0].weight == 1.0 ? std::optional(of[0].prototype) : std::nullopt;
      });
  return either(one, list(kin.kind(), 1, kMostKin));
}

Kind<std::variant<double, DensityMap>> density_kind() {
  using Density = std::variant<double, DensityMap>;
  Record<DensityMap> map(
      "density map",
      "Densities from a raster; each holds in its cell. Where it has no number, nothing grows.");
  add_raster_keys(map);
  map.with_default("band", &DensityMap::band, integer(1, kMostBands), "1",
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
                           map.kind(), [](DensityMap m) { return Density(std::move(m)); },
                           [](const Density& density) { return target::as<DensityMap>(density); }));
}

struct Area {
  std::array<double, 2> low_m{}, high_m{};
};

Kind<Area> area_kind() {
  const auto corner = tuple<double, 2>(quantity(kLength, Range::between(-kFarthest_m, kFarthest_m, "m")));
  Record<Area> area("area", "A rectangle on the map.");
  area.required("low", &Area::low_m, corner, "x and y of its lower left corner")
      .required("high", &Area::high_m, corner, "x and y of the opposite corner")
      .check([](const Area& a, const DocumentNode& node) {
        if (!(a.low_m[0] < a.high_m[0] && a.low_m[1] < a.high_m[1]))
          node.given("high").fail(
              format("{} is not above 'low' in both coordinates", node.given("high").title()));
      });
  return area.kind();
}

Kind<std::array<double, 2>> scale_kind() {
  const Kind<double> factor = number(Range::above(0.0));
  const auto fixed = converted<std::array<double, 2>>(
      factor,
      [](double s) {
        return std::array<double, 2>{s, s};
      },
      [](const std::array<double, 2>& scale) {
        return scale[0] == scale[1] ? std::optional(scale[0]) : std::nullopt;
      });
  const auto pair = tuple<double, 2>(factor);
  const Kind<std::array<double, 2>> range{
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

Kind<ScatterShape> scatter_kind() {
  Record<ScatterShape> record("random placement",
                              "Copies of prototypes at random, with a density and a minimum distance.");
  const Kind<std::variant<double, DensityMap>> density = density_kind();
  record.required("of", &ScatterShape::of, kin_kind(), "what is copied")
      .required("density", &ScatterShape::density_m2, density,
                "copies per area, everywhere the same or from a map")
      .with_default("minimum_distance", &ScatterShape::minimum_distance_m,
                    quantity(kLength, Range::at_least(0.0, "m")), "\"0 m\"",
                    "of copies from each other, on the map")
      .required("area",
                via(
                    [](ScatterShape& s, const Area& area) {
                      s.low_m = area.low_m;
                      s.high_m = area.high_m;
                    },
                    [](const ScatterShape& s) {
                      return Area{s.low_m, s.high_m};
                    }),
                area_kind(), "where they stand")
      .at_most_one()
      .one("on", &ScatterShape::on, name_of("an object"),
           "the objects of this name carry them: each stands on the topmost surface of its place, and where "
           "there is "
           "none, none stands")
      .one("height", &ScatterShape::height_m, quantity(kLength), "z of all; 0 m without it and 'on'")
      .with_default("scale", &ScatterShape::scale, scale_kind(), "1",
                    "factor, or the lowest and the highest of random ones")
      .with_default("turn", &ScatterShape::turn, boolean(), "true", "turned at random about the vertical")
      .with_default("seed",
                    via([](ScatterShape& s, std::int64_t n) { s.seed = static_cast<std::uint64_t>(n); },
                        [](const ScatterShape& s) { return static_cast<std::int64_t>(s.seed); }),
                    long_integer(0, kLargestSeed), "0", "another one gives other places");
  const Kind<ScatterShape> kind = record.kind();
  return {kind.description,
          [read = kind.read](const DocumentNode& node) {
            ScatterShape scatter = read(node);
            scatter.density_position = node.given("density").position();
            return scatter;
          },
          kind.write};
}

}  // namespace ifov::io
