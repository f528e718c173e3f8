// read_gltf: document -> materials -> nodes -> what hangs on each node.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <set>

#include "render/scene/gltf_document.hpp"
#include "render/scene/gltf_json.hpp"
#include "render/scene/gltf_material.hpp"
#include "render/scene/gltf_mesh.hpp"
#include "render/scene/gltf_nodes.hpp"
#include "render/scene/scene.hpp"

namespace render {
namespace {

// Each is asked for its light at each point that is seen: many more would hold a device up for minutes.
constexpr std::size_t kMostLights = 1024;

// The way a light shines and a camera looks: local -z.
glm::dvec3 forward(const GltfDocument& document, const PlacedNode& node) {
  const glm::dvec3 z(node.world_from_node[2]);
  const double length = glm::length(z);
  if (!(length > 0.0)) {
    document.fail(node.field(), "scales its z axis to nothing; a light or a camera needs a direction");
  }
  return -z / length;
}

// Rotation and translation of the node, without its scale; the z axis is kept, y is made perpendicular to it.
tracking::Pose rigid_pose(const GltfDocument& document, const PlacedNode& node) {
  const glm::dvec3 z = -forward(document, node), y(node.world_from_node[1]);
  const glm::dvec3 x = glm::cross(y, z);
  const double length = glm::length(x);
  if (!(length > 0.0)) document.fail(node.field(), "flattens its axes; a camera needs an upright direction");
  const glm::dvec3 right = x / length;
  return {glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(z, right), z))),
          glm::dvec3(node.world_from_node[3])};
}

void spot_cone(const GltfDocument& document, const tinygltf::SpotLight& spot, const std::string& field, Light& light) {
  if (!(spot.innerConeAngle >= 0.0 && spot.innerConeAngle < spot.outerConeAngle)) {
    document.fail(field + ".spot.innerConeAngle",
                  "is " + std::to_string(spot.innerConeAngle) + "; 0 to less than outerConeAngle is allowed");
  }
  if (!(spot.outerConeAngle <= glm::half_pi<double>() + 1e-6)) {
    document.fail(field + ".spot.outerConeAngle",
                  "is " + std::to_string(spot.outerConeAngle) + "; at most pi/2 is allowed");
  }
  light.cos_inner = static_cast<float>(std::cos(spot.innerConeAngle));
  light.cos_outer = static_cast<float>(std::max(std::cos(spot.outerConeAngle), 0.0));
}

Light read_light(const GltfDocument& document, int index, const PlacedNode& node) {
  const tinygltf::Light& source = document.model.lights.at(static_cast<std::size_t>(index));
  const std::string field = "extensions.KHR_lights_punctual.lights[" + std::to_string(index) + "]";
  Light light;
  if (source.type == "directional") {
    light.type = Light::Type::directional;
  } else if (source.type == "point") {
    light.type = Light::Type::point;
  } else if (source.type == "spot") {
    light.type = Light::Type::spot;
    spot_cone(document, source.spot, field, light);
  } else {
    document.fail(field + ".type", "is another word; directional, point and spot are allowed");
  }
  if (!(source.intensity >= 0.0)) {
    document.fail(field + ".intensity", "is " + std::to_string(source.intensity) + "; 0 or more is allowed");
  }
  if (!(source.range >= 0.0)) {
    document.fail(field + ".range", "is " + std::to_string(source.range) + "; more than 0 is allowed");
  }
  for (int i = 0; i < 3; ++i) {
    const double colour = source.color.empty() ? 1.0 : source.color.at(static_cast<std::size_t>(i));
    if (!(colour >= 0.0)) {
      document.fail(field + ".color[" + std::to_string(i) + "]",
                    "is " + std::to_string(colour) + "; 0 or more is allowed");
    }
    light.colour[i] = static_cast<float>(colour * source.intensity);
    if (!std::isfinite(light.colour[i])) {
      document.fail(field + ".intensity", "is too bright; a colour times intensity below 3e38 is allowed");
    }
  }
  light.range = static_cast<float>(source.range);
  light.position = glm::vec3(node.world_from_node[3]);
  light.direction = glm::vec3(forward(document, node));
  return light;
}

bool is_target(const tinygltf::Node& node) {
  return node.extras.IsObject() && node.extras.Has("target") && node.extras.Get("target").IsBool() &&
         node.extras.Get("target").Get<bool>();
}

// names: of the targets so far.
void read_target(const GltfDocument& document, const PlacedNode& node, std::set<std::string>& names, Scene& scene) {
  const std::string& name = document.model.nodes[static_cast<std::size_t>(node.index)].name;
  if (name.empty()) document.fail(node.field() + ".name", "is missing; a target is looked at by its name");
  if (!names.insert(name).second) {
    document.fail(node.field() + ".name",
                  "is " + one_line(name) + ", as another target's; each target needs its own name");
  }
  scene.targets.push_back({name, glm::dvec3(node.world_from_node[3])});
}

Environment read_environment(const GltfDocument& document) {
  Environment environment;
  const tinygltf::Value& extras = document.model.asset.extras;
  if (!extras.IsObject() || !extras.Has("vergence")) return environment;
  const tinygltf::Value& source = extras.Get("vergence");
  const auto take = [&](const char* name, glm::vec3& colour) {
    if (!source.IsObject() || !source.Has(name)) return;
    for (int i = 0; i < 3; ++i) {
      colour[i] = static_cast<float>(source.Get(name).Get(i).GetNumberAsDouble());
      if (!(colour[i] >= 0.0F)) {
        document.fail("asset.extras.vergence." + std::string(name) + "[" + std::to_string(i) + "]",
                      "is " + std::to_string(colour[i]) + "; a radiance of 0 or more is allowed");
      }
    }
  };
  take("sky_zenith", environment.sky_zenith);
  take("sky_horizon", environment.sky_horizon);
  take("ambient", environment.ambient);
  return environment;
}

// Shapes cannot be told apart by light from everywhere alone: a file that says nothing of light gets a sun.
Light default_sun() {
  Light sun;
  sun.type = Light::Type::directional;
  sun.direction = glm::normalize(glm::vec3(-0.4F, -1.0F, -0.6F));
  sun.colour = glm::vec3(2.0F);
  return sun;
}

bool says_its_light(const GltfDocument& document, const Scene& scene) {
  const tinygltf::Value& extras = document.model.asset.extras;
  return !scene.lights.empty() || (extras.IsObject() && extras.Has("vergence"));
}

}  // namespace

Scene read_gltf(const std::string& path) {
  const GltfDocument document = load_gltf_document(path);
  Scene scene;
  scene.source = path;
  scene.environment = read_environment(document);
  const std::vector<UvSets> uv_sets = read_materials(document, scene);
  std::set<std::string> target_names;
  for (const PlacedNode& placed : placed_nodes(document)) {
    const tinygltf::Node& node = document.model.nodes[static_cast<std::size_t>(placed.index)];
    if (node.mesh >= 0) append_mesh(document, node.mesh, placed.world_from_node, uv_sets, scene);
    if (node.camera >= 0) {
      const std::string& own = document.model.cameras.at(static_cast<std::size_t>(node.camera)).name;
      scene.cameras.push_back({node.name.empty() ? own : node.name, rigid_pose(document, placed)});
    }
    if (is_target(node)) read_target(document, placed, target_names, scene);
    const auto light = node.extensions.find("KHR_lights_punctual");
    if (light != node.extensions.end()) {
      if (scene.lights.size() == kMostLights) {
        document.fail(placed.field() + ".extensions.KHR_lights_punctual",
                      "is light number " + std::to_string(kMostLights + 1) + "; " + std::to_string(kMostLights) +
                          " are allowed in all");
      }
      scene.lights.push_back(read_light(document, light->second.Get("light").GetNumberAsInt(), placed));
    }
  }
  if (!says_its_light(document, scene)) scene.lights.push_back(default_sun());
  if (scene.triangles.empty()) document.fail("meshes", "shows no triangles; a scene needs at least one");
  return scene;
}

}  // namespace render
