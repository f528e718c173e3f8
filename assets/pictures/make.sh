#!/usr/bin/env bash
# Draws the README's pictures of the built-in scene again, beside this file; the ladder's picture is what `vergence
# tradeoff` writes. Takes the program to draw with: assets/pictures/make.sh [build/release/app/vergence]
set -euo pipefail
cd "$(dirname "$0")/../.."
vergence=${1:-build/release/app/vergence}

draw() {
  local name=$1
  shift
  "$vergence" render --eye right --size 480x400 --output "assets/pictures/$name.png" "$@" >/dev/null
}

presbyope=(--wearer assets/wearers/presbyopia.json)
progressive=(--spectacles assets/spectacles/presbyopia_bspline_sphere.json)
for place in near:near_card house:house_50m; do
  draw "${place%:*}_without" "${presbyope[@]}" --look-at "${place#*:}" --fov 26
  draw "${place%:*}_with" "${presbyope[@]}" "${progressive[@]}" --look-at "${place#*:}" --fov 26
done
# From 30 km up everything is as good as infinitely far.
over_the_lens=("${presbyope[@]}" "${progressive[@]}" --viewing scanning --pose 0,30000,0,0,0 --fov 80)
draw lens_power "${over_the_lens[@]}" --mode power --range -0.25,2.5
draw lens_astigmatism "${over_the_lens[@]}" --mode astigmatism --range 0,2.75
draw dial_compare --wearer assets/wearers/astigmatism.json --compare assets/spectacles/astigmatism.json \
  --look-at clock_dial --fov 12
