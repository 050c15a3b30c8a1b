#!/usr/bin/env bash
# The viewer in headless Chromium, on a sample scene's folder and on the pack with one of everything. Skipped (77) where node or
# Chromium are absent.
set -euo pipefail
bin=$1 source=$2
if ! command -v node >/dev/null || [ ! -x "${CHROMIUM:-/usr/bin/chromium}" ]; then
  echo "skipped: the viewer's tests need node and Chromium (Debian: apt-get install nodejs chromium)"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
test=$source/web/test

# Of everything a little: quick to load, again and again.
"$bin/oriel-inspect" web "$source/tests/formats/pack/golden/whole-v1.oriel" -o "$work/whole" >/dev/null 2>&1
node "$test/robust_test.mjs" "$work/whole"
node "$test/fuzz_pieces.mjs" "$work/whole" 3000 || [ $? = 77 ]

"$bin/oriel-scenes" gallery -o "$work/a.glb" >/dev/null
"$bin/oriel-bake" "$work/a.glb" -o "$work/a.oriel" --texel 40cm --error 20% --require nothing --light-groups each >/dev/null 2>&1

"$bin/oriel-inspect" web "$work/a.oriel" -o "$work/web" >/dev/null 2>&1

# The stairs to the platform, and the middle of the platform from before them; beside the stairs nothing rises.
node "$test/walk_test.mjs" "$work/web" 100 11,1.6,3,180,-16

# Lamps as on the desktop. The limit is that of all frames with reflections; other lamps are far beyond it.
node "$test/shot.mjs" "$work/web" "$work/dimmed.png" 'camera=entrance&light=*%3Doff&light=A luminaire 2 panel%3D0.6 2700K' 640 360
compare() {
  "$bin/oriel-play" "$work/a.oriel" --offscreen --size 640x360 --camera entrance "$@" -o "$work/difference.png" --compare "$work/dimmed.png"
}
compare --light '*=off' --light 'A luminaire 2 panel=0.6 2700K' --max-flip 0.04
if compare --light '*=off' --light 'window sky=on' --max-flip 0.04; then
  echo "other lamps are told from these by nothing"
  exit 1
fi

# What blends is drawn from far to near, from whichever side: in the mesh's order it differs by 0.14. Behind it is the sky as it is
# by direction, darker above.
node "$test/panes.mjs" >"$work/panes.gltf"
"$bin/oriel-scenes" sky 12 -o "$work/sky.exr" >/dev/null
"$bin/oriel-bake" "$work/panes.gltf" -o "$work/panes.oriel" --sky "$work/sky.exr" --texel 20cm --error 20% >/dev/null 2>&1
"$bin/oriel-inspect" web "$work/panes.oriel" -o "$work/panes" >/dev/null
for camera in front back; do
  node "$test/shot.mjs" "$work/panes" "$work/panes.png" "$camera" 640 360
  "$bin/oriel-play" "$work/panes.oriel" --offscreen --size 640x360 --camera "$camera" -o "$work/difference.png" --compare "$work/panes.png" --max-flip 0.04
done

if [ -d "$source/web/node_modules" ]; then
  node "$source/web/build.mjs" "$work/dist"
  diff -r "$source/web/dist" "$work/dist" || { echo "web/dist is not what web/ builds to: npm run build"; exit 1; }
  (cd "$source/web" && npx --no-install tsc --noEmit)
fi
