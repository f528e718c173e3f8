// The paper's Figures 1, 4, 5 and 6 with our lenses and scenes.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace app {

struct FigureOptions {
  std::filesystem::path folder;
  std::string scene;  // of Figures 1 and 5; 4 looks at the sky, 6 at the built-in reading room's text
  std::string device;
};

// Returns the files written; progress hears the name of each before it is drawn.
std::vector<std::string> write_figures(const FigureOptions& options,
                                       const std::function<void(const std::string& name)>& progress);

}  // namespace app
