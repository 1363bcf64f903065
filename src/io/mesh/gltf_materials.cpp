#include "io/mesh/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/error.h"
#include "io/files/input_file.h"
#include "io/files/inputs.h"
#include "io/mesh/gltf_accessor.h"
#include "io/mesh/gltf_file.h"
#include "io/mesh/mesh_materials.h"
#include "io/raster/picture.h"

namespace ifov::io {
namespace {

[[noreturn]] void fail_in_gltf(const std::string& file, const std::string& message) {
  throw InputError(format("{}: {}", file, message), {file, 0, 0});
}

template <class List>
const auto& entry_of(const List& list, int index, const char* what, const std::string& from,
                     const std::string& file) {
  if (index < 0 || static_cast<std::size_t>(index) >= list.size())
    fail_in_gltf(file, format("{} names {} {}: the file has {}", from, what, index, list.size()));
  return list[static_cast<std::size_t>(index)];
}

bool is_data(const std::string& uri) { return uri.starts_with("data:"); }

class Pictures {
 public:
  Pictures(const tinygltf::Model& model, const std::filesystem::path& path) : model_(model), path_(path) {}

  std::shared_ptr<const Picture> of(int index, const std::string& from, std::string& name) {
    const std::string file = path_.string();
    const tinygltf::Image& image = entry_of(model_.images, index, "image", from, file);
    name = !image.uri.empty() && !is_data(image.uri) ? decoded_uri(image.uri)
           : image.name.empty()                      ? format("image {}", index)
                                                     : image.name;
    std::shared_ptr<const Picture>& known = known_[index];
    if (known) return known;
    const std::string title = format("{}: image {}", file, index);
    known = std::make_shared<const Picture>(decode_picture(bytes_of(image, index), title));
    return known;
  }

 private:
  std::string bytes_of(const tinygltf::Image& image, int index) const {
    const std::string file = path_.string();
    if (image.bufferView >= 0) {
      const tinygltf::BufferView& view =
          entry_of(model_.bufferViews, image.bufferView, "buffer view", format("image {}", index), file);
      const tinygltf::Buffer& buffer =
          entry_of(model_.buffers, view.buffer, "buffer", format("buffer view {}", image.bufferView), file);
      if (view.byteOffset > buffer.data.size() || view.byteLength > buffer.data.size() - view.byteOffset)
        fail_in_gltf(file, format("image {}: its {} bytes reach beyond the {} of its buffer", index,
                                  view.byteLength, buffer.data.size()));
      const auto first = buffer.data.begin() + static_cast<std::ptrdiff_t>(view.byteOffset);
      return {first, first + static_cast<std::ptrdiff_t>(view.byteLength)};
    }
    if (!image.image.empty()) return {image.image.begin(), image.image.end()};
    if (image.uri.empty() || is_data(image.uri)) fail_in_gltf(file, format("image {} has no bytes", index));
    try {
      return read_input(file_beside_mesh(path_, decoded_uri(image.uri), "image"));
    } catch (const InputError& error) {
      fail_in_gltf(file, format("image {}: {}", index, error.what()));
    }
  }

  const tinygltf::Model& model_;
  const std::filesystem::path& path_;
  std::map<int, std::shared_ptr<const Picture>> known_;
};

Wrap wrap_of(int code, const std::string& from, const std::string& file) {
  switch (code) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT: return Wrap::repeat;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT: return Wrap::mirror;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE: return Wrap::edge;
    default: fail_in_gltf(file, format("{}: there is no way {} to wrap a texture", from, code));
  }
}

/// Linear red, green, blue and opacity by which vertices multiply a material's colour.
struct VertexColour {
  std::array<double, 4> factor{1.0, 1.0, 1.0, 1.0};
  bool known = false, differs = false;

  /// Nearer than half a step of 8 bits is alike.
  void add(const std::array<double, 4>& colour) {
    constexpr double kAlike = 0.5 / 255.0;
    for (std::size_t c = 0; c < factor.size(); ++c)
      differs = differs || (known && std::abs(colour[c] - factor[c]) > kAlike);
    if (!known) factor = colour;
    known = true;
  }
};

/// By number of the material; of parts without such colours white.
std::map<int, VertexColour> vertex_colours(const tinygltf::Model& model, const std::string& file) {
  std::map<int, VertexColour> colours;
  for (const tinygltf::Mesh& mesh : model.meshes)
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      VertexColour& own = colours[primitive.material];
      const auto found = primitive.attributes.find("COLOR_0");
      if (found == primitive.attributes.end()) {
        own.add({1.0, 1.0, 1.0, 1.0});
        continue;
      }
      const bool opacity =
          found->second >= 0 && static_cast<std::size_t>(found->second) < model.accessors.size() &&
          model.accessors[static_cast<std::size_t>(found->second)].type == TINYGLTF_TYPE_VEC4;
      const GltfAccessor vertices(model, found->second, opacity ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3,
                                  "COLOR_0", file);
      for (std::size_t k = 0; k < vertices.count(); ++k) {
        std::array<double, 4> colour{1.0, 1.0, 1.0, 1.0};
        for (std::size_t c = 0; c < (opacity ? 4u : 3u); ++c) {
          colour[c] = vertices.value(k, c);
          if (!(colour[c] >= 0.0 && colour[c] <= 1.0))
            fail_in_gltf(file, format("accessor {} (COLOR_0): vertex {} holds {:g}; expected 0 to 1",
                                      found->second, k, colour[c]));
        }
        own.add(colour);
      }
    }
  return colours;
}

}  // namespace

std::vector<std::string> gltf_slot_names(const tinygltf::Model& model, bool unique) {
  std::vector<std::string> names;
  std::set<std::string> used;
  for (std::size_t k = 0; k < model.materials.size(); ++k) {
    std::string name = model.materials[k].name;
    if (name.empty()) name = format("material {}", k);
    if (unique && !used.insert(name).second) {
      name = format("{} (material {})", name, k);
      used.insert(name);
    }
    names.push_back(std::move(name));
  }
  return names;
}

std::array<double, 2> GltfPlacement::of(double u, double v) const {
  const double c = std::cos(rotation_rad), s = std::sin(rotation_rad);
  const double x = scale[0] * u, y = scale[1] * v;
  return {c * x + s * y + offset[0], c * y - s * x + offset[1]};
}

GltfPlacement gltf_placement(const tinygltf::Model& model, int material, const std::string& file) {
  GltfPlacement placement;
  if (material < 0 || static_cast<std::size_t>(material) >= model.materials.size()) return placement;
  const tinygltf::TextureInfo& info =
      model.materials[static_cast<std::size_t>(material)].pbrMetallicRoughness.baseColorTexture;
  if (info.index < 0) return placement;
  placement.set = info.texCoord;
  const auto found = info.extensions.find("KHR_texture_transform");
  if (found != info.extensions.end() && found->second.IsObject()) {
    const tinygltf::Value& given = found->second;
    const auto number = [&](const tinygltf::Value& value) {
      const double n = value.IsNumber() ? value.GetNumberAsDouble() : std::nan("");
      if (!std::isfinite(n))
        fail_in_gltf(file,
                     format("material {}: KHR_texture_transform holds what is no finite number", material));
      return n;
    };
    const auto pair = [&](const char* key, std::array<double, 2>& into) {
      if (!given.Has(key)) return;
      const tinygltf::Value& list = given.Get(key);
      if (!list.IsArray() || list.ArrayLen() != 2)
        fail_in_gltf(file,
                     format("material {}: '{}' of KHR_texture_transform needs two numbers", material, key));
      into = {number(list.Get(0)), number(list.Get(1))};
    };
    pair("offset", placement.offset);
    pair("scale", placement.scale);
    if (given.Has("rotation")) placement.rotation_rad = number(given.Get("rotation"));
    if (given.Has("texCoord")) placement.set = static_cast<int>(number(given.Get("texCoord")));
  }
  if (placement.set < 0)
    fail_in_gltf(file,
                 format("material {}: there is no set {} of texture coordinates", material, placement.set));
  return placement;
}

MeshMaterials read_gltf_materials(const std::filesystem::path& path, LogSink*) {
  const std::string file = path.string();
  const tinygltf::Model model = load_gltf(path, nullptr, GltfImages::kept);
  const std::vector<std::string> names = gltf_slot_names(model, true);
  Pictures pictures(model, path);
  const std::map<int, VertexColour> by_vertex = vertex_colours(model, file);
  MeshMaterials all;
  all.source = path.filename().string();
  for (std::size_t k = 0; k < model.materials.size(); ++k) {
    const tinygltf::Material& source = model.materials[k];
    const tinygltf::PbrMetallicRoughness& base = source.pbrMetallicRoughness;
    FileMaterial material;
    material.slot = names[k];
    const std::string from = format("material {}", k);
    if (base.baseColorFactor.size() != 4)
      fail_in_gltf(file, format("{}: its baseColorFactor needs 4 numbers", from));
    for (const double value : base.baseColorFactor)
      if (!(value >= 0.0 && value <= 1.0))
        fail_in_gltf(file, format("{}: baseColorFactor holds {:g}; expected 0 to 1", from, value));
    const auto found = by_vertex.find(static_cast<int>(k));
    const VertexColour vertices = found != by_vertex.end() ? found->second : VertexColour{};
    const auto factor = [&](std::size_t c) {
      return base.baseColorFactor[c] * (vertices.differs ? 1.0 : vertices.factor[c]);
    };
    for (std::size_t c = 0; c < 3; ++c) material.colour[c] = factor(c);
    material.opacity = factor(3);
    if (source.alphaMode == "MASK")
      material.alpha = AlphaMode::mask;
    else if (source.alphaMode == "BLEND")
      material.alpha = AlphaMode::blend;
    material.alpha_cutoff = source.alphaCutoff;
    if (base.baseColorTexture.index >= 0) {
      const tinygltf::Texture& texture =
          entry_of(model.textures, base.baseColorTexture.index, "texture", from, file);
      const std::string of_texture = format("texture {}", base.baseColorTexture.index);
      if (texture.source < 0)
        fail_in_gltf(file, format("{} has no image of a kind that is read (PNG, JPEG)", of_texture));
      material.picture = pictures.of(texture.source, of_texture, material.picture_name);
      if (texture.sampler >= 0) {
        const tinygltf::Sampler& sampler =
            entry_of(model.samplers, texture.sampler, "sampler", of_texture, file);
        material.wrap = {wrap_of(sampler.wrapS, of_texture, file), wrap_of(sampler.wrapT, of_texture, file)};
      }
      if (material.alpha != AlphaMode::opaque && material.picture->has_alpha) {
        material.opacity_picture = material.picture;
        material.opacity_name = material.picture_name;
        material.opacity_wrap = material.wrap;
      }
    }
    const auto not_used = [&](bool there, const char* what) {
      if (there) material.not_used.emplace_back(what);
    };
    not_used(
        base.metallicFactor > 0.0 && source.extensions.find("KHR_materials_unlit") == source.extensions.end(),
        "metalness");
    not_used(vertices.differs, "colours that differ from vertex to vertex (COLOR_0)");
    not_used(source.normalTexture.index >= 0, "normal map");
    not_used(source.emissiveTexture.index >= 0 ||
                 std::any_of(source.emissiveFactor.begin(), source.emissiveFactor.end(),
                             [](double value) { return value > 0.0; }),
             "emission");
    not_used(source.extensions.find("KHR_materials_transmission") != source.extensions.end(), "transmission");
    not_used(source.extensions.find("KHR_materials_pbrSpecularGlossiness") != source.extensions.end(),
             "specular and glossiness");
    all.materials.push_back(std::move(material));
  }
  return all;
}

std::vector<std::filesystem::path> gltf_material_files(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files;
  try {
    for (const std::string& uri : gltf_image_uris(path)) {
      files.push_back(file_beside_mesh(path, uri, "image"));
    }
  } catch (const InputError&) {
  } catch (const SystemError&) {
  }
  return files;
}

}  // namespace ifov::io
