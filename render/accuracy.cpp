#include "render/accuracy.hpp"

#include <stdexcept>

namespace render {

void LensAccuracy::validate() const {
  const auto refuse = [](const char* what) { throw std::invalid_argument(what); };
  if (form == LensForm::mesh && facets < 8) refuse("a mesh of the lens has 8 facets or more");
  if (form == LensForm::field && field_side < 2) refuse("a field of lens rays has 2 along each side or more");
  if (iterations < 0 || iterations > 8) refuse("surface iterations are 0 to 8");
  if (spacing < 1) refuse("lens rays are 1 pixel apart or more");
  if (form != LensForm::exact && (spacing > 1 || in_double)) refuse("only the exact lens is spaced out or in double");
  if (spacing > 1 && in_double) refuse("lens rays are spaced out or in double, not both");
}

}  // namespace render
