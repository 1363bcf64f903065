#include "io/mesh/obj_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/mesh/mesh_materials.h"
#include "io/mesh/obj_lines.h"
#include "io/mesh/obj_materials.h"
#include "io/mesh/polygon_pieces.h"

namespace ifov::io {
namespace {

constexpr std::string_view kObjExtensions[] = {".obj"};

using geometry::kNoIndex;
using geometry::Triangle;

/// One corner of a face: indices from 0, kNoIndex where the file gives none.
struct Corner {
  std::uint32_t vertex = kNoIndex, uv = kNoIndex, normal = kNoIndex;
  friend bool operator==(const Corner&, const Corner&) = default;
};

class Reader {
 public:
  Reader(const std::filesystem::path& path, LogSink* log, MeshUse use)
      : lines_(path), name_(path.string()), log_(log), told_mtllib_(use == MeshUse::with_materials) {}

  geometry::TriangleMesh read() {
    while (lines_.next()) {
      const ObjWord key = lines_.word();
      if (key.text == "v") {
        const auto [x, y, z] = numbers<3>("a vertex", 3);
        mesh_.vertices_m.push_back({x, y, z});
      } else if (key.text == "vn") {
        const auto [x, y, z] = numbers<3>("a normal", 3);
        mesh_.normals.push_back({x, y, z});
      } else if (key.text == "vt") {
        const auto [u, v] = numbers<2>("a texture coordinate", 1);
        mesh_.uvs.push_back({u, v});
      } else if (key.text == "f") {
        face();
      } else if (key.text == "usemtl") {
        slot_ = slot_of(std::string(lines_.rest()));
      } else if (key.text == "mtllib" && log_ != nullptr && !std::exchange(told_mtllib_, true)) {
        log_->warn(
            format("{}: its material library '{}' is not used; the document says what each name is made of",
                   name_, lines_.rest()));
      }
    }
    if (mesh_.triangles.empty()) throw InputError(format("{}: the file has no faces", name_), {name_, 0, 0});
    if (!any_uv_) mesh_.uvs.clear(), mesh_.uv_corners.clear();
    if (!any_normal_) mesh_.normals.clear(), mesh_.normal_corners.clear();
    return std::move(mesh_);
  }

 private:
  /// The first `N` numbers of the statement, of which `needed` must be there.
  template <std::size_t N>
  std::array<double, N> numbers(const char* what, std::size_t needed) {
    std::array<double, N> values{};
    for (std::size_t k = 0; k < N; ++k) {
      const ObjWord word = lines_.word();
      if (word.text.empty() && k >= needed) break;
      const auto value = obj_number(word.text);
      if (word.text.empty())
        lines_.fail(word.column, format("{} needs {} numbers, found {}", what, needed, k));
      if (!value) lines_.fail(word.column, format("expected a finite number, found '{}'", word.text));
      values[k] = *value;
    }
    return values;
  }

  /// "12" or "-1" as an index from 0 into a list that holds `count` entries so far.
  std::uint32_t index(std::string_view text, int column, const char* what, std::size_t count) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
      lines_.fail(column, format("expected the number of a {}, found '{}'", what, text));
    const auto size = static_cast<std::int64_t>(count);
    const std::int64_t at = value > 0 ? value - 1 : value < 0 ? size + value : -1;
    if (at < 0 || at >= size)
      lines_.fail(column, format("there is no {} number {}: the file has {} so far", what, value, size));
    return static_cast<std::uint32_t>(at);
  }

  /// "v", "v/vt", "v//vn" or "v/vt/vn".
  Corner corner(const ObjWord& word) {
    Corner c;
    const std::size_t first = std::min(word.text.find('/'), word.text.size());
    c.vertex = index(word.text.substr(0, first), word.column, "vertex", mesh_.vertices_m.size());
    if (first == word.text.size()) return c;
    const std::size_t second = std::min(word.text.find('/', first + 1), word.text.size());
    const std::string_view uv = word.text.substr(first + 1, second - first - 1);
    const std::string_view normal =
        second == word.text.size() ? std::string_view{} : word.text.substr(second + 1);
    // Some writers number normals or texture coordinates that they never write.
    if (!uv.empty() && !mesh_.uvs.empty())
      c.uv = index(uv, word.column + static_cast<int>(first) + 1, "texture coordinate", mesh_.uvs.size());
    if (!normal.empty() && !mesh_.normals.empty())
      c.normal = index(normal, word.column + static_cast<int>(second) + 1, "normal", mesh_.normals.size());
    return c;
  }

  void face() {
    corners_.clear();
    ObjWord word = lines_.word();
    for (; !word.text.empty(); word = lines_.word()) corners_.push_back(corner(word));
    if (corners_.size() < 3)
      lines_.fail(word.column, format("a face needs at least 3 corners, found {}", corners_.size()));
    keep_one_round();
    points_.clear();
    for (const Corner& c : corners_) points_.push_back(mesh_.vertices_m[c.vertex]);
    const auto pieces = cut_face(points_);
    if (!pieces) lines_.fail(word.column, kCrossesItself);
    for (const Triangle& t : *pieces) {
      const Corner &a = corners_[t[0]], &b = corners_[t[1]], &c = corners_[t[2]];
      mesh_.triangles.push_back({a.vertex, b.vertex, c.vertex});
      mesh_.uv_corners.push_back({a.uv, b.uv, c.uv});
      mesh_.normal_corners.push_back({a.normal, b.normal, c.normal});
      if (!slot_) slot_ = slot_of({});
      mesh_.slots.push_back(*slot_);
    }
    for (const Corner& c : corners_) {
      any_uv_ = any_uv_ || c.uv != kNoIndex;
      any_normal_ = any_normal_ || c.normal != kNoIndex;
    }
  }

  /// Some writers run round a face several times: once is enough.
  void keep_one_round() {
    const std::size_t n = corners_.size();
    for (std::size_t round = 3; round <= n / 2; ++round) {
      if (n % round != 0) continue;
      if (std::equal(corners_.begin() + static_cast<std::ptrdiff_t>(round), corners_.end(),
                     corners_.begin())) {
        corners_.resize(round);
        return;
      }
    }
  }

  std::uint32_t slot_of(const std::string& name) {
    const auto [entry, is_new] = slots_.try_emplace(name, static_cast<std::uint32_t>(slots_.size()));
    if (is_new) mesh_.slot_names.push_back(name);
    return entry->second;
  }

  ObjLines lines_;
  std::string name_;
  LogSink* log_;
  bool told_mtllib_;
  geometry::TriangleMesh mesh_;
  std::map<std::string, std::uint32_t> slots_;
  std::optional<std::uint32_t> slot_;
  std::vector<Corner> corners_;
  std::vector<math::Point3> points_;
  bool any_uv_ = false, any_normal_ = false;
};

}  // namespace

geometry::TriangleMesh read_obj(const std::filesystem::path& path, LogSink* log, MeshUse use) {
  return Reader(path, log, use).read();
}

constinit const MeshFormat kObj{.name = "Wavefront OBJ",
                                .extensions = kObjExtensions,
                                .y_up = false,
                                .read = read_obj,
                                .read_materials = read_obj_materials,
                                .material_files = obj_material_files};

}  // namespace ifov::io
