#include "thermal/wild_thermal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <vector>

#include "core/format.h"
#include "honesty/random_stream.h"

namespace ifov::benchmarks {
namespace {

using Triple = std::array<double, 3>;

std::string metres(const Triple& at) {
  return format(R"(["{:.4f} m", "{:.4f} m", "{:.4f} m"])", at[0], at[1], at[2]);
}

class Draft {
 public:
  Draft(std::uint64_t seed, std::filesystem::path folder)
      : random(0x7e3a1, seed), seed_(seed), folder_(std::move(folder)) {}

  RandomStream random;
  std::vector<std::string> materials, objects;
  std::string kind;

  void write_weather();
  void add_materials();
  void add_ground();
  void add_things();
  std::string text() const;
  double top_m = 1.0;

 private:
  std::string any() { return names_[random.index(names_.size())]; }
  std::string present();
  void box(Triple low, Triple high, const std::string& material, const std::string& more = "") {
    objects.push_back(format(R"({{"box": {{"low": {}, "high": {}}}, "material": "{}"{}}})", metres(low),
                             metres(high), material, more));
    top_m = std::max(top_m, high[2]);
  }
  Triple somewhere(double z) { return {random.between(-8.0, 8.0), random.between(-8.0, 8.0), z}; }
  void thing(const std::string& what);
  void material(const std::string& name, const std::string& body) {
    materials.push_back(format(R"("{}": {{{}}})", name, body));
    names_.push_back(name);
  }

  std::uint64_t seed_;
  std::filesystem::path folder_;
  std::vector<std::string> names_;
  double latitude_deg_ = 50.0, longitude_deg_ = 0.0;
  int month_ = 6;
  double hour_ = 12.0;
};

void Draft::write_weather() {
  latitude_deg_ = random.between(-60.0, 66.0);
  longitude_deg_ = random.between(-170.0, 170.0);
  month_ = static_cast<int>(random.index(12)) + 1;
  hour_ = random.one_of({0.0, 0.25, 0.5}) + static_cast<double>(random.index(24));
  const double cloud = random.one_of({0.0, 0.1, 0.5, 1.0, random.uniform()}),
               mean_c = random.between(-5.0, 25.0), swing_c = random.between(1.0, 8.0),
               wind = random.magnitude(0.3, 8.0), from = random.between(0.0, 360.0);
  const bool directed = random.with(0.7), humid = true, split = random.with(0.4), longwave = random.with(0.3),
             clouded = random.with(0.7);
  kind += format("lat {:.0f} month {} hour {:.2f} cloud {:.1f} wind {:.1f}", latitude_deg_, month_, hour_,
                 cloud, wind);
  std::ofstream file(folder_ / format("weather_{}.csv", seed_));
  file << "time,air_temperature_c,wind_speed_m_s,global_irradiance_w_m2"
       << (directed ? ",wind_direction_deg" : "") << (humid ? ",relative_humidity_pct" : "")
       << (split ? ",diffuse_irradiance_w_m2" : "") << (longwave ? ",longwave_down_w_m2" : "")
       << (clouded ? ",cloud_fraction" : "") << "\n";
  const double day = 30.4 * (month_ - 1) + 15.0, turn = 2.0 * std::numbers::pi / 365.0 * (day - 80.0);
  const double declination = std::asin(0.3978 * std::sin(turn + 0.0334 * std::sin(turn))),
               latitude = latitude_deg_ * std::numbers::pi / 180.0;
  // Equation of time (Spencer's first terms), hours.
  const double b = 2.0 * std::numbers::pi * (day - 81.0) / 364.0,
               of_time_h = (9.87 * std::sin(2.0 * b) - 7.53 * std::cos(b) - 1.5 * std::sin(b)) / 60.0;
  for (int hour = 0; hour <= 72; ++hour) {
    const double solar_h = hour + longitude_deg_ / 15.0 + of_time_h;
    const double height =
        std::sin(latitude) * std::sin(declination) +
        std::cos(latitude) * std::cos(declination) * std::cos(std::numbers::pi / 12.0 * (solar_h - 12.0));
    const double clear = height > 0.05 ? 1098.0 * height * std::exp(-0.057 / height) : 0.0;
    const double global = clear * (1.0 - 0.75 * std::pow(cloud, 3.4));
    const double air_c =
        mean_c - swing_c * std::cos(std::numbers::pi / 12.0 * (solar_h - 3.0)) + random.between(-0.3, 0.3);
    file << format("2026-{:02d}-{:02d}T{:02d}:00:00Z,{:.2f},{:.2f},{:.1f}", month_, 14 + hour / 24, hour % 24,
                   air_c, wind * random.between(0.8, 1.25), global);
    if (directed) file << format(",{:.0f}", std::fmod(from + random.between(0.0, 40.0), 360.0));
    if (humid) file << format(",{:.0f}", random.between(45.0, 85.0));
    if (split) file << format(",{:.1f}", global * (0.15 + 0.8 * cloud));
    if (longwave) file << format(",{:.1f}", 5.67e-8 * std::pow(air_c + 273.15, 4) * (0.75 + 0.22 * cloud));
    if (clouded) file << format(",{:.2f}", cloud);
    file << "\n";
  }
}

void Draft::add_materials() {
  const std::string solved = R"("temperature": "solved")";
  const auto library = [&](const std::string& name, const char* entry) {
    material(name, format(R"("reflectance": {{"library": "{}"}}, {})", entry, solved));
  };
  library("ground", random.one_of({"asphalt, road, weathered", "grass, lawn", "soil, bare", "sand, beach",
                                   "concrete, pavement", "grass, lawn, sparse", "grass, dry"}));
  library("wall", random.one_of({"brick, red", "concrete, white", "concrete, pavement"}));
  library("roof", random.one_of({"roof tile, red clay", "roof tile, terracotta", "steel, galvanised"}));
  library("crown", random.one_of({"tree crown, broadleaf", "leaf, aspen"}));
  const int layers = static_cast<int>(random.index(3)) + 1;
  std::string sheets;
  for (int k = 0; k < layers; ++k)
    sheets += format(R"({}{{"thickness": "{:.5f} m", "library": "{}"}})", k > 0 ? ", " : "",
                     random.magnitude(0.002, 0.3),
                     random.one_of({"asphalt", "brick", "concrete", "dry soil", "moist clay", "clay tile"}));
  const std::string back =
      random.one_of({R"("back": {"ground": {}}, )", R"("back": {"room": {"temperature": "21 degC"}}, )",
                     R"("back": {"temperature": "15 degC"}, )", ""});
  material(
      "layers",
      format(
          R"("reflectance": {:.3f}, {}, "thermal": {{"layers": [{}], {}"roughness": "{}", "wetness": {:.2f},
      "resistance": "{:.0f} s/m", "power": "{:.0f} W m-2", "solar_absorptance": {:.2f}}})",
          random.between(0.02, 0.3), solved, sheets, back,
          random.one_of({"very rough", "rough", "medium smooth", "very smooth"}),
          random.one_of({0.0, 0.0, random.uniform(), 1.0}), random.one_of({0.0, 70.0}),
          random.one_of({0.0, 0.0, 60.0, 200.0}), random.between(0.1, 0.95)));
  material("metal", format(R"("emissivity": {0:.3f}, {1}, "thermal": {{"therm": {{"density": "7.8 g/cm3",
      "specific_heat": "0.11 cal g-1 K-1", "conductivity": "43 kcal m-1 h-1 K-1", "thickness": "{2:.2f} mm", "solar_absorption": {3:.2f},
      "emissivity": {0:.3f}, "exposed_area": {4}}}}})",
                           random.between(0.2, 0.95), solved, random.magnitude(0.5, 10.0),
                           random.between(0.2, 0.95), random.one_of({0.5, 0.75, 1.0})));
  material("given", format(R"("emissivity": {:.3f}, "temperature": "{:.1f} K")", random.between(0.5, 1.0),
                           random.between(265.0, 330.0)));
}

void Draft::add_ground() {
  switch (random.index(4)) {
    case 0: {  // a map of two materials
      std::ofstream map(folder_ / format("map_{}.asc", seed_));
      map << "ncols 8\nnrows 8\nxllcorner -12\nyllcorner -12\ncellsize 3\n";
      for (int row = 0; row < 8; ++row) {
        for (int column = 0; column < 8; ++column) map << 1 + random.index(2) << " ";
        map << "\n";
      }
      objects.push_back(format(
          R"({{"plane": {{}}, "material": {{"map": {{"file": "map_{}.asc", "classes": {{"1": "ground", "2": "layers"}}}}}}}})",
          seed_));
      kind += "; map";
      break;
    }
    case 1:
      box({-30.0, -30.0, -2.0}, {30.0, 30.0, 0.0}, "ground");
      kind += "; block";
      break;
    case 2: objects.push_back(format(R"({{"plane": {{}}, "material": "{}"}})", any())); break;
    default: objects.push_back(R"({"plane": {}, "material": "ground"})");
  }
}

std::string Draft::present() {
  const auto clock = [&](double before_h) {
    const double at_h = 48.0 + hour_ - before_h;
    const int minutes = static_cast<int>(std::lround(60.0 * at_h));
    return format("2026-{:02d}-{:02d}T{:02d}:{:02d}Z", month_, 14 + minutes / 1440, minutes / 60 % 24,
                  minutes % 60);
  };
  const double left_h = random.one_of({-2.0, random.magnitude(0.05, 6.0)}),
               came_h = std::max(left_h, 0.0) + random.magnitude(0.1, 12.0);
  return format(R"(, "present": [["{}", "{}"]])", clock(came_h), clock(left_h));
}

void Draft::thing(const std::string& what) {
  kind += "; " + what;
  const Triple at = somewhere(0.0);
  if (what == "box") {
    const double height = random.magnitude(0.3, 15.0);
    box(at, {at[0] + random.between(0.5, 6.0), at[1] + random.between(0.5, 6.0), height}, any());
  } else if (what == "canyon") {
    const double width = random.between(2.0, 12.0), height = random.between(3.0, 15.0);
    box({-12.0, at[1] - 4.0, 0.0}, {12.0, at[1], height}, "wall");
    box({-12.0, at[1] + width, 0.0}, {12.0, at[1] + width + 4.0, height * random.between(0.5, 1.2)}, any());
  } else if (what == "court") {
    const double half = random.between(2.0, 6.0), height = random.between(2.0, 10.0);
    const std::string of = any();
    box({-half - 1.0, -half - 1.0, 0.0}, {half + 1.0, -half, height}, of);
    box({-half - 1.0, half, 0.0}, {half + 1.0, half + 1.0, height}, of);
    box({-half - 1.0, -half, 0.0}, {-half, half, height}, any());
    box({half, -half, 0.0}, {half + 1.0, half, height}, any());
  } else if (what == "deck") {
    const double foot = random.between(0.3, 4.0);
    box({at[0] - 3.0, at[1] - 3.0, foot}, {at[0] + 3.0, at[1] + 3.0, foot + random.magnitude(0.02, 0.5)},
        any());
  } else if (what == "wall") {
    box(at, {at[0] + (random.with(0.5) ? 8.0 : 0.2), at[1] + 0.15, random.between(0.8, 4.0)}, any());
  } else if (what == "car") {
    box({at[0], at[1], 0.25}, {at[0] + 4.4, at[1] + 1.8, 1.4}, random.with(0.5) ? "metal" : any(), present());
  } else if (what == "tree") {
    const double height = random.between(2.0, 8.0), radius = random.between(0.8, 2.5);
    objects.push_back(format(
        R"({{"cylinder": {{"base": {}, "radius": "0.2 m", "height": "{:.3f} m"}}, "material": "layers"}})",
        metres(at), height));
    objects.push_back(format(R"({{"sphere": {{"center": {}, "radius": "{:.3f} m"}}, "material": "crown"}})",
                             metres({at[0], at[1], height + 0.7 * radius}), radius));
    top_m = std::max(top_m, height + 2.0 * radius);
  } else if (what == "leaves") {
    for (int k = 0; k < 25; ++k)
      objects.push_back(format(
          R"({{"disk": {{"center": {}, "normal": [{:.3f}, {:.3f}, {:.3f}], "radius": "0.25 m"}}, "material": "crown"}})",
          metres({at[0] + random.between(-1.0, 1.0), at[1] + random.between(-1.0, 1.0),
                  random.between(1.5, 3.5)}),
          random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-0.3, 1.0)));
    top_m = std::max(top_m, 3.5);
  } else if (what == "sheet") {
    const double foot = random.between(0.2, 3.0), slope = random.between(-2.0, 2.0);
    objects.push_back(format(R"({{"polygon": {{"vertices": [{}, {}, {}, {}]}}, "material": "{}"}})",
                             metres({at[0], at[1], foot + 2.0}), metres({at[0] + 4.0, at[1], foot + 2.0}),
                             metres({at[0] + 4.0, at[1] + 3.0, foot + 2.0 + slope}),
                             metres({at[0], at[1] + 3.0, foot + 2.0 + slope}), any()));
    top_m = std::max(top_m, foot + 4.0);
  } else if (what == "roof") {
    const double eaves = random.between(2.0, 6.0), ridge = eaves + random.between(0.5, 3.0);
    box(at, {at[0] + 6.0, at[1] + 5.0, eaves}, "wall");
    const Triple low_a{at[0] - 0.3, at[1] - 0.3, eaves}, low_b{at[0] + 6.3, at[1] - 0.3, eaves},
        top_a{at[0] - 0.3, at[1] + 2.5, ridge}, top_b{at[0] + 6.3, at[1] + 2.5, ridge},
        far_a{at[0] - 0.3, at[1] + 5.3, eaves}, far_b{at[0] + 6.3, at[1] + 5.3, eaves};
    for (const auto& [a, b, c, d] :
         {std::array{low_a, low_b, top_b, top_a}, std::array{top_a, top_b, far_b, far_a}})
      objects.push_back(format(R"({{"polygon": {{"vertices": [{}, {}, {}, {}]}}, "material": "roof"}})",
                               metres(a), metres(b), metres(c), metres(d)));
    top_m = std::max(top_m, ridge);
  } else if (what == "turned") {
    objects.push_back(format(
        R"({{"box": {{"low": ["-2 m", "-1 m", "0 m"], "high": ["2 m", "1 m", "{:.2f} m"]}}, "material": "{}", "transform": {{"rotate": {{"angle": "{:.0f} deg"}}, "translate": {}}}}})",
        random.between(0.5, 6.0), any(), random.between(0.0, 90.0), metres(at)));
    top_m = std::max(top_m, 6.0);
  } else if (what == "column") {
    objects.push_back(format(
        R"({{"cylinder": {{"base": {}, "radius": "{:.2f} m", "height": "{:.2f} m"}}, "material": "{}"}})",
        metres(at), random.between(0.2, 2.0), random.between(1.0, 8.0), any()));
    top_m = std::max(top_m, 8.0);
  }
}

void Draft::add_things() {
  const int count = 2 + static_cast<int>(random.index(5));
  for (int k = 0; k < count; ++k)
    thing(random.one_of({"box", "canyon", "court", "deck", "deck", "wall", "car", "car", "tree", "leaves",
                         "sheet", "roof", "turned", "column"}));
}

std::string Draft::text() const {
  const auto joined = [](const std::vector<std::string>& of) {
    std::string all;
    for (const std::string& one : of) all += (all.empty() ? "" : ",\n    ") + one;
    return all;
  };
  const int hour = static_cast<int>(hour_), minute = static_cast<int>(std::lround(60.0 * (hour_ - hour)));
  return format(R"({{"ifov": 1, "time": "2026-{:02d}-16T{:02d}:{:02d}:00Z",
 "weather": {{"file": "weather_{}.csv"}},
 "temperatures": {{"spin_up": "1 d", "step": "10 min", "repeat_first_day": true}},
 "scene": {{"origin": {{"latitude": "{:.3f} deg", "longitude": "{:.3f} deg"}},
  "materials": {{
    {}}},
  "objects": [
    {}]}},
 "light": {{"sky": {{"temperature": "255 K"}}}},
 "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [24, 24]}}}},
  "channels": [{{"name": "thermal", "monochromatic": {{"at": "10 um"}}}}]}},
 "sampling": {{"accuracy": {{"error": "50 K"}}}}}}
)",
                month_, hour, minute, seed_, latitude_deg_, longitude_deg_, joined(materials),
                joined(objects));
}

}  // namespace

WildThermal wild_thermal(std::uint64_t seed, const std::filesystem::path& folder) {
  Draft draft(seed, folder);
  draft.write_weather();
  draft.add_materials();
  draft.add_ground();
  draft.add_things();
  return {draft.text(), draft.kind, 12.0, draft.top_m};
}

}  // namespace ifov::benchmarks
