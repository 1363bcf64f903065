#pragma once

#include <string>
#include <string_view>

namespace ifov::studies {

/// Text with the characters that HTML reserves replaced.
std::string html_text(std::string_view text);

/// One self-contained page: title, style sheet and body.
std::string html_page(std::string_view title, std::string_view body);

}  // namespace ifov::studies
