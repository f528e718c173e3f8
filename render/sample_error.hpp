// How far the mean of a picture's samples may be from what more of them would give.
#pragma once

#include <glm/vec4.hpp>
#include <span>

namespace render {

// Standard error of the pixels' mean luminance, rms over the picture, from what shaders/samples.comp.glsl sums: r, g,
// b, and the luminance of even samples less that of odd ones. Within a sequence samples are not independent (their
// spread would overstate the error many times), but the two sequences are: half of the difference of their means is an
// estimate of the error, good to a few percent over thousands of pixels though no pixel's own is worth much. It holds
// once both sequences have reached the whole pupil, from kEvenSamples on (sample_pattern.h); after one sample it is the
// luminance itself.
[[nodiscard]] double rms_standard_error(std::span<const glm::vec4> sums, int samples);

}  // namespace render
