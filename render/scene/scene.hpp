// A static scene as the tracer needs it: one list of world-space triangles, materials, textures, lights and named
// targets. Metres; radiance is linear and unclamped.
#pragma once

#include <cstdint>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tracking/stereo_view.hpp"

namespace render {

struct Vertex {
  glm::vec3 position;  // m, world
  glm::vec3 normal;    // unit, world
  glm::vec2 uv;
};

struct Texture {
  enum class Wrap : std::uint32_t { repeat, clamp, mirror };
  std::uint32_t width = 0, height = 0;
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  std::vector<std::uint8_t> rgba;  // as stored in the image, width * height * 4, top row first
};

// A texture as a material uses it: sampled at linear * uv + offset (KHR_texture_transform).
struct TextureUse {
  std::int32_t index = -1;  // into Scene::textures; -1 for none
  int second_uv = 0;        // 1: Scene::second_uvs instead of Vertex::uv
  glm::mat2 linear{1.0F};
  glm::vec2 offset{0.0F};
};

// glTF's metallic-roughness model.
struct Material {
  enum class Alpha : std::uint32_t { opaque, mask, blend };
  std::string name;
  glm::vec4 base_colour{1.0F};     // linear, times the texture and the vertex's colour
  TextureUse base_colour_texture;  // sRGB, with alpha
  glm::vec3 emission{0.0F};        // linear radiance
  TextureUse emission_texture;     // sRGB
  float metallic = 1.0F, roughness = 1.0F;
  TextureUse surface_texture;  // linear: roughness in green, metallic in blue
  TextureUse normal_texture;   // linear
  float normal_scale = 1.0F;
  TextureUse occlusion_texture;  // linear: red
  float occlusion_strength = 1.0F;
  Alpha alpha = Alpha::opaque;
  float alpha_cutoff = 0.5F;  // mask: less is not there
  bool double_sided = false;  // else the back is not seen
  bool unlit = false;         // shows its base colour, whatever the light
};

struct Light {
  enum class Type : std::uint32_t { directional, point, spot };
  Type type = Type::point;
  glm::vec3 colour{1.0F};                    // linear, times intensity
  glm::vec3 position{0.0F};                  // m, world (point, spot)
  glm::vec3 direction{0.0F, -1.0F, 0.0F};    // unit, world, the way the light travels (directional, spot)
  float range = 0.0F;                        // m, 0 = unlimited
  float cos_inner = 1.0F, cos_outer = 0.0F;  // spot
};

// A point that can be looked at by name: a glTF node whose extras hold {"target": true}.
struct Target {
  std::string name;
  glm::dvec3 position;  // m, world
};

// Where a head may start: a glTF camera with its node's name, or its own where the node has none.
struct Camera {
  std::string name;
  tracking::Pose pose;  // world from head
};

// What a ray sees that hits nothing, and the light that comes from everywhere: the asset's
// extras.vergence = {"sky_zenith": [r,g,b], "sky_horizon": [r,g,b], "ambient": [r,g,b]}, linear radiance.
struct Environment {
  glm::vec3 sky_zenith{0.25F, 0.40F, 0.70F}, sky_horizon{0.70F, 0.78F, 0.85F};
  glm::vec3 ambient{0.25F};
};

struct Scene {
  std::string source;  // the file it came from
  std::vector<Vertex> vertices;
  std::vector<glm::vec2> second_uvs;             // one a vertex, or empty: no material uses them
  std::vector<glm::vec4> colours;                // linear, one a vertex, or empty: all white
  std::vector<glm::uvec3> triangles;             // indices into vertices, counter-clockwise front
  std::vector<std::uint32_t> triangle_material;  // one a triangle
  std::vector<Material> materials;               // at least one
  std::vector<Texture> textures;
  std::vector<Light> lights;
  std::vector<Target> targets;
  std::vector<Camera> cameras;
  Environment environment;

  // The first camera's.
  [[nodiscard]] std::optional<tracking::Pose> start_pose() const {
    return cameras.empty() ? std::nullopt : std::optional(cameras.front().pose);
  }
};

// Reads a .gltf or .glb and checks every index, size, type, finiteness and cycle. Throws tracking::InputError{file,
// field (as a dotted path such as meshes[0].primitives[0].indices), reason}. A file with neither lights nor
// extras.vergence gets a sun.
[[nodiscard]] Scene read_gltf(const std::string& path);

}  // namespace render
