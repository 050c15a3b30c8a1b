"""Reads, changes and writes .glb files, as far as the scenes of these benchmarks need it."""
import json
import struct


def read(path):
    """glTF's JSON and the binary chunk."""
    with open(path, "rb") as file:
        data = file.read()
    (length,) = struct.unpack_from("<I", data, 12)
    binary = 20 + length
    (size,) = struct.unpack_from("<I", data, binary)
    return json.loads(data[20:binary]), data[binary + 8 : binary + 8 + size]


def write(path, gltf, binary):
    binary += b"\0" * (-len(binary) % 4)
    gltf["buffers"] = [{"byteLength": len(binary)}]
    text = json.dumps(gltf).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(b"glTF" + struct.pack("<II", 2, 28 + len(text) + len(binary)))
        file.write(struct.pack("<I", len(text)) + b"JSON" + text)
        file.write(struct.pack("<I", len(binary)) + b"BIN\0" + binary)


def make_lambert(source, path):
    """The same scene with diffuse reflection only: what the two tools' glossy materials differ by is left out."""
    gltf, binary = read(source)
    for material in gltf.get("materials", []):
        material.setdefault("pbrMetallicRoughness", {}).update(metallicFactor=0, roughnessFactor=1)
        material.setdefault("extensions", {})["KHR_materials_specular"] = {"specularFactor": 0}
    gltf["extensionsUsed"] = sorted({*gltf.get("extensionsUsed", []), "KHR_materials_specular"})
    write(path, gltf, binary)


def cut(corners, parts):
    """A triangle as parts x parts alike; corners: tuples of numbers."""
    def at(i, j):
        weights = (parts - i - j) / parts, i / parts, j / parts
        return tuple(sum(w * c[k] for w, c in zip(weights, corners)) for k in range(len(corners[0])))

    for i in range(parts):
        for j in range(parts - i):
            yield at(i, j), at(i + 1, j), at(i, j + 1)
            if i + j + 2 <= parts:
                yield at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)


def vectors(gltf, binary, index):
    accessor = gltf["accessors"][index]
    view = gltf["bufferViews"][accessor["bufferView"]]
    kind = {5123: "H", 5125: "I", 5126: "3f"}[accessor["componentType"]]
    size = struct.calcsize("<" + kind)
    offset = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return list(struct.iter_unpack("<" + kind, binary[offset : offset + size * accessor["count"]]))


def cut_lamps(source, path, parts=16):
    """The same scene with every plain lamp's triangles cut into parts x parts: of a large one Cycles 3.4 loses light."""
    gltf, binary = read(source)
    binary = bytearray(binary)

    def append(values):
        data = b"".join(struct.pack("<3f", *v) for v in values)
        gltf["bufferViews"].append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
        binary.extend(data)
        bounds = {"min": [min(v[k] for v in values) for k in range(3)], "max": [max(v[k] for v in values) for k in range(3)]}
        gltf["accessors"].append({"bufferView": len(gltf["bufferViews"]) - 1, "componentType": 5126, "count": len(values),
                                  "type": "VEC3", **bounds})
        return len(gltf["accessors"]) - 1

    for mesh in gltf["meshes"]:
        for primitive in mesh["primitives"]:
            if max(gltf["materials"][primitive["material"]].get("emissiveFactor", [0])) <= 0:
                continue
            corner = [i for (i,) in vectors(gltf, binary, primitive["indices"])] if "indices" in primitive else None
            cuts = {}
            for name in ("POSITION", "NORMAL"):
                values = vectors(gltf, binary, primitive["attributes"][name])
                values = [values[i] for i in corner] if corner else values
                whole = [values[k : k + 3] for k in range(0, len(values), 3)]
                cuts[name] = append([v for triangle in whole for part in cut(triangle, parts) for v in part])
            primitive.pop("indices", None)
            primitive["attributes"] = cuts
    write(path, gltf, bytes(binary))
