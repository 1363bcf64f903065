#include "io/mesh/obj_materials.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "core/error.h"
#include "io/files/input_file.h"
#include "io/files/inputs.h"
#include "io/mesh/mesh_materials.h"
#include "io/mesh/obj_lines.h"
#include "io/raster/picture.h"

namespace ifov::io {
namespace {

/// A library that an OBJ file names, and where it does.
struct NamedLibrary {
  std::string name;
  std::filesystem::path path;
};

/// `mtllib` may hold several names, or one with blanks.
std::vector<NamedLibrary> libraries_of(const std::filesystem::path& path) {
  std::vector<NamedLibrary> libraries;
  ObjLines lines(path);
  const auto add = [&](const ObjWord& word) {
    try {
      const std::string name(word.text);
      const auto file = file_beside_mesh(path, name, "material library");
      if (std::none_of(libraries.begin(), libraries.end(), [&](const auto& l) { return l.path == file; }))
        libraries.push_back({name, file});
    } catch (const InputError& error) {
      lines.fail(word.column, error.what());
    }
  };
  while (lines.next()) {
    if (lines.word().text != "mtllib") continue;
    std::vector<ObjWord> words;
    for (ObjWord word = lines.word(); !word.text.empty(); word = lines.word()) words.push_back(word);
    if (words.empty()) continue;
    const ObjWord whole{{words.front().text.data(),
                         static_cast<std::size_t>(words.back().text.data() + words.back().text.size() -
                                                  words.front().text.data())},
                        words.front().column};
    const bool several = words.size() > 1 && std::all_of(words.begin(), words.end(), [](const ObjWord& word) {
                           return word.text.ends_with(".mtl") || word.text.ends_with(".MTL");
                         });
    if (!several)
      add(whole);
    else
      for (const ObjWord& word : words) add(word);
  }
  return libraries;
}

class Library {
 public:
  Library(const std::filesystem::path& mesh, const std::filesystem::path& library,
          std::map<std::string, std::shared_ptr<const Picture>>* pictures)
      : mesh_(mesh), lines_(library), pictures_(pictures) {}

  void read(std::vector<FileMaterial>& materials, std::vector<std::filesystem::path>& files) {
    FileMaterial* now = nullptr;
    bool any_colour = true;
    const auto settle = [&] {
      if (!any_colour) materials.pop_back();
      any_colour = true;
    };
    while (lines_.next()) {
      const ObjWord key = lines_.word();
      if (key.text == "newmtl") {
        settle();
        now = &materials.emplace_back();
        now->slot = std::string(lines_.rest());
        any_colour = false;
        continue;
      }
      if (now == nullptr) continue;
      if (key.text == "Kd") {
        colour(*now);
        any_colour = true;
      } else if (key.text == "map_Kd") {
        picture(*now, files);
        any_colour = true;
      } else if (key.text == "d") {
        ObjWord word = lines_.word();
        if (word.text == "-halo") word = lines_.word();
        now->opacity = share(word);
        if (now->opacity < 1.0) now->alpha = AlphaMode::blend;
      } else if (key.text == "Tr") {
        now->opacity = 1.0 - share(lines_.word());
        if (now->opacity < 1.0) now->alpha = AlphaMode::blend;
      } else if (key.text == "map_d") {
        now->not_used.emplace_back("map of transparency");
      } else if (key.text == "map_Bump" || key.text == "map_bump" || key.text == "bump" ||
                 key.text == "norm") {
        now->not_used.emplace_back("relief");
      } else if (key.text == "Ke" || key.text == "map_Ke") {
        bool any = key.text != "Ke";
        for (ObjWord word = lines_.word(); !word.text.empty(); word = lines_.word())
          any = any || obj_number(word.text).value_or(0.0) > 0.0;
        if (any) now->not_used.emplace_back("emission");
      }
    }
    settle();
  }

 private:
  double share(const ObjWord& word) {
    const auto value = obj_number(word.text);
    if (!value || *value < 0.0 || *value > 1.0)
      lines_.fail(word.column, format("expected a number from 0 to 1, found '{}'", word.text));
    return *value;
  }

  void colour(FileMaterial& material) {
    ObjWord word = lines_.word();
    if (word.text == "xyz" || word.text == "spectral")
      lines_.fail(word.column,
                  format("a colour as '{}' is not read; expected red, green and blue", word.text));
    material.colour[0] = share(word);
    // One number stands for all three.
    for (std::size_t c = 1; c < 3; ++c) {
      word = lines_.word();
      if (word.text.empty() && c == 1) {
        material.colour[1] = material.colour[2] = material.colour[0];
        return;
      }
      material.colour[c] = share(word);
    }
  }

  void picture(FileMaterial& material, std::vector<std::filesystem::path>& files) {
    ObjWord word = lines_.word();
    for (; word.text.starts_with('-'); word = lines_.word()) {
      const ObjWord option = word;
      if (option.text == "-clamp") {
        if (lines_.word().text == "on") material.wrap = {Wrap::edge, Wrap::edge};
      } else if (option.text == "-blendu" || option.text == "-blendv" || option.text == "-cc") {
        lines_.word();
      } else {
        lines_.fail(
            option.column,
            format("the option '{}' of a picture is not read; expected '-clamp', '-blendu', '-blendv' or "
                   "'-cc'",
                   option.text));
      }
    }
    if (word.text.empty()) lines_.fail(word.column, "a picture needs the name of its file");
    std::string name(word.text);
    if (const std::string_view more = lines_.rest(); !more.empty())
      name = std::string(word.text.data(),
                         static_cast<std::size_t>(more.data() + more.size() - word.text.data()));
    std::filesystem::path file;
    try {
      file = file_beside_mesh(mesh_, name, "image");
    } catch (const InputError& error) {
      lines_.fail(word.column, error.what());
    }
    files.push_back(file);
    material.picture_name = name;
    if (pictures_ == nullptr) return;
    std::shared_ptr<const Picture>& known = (*pictures_)[file.string()];
    try {
      if (!known) known = std::make_shared<const Picture>(decode_picture(read_input(file), file.string()));
    } catch (const InputError& error) {
      lines_.fail(word.column, error.what());
    } catch (const SystemError& error) {
      lines_.fail(word.column, error.what());
    }
    material.picture = known;
  }

  const std::filesystem::path& mesh_;
  ObjLines lines_;
  std::map<std::string, std::shared_ptr<const Picture>>* pictures_;
};

}  // namespace

MeshMaterials read_obj_materials(const std::filesystem::path& path, LogSink*) {
  MeshMaterials all;
  all.says_coding = false;
  const std::vector<NamedLibrary> libraries = libraries_of(path);
  if (libraries.empty())
    throw InputError(format("{}: the file names no material library (mtllib)", path.string()),
                     {path.string(), 0, 0});
  std::map<std::string, std::shared_ptr<const Picture>> pictures;
  std::vector<std::filesystem::path> files;
  for (const NamedLibrary& library : libraries) {
    all.source += (all.source.empty() ? "" : ", ") + library.name;
    Library(path, library.path, &pictures).read(all.materials, files);
  }
  return all;
}

std::vector<std::filesystem::path> obj_material_files(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files;
  try {
    for (const NamedLibrary& library : libraries_of(path)) {
      if (!input_exists(library.path)) continue;
      files.push_back(library.path);
      std::vector<FileMaterial> materials;
      std::vector<std::filesystem::path> pictures;
      Library(path, library.path, nullptr).read(materials, pictures);
      std::copy_if(pictures.begin(), pictures.end(), std::back_inserter(files),
                   [](const auto& file) { return input_exists(file); });
    }
  } catch (const InputError&) {
  } catch (const SystemError&) {
  }
  return files;
}

}  // namespace ifov::io
