#!/usr/bin/env bash
# The viewer in headless Chromium, on a sample scene's folder. Skipped (77) where node or Chromium are absent.
set -euo pipefail
bin=$1 source=$2
if ! command -v node >/dev/null || [ ! -x "${CHROMIUM:-/usr/bin/chromium}" ]; then
  echo "skipped: the viewer's tests need node and Chromium (Debian: apt-get install nodejs chromium)"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$bin/oriel-scenes" gallery -o "$work/a.glb" >/dev/null
"$bin/oriel-bake" "$work/a.glb" -o "$work/a.oriel" --texel 40cm --error 20% --accept-partial >/dev/null 2>&1
"$bin/oriel-inspect" web "$work/a.oriel" -o "$work/web" >/dev/null
node "$source/web/test/walk_test.mjs" "$work/web" 100
if [ -d "$source/web/node_modules" ]; then
  node "$source/web/build.mjs" "$work/dist"
  diff -r "$source/web/dist" "$work/dist" || { echo "web/dist is not what web/ builds to: npm run build"; exit 1; }
  (cd "$source/web" && npx --no-install tsc --noEmit)
fi
