// OpenXR's chains of structures: finding one, and hiding those that whoever comes next does not know.
#pragma once

#include "xr/openxr_compat.hpp"

#include <initializer_list>
#include <utility>
#include <vector>

namespace xr::layer {

template <class Structure>
[[nodiscard]] Structure* find_structure(void* chain, XrStructureType type) {
  for (auto* at = static_cast<XrBaseOutStructure*>(chain); at; at = at->next) {
    if (at->type == type) {
      return reinterpret_cast<Structure*>(at);
    }
  }
  return nullptr;
}

// Takes structures of some types out of an output chain while it lives, and puts them back where they were.
class HiddenStructures {
 public:
  HiddenStructures(void* structure, std::initializer_list<XrStructureType> hidden) {
    for (auto* at = static_cast<XrBaseOutStructure*>(structure); at; at = at->next) {
      auto* const original = at->next;
      while (at->next && is_one_of(at->next->type, hidden)) {
        at->next = at->next->next;
      }
      if (at->next != original) {
        relink_.emplace_back(at, original);
      }
    }
  }
  ~HiddenStructures() {
    for (const auto& [at, next] : relink_) {
      at->next = next;
    }
  }
  HiddenStructures(const HiddenStructures&) = delete;
  HiddenStructures& operator=(const HiddenStructures&) = delete;

 private:
  static bool is_one_of(XrStructureType type, std::initializer_list<XrStructureType> types) {
    for (const XrStructureType t : types) {
      if (t == type) {
        return true;
      }
    }
    return false;
  }

  std::vector<std::pair<XrBaseOutStructure*, XrBaseOutStructure*>> relink_;
};

}  // namespace xr::layer
