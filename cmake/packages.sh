#!/usr/bin/env bash
# Installs the Debian packages that building, running and testing need, if any is missing. Asks nothing, and touches no
# network when all are there. More packages may be named as arguments.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config git
  libvulkan-dev glslc mesa-vulkan-drivers vulkan-validationlayers
  libembree-dev libglm-dev libtinygltf-dev nlohmann-json3-dev libcli11-dev libstb-dev libopenexr-dev libeigen3-dev
  libboost-dev libfreetype-dev fonts-liberation libgtest-dev assimp-testmodels libopenxr-dev libglfw3-dev
  "$@"
)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

if [ "$(id -u)" -ne 0 ]; then
  echo "These packages are missing: ${missing[*]}" >&2
  echo "Run this as root once, or install them with apt-get." >&2
  exit 1
fi
echo "Installing ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
apt-get update -qq
apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
