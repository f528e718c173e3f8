#!/usr/bin/env bash
# Scenes around real models: the paper's kind of car scene, a chessboard, an engine. Takes the models from Debian's
# packages (as root they are installed if missing), converts them with assimp, and composes them with make_assets.
# What is there is kept: a second run needs no network. --again makes the scenes anew.
# usage: assets/fetch_scenes.sh [--again] [FOLDER]    (FOLDER: build/scenes)
set -euo pipefail
cd "$(dirname "$0")/.."

again=no
if [ "${1:-}" = --again ]; then
  again=yes
  shift
fi
out=${1:-build/scenes}
models=$out/models
if [ $again = no ] && [ -s "$out/car_scene.glb" ] && [ -s "$out/chessboard.glb" ] && [ -s "$out/engine.glb" ]; then
  echo "The scenes are in $out already; --again makes them anew."
  exit 0
fi

bash cmake/packages.sh sweethome3d-furniture assimp-utils assimp-testmodels unzip

# name, archive, path inside it without its ending
furniture=/usr/share/sweethome3d/furniture
converted() {
  local name=$1 archive=$2 path=$3
  [ -s "$models/$name.glb" ] && return
  unzip -qo "$furniture/$archive" "$path.obj" "$path.mtl" -d "$models"
  assimp export "$models/$path.obj" "$models/$name.part.glb" -tri >"$models/$name.log" || {
    echo "assimp could not convert $name; see $models/$name.log" >&2
    exit 1
  }
  mv "$models/$name.part.glb" "$models/$name.glb"
}
mkdir -p "$models"
converted concept-sedan-02 KatorLegaz.sh3f katorlegaz/concept-sedan-02/concept-sedan-02
converted concept-sedan-02-sport KatorLegaz.sh3f katorlegaz/concept-sedan-02-sport/concept-sedan-02-sport
converted fordFocus BlendSwap-CC-BY.sh3f blendswap-cc-by/fordFocus/fordFocus
converted chessboard BlendSwap-CC-BY.sh3f blendswap-cc-by/chessboard/chessboard
cp /usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb "$models/"

if [ -n "${MAKE_ASSETS:-}" ]; then
  make_assets=$MAKE_ASSETS
else
  [ -f build/release/build.ninja ] || cmake --preset release
  cmake --build build/release --target make_assets
  make_assets=build/release/assets/make_assets
fi
"$make_assets" --models "$models" --scenes "$out" | tee "$out/counts.txt"
# 124,188 + 120,284 + 65,969: as many as in the paper's car scene.
grep -q '^car_scene.*, 310441 of them' "$out/counts.txt" ||
  echo "The cars are not the 310,441 triangles that the benchmark is named for: the packages hold other models." >&2

cat >"$out/CREDITS.txt" <<'TEXT'
The scenes in this folder are adaptations: models scaled to metres, turned, given normals, and placed in rooms of ours.

car_scene.glb
  "Concept Sedan 02" and "Concept Sedan 02 Sport", (C) Andrew Kator & Jennifer Legaz,
  Creative Commons Attribution 3.0 United States, https://creativecommons.org/licenses/by/3.0/us/
  "Ford Focus" by Ruff (Blend Swap 76275),
  Creative Commons Attribution 3.0, https://creativecommons.org/licenses/by/3.0/
chessboard.glb
  "Chessboard" by Swapnilrocks98 (Blend Swap 73022),
  Creative Commons Attribution 3.0, https://creativecommons.org/licenses/by/3.0/
engine.glb
  "2 Cylinder Engine" of the Khronos glTF sample models, as packaged in Debian's assimp-testmodels, whose
  /usr/share/doc/assimp-testmodels/copyright says under which terms

All but the engine from Debian's package sweethome3d-furniture.
TEXT
echo "Scenes and CREDITS.txt are in $out"
