#include "render/traversal.hpp"

#include <fstream>
#include <system_error>
#include <vector>

namespace render {
namespace {

constexpr std::size_t kMostLines = 256;  // of a file that is ours

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; lines.size() < kMostLines && std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

constexpr Traversal kKept[] = {Traversal::per_ray, Traversal::tile, Traversal::ray_query};

}  // namespace

std::string TraversalRecord::line(RayKind kind, Traversal traversal) const {
  std::string text = traversal == Traversal::ray_query ? "ray_query "
                     : traversal == Traversal::tile    ? "tile "
                                                       : "per_ray ";
  text += kind == RayKind::bare ? "bare " : "refracted ";
  text += device_;
  return text;
}

std::optional<Traversal> TraversalRecord::find(RayKind kind) const {
  if (file_.empty()) {
    return std::nullopt;
  }
  for (const std::string& text : lines_of(file_)) {
    for (const Traversal traversal : kKept) {
      if (text == line(kind, traversal)) {
        return traversal;
      }
    }
  }
  return std::nullopt;
}

void TraversalRecord::keep(RayKind kind, Traversal traversal) const {
  if (file_.empty()) {
    return;
  }
  std::vector<std::string> lines = lines_of(file_);
  for (const Traversal old : kKept) {
    std::erase(lines, line(kind, old));
  }
  lines.push_back(line(kind, traversal));
  std::filesystem::path draft = file_;
  draft += ".new";
  std::error_code ignored;
  std::filesystem::create_directories(file_.parent_path(), ignored);
  {
    std::ofstream out(draft);
    for (const std::string& text : lines) {
      out << text << '\n';
    }
    out.close();
    if (!out) {
      std::filesystem::remove(draft, ignored);
      return;
    }
  }
  std::filesystem::rename(draft, file_, ignored);
}

}  // namespace render
