"""Binary glTF files as far as the bench needs them: one file's meshes put into another as a mover."""
import json
import struct


def read(path):
    data = open(path, "rb").read()
    size = struct.unpack_from("<I", data, 12)[0]
    binary = 20 + size
    return json.loads(data[20:binary]), data[binary + 8:] if len(data) > binary else b""


def write(path, tree, binary):
    tree["buffers"] = [{"byteLength": len(binary)}]
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    with open(path, "wb") as out:
        out.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)))
        out.write(struct.pack("<I4s", len(text), b"JSON") + text)
        out.write(struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def add_movers(scene, mover, names, scale, place):
    """Puts the root nodes of `mover` into `scene`, each (tree, binary), under marked nodes of those names at `place`."""
    tree, binary = scene
    added, more = mover
    binary += b"\0" * (-len(binary) % 4)
    first = {kind: len(tree.get(kind, [])) for kind in ("bufferViews", "accessors", "materials", "meshes", "nodes",
                                                        "textures", "images", "samplers")}
    for view in added["bufferViews"]:
        view["byteOffset"] = view.get("byteOffset", 0) + len(binary)
        view["buffer"] = 0
    for accessor in added["accessors"]:
        accessor["bufferView"] += first["bufferViews"]
    for mesh in added["meshes"]:
        for primitive in mesh["primitives"]:
            primitive["attributes"] = {k: v + first["accessors"] for k, v in primitive["attributes"].items()}
            if "indices" in primitive:
                primitive["indices"] += first["accessors"]
            if "material" in primitive:
                primitive["material"] += first["materials"]
    if added.get("textures"):
        raise ValueError("the mover has textures, expected none")
    for kind in ("bufferViews", "accessors", "materials", "meshes"):
        tree.setdefault(kind, []).extend(added.get(kind, []))
    roots = added["scenes"][added.get("scene", 0)]["nodes"]
    for name in names:
        for root in roots:
            node = dict(added["nodes"][root])
            if node.get("children"):
                raise ValueError("the mover's nodes have children, expected none")
            node["mesh"] += first["meshes"]
            node["scale"] = [scale * s for s in node.get("scale", [1, 1, 1])]
            node.update(name=name, translation=list(place), extras={"oriel": {"mover": True}})
            tree["scenes"][tree.get("scene", 0)]["nodes"].append(len(tree["nodes"]))
            tree["nodes"].append(node)
    return tree, binary + more
