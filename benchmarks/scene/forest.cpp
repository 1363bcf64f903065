#include "scene/forest.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "core/format.h"

namespace ifov::benchmarks {

namespace {

constexpr double kPi = std::numbers::pi;

/// Uniform in [0, 1), keyed by what it is for (the mixing function of splitmix64).
double uniform(std::uint64_t purpose, std::uint64_t index) {
  std::uint64_t h = purpose * 0x9e3779b97f4a7c15ull + index;
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ull;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebull;
  h ^= h >> 31;
  return static_cast<double>(h >> 11) * 0x1.0p-53;
}

enum Purpose : std::uint64_t { kNoise = 1, kGround, kLeaf, kPlace, kSpectrum };

double lattice(std::int64_t x, std::int64_t y) {
  return uniform(kNoise, (static_cast<std::uint64_t>(x) << 32) ^ static_cast<std::uint64_t>(y & 0xffffffff));
}

double value_noise(double x, double y) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto ix = static_cast<std::int64_t>(fx), iy = static_cast<std::int64_t>(fy);
  const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double u = smooth(x - fx), v = smooth(y - fy);
  return std::lerp(std::lerp(lattice(ix, iy), lattice(ix + 1, iy), u),
                   std::lerp(lattice(ix, iy + 1), lattice(ix + 1, iy + 1), u), v);
}

std::uint32_t add_vertex(ForestMesh& mesh, double x, double y, double z) {
  mesh.vertices_m.insert(mesh.vertices_m.end(), {x, y, z});
  return static_cast<std::uint32_t>(mesh.vertices_m.size() / 3 - 1);
}

void add_triangle(ForestMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t slot) {
  mesh.corners.insert(mesh.corners.end(), {a, b, c});
  mesh.slots.push_back(slot);
}

void add_trunk(ForestMesh& mesh) {
  constexpr std::uint32_t kRings = 5, kSides = 10;
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size() / 3);
  for (std::uint32_t ring = 0; ring <= kRings; ++ring)
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const double angle = 2.0 * kPi * side / kSides, radius = 0.25 * (1.0 - 0.15 * ring);
      add_vertex(mesh, radius * std::cos(angle), radius * std::sin(angle), -0.5 + 6.0 * ring / kRings);
    }
  for (std::uint32_t ring = 0; ring < kRings; ++ring)
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const std::uint32_t a = first + ring * kSides + side, b = first + ring * kSides + (side + 1) % kSides;
      add_triangle(mesh, a, b, b + kSides, 1);
      add_triangle(mesh, a, b + kSides, a + kSides, 1);
    }
}

/// A card of 0.35 m x 0.25 m, turned at random, in an ellipsoid of leaves that is denser towards its surface.
void add_leaf(ForestMesh& mesh, std::uint64_t leaf) {
  const auto random = [leaf](std::uint64_t which) { return uniform(kLeaf, leaf * 8 + which); };
  const double up = 2.0 * random(0) - 1.0, around = 2.0 * kPi * random(1), out = std::pow(random(2), 0.25);
  const double level = std::sqrt(1.0 - up * up);
  const double centre[3] = {3.5 * out * level * std::cos(around), 3.5 * out * level * std::sin(around),
                            7.0 + 4.0 * out * up};

  const double cos_t = 2.0 * random(3) - 1.0, sin_t = std::sqrt(1.0 - cos_t * cos_t);
  const double azimuth = 2.0 * kPi * random(4), spin = 2.0 * kPi * random(5);
  const double e1[3] = {std::cos(azimuth) * cos_t, std::sin(azimuth) * cos_t, -sin_t};
  const double e2[3] = {-std::sin(azimuth), std::cos(azimuth), 0.0};
  std::uint32_t corner[4];
  constexpr double kSigns[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (int k = 0; k < 4; ++k) {
    const double a = 0.175 * kSigns[k][0], b = 0.125 * kSigns[k][1];
    const double along = a * std::cos(spin) - b * std::sin(spin),
                 across = a * std::sin(spin) + b * std::cos(spin);
    corner[k] =
        add_vertex(mesh, centre[0] + along * e1[0] + across * e2[0],
                   centre[1] + along * e1[1] + across * e2[1], centre[2] + along * e1[2] + across * e2[2]);
  }
  add_triangle(mesh, corner[0], corner[1], corner[2], 0);
  add_triangle(mesh, corner[0], corner[2], corner[3], 0);
}

void write_obj(const ForestMesh& mesh, const std::filesystem::path& path, const char* slot_prefix,
               std::uint32_t slots) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (file == nullptr) throw std::runtime_error("cannot write " + path.string());
  for (std::size_t v = 0; v < mesh.vertices_m.size(); v += 3)
    std::fprintf(file, "v %.4f %.4f %.4f\n", mesh.vertices_m[v], mesh.vertices_m[v + 1],
                 mesh.vertices_m[v + 2]);
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    std::fprintf(file, "usemtl %s%u\n", slot_prefix, slot);
    for (std::size_t t = 0; t < mesh.slots.size(); ++t)
      if (mesh.slots[t] == slot)
        std::fprintf(file, "f %u %u %u\n", mesh.corners[3 * t] + 1, mesh.corners[3 * t + 1] + 1,
                     mesh.corners[3 * t + 2] + 1);
  }
  if (std::fclose(file) != 0) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

double forest_terrain_height_m(double x_m, double y_m) {
  double height_m = 0.0, amplitude_m = 60.0, frequency = 1.0 / 300.0;
  for (int octave = 0; octave < 8; ++octave, amplitude_m *= 0.48, frequency *= 2.03)
    height_m += amplitude_m * value_noise(x_m * frequency + 31.7 * octave, y_m * frequency + 11.9 * octave);
  return height_m;
}

ForestMesh forest_terrain() {
  constexpr std::uint32_t kCells = 707;
  ForestMesh mesh;
  for (std::uint32_t j = 0; j <= kCells; ++j)
    for (std::uint32_t i = 0; i <= kCells; ++i) {
      const double x = (double(i) / kCells - 0.5) * kForestSide_m,
                   y = (double(j) / kCells - 0.5) * kForestSide_m;
      add_vertex(mesh, x, y, forest_terrain_height_m(x, y));
    }
  const auto ground = [&mesh] {
    return static_cast<std::uint32_t>(kForestGroundMaterials * uniform(kGround, mesh.slots.size()));
  };
  for (std::uint32_t j = 0; j < kCells; ++j)
    for (std::uint32_t i = 0; i < kCells; ++i) {
      const std::uint32_t a = j * (kCells + 1) + i, b = a + 1, c = a + kCells + 1, d = c + 1;
      add_triangle(mesh, a, b, d, ground());
      add_triangle(mesh, a, d, c, ground());
    }
  return mesh;
}

ForestMesh forest_tree() {
  ForestMesh mesh;
  add_trunk(mesh);
  for (std::uint64_t leaf = 0; leaf < 2450; ++leaf) add_leaf(mesh, leaf);
  return mesh;
}

std::vector<TreePosition> tree_positions() {
  constexpr int kRows = 100;
  constexpr double kStep_m = kForestSide_m / kRows;
  std::vector<TreePosition> positions;
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kRows; ++i) {
      const auto random = [index = positions.size()](std::uint64_t which) {
        return uniform(kPlace, index * 4 + which);
      };
      TreePosition position;
      position.x_m = -kForestSide_m / 2 + (i + 0.1 + 0.8 * random(0)) * kStep_m;
      position.y_m = -kForestSide_m / 2 + (j + 0.1 + 0.8 * random(1)) * kStep_m;
      position.z_m = forest_terrain_height_m(position.x_m, position.y_m);
      position.yaw_deg = 360.0 * random(2);
      position.scale = 0.8 + 0.5 * random(3);
      positions.push_back(position);
    }
  return positions;
}

double forest_reflectance(int material, int band) {
  return 0.05 + 0.5 * uniform(kSpectrum,
                              static_cast<std::uint64_t>(material) * 4096 + static_cast<std::uint64_t>(band));
}

std::string forest_document(const ForestView& view) {
  const auto wavelength_um = [&view](int band) { return 0.4 + (view.gaussian ? 0.01 : 0.002) * band; };
  std::string wavelengths, materials, ground, channels;
  for (int band = 0; band < view.bands; ++band) {
    const char* comma = band > 0 ? ", " : "";
    wavelengths += format("{}\"{:.3f} um\"", comma, wavelength_um(band));
    channels += view.gaussian
                    ? format(R"({}{{"gaussian": {{"center": "{:.3f} um", "fwhm": "0.01 um"}}}})", comma,
                             wavelength_um(band))
                    : format(R"({}{{"monochromatic": {{"at": "{:.3f} um"}}}})", comma, wavelength_um(band));
  }
  for (int m = 0; m < kForestGroundMaterials + 2; ++m) {
    const std::string name =
        m < kForestGroundMaterials ? format("ground{}", m) : format("tree{}", m - kForestGroundMaterials);
    std::string values;
    for (int band = 0; band < view.bands; ++band)
      values += format("{}{:.9f}", band > 0 ? ", " : "", forest_reflectance(m, band));
    materials += format(
        R"({}"{}": {{"reflectance": {{"table": {{"wavelength": [{}], "values": [{}]}}, "outside": "extend"}}}})",
        m > 0 ? ",\n" : "", name, wavelengths, values);
    if (m < kForestGroundMaterials) ground += format(R"({}"{}": "{}")", m > 0 ? ", " : "", name, name);
  }
  const std::string sky =
      view.sky_w_m2_sr_um > 0.0
          ? format(R"(, "sky": {{"radiance": "{} W m-2 sr-1 um-1"}})", view.sky_w_m2_sr_um)
          : "";
  return format(R"({{"ifov": 1,
 "scene": {{
  "materials": {{{}}},
  "prototypes": {{"tree": [{{"mesh": {{"file": "tree.obj"}}, "material": {{"slots": {{"tree0": "tree0", "tree1": "tree1"}}}}}}]}},
  "objects": [{{"mesh": {{"file": "terrain.obj"}}, "material": {{"slots": {{{}}}}}}},
              {{"instances": {{"of": "tree", "csv": "trees.csv"}}}}]}},
 "light": {{"sun": {{"point": {{"zenith": "35 deg", "azimuth": "135 deg", "distance": "1 au", "spectrum": "{} W m-2 um-1"}}}}{}}},
 "sensor": {{"camera": {{"orthographic": {{"gsd": "{} m", "pixels": [{}, {}]}}}}, "channels": [{}]}},
 "sampling": {}}}
)",
                materials, ground, kForestSun_w_m2_um, sky, view.side_m / view.pixels, view.pixels,
                view.pixels, channels, view.sampling);
}

void write_forest(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  write_obj(forest_terrain(), folder / "terrain.obj", "ground", kForestGroundMaterials);
  write_obj(forest_tree(), folder / "tree.obj", "tree", 2);
  std::ofstream csv(folder / "trees.csv");
  csv << "x,y,z,rotation,scale\n";
  csv.precision(10);
  for (const TreePosition& position : tree_positions())
    csv << position.x_m << ',' << position.y_m << ',' << position.z_m << ',' << position.yaw_deg << ','
        << position.scale << '\n';
  csv.close();
  if (!csv) throw std::runtime_error("cannot write " + (folder / "trees.csv").string());
}

}  // namespace ifov::benchmarks
