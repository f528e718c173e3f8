// Scenes around the models that assets/fetch_scenes.sh brings: cars in a hall, a chessboard and an engine on a table.
// Metres, floor at y = 0, the camera at kHallEyes or kTableEyes. The models' triangles are kept one for one.
#pragma once

#include <string>

#include "assets/generator/model_reader.hpp"
#include "assets/generator/scene_model.hpp"

namespace assets {

inline constexpr glm::dvec3 kHallEyes{0.0, 1.6, 0.0}, kTableEyes{0.0, 1.2, 0.0};

// models: the folder with concept-sedan-02.glb, concept-sedan-02-sport.glb and fordFocus.glb.
[[nodiscard]] SceneModel make_car_scene(const std::string& models, const std::string& font_path);
// A model on a table 0.6 m ahead of a seated wearer, its longest side (across or deep) scaled to `size` metres.
[[nodiscard]] SceneModel make_table_scene(const std::string& model, double size);

// Puts the model down: longest horizontal side `size` metres long, standing on `place`, turned about y by yaw.
void add_model(SceneModel& scene, const Model& model, const std::string& name, double size, const glm::dvec3& place,
               double yaw);

// Of the nodes that add_model made.
[[nodiscard]] std::size_t model_triangle_count(const SceneModel& scene);

}  // namespace assets
