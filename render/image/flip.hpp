// How different two pictures look to someone who flips between them: FLIP for displays of standard range (Andersson,
// Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild: "FLIP: A Difference Evaluator for Alternating Images", Proc.
// ACM Comput. Graph. Interact. Tech. 3(2), 2020), with the constants published there.
#pragma once

#include <vector>

#include "render/image/image.hpp"

namespace render {

struct Flip {
  double mean = 0.0;
  std::vector<float> map = {};  // one a pixel, 0 (the same) to 1
};

// Images of one size; pixels_per_degree, above 0, of the display at the viewer's distance. Anything else throws
// std::invalid_argument.
[[nodiscard]] Flip flip(const Image8& image, const Image8& reference, double pixels_per_degree);

}  // namespace render
