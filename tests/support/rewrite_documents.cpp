// Reads documents and writes each anew: rewrite_documents OUTPUT FILE... leaves OUTPUT/<n>.json (what differs from the
// defaults), OUTPUT/<n>.again.json (that, read and written once more) and OUTPUT/<n>.all.json (all keys), and a line for each
// file: "written", or "refused" with the message.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"
#include "io/document/document.h"

int main(int count, char** words) {
  using namespace ifov;
  namespace fs = std::filesystem;
  const auto put = [](const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
  };
  for (int k = 2; k < count; ++k) {
    const std::string file = words[k];
    const fs::path to = fs::path(words[1]) / std::to_string(k - 2);
    try {
      const io::Document document = io::read_document(file);
      const std::string text = io::document_text(document, file);
      put(to.string() + ".json", text);
      const io::Document again = io::parse_document(text, file);
      put(to.string() + ".again.json", io::document_text(again, file));
      const std::string all = io::document_text(document, file, {.all_keys = true});
      put(to.string() + ".all.json", all);
      put(to.string() + ".from_all.json", io::document_text(io::parse_document(all, file), file));
      std::printf("written\n");
    } catch (const std::exception& error) {
      std::string message = error.what();
      for (char& c : message)
        if (c == '\n') c = ' ';
      std::printf("refused %s\n", message.c_str());
    }
  }
  return 0;
}
