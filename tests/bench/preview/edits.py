#!/usr/bin/env python3
"""A window of oriel-preview under Xvfb while its file is saved again and again: a lamp moves each time, or a colour
changes, and every fifth file is cut off.
Prints how soon they were seen, and what memory the window holds after 20 of them and at the end; exit code 1 where the window died or
missed one.

edits.py PROGRAM SCENE.glb [EDITS [lamps|colours]]    at least 20; default 100 lamps"""
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import threading
import time


def parts_of(glb):
    length = struct.unpack_from("<I", glb, 12)[0]
    return json.loads(glb[20:20 + length]), glb[20 + length:]


def glb_of(document, rest):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest


def lamp_nodes(document):
    """Nodes whose mesh glows, and nodes of lights."""
    glows = {i for i, m in enumerate(document.get("materials", [])) if any(m.get("emissiveFactor", []))}
    meshes = {i for i, m in enumerate(document.get("meshes", [])) if any(p.get("material") in glows for p in m["primitives"])}
    return [n for n in document["nodes"]
            if n.get("mesh") in meshes or "KHR_lights_punctual" in n.get("extensions", {})]


def move_lamps(document):
    for node in lamp_nodes(document):
        if "matrix" in node:
            node["matrix"][13] -= 0.001
        else:
            node.setdefault("translation", [0, 0, 0])[1] -= 0.001


def change_colours(document):
    for material in document.get("materials", []):
        colour = material.setdefault("pbrMetallicRoughness", {}).setdefault("baseColorFactor", [1, 1, 1, 1])
        colour[:3] = [0.99 * c for c in colour[:3]]


def resident_mib(process):
    return int(pathlib.Path(f"/proc/{process.pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20


def save(file, data):
    beside = file.with_suffix(".new")
    beside.write_bytes(data)
    os.replace(beside, file)


def start(program, file):
    number = 90 + os.getpid() % 900
    server = subprocess.Popen(["Xvfb", f":{number}", "-screen", "0", "700x520x24"], stderr=subprocess.DEVNULL)
    time.sleep(1)
    window = subprocess.Popen([program, str(file), "--size", "640x480", "--stats"], text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, env={**os.environ, "DISPLAY": f":{number}"})
    return server, window


def main():
    program, scene = sys.argv[1], pathlib.Path(sys.argv[2])
    change = {"lamps": move_lamps, "colours": change_colours}[sys.argv[4] if len(sys.argv) > 4 else "lamps"]
    edits = max(20, int(sys.argv[3])) if len(sys.argv) > 3 else 100
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / scene.name
        file.write_bytes(scene.read_bytes())
        document, rest = parts_of(file.read_bytes())
        server, window = start(program, file)
        told = []
        for stream in (window.stdout, window.stderr):
            threading.Thread(target=lambda s=stream: told.extend(iter(s.readline, "")), daemon=True).start()
        seen, missed, refused, held = [], 0, 0, float("nan")
        try:
            wait(told, 0, 60)
            for i in range(1, edits + 1):
                change(document)
                data, before = glb_of(document, rest), len(told)
                save(file, data[:len(data) // 2] if i % 5 == 0 else data)
                line = wait(told, before, 30)
                if line is None or window.poll() is not None:
                    missed += 1
                elif line.startswith("{"):
                    seen.append(json.loads(line)["seen_after_saving_s"])
                else:
                    refused += 1
                if i == 20:
                    held = resident_mib(window)
            alive = window.poll() is None
            at_end = resident_mib(window) if alive else float("nan")
        finally:
            window.terminate()
            window.wait()
            server.terminate()
            server.wait()
    seen.sort()
    print(f"{edits} edits of {scene.name} ({change.__name__}): {len(seen)} seen, {refused} refused, {missed} missed; "
          f"after saving seen within {seen[len(seen) // 2]:.3f} s (median), {seen[-1]:.3f} s (slowest); "
          f"{held:.1f} MiB after 20, {at_end:.1f} at the end; the window {'lives' if alive else 'died'}")
    return 0 if alive and missed == 0 else 1


def wait(told, before, seconds):
    """The first line that tells of a reading: JSON, or an error."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        for line in told[before:]:
            if line.startswith("{") or "glb" in line:
                return line
        time.sleep(0.01)
    return None


sys.exit(main())
