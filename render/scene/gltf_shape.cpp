#include "render/scene/gltf_shape.hpp"

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>

#include "tracking/input_error.hpp"

namespace render {
namespace {

using nlohmann::json;

enum class Kind { object, objects, string, strings, boolean, natural, number, numbers, index, indices, index_map };

struct Field {
  const char* name;
  Kind kind;
  bool required = false;
  const char* list = nullptr;          // JSON pointer of what an index counts
  std::size_t length = 0;              // of numbers
  std::span<const Field> fields = {};  // of object and objects
};

constexpr const char* kLights = "/extensions/KHR_lights_punctual/lights";

constexpr Field kTextureTransform[] = {{.name = "offset", .kind = Kind::numbers, .length = 2},
                                       {.name = "rotation", .kind = Kind::number},
                                       {.name = "scale", .kind = Kind::numbers, .length = 2},
                                       {.name = "texCoord", .kind = Kind::natural}};
constexpr Field kTextureExtensions[] = {
    {.name = "KHR_texture_transform", .kind = Kind::object, .fields = kTextureTransform}};
constexpr Field kTextureInfo[] = {{.name = "index", .kind = Kind::index, .required = true, .list = "/textures"},
                                  {.name = "texCoord", .kind = Kind::natural},
                                  {.name = "extensions", .kind = Kind::object, .fields = kTextureExtensions}};
constexpr Field kNormalTexture[] = {{.name = "index", .kind = Kind::index, .required = true, .list = "/textures"},
                                    {.name = "texCoord", .kind = Kind::natural},
                                    {.name = "scale", .kind = Kind::number},
                                    {.name = "extensions", .kind = Kind::object, .fields = kTextureExtensions}};
constexpr Field kOcclusionTexture[] = {{.name = "index", .kind = Kind::index, .required = true, .list = "/textures"},
                                       {.name = "texCoord", .kind = Kind::natural},
                                       {.name = "strength", .kind = Kind::number},
                                       {.name = "extensions", .kind = Kind::object, .fields = kTextureExtensions}};
constexpr Field kPbr[] = {{.name = "baseColorFactor", .kind = Kind::numbers, .length = 4},
                          {.name = "baseColorTexture", .kind = Kind::object, .fields = kTextureInfo},
                          {.name = "metallicFactor", .kind = Kind::number},
                          {.name = "roughnessFactor", .kind = Kind::number},
                          {.name = "metallicRoughnessTexture", .kind = Kind::object, .fields = kTextureInfo}};
constexpr Field kEmissiveStrength[] = {{.name = "emissiveStrength", .kind = Kind::number}};
constexpr Field kMaterialExtensions[] = {
    {.name = "KHR_materials_emissive_strength", .kind = Kind::object, .fields = kEmissiveStrength},
    {.name = "KHR_materials_unlit", .kind = Kind::object}};
constexpr Field kMaterial[] = {{.name = "name", .kind = Kind::string},
                               {.name = "doubleSided", .kind = Kind::boolean},
                               {.name = "pbrMetallicRoughness", .kind = Kind::object, .fields = kPbr},
                               {.name = "emissiveFactor", .kind = Kind::numbers, .length = 3},
                               {.name = "emissiveTexture", .kind = Kind::object, .fields = kTextureInfo},
                               {.name = "normalTexture", .kind = Kind::object, .fields = kNormalTexture},
                               {.name = "occlusionTexture", .kind = Kind::object, .fields = kOcclusionTexture},
                               {.name = "alphaMode", .kind = Kind::string},
                               {.name = "alphaCutoff", .kind = Kind::number},
                               {.name = "extensions", .kind = Kind::object, .fields = kMaterialExtensions}};

constexpr Field kBuffer[] = {{.name = "byteLength", .kind = Kind::natural, .required = true},
                             {.name = "uri", .kind = Kind::string}};
constexpr Field kBufferView[] = {{.name = "buffer", .kind = Kind::index, .required = true, .list = "/buffers"},
                                 {.name = "byteOffset", .kind = Kind::natural},
                                 {.name = "byteLength", .kind = Kind::natural, .required = true},
                                 {.name = "byteStride", .kind = Kind::natural}};
constexpr Field kSparseIndices[] = {
    {.name = "bufferView", .kind = Kind::index, .required = true, .list = "/bufferViews"},
    {.name = "byteOffset", .kind = Kind::natural},
    {.name = "componentType", .kind = Kind::natural, .required = true}};
constexpr Field kSparseValues[] = {
    {.name = "bufferView", .kind = Kind::index, .required = true, .list = "/bufferViews"},
    {.name = "byteOffset", .kind = Kind::natural}};
constexpr Field kSparse[] = {{.name = "count", .kind = Kind::natural, .required = true},
                             {.name = "indices", .kind = Kind::object, .required = true, .fields = kSparseIndices},
                             {.name = "values", .kind = Kind::object, .required = true, .fields = kSparseValues}};
constexpr Field kAccessor[] = {{.name = "bufferView", .kind = Kind::index, .list = "/bufferViews"},
                               {.name = "byteOffset", .kind = Kind::natural},
                               {.name = "componentType", .kind = Kind::natural, .required = true},
                               {.name = "normalized", .kind = Kind::boolean},
                               {.name = "count", .kind = Kind::natural, .required = true},
                               {.name = "type", .kind = Kind::string, .required = true},
                               {.name = "sparse", .kind = Kind::object, .fields = kSparse}};

constexpr Field kPrimitive[] = {{.name = "attributes", .kind = Kind::index_map, .required = true, .list = "/accessors"},
                                {.name = "indices", .kind = Kind::index, .list = "/accessors"},
                                {.name = "material", .kind = Kind::index, .list = "/materials"},
                                {.name = "mode", .kind = Kind::natural}};
constexpr Field kMesh[] = {{.name = "primitives", .kind = Kind::objects, .required = true, .fields = kPrimitive}};

constexpr Field kNodeLight[] = {{.name = "light", .kind = Kind::index, .required = true, .list = kLights}};
constexpr Field kNodeExtensions[] = {{.name = "KHR_lights_punctual", .kind = Kind::object, .fields = kNodeLight}};
constexpr Field kNode[] = {{.name = "name", .kind = Kind::string},
                           {.name = "mesh", .kind = Kind::index, .list = "/meshes"},
                           {.name = "camera", .kind = Kind::index, .list = "/cameras"},
                           {.name = "children", .kind = Kind::indices, .list = "/nodes"},
                           {.name = "matrix", .kind = Kind::numbers, .length = 16},
                           {.name = "rotation", .kind = Kind::numbers, .length = 4},
                           {.name = "translation", .kind = Kind::numbers, .length = 3},
                           {.name = "scale", .kind = Kind::numbers, .length = 3},
                           {.name = "extensions", .kind = Kind::object, .fields = kNodeExtensions}};
constexpr Field kScene[] = {{.name = "nodes", .kind = Kind::indices, .list = "/nodes"}};

constexpr Field kSpot[] = {{.name = "innerConeAngle", .kind = Kind::number},
                           {.name = "outerConeAngle", .kind = Kind::number}};
constexpr Field kLight[] = {{.name = "type", .kind = Kind::string, .required = true},
                            {.name = "color", .kind = Kind::numbers, .length = 3},
                            {.name = "intensity", .kind = Kind::number},
                            {.name = "range", .kind = Kind::number},
                            {.name = "spot", .kind = Kind::object, .fields = kSpot}};
constexpr Field kPunctual[] = {{.name = "lights", .kind = Kind::objects, .fields = kLight}};
constexpr Field kExtensions[] = {{.name = "KHR_lights_punctual", .kind = Kind::object, .fields = kPunctual}};

constexpr Field kEnvironment[] = {{.name = "sky_zenith", .kind = Kind::numbers, .length = 3},
                                  {.name = "sky_horizon", .kind = Kind::numbers, .length = 3},
                                  {.name = "ambient", .kind = Kind::numbers, .length = 3}};
constexpr Field kAssetExtras[] = {{.name = "vergence", .kind = Kind::object, .fields = kEnvironment}};
constexpr Field kAsset[] = {{.name = "version", .kind = Kind::string, .required = true}};

constexpr Field kImage[] = {{.name = "uri", .kind = Kind::string},
                            {.name = "bufferView", .kind = Kind::index, .list = "/bufferViews"},
                            {.name = "mimeType", .kind = Kind::string}};
constexpr Field kSampler[] = {{.name = "wrapS", .kind = Kind::natural}, {.name = "wrapT", .kind = Kind::natural}};
constexpr Field kTexture[] = {{.name = "source", .kind = Kind::index, .list = "/images"},
                              {.name = "sampler", .kind = Kind::index, .list = "/samplers"}};
constexpr Field kCamera[] = {{.name = "name", .kind = Kind::string}};

constexpr Field kRoot[] = {{.name = "asset", .kind = Kind::object, .required = true, .fields = kAsset},
                           {.name = "extensionsUsed", .kind = Kind::strings},
                           {.name = "extensionsRequired", .kind = Kind::strings},
                           {.name = "buffers", .kind = Kind::objects, .fields = kBuffer},
                           {.name = "bufferViews", .kind = Kind::objects, .fields = kBufferView},
                           {.name = "accessors", .kind = Kind::objects, .fields = kAccessor},
                           {.name = "images", .kind = Kind::objects, .fields = kImage},
                           {.name = "samplers", .kind = Kind::objects, .fields = kSampler},
                           {.name = "textures", .kind = Kind::objects, .fields = kTexture},
                           {.name = "materials", .kind = Kind::objects, .fields = kMaterial},
                           {.name = "meshes", .kind = Kind::objects, .fields = kMesh},
                           {.name = "cameras", .kind = Kind::objects, .fields = kCamera},
                           {.name = "nodes", .kind = Kind::objects, .fields = kNode},
                           {.name = "scenes", .kind = Kind::objects, .fields = kScene},
                           {.name = "scene", .kind = Kind::index, .list = "/scenes"},
                           {.name = "extensions", .kind = Kind::object, .fields = kExtensions}};

constexpr std::uint64_t kLargestNatural = 2147483647;  // tinygltf keeps most of them in an int

class Checker {
 public:
  Checker(const json& root, const std::string& file) : root_(root), file_(file) {}

  void object(const json& value, const std::string& path, std::span<const Field> fields) const {
    if (!value.is_object()) wrong_type(value, path, "an object");
    for (const Field& field : fields) {
      const std::string inner = path.empty() ? field.name : path + "." + field.name;
      const auto found = value.find(field.name);
      if (found != value.end()) {
        check(*found, inner, field);
      } else if (field.required) {
        fail(inner, "is missing; it is required");
      }
    }
  }

 private:
  [[noreturn]] void fail(const std::string& path, const std::string& reason) const {
    throw tracking::InputError(file_, path, reason);
  }

  [[noreturn]] void wrong_type(const json& value, const std::string& path, const std::string& allowed) const {
    fail(path, std::string("is of type ") + value.type_name() + "; " + allowed + " is allowed");
  }

  void check(const json& value, const std::string& path, const Field& field) const {
    switch (field.kind) {
      case Kind::object:
        return object(value, path, field.fields);
      case Kind::objects:
        return each(value, path, [&](const json& v, const std::string& p) { object(v, p, field.fields); });
      case Kind::string:
        return string(value, path);
      case Kind::strings:
        return each(value, path, [&](const json& v, const std::string& p) { string(v, p); });
      case Kind::boolean:
        if (!value.is_boolean()) wrong_type(value, path, "true or false");
        return;
      case Kind::natural:
        (void)natural(value, path);
        return;
      case Kind::number:
        return number(value, path);
      case Kind::numbers:
        return numbers(value, path, field.length);
      case Kind::index:
        return index(value, path, field.list);
      case Kind::indices:
        return each(value, path, [&](const json& v, const std::string& p) { index(v, p, field.list); });
      case Kind::index_map:
        return index_map(value, path, field.list);
    }
  }

  template <typename Each>
  void each(const json& value, const std::string& path, Each&& visit) const {
    if (!value.is_array()) wrong_type(value, path, "an array");
    for (std::size_t i = 0; i < value.size(); ++i) visit(value[i], path + "[" + std::to_string(i) + "]");
  }

  void string(const json& value, const std::string& path) const {
    if (!value.is_string()) wrong_type(value, path, "a string");
  }

  [[nodiscard]] std::uint64_t natural(const json& value, const std::string& path) const {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > kLargestNatural) {
      fail(path, "is " + (value.is_number() ? value.dump() : std::string("of type ") + value.type_name()) +
                     "; a whole number from 0 to 2147483647 is allowed");
    }
    return value.get<std::uint64_t>();
  }

  void number(const json& value, const std::string& path) const {
    if (!value.is_number()) wrong_type(value, path, "a number");
    if (!(std::abs(value.get<double>()) < 1e30)) {
      fail(path, "is " + value.dump() + "; a number of magnitude below 1e30 is allowed");
    }
  }

  void numbers(const json& value, const std::string& path, std::size_t length) const {
    each(value, path, [&](const json& v, const std::string& p) { number(v, p); });
    if (value.size() != length) {
      fail(path, "has " + std::to_string(value.size()) + " numbers; " + std::to_string(length) + " are required");
    }
  }

  void index(const json& value, const std::string& path, const char* list) const {
    const std::uint64_t wanted = natural(value, path);
    const json::json_pointer pointer(list);
    const std::size_t count = root_.contains(pointer) && root_.at(pointer).is_array() ? root_.at(pointer).size() : 0;
    if (wanted >= count) {
      const std::string what = pointer.back();
      fail(path,
           "is " + std::to_string(wanted) + "; the file has " + std::to_string(count) + " " + what +
               (count == 0 ? ", so no index is allowed" : ", 0 to " + std::to_string(count - 1) + " are allowed"));
    }
  }

  void index_map(const json& value, const std::string& path, const char* list) const {
    if (!value.is_object()) wrong_type(value, path, "an object");
    for (const auto& [name, wanted] : value.items()) index(wanted, path + "." + name, list);
  }

  const json& root_;
  const std::string& file_;
};

}  // namespace

void check_gltf_shape(const json& root, const std::string& file) {
  const Checker checker(root, file);
  checker.object(root, "", kRoot);
  const auto extras = root["asset"].find("extras");
  if (extras != root["asset"].end() && extras->is_object()) checker.object(*extras, "asset.extras", kAssetExtras);
}

}  // namespace render
