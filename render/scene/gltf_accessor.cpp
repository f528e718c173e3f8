#include "render/scene/gltf_accessor.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>

namespace render {
namespace {

// No data stand behind an accessor without a buffer view (zeros, or sparse), so a small file could ask for anything.
constexpr std::size_t kMostZeros = std::size_t{1} << 24;
// In all primitives together, seconds of work; far beyond what a scene of the allowed size needs.
constexpr std::size_t kMostDecoded = std::size_t{1} << 28;

template <typename T>
T load(const std::uint8_t* p) {
  T value;
  std::memcpy(&value, p, sizeof(T));
  return value;
}

std::size_t component_size(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

// glTF 2.0, section 3.11 (animations) has the same rule for normalised integers: signed ones stop at -1.
float load_float(const std::uint8_t* p, int type, bool normalised) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const auto value = static_cast<float>(load<std::int8_t>(p));
      return normalised ? std::max(value / 127.0F, -1.0F) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
      const auto value = static_cast<float>(load<std::uint8_t>(p));
      return normalised ? value / 255.0F : value;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const auto value = static_cast<float>(load<std::int16_t>(p));
      return normalised ? std::max(value / 32767.0F, -1.0F) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
      const auto value = static_cast<float>(load<std::uint16_t>(p));
      return normalised ? value / 65535.0F : value;
    }
    default:
      return load<float>(p);
  }
}

std::uint32_t load_index(const std::uint8_t* p, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(p);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(p);
    default:
      return load<std::uint32_t>(p);
  }
}

bool is_index_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

// Equally spaced elements inside a buffer view; data is null for an accessor of zeros.
struct Elements {
  const std::uint8_t* data = nullptr;
  std::size_t stride = 0, count = 0;

  [[nodiscard]] const std::uint8_t* operator[](std::size_t i) const { return data + i * stride; }
};

Elements elements(const GltfDocument& document, const std::string& field, int buffer_view, std::size_t offset,
                  std::size_t stride, std::size_t count, std::size_t size) {
  const auto bytes = document.view_bytes(buffer_view);
  if (stride == 0) stride = size;
  // Below 2^31 each (the shape check), so the product fits 64 bits.
  const std::size_t end = offset + (count - 1) * stride + size;
  if (stride < size || end > bytes.size()) {
    document.fail(field, std::to_string(count) + " elements of " + std::to_string(size) + " bytes every " +
                             std::to_string(stride) + " from byte " + std::to_string(offset) + " need " +
                             std::to_string(end) + " bytes; bufferViews[" + std::to_string(buffer_view) + "] has " +
                             std::to_string(bytes.size()) + ", and elements may not overlap");
  }
  return {bytes.data() + offset, stride, count};
}

void count_decoded(const GltfDocument& document, std::size_t count, const std::string& field) {
  document.decoded += count;
  if (document.decoded > kMostDecoded) {
    document.fail(field, "brings the elements read to " + std::to_string(document.decoded) +
                             "; 268435456 are allowed in all primitives together");
  }
}

Elements accessor_elements(const GltfDocument& document, const tinygltf::Accessor& accessor, const std::string& field,
                           std::size_t size) {
  if (accessor.count == 0) document.fail(field, "has no elements; at least 1 is required");
  if (accessor.bufferView < 0) {
    if (accessor.count > kMostZeros) {
      document.fail(field,
                    std::to_string(accessor.count) + " elements without a buffer view; at most 16777216 are allowed");
    }
    count_decoded(document, accessor.count, field);
    return {nullptr, size, accessor.count};
  }
  const auto view = static_cast<std::size_t>(accessor.bufferView);
  const Elements result = elements(document, field, accessor.bufferView, accessor.byteOffset,
                                   document.model.bufferViews[view].byteStride, accessor.count, size);
  count_decoded(document, accessor.count, field);
  return result;
}

// Calls replace(element, bytes) for each element that the sparse part replaces.
template <typename Replace>
void read_sparse(const GltfDocument& document, const tinygltf::Accessor& accessor, const std::string& field,
                 std::size_t size, Replace&& replace) {
  if (!accessor.sparse.isSparse) return;
  const auto& sparse = accessor.sparse;
  const auto count = static_cast<std::size_t>(sparse.count);
  if (count == 0 || count > accessor.count) {
    document.fail(field, "replaces " + std::to_string(count) + " elements (sparse.count); 1 to " +
                             std::to_string(accessor.count) + " are allowed");
  }
  if (!is_index_type(sparse.indices.componentType)) {
    document.fail(field, "sparse.indices.componentType is " + std::to_string(sparse.indices.componentType) +
                             "; 5121, 5123 and 5125 are allowed");
  }
  const Elements places =
      elements(document, field, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), 0,
               count, component_size(sparse.indices.componentType));
  const Elements values = elements(document, field, sparse.values.bufferView,
                                   static_cast<std::size_t>(sparse.values.byteOffset), 0, count, size);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = load_index(places[i], sparse.indices.componentType);
    if (place >= accessor.count) {
      document.fail(field, "sparse index " + std::to_string(place) + " at element " + std::to_string(i) + "; 0 to " +
                               std::to_string(accessor.count - 1) + " are allowed");
    }
    replace(place, values[i]);
  }
}

const tinygltf::Accessor& accessor_of_type(const GltfDocument& document, int index, const std::string& field, int type,
                                           const char* name) {
  const tinygltf::Accessor& accessor = document.model.accessors.at(static_cast<std::size_t>(index));
  if (accessor.type != type)
    document.fail(field, std::string("its accessor has another type; ") + name + " is allowed");
  return accessor;
}

template <typename Vector>
std::vector<Vector> read_vectors(const GltfDocument& document, const tinygltf::Accessor& accessor,
                                 const std::string& field) {
  const std::size_t step = component_size(accessor.componentType);
  const std::size_t size = step * static_cast<std::size_t>(Vector::length());
  const Elements source = accessor_elements(document, accessor, field, size);
  std::vector<Vector> result(source.count, Vector(0.0F));
  const auto store = [&](std::size_t i, const std::uint8_t* bytes) {
    for (int axis = 0; axis < Vector::length(); ++axis) {
      const float value =
          load_float(bytes + step * static_cast<std::size_t>(axis), accessor.componentType, accessor.normalized);
      if (!std::isfinite(value)) {
        document.fail(field, "element " + std::to_string(i) + " is not finite; finite numbers are allowed");
      }
      result[i][axis] = value;
    }
  };
  for (std::size_t i = 0; source.data != nullptr && i < source.count; ++i) store(i, source[i]);
  read_sparse(document, accessor, field, size, store);
  return result;
}

}  // namespace

std::vector<glm::vec3> read_vec3(const GltfDocument& document, int index, const std::string& field) {
  const tinygltf::Accessor& accessor = accessor_of_type(document, index, field, TINYGLTF_TYPE_VEC3, "VEC3");
  const int type = accessor.componentType;
  const bool integer = component_size(type) != 0 && type != TINYGLTF_COMPONENT_TYPE_FLOAT &&
                       type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (type != TINYGLTF_COMPONENT_TYPE_FLOAT && !(integer && document.uses("KHR_mesh_quantization"))) {
    document.fail(field, "has component type " + std::to_string(type) +
                             "; 5126 (float) is allowed, and 8- or 16-bit integers with KHR_mesh_quantization");
  }
  return read_vectors<glm::vec3>(document, accessor, field);
}

std::vector<glm::vec2> read_texture_coordinates(const GltfDocument& document, int index, const std::string& field) {
  const tinygltf::Accessor& accessor = accessor_of_type(document, index, field, TINYGLTF_TYPE_VEC2, "VEC2");
  const int type = accessor.componentType;
  const bool small = component_size(type) == 1 || component_size(type) == 2;
  const bool plain = type == TINYGLTF_COMPONENT_TYPE_FLOAT ||
                     (accessor.normalized && (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                              type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT));
  if (!plain && !(small && document.uses("KHR_mesh_quantization"))) {
    document.fail(field, "has component type " + std::to_string(type) +
                             "; 5126 (float) and normalised 5121 and 5123 are allowed, and other 8- or 16-bit "
                             "integers with KHR_mesh_quantization");
  }
  return read_vectors<glm::vec2>(document, accessor, field);
}

std::vector<glm::vec4> read_colours(const GltfDocument& document, int index, const std::string& field) {
  const tinygltf::Accessor& accessor = document.model.accessors.at(static_cast<std::size_t>(index));
  const int type = accessor.componentType;
  const bool whole = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  if (type != TINYGLTF_COMPONENT_TYPE_FLOAT && !(whole && accessor.normalized)) {
    document.fail(field, "has component type " + std::to_string(type) +
                             "; 5126 (float) and normalised 5121 and 5123 are allowed");
  }
  std::vector<glm::vec4> colours;
  if (accessor.type == TINYGLTF_TYPE_VEC3) {
    for (const glm::vec3& c : read_vectors<glm::vec3>(document, accessor, field)) colours.emplace_back(c, 1.0F);
  } else if (accessor.type == TINYGLTF_TYPE_VEC4) {
    colours = read_vectors<glm::vec4>(document, accessor, field);
  } else {
    document.fail(field, "its accessor has another type; VEC3 and VEC4 are allowed");
  }
  for (glm::vec4& c : colours) c = glm::clamp(c, 0.0F, 1.0F);
  return colours;
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, int index, const std::string& field,
                                        std::size_t vertices) {
  const tinygltf::Accessor& accessor = accessor_of_type(document, index, field, TINYGLTF_TYPE_SCALAR, "SCALAR");
  if (!is_index_type(accessor.componentType)) {
    document.fail(field, "has component type " + std::to_string(accessor.componentType) +
                             "; 5121, 5123 and 5125 (unsigned integers) are allowed");
  }
  const std::size_t size = component_size(accessor.componentType);
  const Elements source = accessor_elements(document, accessor, field, size);
  std::vector<std::uint32_t> result(source.count, 0);
  const auto store = [&](std::size_t i, const std::uint8_t* bytes) {
    result[i] = load_index(bytes, accessor.componentType);
  };
  for (std::size_t i = 0; source.data != nullptr && i < source.count; ++i) store(i, source[i]);
  read_sparse(document, accessor, field, size, store);
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (result[i] >= vertices) {
      document.fail(field, "index " + std::to_string(result[i]) + " at element " + std::to_string(i) +
                               "; the primitive has " + std::to_string(vertices) + " vertices, 0 to " +
                               std::to_string(vertices - 1) + " are allowed");
    }
  }
  return result;
}

}  // namespace render
