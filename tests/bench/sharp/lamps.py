#!/usr/bin/env python3
"""Adds spots to a binary glTF file. Usage: lamps.py IN.glb OUT.glb X,Y,Z:TO_X,TO_Y,TO_Z:CANDELA:INNER:OUTER …  (metres, radians)"""
import json
import math
import struct
import sys

data = open(sys.argv[1], "rb").read()
size = struct.unpack_from("<I", data, 12)[0]
scene = json.loads(data[20:20 + size])
lights = scene.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"]
scene["extensionsUsed"] = sorted({*scene.get("extensionsUsed", []), "KHR_lights_punctual"})
for k, lamp in enumerate(sys.argv[3:]):
    eye, to, candela, inner, outer = ([float(v) for v in part.split(",")] for part in lamp.split(":"))
    z = [(a - b) / math.dist(eye, to) for a, b in zip(eye, to)]
    x = [v / math.hypot(z[2], z[0]) for v in (z[2], 0, -z[0])]
    y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]]
    scene["scenes"][scene.get("scene", 0)]["nodes"].append(len(scene["nodes"]))
    scene["nodes"].append({"name": f"spot {k}", "matrix": x + [0] + y + [0] + z + [0] + eye + [1],
                           "extensions": {"KHR_lights_punctual": {"light": len(lights)}}})
    lights.append({"name": f"spot {k}", "type": "spot", "intensity": candela[0], "spot": {"innerConeAngle": inner[0], "outerConeAngle": outer[0]}})
text = json.dumps(scene).encode()
text += b" " * (-len(text) % 4)
rest = data[20 + size:]
open(sys.argv[2], "wb").write(struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest)) + struct.pack("<I4s", len(text), b"JSON") + text + rest)
