// What reports share of HTML.
#pragma once

#include <string>

namespace app {

// Text as it stands in a page.
[[nodiscard]] std::string html_escaped(const std::string& text);

// A whole page; the title is text, the body HTML.
[[nodiscard]] std::string html_page(const std::string& title, const std::string& body);

}  // namespace app
