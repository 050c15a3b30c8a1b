"""Bakes a glTF scene's irradiance with Blender Cycles. Runs inside Blender:

    blender -b --factory-startup -P bake_in_blender.py -- SCENE.glb OUT.exr SPP [RESOLUTION [SEED [BOUNCES]]]

Every mesh with a second UV set that does not emit is baked through it, all of them joined into one object, which is what
Cycles is fastest with. OUT.exr holds E / pi, row 0 being v = 0 in glTF's sense. The last line of the output is one JSON
object with the wall-clock and CPU seconds of the bake alone.
"""
import json
import os
import struct
import sys
import time

import bpy
import numpy

# Blender 3.4's glTF importer uses names that NumPy has dropped.
for name, builtin in {"bool": bool, "int": int, "float": float, "object": object}.items():
    if name not in vars(numpy):
        setattr(numpy, name, builtin)


def gltf_of(path):
    with open(path, "rb") as file:
        data = file.read()
    if data[:4] != b"glTF":
        return json.loads(data)
    (length,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20 : 20 + length])


def lambert_and_gloss(tree, gltf_material):
    """The reflection that oriel-bake traces: Lambert, GGX metal, or a dielectric's GGX over Lambert by Fresnel."""
    pbr = gltf_material.get("pbrMetallicRoughness", {})
    color = pbr.get("baseColorFactor", [1, 1, 1, 1])
    roughness = pbr.get("roughnessFactor", 1)

    def gloss(tint):
        node = tree.nodes.new("ShaderNodeBsdfGlossy")
        node.distribution = "SHARP" if roughness == 0 else "GGX"
        node.inputs["Roughness"].default_value = roughness
        node.inputs["Color"].default_value = tint
        return node.outputs[0]

    if pbr.get("metallicFactor", 1) > 0.5:
        return gloss(color)
    matt = tree.nodes.new("ShaderNodeBsdfDiffuse")
    matt.inputs["Color"].default_value = color
    extensions = gltf_material.get("extensions", {})
    if extensions.get("KHR_materials_specular", {}).get("specularFactor", 1) == 0:
        return matt.outputs[0]
    fresnel = tree.nodes.new("ShaderNodeFresnel")
    fresnel.inputs["IOR"].default_value = extensions.get("KHR_materials_ior", {}).get("ior", 1.5)
    mix = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(fresnel.outputs[0], mix.inputs[0])
    tree.links.new(matt.outputs[0], mix.inputs[1])
    tree.links.new(gloss((1, 1, 1, 1)), mix.inputs[2])
    return mix.outputs[0]


def emits(gltf_material):
    return max(gltf_material.get("emissiveFactor", [0])) > 0


def rebuild_material(material, gltf_material):
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    if emits(gltf_material):
        emission = tree.nodes.new("ShaderNodeEmission")
        emission.inputs["Color"].default_value = (*gltf_material["emissiveFactor"], 1)
        strength = gltf_material.get("extensions", {}).get("KHR_materials_emissive_strength", {})
        emission.inputs["Strength"].default_value = strength.get("emissiveStrength", 1)
        shader = emission.outputs[0]
    else:
        shader = lambert_and_gloss(tree, gltf_material)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(shader, output.inputs["Surface"])


def set_lights(gltf):
    """glTF's numbers as they stand: lux of a sun, candela of a lamp, without the factor of 683."""
    lights = gltf.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
    for node in gltf.get("nodes", []):
        index = node.get("extensions", {}).get("KHR_lights_punctual", {}).get("light")
        thing = bpy.data.objects.get(node.get("name", ""))
        if index is None or thing is None:
            continue
        lamps = [o.data for o in (thing, *thing.children) if o.type == "LIGHT"]
        for lamp in lamps:
            lamp.color = lights[index].get("color", [1, 1, 1])
            intensity = lights[index].get("intensity", 1)
            if lamp.type == "SUN":
                lamp.energy, lamp.angle = intensity, 0
            else:
                lamp.energy, lamp.shadow_soft_size = 4 * numpy.pi * intensity, 0


def set_up_cycles(scene, spp, seed, bounces):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples, cycles.seed = spp, seed
    # Debian's build has no denoiser; asked for one, it bakes zeros.
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = bounces
    cycles.transmission_bounces = cycles.volume_bounces = 0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    bake = scene.render.bake
    bake.use_selected_to_active, bake.margin = False, 0
    bake.use_pass_direct, bake.use_pass_indirect, bake.use_pass_color = True, True, False
    for node in scene.world.node_tree.nodes if scene.world and scene.world.use_nodes else []:
        if node.type == "BACKGROUND":
            node.inputs["Strength"].default_value = 0


def join_targets(materials):
    def is_target(thing):
        own = [materials.get(m.name, {}) for m in thing.data.materials if m]
        return len(thing.data.uv_layers) > 1 and thing.get("lightmap", 1) and not any(map(emits, own))

    targets = [o for o in bpy.data.objects if o.type == "MESH" and is_target(o)]
    bpy.ops.object.select_all(action="DESELECT")
    for target in targets:
        target.data.uv_layers.active_index = 1
        target.select_set(True)
    bpy.context.view_layer.objects.active = targets[0]
    if len(targets) > 1:
        bpy.ops.object.join()
    joined = bpy.context.view_layer.objects.active
    joined.data.uv_layers.active_index = 1
    return joined


def bake_into(joined, resolution):
    image = bpy.data.images.new("lightmap", resolution, resolution, alpha=True, float_buffer=True)
    image.colorspace_settings.name = "Linear" if bpy.app.version < (4, 0, 0) else "Linear Rec.709"
    for slot in joined.material_slots:
        nodes = slot.material.node_tree.nodes
        nodes.active = nodes.new("ShaderNodeTexImage")
        nodes.active.image = image
    for thing in bpy.data.objects:
        if thing.type == "MESH":
            thing.cycles.shadow_terminator_offset = thing.cycles.shadow_terminator_geometry_offset = 0
    cpu, wall = time.process_time(), time.perf_counter()
    bpy.ops.object.bake(type="DIFFUSE", pass_filter={"DIRECT", "INDIRECT"}, margin=0, use_clear=True)
    return image, {"wall_s": time.perf_counter() - wall, "cpu_s": time.process_time() - cpu}


def save(image, path):
    scene = bpy.context.scene
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.color_depth = "32"
    scene.view_settings.view_transform = "Raw"
    # Blender keeps row 0 at the bottom and writes files from the top: v = 0 of glTF, its own v = 1, comes first.
    image.save_render(path, scene=scene)


def main(scene_path, out, spp, resolution=256, seed=1, bounces=8):
    gltf = gltf_of(scene_path)
    materials = {m["name"]: m for m in gltf.get("materials", [])}
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    bpy.ops.import_scene.gltf(filepath=scene_path)
    for material in bpy.data.materials:
        if material.name in materials:
            rebuild_material(material, materials[material.name])
    set_lights(gltf)
    set_up_cycles(bpy.context.scene, int(spp), int(seed), int(bounces))
    image, times = bake_into(join_targets(materials), int(resolution))
    save(image, os.path.abspath(out))
    print("\n" + json.dumps(times))


main(*sys.argv[sys.argv.index("--") + 1 :])
