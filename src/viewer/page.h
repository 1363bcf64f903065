#pragma once

#include <string_view>

namespace ifov::viewer {

/// A file of the page, web/ of the sources, which is compiled in.
struct PageFile {
  std::string_view path, type, content;
};

/// Null where the page has no such file; "/" is index.html.
const PageFile* page_file(std::string_view path);

}  // namespace ifov::viewer
