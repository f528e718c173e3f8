#!/usr/bin/env bash
# Lays down build/monado with bin/monado-service, bin/monado-ctl and share/openxr/1/openxr_monado.json: Monado, the OpenXR runtime that
# the tests labelled xr run on. Where Debian has no package of it (Debian 12), it is built from Debian's source archive
# of trixie into that folder; nothing of another release is installed. Does nothing once it is there.
set -euo pipefail
cd "$(dirname "$0")/.."

prefix=$PWD/build/monado
manifest=$prefix/share/openxr/1/openxr_monado.json
[ -e "$manifest" ] && exit 0

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Moved into place in one step, so that what is there is whole.
lay_down() {
  mkdir -p build
  rm -rf "$prefix"
  mv "$work/root" "$prefix"
}

if apt-cache policy monado-service | grep -q 'Candidate: [0-9]'; then
  bash cmake/packages.sh monado-service libopenxr1-monado
  mkdir -p "$work/root/bin" "$work/root/share/openxr/1"
  ln -s "$(command -v monado-service)" "$(command -v monado-ctl)" "$work/root/bin/"
  printf '{"file_format_version": "1.0.0", "runtime": {"name": "Monado", "library_path": "%s"}}\n' \
    "$(dpkg -L libopenxr1-monado | grep '/libopenxr_monado\.so$')" >"$work/root/share/openxr/1/openxr_monado.json"
  lay_down
  exit 0
fi

bash cmake/packages.sh python3-minimal glslang-tools libxcb1-dev libxcb-randr0-dev libx11-dev libx11-xcb-dev libxrandr-dev

# Package lists of its own: the system's sources stay as they are.
mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/source"
codename=$(. /etc/os-release && echo "$VERSION_CODENAME")
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' "Codename: $codename" 'Label: Debian' |
  head -n 1)
[ -n "$mirror" ] || { echo "apt knows no source of Debian's $codename; one is needed" >&2; exit 1; }
echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror trixie main" >"$work/sources.list"
apt=(-qq -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=/dev/null
  -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work/cache" -o APT::Sandbox::User=root)
echo "Building Monado from the source archive of trixie"
apt-get "${apt[@]}" update
(cd "$work" && apt-get "${apt[@]}" source --download-only --tar-only monado)
archive=$(echo "$work"/monado_*.orig.tar.*)
version=$(basename "$archive" | sed 's/^monado_\([0-9.]*\).*/\1/')
tar -xf "$archive" -C "$work/source" --strip-components=1

# The service, its client and two drivers: a simulated headset, and one that is told its poses over a socket. All that
# would want hardware, and the prober that needs libudev's headers, stays out; the search for udev is answered with the
# library that every system has, and nothing is compiled against it.
off=()
for driver in ARDUINO DAYDREAM EUROC HANDTRACKING HDK HYDRA NS OHMD OPENGLOVES PSMV PSSENSE PSVR REALSENSE RIFT_S ROKID \
  STEAMVR_LIGHTHOUSE SURVIVE TWRAP ULV2 ULV5 VF VIVE WMR XREAL_AIR SIMULAVR DEPTHAI; do
  off+=("-DXRT_BUILD_DRIVER_$driver=OFF")
done
for part in OPENGL OPENGLES EGL SDL2 WAYLAND OPENCV GST DBUS SYSTEMD JPEG LIBUVC LIBUSB HIDAPI BLUETOOTH LIBBSD LIBUDEV \
  SYSTEM_CJSON; do
  off+=("-DXRT_HAVE_$part=OFF")
done
cmake -G Ninja -S "$work/source" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$work/root" \
  -DGIT_DESC="$version" -DBUILD_TESTING=OFF -DBUILD_DOC=OFF -DXRT_BUILD_SAMPLES=OFF -DXRT_MODULE_MONADO_GUI=OFF \
  -DXRT_FEATURE_STEAMVR_PLUGIN=OFF -DXRT_FEATURE_SLAM=OFF \
  -DUDEV_LIBRARY="$(ldconfig -p | awk '/libudev\.so\.1 / { print $NF; exit }')" -DUDEV_INCLUDE_DIR=/usr/include \
  -DXRT_BUILD_DRIVER_SIMULATED=ON -DXRT_BUILD_DRIVER_REMOTE=ON "${off[@]}" >"$work/log" 2>&1 ||
  { tail -n 30 "$work/log" >&2; exit 1; }
{ cmake --build "$work/build" && cmake --install "$work/build" --strip; } >"$work/log" 2>&1 ||
  { tail -n 30 "$work/log" >&2; exit 1; }
lay_down
