"""Scenes with glass in them, as .glb files, and where its boxes are."""
import math
import os
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cycles"))
import glb  # noqa: E402

FACES = [((1, 0, 0), (0, 1, 0), (0, 0, 1)), ((-1, 0, 0), (0, 0, 1), (0, 1, 0)), ((0, 1, 0), (0, 0, 1), (1, 0, 0)),
         ((0, -1, 0), (1, 0, 0), (0, 0, 1)), ((0, 0, 1), (1, 0, 0), (0, 1, 0)), ((0, 0, -1), (0, 1, 0), (1, 0, 0))]


class Scene:
    """A scene that is built up; `glass`: the eight corners of each box of glass, where eyes see it; `bake`: options it asks for."""

    def __init__(self, source=None):
        empty = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": []}
        self.tree, self.binary = glb.read(source) if source else (empty, b"")
        self.glass = []
        self.bake = ""

    def _list(self, kind, value):
        self.tree.setdefault(kind, []).append(value)
        return len(self.tree[kind]) - 1

    def diffuse(self, color, cd_m2=0):
        return self._list("materials", {
            "pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": 1},
            "extensions": {"KHR_materials_specular": {"specularFactor": 0},
                           "KHR_materials_emissive_strength": {"emissiveStrength": max(cd_m2, 1)}},
            "emissiveFactor": [1 if cd_m2 else 0] * 3})

    def glass_of(self, thickness_m, roughness=0, left_after_1m=(1, 1, 1), ior=1.5):
        """thickness 0: a thin pane."""
        return self._list("materials", {
            "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "metallicFactor": 0, "roughnessFactor": roughness},
            "doubleSided": thickness_m == 0,
            "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": ior},
                           "KHR_materials_volume": {"thicknessFactor": thickness_m, "attenuationDistance": 1,
                                                    "attenuationColor": list(left_after_1m)}}})

    def mirror(self):
        return self._list("materials", {
            "pbrMetallicRoughness": {"baseColorFactor": [0.95, 0.95, 0.95, 1], "metallicFactor": 1, "roughnessFactor": 0}})

    def _mesh(self, name, points, normals, indices, material):
        def view(data):
            self.binary += b"\0" * (-len(self.binary) % 4)
            self.binary += data
            return self._list("bufferViews", {"buffer": 0, "byteOffset": len(self.binary) - len(data), "byteLength": len(data)})

        def vectors(values):
            data = b"".join(struct.pack("<3f", *v) for v in values)
            return self._list("accessors", {
                "bufferView": view(data), "componentType": 5126, "count": len(values), "type": "VEC3",
                "min": [min(v[c] for v in values) for c in range(3)], "max": [max(v[c] for v in values) for c in range(3)]})

        corners = self._list("accessors", {"bufferView": view(struct.pack(f"<{len(indices)}I", *indices)),
                                           "componentType": 5125, "count": len(indices), "type": "SCALAR"})
        mesh = self._list("meshes", {"primitives": [{
            "attributes": {"POSITION": vectors(points), "NORMAL": vectors(normals)}, "indices": corners, "material": material}]})
        node = self._list("nodes", {"name": name, "mesh": mesh})
        self.tree["scenes"][self.tree.get("scene", 0)]["nodes"].append(node)

    def box(self, name, middle, size, material, yaw=0, glass=False):
        """yaw: about up, radians."""
        c, s = math.cos(yaw), math.sin(yaw)

        def turned(v):
            return (c * v[0] + s * v[2], v[1], -s * v[0] + c * v[2])

        def at(*signs):
            v = turned([0.5 * signs[i] * size[i] for i in range(3)])
            return tuple(v[i] + middle[i] for i in range(3))

        points, normals, indices = [], [], []
        for n, u, v in FACES:
            first = len(points)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                points.append(at(*(n[i] + a * u[i] + b * v[i] for i in range(3))))
                normals.append(turned(n))
            indices += [first + i for i in (0, 1, 2, 0, 2, 3)]
        self._mesh(name, points, normals, indices, material)
        if glass:
            self.glass.append([at(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])

    def turned(self, name, middle, outline, material, sides=64):
        """A surface round about up through `middle`; outline: its (radius, height) from the axis below, fronts to the right of it."""
        points, normals, indices = [], [], []
        steps = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(outline, outline[1:])]
        for i, (radius, height) in enumerate(outline):
            beside = [steps[k] for k in (i - 1, i) if 0 <= k < len(steps)]
            lengths = [math.hypot(*step) for step in beside]
            n = [sum(step[1] / l for step, l in zip(beside, lengths)), -sum(step[0] / l for step, l in zip(beside, lengths))]
            if radius == 0:
                n[0] = 0
            length = math.hypot(*n)
            for side in range(sides):
                phi = 2 * math.pi * side / sides
                c, d = math.cos(phi), -math.sin(phi)
                points.append((middle[0] + radius * c, middle[1] + height, middle[2] + radius * d))
                normals.append((n[0] / length * c, n[1] / length, n[0] / length * d))
        for i, (low, high) in enumerate(zip(outline, outline[1:])):
            for side in range(sides):
                a, b = i * sides + side, i * sides + (side + 1) % sides
                if low[0] > 0:
                    indices += [a, b, b + sides]
                if high[0] > 0:
                    indices += [a, b + sides, a + sides]
        self._mesh(name, points, normals, indices, material)
        radius, top = max(r for r, _ in outline), max(h for _, h in outline)
        self.glass.append([(middle[0] + x, middle[1] + y, middle[2] + z)
                           for x in (-radius, radius) for y in (0, top) for z in (-radius, radius)])

    def pane(self, name, corner, right, up, material):
        """A thin one."""
        def add(*vectors):
            return tuple(sum(v[i] for v in vectors) for i in range(3))

        n = (right[1] * up[2] - right[2] * up[1], right[2] * up[0] - right[0] * up[2], right[0] * up[1] - right[1] * up[0])
        length = math.sqrt(sum(x * x for x in n))
        points = [corner, add(corner, right), add(corner, right, up), add(corner, up)]
        self._mesh(name, points, [tuple(x / length for x in n)] * 4, [0, 1, 2, 0, 2, 3], material)
        self.glass.append(points)

    def camera(self, name, eye, target, fov):
        back = [e - t for e, t in zip(eye, target)]
        length = math.sqrt(sum(x * x for x in back))
        back = [x / length for x in back]
        right = [back[2], 0, -back[0]]
        flat = math.hypot(right[0], right[2])
        right = [x / flat for x in right]
        up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2],
              back[0] * right[1] - back[1] * right[0]]
        camera = self._list("cameras", {"type": "perspective", "perspective": {"yfov": fov, "znear": 0.01}})
        node = self._list("nodes", {"name": name, "camera": camera, "matrix": [*right, 0, *up, 0, *back, 0, *eye, 1]})
        self.tree["scenes"][self.tree.get("scene", 0)]["nodes"].append(node)

    def write(self, path):
        used = {e for m in self.tree.get("materials", []) for e in m.get("extensions", {})}
        self.tree["extensionsUsed"] = sorted({*self.tree.get("extensionsUsed", []), *used})
        glb.write(path, self.tree, self.binary)


def block(cornell):
    """The Cornell box with a block of glass before its blocks."""
    scene = Scene(cornell)
    scene.box("glass block", (0.39, 0.101, 0.11), (0.13, 0.2, 0.1), scene.glass_of(0.1, left_after_1m=(0.02, 0.4, 0.1)), 0.4, True)
    return scene


def vase(cornell):
    """The Cornell box with a vase before its blocks, whose walls are 8 mm thick."""
    scene = Scene(cornell)
    outer = [(0.035 + 0.03 * math.sin(math.pi * t / 16) ** 2 * (1 - t / 32) + 0.01 * (t / 16) ** 3, 0.24 * t / 16) for t in range(17)]
    inner = [(radius - 0.008, height) for radius, height in outer if height > 0.012]
    rim = [(outer[-1][0] - 0.004, outer[-1][1] + 0.003)]
    outline = [(0, 0), *outer, *rim, *inner[::-1], (0, inner[0][1])]
    scene.turned("vase", (0.36, 0.001, 0.12), outline, scene.glass_of(0.008, left_after_1m=(0.001, 0.1, 0.01)))
    scene.camera("near", (0.3, 0.2, -0.25), (0.34, 0.13, 0.12), 0.75)
    return scene


SCREEN = 0.05


def frosted(cornell, thin=False):
    """The Cornell box behind a frosted screen."""
    scene = Scene(cornell)
    if thin:
        scene.pane("frosted pane", (0.025, 0.01, SCREEN), (0.5, 0, 0), (0, 0.38, 0), scene.glass_of(0, 0.3))
        return scene
    scene.box("frosted screen", (0.275, 0.2, SCREEN), (0.5, 0.38, 0.006), scene.glass_of(0.006, 0.3), 0, True)
    return scene


BOARDS = [(0.09, 0.01), (0.24, 0.04), (0.39, 0.15)]  # left edge, metres behind the screen


def boards(cornell):
    """Black boards at three distances behind a frosted screen, before a bright wall."""
    scene = Scene(cornell)
    scene.box("frosted screen", (0.275, 0.2, SCREEN), (0.5, 0.38, 0.006), scene.glass_of(0.006, 0.3), 0, True)
    scene.box("bright", (0.275, 0.25, 0.218), (0.54, 0.5, 0.004), scene.diffuse((0, 0, 0), 100))
    black = scene.diffuse((0, 0, 0))
    for left, behind in BOARDS:
        scene.box("board", (left + 0.035, 0.2, SCREEN + 0.005 + behind), (0.07, 0.36, 0.004), black)
    return scene


def window(solid, roughness=0):
    """A wall of six panes, and what is seen through it of a garden under a bright ceiling."""
    scene = Scene()
    white, grey = scene.diffuse((0.75, 0.75, 0.75)), scene.diffuse((0.3, 0.3, 0.3))
    green, red, blue = (scene.diffuse(c) for c in ((0.1, 0.35, 0.08), (0.6, 0.12, 0.08), (0.1, 0.15, 0.5)))
    scene.box("floor", (0, -0.05, 0), (4, 0.1, 4), white)
    scene.box("ceiling", (0, 2.55, 0), (4, 0.1, 4), white)
    scene.box("back", (0, 1.25, 2.05), (4, 2.5, 0.1), white)
    scene.box("left", (-2.05, 1.25, 0), (0.1, 2.5, 4), red)
    scene.box("right", (2.05, 1.25, 0), (0.1, 2.5, 4), white)
    scene.box("lamp", (0, 2.49, 0.6), (1, 0.02, 0.6), scene.diffuse((0.8, 0.8, 0.8), 1500))
    scene.box("ground", (0, -0.05, -5.1), (12, 0.1, 6), green)
    scene.box("far wall", (0, 1.95, -8.1), (12, 4, 0.1), grey)
    scene.box("sky", (0, 4, -5), (6, 0.02, 3), scene.diffuse((0.8, 0.8, 0.8), 3000))
    for i in range(6):
        scene.box("post", (-2.5 + i, 0.9, -3.5 - 0.5 * (i % 3)), (0.15, 1.8, 0.15), (red, blue, white)[i % 3])
    for x in (-2, -0.667, 0.667, 2):
        scene.box("mullion", (x, 1.25, -2), (0.06, 2.5, 0.06), white)
    for y in (0.03, 1.25, 2.47):
        scene.box("transom", (0, y, -2), (4, 0.06, 0.06), white)
    material = scene.glass_of(0.006 if solid else 0, roughness)
    for x in (-1.333, 0, 1.333):
        for y in (0.64, 1.86):
            if solid:
                scene.box("pane", (x, y, -2), (1.272, 1.158, 0.006), material, 0, True)
            else:
                scene.pane("pane", (x - 0.636, y - 0.579, -2), (1.272, 0, 0), (0, 1.158, 0), material)
    scene.camera("inside", (0.6, 1.5, 1.6), (-0.2, 1.2, -2), 1.0)
    scene.camera("outside", (-0.8, 1.5, -4.9), (0.2, 1.2, -2), 0.9)
    return scene


def mirrored():
    """A bathroom: a frosted screen with towels behind it and a green block, seen in the mirror alone."""
    scene = Scene()
    scene.bake = "--reflections geometry"
    white, blue = scene.diffuse((0.75, 0.75, 0.75)), scene.diffuse((0.1, 0.2, 0.55))
    red, yellow, dark = (scene.diffuse(c) for c in ((0.6, 0.1, 0.08), (0.7, 0.5, 0.08), (0.08, 0.08, 0.08)))
    for name, middle, size, material in (
            ("floor", (0, -0.05, 0), (2.6, 0.1, 3), dark), ("ceiling", (0, 2.45, 0), (2.6, 0.1, 3), white),
            ("front", (0, 1.2, -1.35), (2.6, 2.4, 0.1), white), ("back", (0, 1.2, 1.35), (2.6, 2.4, 0.1), white),
            ("left", (-1.25, 1.2, 0), (0.1, 2.4, 2.6), blue), ("right", (1.25, 1.2, 0), (0.1, 2.4, 2.6), white),
            ("lamp", (0.2, 2.39, 0.1), (0.8, 0.02, 0.5), scene.diffuse((0.8, 0.8, 0.8), 1500)),
            ("shower lamp", (-0.7, 2.39, 1), (0.3, 0.02, 0.3), scene.diffuse((0.8, 0.8, 0.8), 1500)),
            ("plinth", (0.5, 0.55, 0.6), (0.4, 1.1, 0.3), white), ("tiles", (0.6, 1.5, 1.29), (0.5, 0.12, 0.02), yellow),
            ("more tiles", (0.6, 1.2, 1.29), (0.5, 0.12, 0.02), red), ("towel", (-0.9, 1.3, 0.65), (0.18, 0.8, 0.06), red),
            ("far towel", (-0.45, 1.3, 1.25), (0.2, 0.8, 0.06), yellow), ("shelf", (-0.6, 1.0, 1.2), (1.1, 0.04, 0.2), dark)):
        scene.box(name, middle, size, material)
    scene.box("mirror", (0, 1.4, -1.295), (1.8, 1.2, 0.01), scene.mirror())
    scene.pane("frosted screen", (-1.1, 0.1, 0.5), (1.1, 0, 0), (0, 1.9, 0), scene.glass_of(0, 0.25))
    scene.box("glass block", (0.5, 1.251, 0.6), (0.24, 0.3, 0.12), scene.glass_of(0.12, left_after_1m=(0.02, 0.4, 0.1)), 0.5, True)
    scene.glass = [[(x, y, -2.58 - z) for x, y, z in corners] for corners in scene.glass]  # the mirror's front is at -1.29
    scene.camera("in the mirror", (0.15, 1.5, -0.45), (-0.02, 1.42, -1.29), 0.9)
    return scene


def shower(bathroom):
    """A bathroom of the test assets with a screen of 10 mm before the camera."""
    scene = Scene(bathroom)
    node = next(n for n in scene.tree["nodes"] if "camera" in n)
    m = node["matrix"]
    ahead, right, eye = [-x for x in m[8:11]], m[0:3], m[12:15]
    middle = [e + 0.8 * a + 0.12 * r for e, a, r in zip(eye, ahead, right)]
    scene.box("shower screen", (middle[0], middle[1] - 0.1, middle[2]), (0.5, 1.2, 0.01),
              scene.glass_of(0.01, left_after_1m=(0.1, 0.6, 0.4)), math.atan2(-ahead[0], -ahead[2]) + 0.5, True)
    return scene
