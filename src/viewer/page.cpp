#include "viewer/page.h"

namespace ifov::data {
extern const std::string_view web_index_html, web_style_css, web_main_js, web_api_js, web_tools_js,
    web_times_js, web_plot_js, web_image_js, web_spectra_js, web_scatter_js, web_points_js, web_run_js,
    web_document_js, web_scene_js;
}

namespace ifov::viewer {

const PageFile* page_file(std::string_view path) {
  constexpr std::string_view kHtml = "text/html; charset=utf-8", kStyle = "text/css; charset=utf-8",
                             kScript = "text/javascript; charset=utf-8";
  static const PageFile kFiles[] = {
      {"/", kHtml, data::web_index_html},
      {"/style.css", kStyle, data::web_style_css},
      {"/main.js", kScript, data::web_main_js},
      {"/api.js", kScript, data::web_api_js},
      {"/tools.js", kScript, data::web_tools_js},
      {"/times.js", kScript, data::web_times_js},
      {"/plot.js", kScript, data::web_plot_js},
      {"/image.js", kScript, data::web_image_js},
      {"/spectra.js", kScript, data::web_spectra_js},
      {"/scatter.js", kScript, data::web_scatter_js},
      {"/points.js", kScript, data::web_points_js},
      {"/run.js", kScript, data::web_run_js},
      {"/document.js", kScript, data::web_document_js},
      {"/scene.js", kScript, data::web_scene_js},
  };
  for (const PageFile& file : kFiles)
    if (file.path == path) return &file;
  return nullptr;
}

}  // namespace ifov::viewer
