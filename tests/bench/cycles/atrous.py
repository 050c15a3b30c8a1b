"""An edge-avoiding à-trous filter over a lightmap that Cycles baked: the denoiser that stands beside it in docs/notes/benchmarks.md.

Irradiance without albedo, filtered over texels of the page (Dammertz et al. 2010), guided by what lies under the texels'
centres, position and normal, and by how much their light differs for its noise (Schied et al. 2017, SVGF). The noise is
told by two bakes of half the samples each, whose mean is filtered: together they cost what one of all samples does.
"""
import numpy

import glb

KERNEL = (1 / 16, 1 / 4, 3 / 8, 1 / 4, 1 / 16)
TYPES = {5121: "<u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
SIZES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def accessor(gltf, binary, index):
    """Of buffers whose values lie side by side."""
    found = gltf["accessors"][index]
    view = gltf["bufferViews"][found["bufferView"]]
    size = SIZES[found["type"]]
    offset = view.get("byteOffset", 0) + found.get("byteOffset", 0)
    return numpy.frombuffer(binary, TYPES[found["componentType"]], found["count"] * size, offset).reshape(-1, size)


class Guides:
    """Position and normal under each texel's centre, and the side of a texel, m; nodes must not be moved."""

    def __init__(self, scene, side):
        self.position, self.normal = numpy.zeros((side, side, 3)), numpy.zeros((side, side, 3))
        self.covered = numpy.zeros((side, side), bool)
        self.step = numpy.ones((side, side))
        gltf, binary = glb.read(scene)
        for node in gltf["nodes"]:
            for primitive in gltf["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []:
                names = primitive["attributes"]
                if "TEXCOORD_1" not in names or node.get("extras", {}).get("lightmap", 1) == 0:
                    continue
                position, normal, uv = (accessor(gltf, binary, names[n]).astype(float) for n in ("POSITION", "NORMAL", "TEXCOORD_1"))
                corners = accessor(gltf, binary, primitive["indices"]).reshape(-1, 3) if "indices" in primitive else \
                    numpy.arange(len(position)).reshape(-1, 3)
                for triangle in corners:
                    self.rasterise(position[triangle], normal[triangle], uv[triangle] * side)

    def rasterise(self, position, normal, uv):
        edges = uv[1:] - uv[0]
        area = edges[0, 0] * edges[1, 1] - edges[0, 1] * edges[1, 0]
        if abs(area) < 1e-12:
            return
        low = numpy.maximum(numpy.floor(uv.min(0)).astype(int), 0)
        high = numpy.minimum(numpy.ceil(uv.max(0)).astype(int), self.covered.shape[0])
        x, y = numpy.meshgrid(numpy.arange(low[0], high[0]), numpy.arange(low[1], high[1]))
        at = numpy.stack([x, y], -1) + 0.5 - uv[0]
        b = (at[..., 0] * edges[1, 1] - at[..., 1] * edges[1, 0]) / area
        c = (at[..., 1] * edges[0, 0] - at[..., 0] * edges[0, 1]) / area
        inside = (b >= -1e-6) & (c >= -1e-6) & (b + c <= 1 + 1e-6)
        x, y = x[inside], y[inside]
        w = numpy.stack([1 - b - c, b, c], -1)[inside]
        self.position[y, x], self.covered[y, x] = w @ position, True
        n = w @ normal
        self.normal[y, x] = n / numpy.linalg.norm(n, axis=-1, keepdims=True)
        world = numpy.linalg.norm(numpy.cross(position[1] - position[0], position[2] - position[0]))
        self.step[y, x] = numpy.sqrt(world / abs(area))


def shifted(image, dx, dy):
    """What lies dx, dy further; beyond the page nothing."""
    out = numpy.zeros_like(image)
    height, width = image.shape[:2]
    ys, xs = slice(max(0, -dy), min(height, height - dy)), slice(max(0, -dx), min(width, width - dx))
    yt, xt = slice(max(0, dy), min(height, height + dy)), slice(max(0, dx), min(width, width + dx))
    out[ys, xs] = image[yt, xt]
    return out


def near(guides, dx, dy):
    """Weights by geometry: neighbours on the page that are so in the world, on one plane, with one normal."""
    there, normal = shifted(guides.position, dx, dy), shifted(guides.normal, dx, dy)
    away = there - guides.position
    distance = numpy.linalg.norm(away, axis=-1) / (guides.step * max(1.0, numpy.hypot(dx, dy)))
    off_plane = numpy.abs((away * guides.normal).sum(-1)) / guides.step
    alike = numpy.maximum((guides.normal * normal).sum(-1), 0) ** 64
    return (guides.covered & shifted(guides.covered, dx, dy) & (distance < 2.5)) * alike * numpy.exp(-off_plane)


def luminance(image):
    return image @ numpy.array([0.2126, 0.7152, 0.0722])


def pooled(variance, guides):
    """The variance that two bakes tell of, over 7 x 7 neighbours."""
    total, weight = numpy.zeros_like(variance), numpy.zeros_like(variance)
    for dy in range(-3, 4):
        for dx in range(-3, 4):
            w = near(guides, dx, dy)
            total, weight = total + w * shifted(variance, dx, dy), weight + w
    return total / numpy.maximum(weight, 1e-12)


def denoise(halves, guides, levels=3, strength=4.0):
    """The mean of both, filtered by `levels` passes with steps of 1, 2, 4, ... texels. What is set is what served the gallery best."""
    a, b = (numpy.nan_to_num(half) for half in halves)
    image = 0.5 * (a + b)
    variance = pooled(luminance(0.5 * (a - b)) ** 2, guides)
    for level in range(levels):
        step = 2**level
        total, weight, spread = numpy.zeros_like(image), numpy.zeros_like(variance), numpy.zeros_like(variance)
        light, noise = luminance(image), numpy.sqrt(variance)
        for ky in range(5):
            for kx in range(5):
                dx, dy = (kx - 2) * step, (ky - 2) * step
                differs = numpy.abs(shifted(light, dx, dy) - light) / (strength * noise + 1e-6)
                w = KERNEL[kx] * KERNEL[ky] * near(guides, dx, dy) * numpy.exp(-differs)
                total += w[..., None] * shifted(image, dx, dy)
                spread += w**2 * shifted(variance, dx, dy)
                weight += w
        safe = numpy.maximum(weight, 1e-12)
        image = numpy.where(guides.covered[..., None], total / safe[..., None], image)
        variance = spread / safe**2
    return image
