#include "studies/common/report_figures.h"

#include <algorithm>
#include <cctype>

#include "core/format.h"
#include "io/report/report_data.h"
#include "studies/common/html_page.h"
#include "studies/common/study_files.h"

namespace ifov::studies {
namespace {

/// "Error against cost" as error_against_cost.
std::string file_name_of(const std::string& title) {
  constexpr std::size_t kMost = 60;
  std::string name;
  for (const char c : title) {
    if (name.size() >= kMost) break;
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  if (name.size() >= kMost) name.resize(std::min(name.rfind('_'), name.size()));  // whole words
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name.empty() ? "figure" : name;
}

}  // namespace

std::string ReportFigures::add(const std::string& title, DrawnFigure figure) {
  const std::string name = file_name_of(title);
  std::string free = name;
  for (int number = 2; std::any_of(kept_.begin(), kept_.end(), [&](const Kept& k) { return k.name == free; });
       ++number)
    free = format("{}_{}", name, number);
  // As an image of its own: the names inside one SVG must not meet those of another.
  std::string element = format("<img alt=\"{}\" src=\"data:image/svg+xml;base64,{}\">", html_text(title),
                               io::base64(figure.svg));
  kept_.push_back({free, std::move(figure)});
  return element;
}

std::vector<std::filesystem::path> ReportFigures::write(const std::filesystem::path& folder) const {
  std::vector<std::filesystem::path> files;
  if (kept_.empty()) return files;
  make_folder(folder / "figures");
  for (const auto& [name, figure] : kept_)
    for (const auto& [ending, bytes] :
         {std::pair<const char*, const std::string&>{".svg", figure.svg}, {".pdf", figure.pdf}}) {
      files.push_back(folder / "figures" / (name + ending));
      write_file(files.back(), bytes);
    }
  return files;
}

}  // namespace ifov::studies
