#!/usr/bin/env python3
"""Writes a room with a barred window, a sun, a pendant, a table and a chair as glTF. Usage: room.py OUT.gltf"""
import base64
import json
import math
import struct
import sys

data, views, accessors, meshes, nodes, cameras = b"", [], [], [], [], []
MATERIALS = [("floor", (0.5, 0.4, 0.3)), ("white", (0.75, 0.75, 0.75)), ("iron", (0.1, 0.1, 0.1)), ("wood", (0.45, 0.3, 0.2))]
FLOOR, WHITE, IRON, WOOD = range(4)


def add(values, kind, code, target, **more):
    global data
    raw = struct.pack(f"<{len(values)}{code}", *values)
    views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(raw), "target": target})
    data += raw
    count = len(values) // {"VEC3": 3, "SCALAR": 1}[kind]
    accessors.append({"bufferView": len(views) - 1, "componentType": {"f": 5126, "I": 5125}[code], "count": count, "type": kind, **more})
    return len(accessors) - 1


def box(name, lower, upper, material):
    positions, normals, indices = [], [], []
    for axis in range(3):
        for side in (0, 1):
            u, v = ((axis + 1) % 3, (axis + 2) % 3) if side else ((axis + 2) % 3, (axis + 1) % 3)
            first = len(positions) // 3
            for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
                corner = list(upper if side else lower)
                corner[u], corner[v] = (lower[u], upper[u])[s], (lower[v], upper[v])[t]
                positions += corner
                normals += [(2 * side - 1) * (k == axis) for k in range(3)]
            indices += [first + k for k in (0, 1, 2, 0, 2, 3)]
    attributes = {"POSITION": add(positions, "VEC3", "f", 34962, min=list(lower), max=list(upper)), "NORMAL": add(normals, "VEC3", "f", 34962)}
    meshes.append({"primitives": [{"attributes": attributes, "indices": add(indices, "SCALAR", "I", 34963), "material": material}]})
    nodes.append({"name": name, "mesh": len(meshes) - 1})


def looking(name, eye, to, **more):
    z = [a - b for a, b in zip(eye, to)]
    z = [k / math.dist(eye, to) for k in z]
    x = [k / math.hypot(z[2], z[0]) for k in (z[2], 0, -z[0])]
    y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]]
    nodes.append({"name": name, "matrix": x + [0] + y + [0] + z + [0] + list(eye) + [1], **more})


box("floor", (-0.2, -0.2, -0.2), (5.2, 0, 4.2), FLOOR)
box("ceiling", (-0.2, 2.8, -0.2), (5.2, 3, 4.2), WHITE)
for name, lower, upper in (("north", (0, 0, -0.2), (5, 2.8, 0)), ("south", (0, 0, 4), (5, 2.8, 4.2)), ("east", (5, 0, -0.2), (5.2, 2.8, 4.2)),
                           ("low", (-0.2, 0, -0.2), (0, 0.9, 4.2)), ("high", (-0.2, 2.3, -0.2), (0, 2.8, 4.2)),
                           ("left", (-0.2, 0.9, -0.2), (0, 2.3, 1.2)), ("right", (-0.2, 0.9, 2.8), (0, 2.3, 4.2))):
    box("wall " + name, lower, upper, WHITE)
for k in range(9):
    box(f"bar {k}", (-0.12, 0.9, 1.3 + 0.175 * k), (-0.1, 2.3, 1.32 + 0.175 * k), IRON)
box("cross bar", (-0.12, 1.59, 1.2), (-0.1, 1.61, 2.8), IRON)
box("table top", (2, 0.72, 1.5), (3.4, 0.75, 2.3), WOOD)
for x, z in ((2.05, 1.55), (3.3, 1.55), (2.05, 2.2), (3.3, 2.2)):
    box("table leg", (x, 0, z), (x + 0.05, 0.72, z + 0.05), WOOD)
box("chair seat", (2.4, 0.43, 2.5), (2.85, 0.46, 2.95), WOOD)
for x, z, height in ((2.4, 2.5, 0.43), (2.8, 2.5, 0.43), (2.4, 2.9, 0.95), (2.8, 2.9, 0.95)):
    box("chair leg", (x, 0, z), (x + 0.04, height, z + 0.04), WOOD)
for k in range(4):
    box("chair slat", (2.44, 0.55 + 0.1 * k, 2.91), (2.8, 0.59 + 0.1 * k, 2.93), WOOD)
light = lambda k: {"extensions": {"KHR_lights_punctual": {"light": k}}}
looking("sun", (0, 0, 0), (1, -0.75, 0.15), **light(0))
nodes.append({"name": "pendant", "translation": [2.7, 1.9, 1.9], **light(1)})
for name, eye, to in (("room", (4.6, 1.6, 3.6), (1.5, 0.5, 1.6)), ("near", (2.2, 0.5, 3.4), (2.6, 0, 2.8)), ("floor", (1.6, 1.5, 2.2), (1.2, 0, 2))):
    looking(name, eye, to, camera=len(cameras))
    cameras.append({"name": name, "type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.02}})
json.dump({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes, "meshes": meshes, "cameras": cameras,
    "materials": [{"name": n, "pbrMetallicRoughness": {"baseColorFactor": [*c, 1], "metallicFactor": 0, "roughnessFactor": 1}} for n, c in MATERIALS],
    "accessors": accessors, "bufferViews": views,
    "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
    "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"name": "sun", "type": "directional", "intensity": 60000}, {"name": "pendant", "type": "point", "intensity": 300}]}},
}, open(sys.argv[1], "w"))
