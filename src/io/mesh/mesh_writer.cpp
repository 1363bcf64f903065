#include "io/mesh/mesh_writer.h"

#include <algorithm>
#include <cstring>

#include "core/format.h"

namespace ifov::io {
namespace {

/// Without the zeros at its end that a fixed number of decimals leaves.
std::string short_number(double value) {
  std::string text = format("{:.4f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

/// "7", "7/3" or "7//2", counted from 1.
std::string corner_text(const geometry::TriangleMesh& mesh, std::size_t triangle, std::size_t corner) {
  const auto index = [&](const std::vector<geometry::Triangle>& own) {
    const std::uint32_t k = own.empty() ? mesh.triangles[triangle][corner] : own[triangle][corner];
    return k == geometry::kNoIndex ? std::string() : format("{}", k + 1);
  };
  const std::string uv = mesh.uvs.empty() ? "" : index(mesh.uv_corners);
  const std::string normal = mesh.normals.empty() ? "" : index(mesh.normal_corners);
  std::string text = format("{}", mesh.triangles[triangle][corner] + 1);
  if (!uv.empty() || !normal.empty()) text += "/" + uv;
  if (!normal.empty()) text += "/" + normal;
  return text;
}

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

}  // namespace

std::string obj_text(const geometry::TriangleMesh& mesh) {
  std::string text;
  for (const math::Point3& p : mesh.vertices_m)
    text += format("v {} {} {}\n", short_number(p.x), short_number(p.y), short_number(p.z));
  for (const geometry::Uv& uv : mesh.uvs)
    text += format("vt {} {}\n", short_number(uv.u), short_number(uv.v));
  for (const math::Normal3& n : mesh.normals)
    text += format("vn {} {} {}\n", short_number(n.x), short_number(n.y), short_number(n.z));
  const std::size_t slots = std::max<std::size_t>(1, mesh.slot_names.size());
  for (std::size_t slot = 0; slot < slots; ++slot) {
    if (!mesh.slot_names.empty()) text += format("usemtl {}\n", mesh.slot_names[slot]);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if ((mesh.slots.empty() ? 0 : mesh.slots[t]) == slot)
        text +=
            format("f {} {} {}\n", corner_text(mesh, t, 0), corner_text(mesh, t, 1), corner_text(mesh, t, 2));
  }
  return text;
}

std::string ply_bytes(const geometry::TriangleMesh& mesh) {
  const bool has_uvs = mesh.uvs.size() == mesh.vertices_m.size() && mesh.uv_corners.empty();
  std::string bytes = format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n",
      mesh.vertices_m.size());
  if (has_uvs) bytes += "property float s\nproperty float t\n";
  bytes +=
      format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n", mesh.triangles.size());
  for (std::size_t k = 0; k < mesh.vertices_m.size(); ++k) {
    const math::Point3& p = mesh.vertices_m[k];
    append(bytes, static_cast<float>(p.x)), append(bytes, static_cast<float>(p.y)),
        append(bytes, static_cast<float>(p.z));
    if (has_uvs)
      append(bytes, static_cast<float>(mesh.uvs[k].u)), append(bytes, static_cast<float>(mesh.uvs[k].v));
  }
  for (const geometry::Triangle& t : mesh.triangles) {
    bytes.push_back(3);
    for (const std::uint32_t k : t) append(bytes, k);
  }
  return bytes;
}

}  // namespace ifov::io
