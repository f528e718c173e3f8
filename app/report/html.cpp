#include "app/report/html.hpp"

namespace app {

std::string html_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  }
  return out;
}

std::string html_page(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Vergence: " + html_escaped(title) +
         "</title>\n<style>body { font-family: sans-serif; max-width: 115em; margin: 1em auto; padding: 0 1em }\n"
         "table { border-collapse: collapse } td, th { border: 1px solid #bbb; padding: 0.2em 0.7em; "
         "text-align: right }\n.fail { background: #f5c6c6 } figure { display: inline-block; margin: 0.5em }\n"
         "img { max-width: 100% }</style></head>\n<body>\n" +
         body + "</body></html>\n";
}

}  // namespace app
