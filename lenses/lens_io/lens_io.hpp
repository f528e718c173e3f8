// Readers and writers of the JSON files that describe lenses, spectacles, wearers and headsets. Readers are strict:
// whatever they do not understand is a tracking::InputError with the file, the field's dotted path and what is allowed.
// A reader's result always reads back equal (to rounding) from what the writer makes of it.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "lenses/headset.hpp"
#include "lenses/lens.hpp"

namespace lenses {

[[nodiscard]] Lens read_lens(const std::string& path);
[[nodiscard]] Spectacles read_spectacles(const std::string& path);
// A file that is only an outline: {"polygon_mm": [[x, y], ...]}, metres out.
[[nodiscard]] std::vector<glm::dvec2> read_outline(const std::string& path);
[[nodiscard]] Wearer read_wearer(const std::string& path);
[[nodiscard]] HeadsetDisplay read_headset(const std::string& path);

// The same from text in memory; `file` is the name that errors carry.
[[nodiscard]] Lens parse_lens(std::string_view text, const std::string& file);
[[nodiscard]] Spectacles parse_spectacles(std::string_view text, const std::string& file);
[[nodiscard]] Wearer parse_wearer(std::string_view text, const std::string& file);
[[nodiscard]] HeadsetDisplay parse_headset(std::string_view text, const std::string& file);

// Throw std::invalid_argument when a number is not finite: JSON has no text for it.
[[nodiscard]] std::string to_json(const Lens& lens);
[[nodiscard]] std::string to_json(const Spectacles& spectacles);
[[nodiscard]] std::string to_json(const Wearer& wearer);
[[nodiscard]] std::string to_json(const HeadsetDisplay& headset);

}  // namespace lenses
