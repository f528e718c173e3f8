// What `vergence vr` is asked to do.
#pragma once

#include <optional>
#include <string>

#include "app/scene_options.hpp"
#include "xr/spaces.hpp"

namespace app {

struct VrOptions {
  SceneOptions scene;
  PictureOptions picture{.accuracy = "auto"};  // or a rung's name
  std::string mode = "adof";
  int samples = 4;  // dof, in every frame
  std::string range;
  std::string colour_map = "hsv";
  std::string size;  // of each eye's image; empty: as the runtime recommends
  std::string space = "auto";
  std::string device;
  std::string screenshot;
  std::string record, replay;  // FILE.csv
  std::optional<int> frames;
  bool mirror = false;
  bool no_text = false;       // nothing to read in the headset
  double reconnect_s = 10.0;  // how long a lost runtime is waited for
  bool json = false;
};

}  // namespace app
