#!/usr/bin/env bash
# Lays down build/mesa25/lvp_icd.json, the description of a software Vulkan driver of Mesa 25 or later, for the tests
# that run with VK_DRIVER_FILES set to it. Where the system's own driver is older (Debian 12), one from Debian's
# backports is unpacked beside the description; nothing is installed. Does nothing once it is there.
set -euo pipefail
cd "$(dirname "$0")/.."

least=25
prefix=$PWD/build/mesa25
description=$prefix/lvp_icd.json
[ -e "$description" ] && exit 0

version=$(dpkg-query -W -f='${Version}' mesa-vulkan-drivers)
mkdir -p "$prefix"
if dpkg --compare-versions "$version" ge $least; then
  ln -s "$(find /usr/share/vulkan/icd.d -name 'lvp_icd*.json' | head -n 1)" "$description"
  exit 0
fi

# Package lists of its own: the system's sources stay as they are.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/root"
codename=$(. /etc/os-release && echo "$VERSION_CODENAME")
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' "Codename: $codename" 'Label: Debian' |
  head -n 1)
[ -n "$mirror" ] || { echo "apt knows no source of Debian's $codename; one is needed" >&2; exit 1; }
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $codename-backports main" \
  >"$work/sources.list"
apt=(-qq -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=/dev/null
  -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work/cache" -o APT::Sandbox::User=root)
echo "Fetching mesa-vulkan-drivers of $codename-backports"
apt-get "${apt[@]}" update
(cd "$work" && apt-get "${apt[@]}" download "mesa-vulkan-drivers/$codename-backports")
package=$(echo "$work"/mesa-vulkan-drivers_*.deb)
version=$(dpkg-deb -f "$package" Version)
dpkg --compare-versions "$version" ge $least ||
  { echo "mesa-vulkan-drivers of $codename-backports is $version; $least or later is needed" >&2; exit 1; }
dpkg-deb -x "$package" "$work/root"
driver=$(find "$work/root" -name libvulkan_lvp.so)
# What the driver links to comes with the system's own, of the same LLVM.
missing=$(ldd "$driver" | grep 'not found' || true)
[ -z "$missing" ] || { echo "mesa-vulkan-drivers $version lacks libraries here: $missing" >&2; exit 1; }
mv "$driver" "$prefix/"
sed "s|\"library_path\": *\"[^\"]*\"|\"library_path\": \"./libvulkan_lvp.so\"|" \
  "$(find "$work/root" -name 'lvp_icd*.json')" >"$work/lvp_icd.json"
mv "$work/lvp_icd.json" "$description"
