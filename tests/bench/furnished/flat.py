"""Run by Blender: a flat of one to six rooms, furnished. blender -b -P flat.py -- SEED OUT.glb KIND FURNITURE"""
import glob
import math
import os
import random
import sys

import bpy
from mathutils import Matrix, Vector

SEED, OUT, KIND, FURNITURE = sys.argv[sys.argv.index("--") + 1:][:4]
HEIGHT, THICK = 2.7, 0.12  # of rooms and walls, m
BELOW_CEILING = 0.02       # where panels hang: modellers leave a gap
ROOMS = {"Living room": ["Living room", "Lights"], "Kitchen": ["Kitchen"], "Bathroom": ["Bathroom"],
         "Bedroom": ["Bedroom", "Lights"], "Office": ["Office", "Miscellaneous"]}
chance = random.Random(int(SEED))


def catalogue():
    """What the libraries' lists say of each model that is there."""
    found = []
    for path in sorted(glob.glob(os.path.join(FURNITURE, "*", "PluginFurnitureCatalog.properties"))):
        pieces = {}
        with open(path, encoding="latin-1") as file:
            for line in file:
                name, _, value = line.strip().partition("=")
                if "#" in name and not name.startswith("#"):
                    key, number = name.split("#")
                    pieces.setdefault(number, {})[key] = value.strip()
        for piece in pieces.values():
            piece["path"] = os.path.dirname(path) + piece.get("model", "")
            if piece["path"].endswith(".obj") and os.path.exists(piece["path"]):
                found.append(piece)
    return found


def material(name, colour, roughness=1.0, metallic=0.0, emission=0.0, transmission=0.0):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    inputs = made.node_tree.nodes["Principled BSDF"].inputs
    inputs["Base Color"].default_value = (*colour, 1)
    inputs["Roughness"].default_value, inputs["Metallic"].default_value = roughness, metallic
    inputs["Transmission"].default_value = transmission
    if emission:
        inputs["Emission"].default_value, inputs["Emission Strength"].default_value = (*colour, 1), emission
    return made


def mesh(name, points, faces, of):
    data = bpy.data.meshes.new(name)
    data.from_pydata(points, [], faces)
    data.materials.append(of)
    data.validate()
    bpy.context.collection.objects.link(bpy.data.objects.new(name, data))


def box(name, lower, upper, of):
    points = [(x, y, z) for x in (lower[0], upper[0]) for y in (lower[1], upper[1]) for z in (lower[2], upper[2])]
    mesh(name, points, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)], of)


def add(name, data, location, rotation=(0, 0, 0)):
    made = bpy.data.objects.new(name, data)
    made.location, made.rotation_euler = location, rotation
    bpy.context.collection.objects.link(made)
    return made


def wall(name, along_x, at, begin, end, hole, of, glass):
    """From begin to end on the line `at`; hole: begin, end, sill and head, which gets a pane where glass is given."""
    def corner(along, across, up):
        return (along, at + across, up) if along_x else (at + across, along, up)

    def part(suffix, a, b, low, high):
        if b - a > 1e-4 and high - low > 1e-4:
            box(name + suffix, corner(a, -THICK / 2, low), corner(b, THICK / 2, high), of)

    if not hole:
        part("", begin, end, 0, HEIGHT)
        return
    a, b, sill, head = hole
    part(".left", begin, a, 0, HEIGHT)
    part(".right", b, end, 0, HEIGHT)
    part(".top", a, b, head, HEIGHT)
    part(".sill", a, b, 0, sill)
    if glass:
        mesh("pane", [corner(a, 0, sill), corner(b, 0, sill), corner(b, 0, head), corner(a, 0, head)], [(0, 1, 2, 3)], glass)


def place(piece, x, y, angle):
    """A model at its catalogue's size."""
    before = set(bpy.data.objects)
    bpy.ops.import_scene.obj(filepath=piece["path"], axis_forward="-Z", axis_up="Y")
    parts = [o for o in bpy.data.objects if o not in before and o.type == "MESH"]
    if not parts:
        return
    bpy.context.view_layer.update()
    corners = [o.matrix_world @ Vector(c) for o in parts for c in o.bound_box]
    low, high = (Vector(map(f, *corners)) for f in (min, max))
    wanted = [float(piece[side]) / 100 for side in ("width", "depth", "height")]
    scale = [want / size if size > 1e-6 else 1 for want, size in zip(wanted, high - low)]
    at = add(piece["name"], None, (x, y, float(piece.get("elevation", 0)) / 100), (0, 0, angle))
    middle = (low + high) / 2
    for o in parts:
        world = o.matrix_world.copy()
        o.parent = at
        o.matrix_local = Matrix.Diagonal((*scale, 1)) @ Matrix.Translation((-middle.x, -middle.y, -low.z)) @ world


def furnish(pieces, lower, upper, count):
    """Along the walls of a room, where there is place."""
    gap, taken = 0.08, []
    for piece in (chance.choice(pieces) for _ in range(count)):
        width, depth = float(piece["width"]) / 100, float(piece["depth"]) / 100
        for _ in range(30):
            side = chance.randrange(4)
            w, d = (width, depth) if side % 2 == 0 else (depth, width)
            if w > upper[0] - lower[0] - 0.3 or d > upper[1] - lower[1] - 0.3:
                continue
            x = chance.uniform(lower[0] + w / 2 + gap, upper[0] - w / 2 - gap)
            y = chance.uniform(lower[1] + d / 2 + gap, upper[1] - d / 2 - gap)
            x = {1: lower[0] + w / 2 + gap, 3: upper[0] - w / 2 - gap}.get(side, x)
            y = {0: upper[1] - d / 2 - gap, 2: lower[1] + d / 2 + gap}.get(side, y)
            floor = (x - w / 2, y - d / 2, x + w / 2, y + d / 2)
            if any(floor[0] < t[2] and floor[2] > t[0] and floor[1] < t[3] and floor[3] > t[1] for t in taken):
                continue
            taken.append(floor)
            place(piece, x, y, (0, math.pi / 2, math.pi, -math.pi / 2)[side])
            break


def lamp(x, y, half, of):
    if KIND in ("panels", "office"):
        z = HEIGHT - BELOW_CEILING
        mesh("lamp", [(x - half, y - half, z), (x - half, y + half, z), (x + half, y + half, z), (x + half, y - half, z)],
             [(0, 1, 2, 3)], of)
        return
    bulb = bpy.data.lights.new("bulb", "POINT")
    bulb.energy, bulb.color = 60, (1, 0.85, 0.7)
    add("bulb", bulb, (x, y, HEIGHT - 0.4))


def build_rooms(pieces, across, deep, width, depth, of):
    names = list(ROOMS)
    chance.shuffle(names)
    for i in range(across * deep):
        name = "Office" if KIND == "office" else names[i % len(names)]
        x, y = i // deep * width, i % deep * depth
        lower, upper = (x + THICK / 2, y + THICK / 2), (x + width - THICK / 2, y + depth - THICK / 2)
        if name == "Bathroom":
            mesh("tiles", [(*lower, 0.003), (upper[0], lower[1], 0.003), (*upper, 0.003), (lower[0], upper[1], 0.003)],
                 [(0, 1, 2, 3)], of["tiles"])
        if name in ("Bathroom", "Bedroom"):
            a = lower[0] + 0.01
            mesh("mirror", [(a, y + 1, 0.8), (a, y + 2, 0.8), (a, y + 2, 1.9), (a, y + 1, 1.9)], [(0, 1, 2, 3)], of["mirror"])
        furnish([p for p in pieces if p["category"] in ROOMS[name]], lower, upper, 26 if KIND == "office" else chance.randint(5, 9))
        if KIND == "office":
            for k in range(8):
                lamp(x + 1.5 + k // 2 * 3, y + 2 + k % 2 * 4, 0.6, of["lamp"])
        else:
            lamp(x + width / 2, y + depth / 2, 0.3, of["lamp"])


def build_walls(along_x, lines, cells, line_step, cell_step, of):
    for line in range(lines + 1):
        for cell in range(cells):
            begin, end, outer = cell * cell_step, (cell + 1) * cell_step, line in (0, lines)
            middle = (begin + end) / 2
            hole = (middle - 0.75, middle + 0.75, 0.9, 2.2) if outer else (begin + 0.5, begin + 1.4, 0, 2.05)
            if outer and chance.random() < 0.4:
                hole = None
            wall(f"wall {'x' if along_x else 'y'}{line}.{cell}", along_x, line * line_step, begin, end, hole, of["wall"],
                 of["glass"] if outer else None)


def build():
    of = {"wall": material("wall", (0.75, 0.73, 0.7)), "floor": material("parquet", (0.45, 0.3, 0.18), 0.25),
          "tiles": material("tiles", (0.7, 0.72, 0.72), 0.1), "ceiling": material("ceiling", (0.85, 0.85, 0.85)),
          "lamp": material("panel", (1, 0.93, 0.83), emission=12), "glass": material("glass", (1, 1, 1), 0, transmission=1),
          "mirror": material("mirror", (0.95, 0.95, 0.95), 0, 1), "grass": material("grass", (0.12, 0.25, 0.08))}
    across, deep, width, depth = (1, 1, 12, 8) if KIND == "office" else (
        *chance.choice([(1, 1), (2, 1), (2, 2), (3, 2)]), chance.uniform(3.6, 4.8), chance.uniform(3.4, 4.4))
    x, y = across * width + THICK, deep * depth + THICK
    box("slab", (-THICK, -THICK, -0.2), (x, y, 0), of["floor"])
    box("roof", (-THICK, -THICK, HEIGHT), (x, y, HEIGHT + 0.2), of["ceiling"])
    fitting = [p for p in catalogue() if float(p["width"]) < 260 and float(p["depth"]) < 230 and float(p["height"]) < 240
               and p.get("doorOrWindow") != "true"]
    build_rooms(fitting, across, deep, width, depth, of)
    build_walls(False, across, deep, width, depth, of)
    build_walls(True, deep, across, depth, width, of)
    if KIND == "sun":
        sun = bpy.data.lights.new("sun", "SUN")
        sun.energy = 4
        add("sun", sun, (0, 0, 10), (0.9, 0.1, chance.uniform(0, 2 * math.pi)))
        mesh("lawn", [(-15, -15, -0.21), (x + 15, -15, -0.21), (x + 15, y + 15, -0.21), (-15, y + 15, -0.21)],
             [(0, 1, 2, 3)], of["grass"])
    for k in range(4):
        add(f"eye{k}", bpy.data.cameras.new(f"eye{k}"), (chance.uniform(0.6, x - 0.8), chance.uniform(0.6, y - 0.8), 1.6),
            (math.pi / 2 - 0.1, 0, chance.uniform(0, 2 * math.pi)))
    return across * deep


def mend_materials():
    """Blender's exporter divides by zero where an index of refraction is 1."""
    for made in bpy.data.materials:
        for node in made.node_tree.nodes if made.use_nodes else []:
            if node.type == "BSDF_PRINCIPLED" and node.inputs["IOR"].default_value < 1.01:
                node.inputs["IOR"].default_value = 1.45


bpy.ops.wm.read_factory_settings(use_empty=True)
for addon in ("io_scene_obj", "io_scene_gltf2"):
    bpy.ops.preferences.addon_enable(module=addon)
rooms = build()
mend_materials()
bpy.ops.export_scene.gltf(filepath=OUT, export_format="GLB", export_lights=True, export_cameras=True, export_yup=True)
triangles = sum(len(p.vertices) - 2 for o in bpy.data.objects if o.type == "MESH" for p in o.data.polygons)
print(f"flat: {rooms} rooms, {triangles} triangles, {OUT}")
