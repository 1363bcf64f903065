#include "landscape/output/scene_text.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "io/json/json_writer.h"
#include "landscape/output/material_table.h"

namespace ifov::landscape {
namespace {

/// Entries between braces or brackets, comments without a comma.
std::string listed(const std::vector<std::string>& entries) {
  std::string text;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const bool is_comment = entries[k].starts_with("//");
    text += "      " + entries[k] + (is_comment || k + 1 == entries.size() ? "\n" : ",\n");
  }
  return text;
}

std::string number(double value, int decimals) {
  std::string text = format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

}  // namespace

std::string metres(double value_m) { return format("\"{} m\"", number(value_m, 3)); }

std::string point_text(double x_m, double y_m, double z_m) {
  return format("[{}, {}, {}]", metres(x_m), metres(y_m), metres(z_m));
}

std::string mesh_text(const std::string& file) {
  return format("\"mesh\": {{\"file\": {}}}", io::json_string(file));
}

std::string transform_text(const Stand& stand, double z_m) {
  return format("\"transform\": {{\"translate\": {}, \"rotate\": {{\"angle\": \"{} deg\"}}}}",
                point_text(stand.origin.x, stand.origin.y, z_m),
                number(stand.rotation_rad() * 180.0 / M_PI, 3));
}

std::string SceneText::material(const std::string& name) {
  if (known_.insert(name).second) materials_.push_back(material_text(name, folder_));
  return io::json_string(name);
}

std::string SceneText::slots(const std::vector<std::pair<std::string, std::string>>& materials) {
  std::string text;
  for (const auto& [slot, name] : materials)
    text += format("{}{}: {}", text.empty() ? "" : ", ", io::json_string(slot), material(name));
  return format("{{\"slots\": {{{}}}}}", text);
}

void SceneText::prototype(const std::string& name, const std::vector<std::string>& objects) {
  std::string text;
  for (std::size_t k = 0; k < objects.size(); ++k) {
    const bool is_comment = objects[k].starts_with("//");
    text += "        " + objects[k] + (is_comment || k + 1 == objects.size() ? "" : ",") + "\n";
  }
  text.pop_back();
  prototypes_.push_back(format("{}: [\n{}]", io::json_string(name), text));
}

std::string SceneText::document(std::string_view title, const SceneLight& light) const {
  std::string text = format(
      "{{\n  // {}\n  // The scene and its light, which the documents beside this one include.\n", title);
  text += "  \"ifov\": 1,\n  \"scene\": {\n";
  text += "    // Temperatures are those of a calm, clear early afternoon in summer.\n";
  text += format("    \"materials\": {{\n{}    }},\n", listed(materials_));
  if (!prototypes_.empty()) text += format("    \"prototypes\": {{\n{}    }},\n", listed(prototypes_));
  text += format("    \"objects\": [\n{}    ]\n  }},\n", listed(objects_));
  return text + format("  \"light\": {},\n  \"atmosphere\": {}\n}}\n", light.light, light.atmosphere);
}

std::string view_text(const View& view, std::string_view title) {
  std::string text = format("{{\n  // {}\n", title);
  for (std::size_t from = 0; from < view.purpose.size();) {
    const std::size_t end = std::min(view.purpose.find('\n', from), view.purpose.size());
    text += format("  // {}\n", view.purpose.substr(from, end - from));
    from = end + 1;
  }
  text += format("  \"ifov\": 1,\n  \"include\": \"{}\",\n  \"sensor\": {},\n  \"sampling\": {}", kSceneFile,
                 view.sensor, view.sampling);
  if (!view.output.empty()) text += format(",\n  \"output\": {}", view.output);
  return text + "\n}\n";
}

}  // namespace ifov::landscape
