"""Moves a node of a .glb: what an edit of a scene is to a bake that knows its light from before."""
import json
import struct


def moved(glb, name, offset):
    """The bytes of the file with all nodes of that name moved by offset (x, y, z), in their parents' metres."""
    length = struct.unpack("<I", glb[12:16])[0]
    scene = json.loads(glb[20:20 + length])
    nodes = [node for node in scene["nodes"] if node.get("name") == name]
    if not nodes:
        raise ValueError(f"no node is named {name}")
    for node in nodes:
        node["translation"] = [a + b for a, b in zip(node.get("translation", [0, 0, 0]), offset)]
    text = json.dumps(scene, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    rest = glb[20 + length:]
    return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest
