#include "io/mesh/obj_materials.h"

#include <algorithm>
#include <array>
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
        opacity_picture(*now, files);
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

  /// A picture as a line names it.
  struct Named {
    std::shared_ptr<const Picture> picture;  ///< null where pictures are not read
    std::string name;
    std::array<Wrap, 2> wrap{Wrap::repeat, Wrap::repeat};
    char channel = '\0';  ///< of -imfchan; '\0': not told
  };

  void picture(FileMaterial& material, std::vector<std::filesystem::path>& files) {
    Named named = named_picture(files, false);
    material.picture = std::move(named.picture);
    material.picture_name = std::move(named.name);
    material.wrap = named.wrap;
  }

  /// Opacity is what the picture's matte (alpha) says where it has one, else how bright it is.
  void opacity_picture(FileMaterial& material, std::vector<std::filesystem::path>& files) {
    const Named named = named_picture(files, true);
    material.alpha = AlphaMode::blend;
    material.opacity_name = named.name;
    material.opacity_wrap = named.wrap;
    if (!named.picture) return;
    const char channel = named.channel != '\0' ? named.channel : named.picture->has_alpha ? 'm' : 'l';
    auto opacity = std::make_shared<Picture>(*named.picture);
    opacity->has_alpha = true;
    for (std::uint32_t& cell : opacity->cells) {
      const std::uint32_t red = cell & 255u, green = cell >> 8 & 255u, blue = cell >> 16 & 255u;
      // Luminance of Rec. 709, of the numbers as they are written: of a grey picture these.
      const std::uint32_t opaque = channel == 'm'   ? cell >> 24
                                   : channel == 'r' ? red
                                   : channel == 'g' ? green
                                   : channel == 'b'
                                       ? blue
                                       : (2126u * red + 7152u * green + 722u * blue + 5000u) / 10000u;
      cell = (cell & 0xffffffu) | opaque << 24;
    }
    material.opacity_picture = std::move(opacity);
  }

  Named named_picture(std::vector<std::filesystem::path>& files, bool has_channel) {
    Named named;
    ObjWord word = lines_.word();
    for (; word.text.starts_with('-'); word = lines_.word()) {
      const ObjWord option = word;
      if (option.text == "-clamp") {
        if (lines_.word().text == "on") named.wrap = {Wrap::edge, Wrap::edge};
      } else if (option.text == "-blendu" || option.text == "-blendv" || option.text == "-cc") {
        lines_.word();
      } else if (has_channel && option.text == "-imfchan") {
        const ObjWord channel = lines_.word();
        if (channel.text.size() != 1 ||
            std::string_view("rgbml").find(channel.text[0]) == std::string_view::npos)
          lines_.fail(channel.column,
                      format("the channel '{}' of a picture is not read; expected 'r', 'g', 'b', 'm' or 'l'",
                             channel.text));
        named.channel = channel.text[0];
      } else {
        lines_.fail(
            option.column,
            format("the option '{}' of a picture is not read; expected '-clamp', '-blendu', '-blendv'{} or "
                   "'-cc'",
                   option.text, has_channel ? ", '-imfchan'" : ""));
      }
    }
    if (word.text.empty()) lines_.fail(word.column, "a picture needs the name of its file");
    named.name = std::string(word.text);
    if (const std::string_view more = lines_.rest(); !more.empty())
      named.name = std::string(word.text.data(),
                               static_cast<std::size_t>(more.data() + more.size() - word.text.data()));
    std::filesystem::path file;
    try {
      file = file_beside_mesh(mesh_, named.name, "image");
    } catch (const InputError& error) {
      lines_.fail(word.column, error.what());
    }
    files.push_back(file);
    if (pictures_ == nullptr) return named;
    std::shared_ptr<const Picture>& known = (*pictures_)[file.string()];
    try {
      if (!known) known = std::make_shared<const Picture>(decode_picture(read_input(file), file.string()));
    } catch (const InputError& error) {
      lines_.fail(word.column, error.what());
    } catch (const SystemError& error) {
      lines_.fail(word.column, error.what());
    }
    named.picture = known;
    return named;
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
