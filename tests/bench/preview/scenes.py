#!/usr/bin/env python3
"""Draws scenes with oriel-preview as nobody here made them, one pass after another, shared and with paths, and says which fail: a crash, an
error without words, pixels that are no numbers, a frame that is black though the scene has light.

scenes.py PROGRAM FILE.glb …    exit code 1 where any fails"""
import json
import subprocess
import sys

WAYS = [[], ["--paths", "1"]]
SIZE = ["--offscreen", "--size", "160x120", "--passes", "2", "--sky", "1000", "--stats"]


def fault(program, file, way):
    ran = subprocess.run([program, file, *SIZE, *way], capture_output=True, text=True, timeout=300)
    if ran.returncode < 0 or ran.returncode > 100:
        return f"died of signal {ran.returncode}"
    if ran.returncode != 0:
        said = ran.stderr.strip().splitlines()
        return None if said and said[-1].startswith("oriel-preview: ") else f"exit code {ran.returncode} without a word"
    stats = json.loads(ran.stdout.strip().splitlines()[-1])
    frame = stats["passes_frame"]
    if frame["no_number"] > 0:
        return f"{frame['no_number']} pixels are no numbers"
    if frame["mean_cd_m2"] <= 0 and stats["lamps"] > 0:
        return "black, with lamps"
    return None


def main():
    program, files, failed = sys.argv[1], sys.argv[2:], 0
    for file in files:
        for way in WAYS:
            try:
                wrong = fault(program, file, way)
            except subprocess.TimeoutExpired:
                wrong = "took more than 300 s"
            if wrong:
                failed += 1
                print(f"{file} {' '.join(way)}: {wrong}", flush=True)
    print(f"{len(files)} scenes, {len(WAYS)} ways each: {failed} failed")
    return 1 if failed else 0


sys.exit(main())
