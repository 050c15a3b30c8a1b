// A glTF file to standard output: two panes of one mesh that blend, one behind the other, and a camera on either side. The mesh has the red
// one first.
const quad = (z) => [-1, 0, z, 1, 0, z, 1, 2, z, -1, 2, z];
const floats = [...quad(0.2), ...quad(-0.2), ...[[1, 0, 0, 0.5], [0, 0, 1, 0.5]].flatMap((c) => [c, c, c, c].flat())];
const triangles = [0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7], bytes = Buffer.alloc(4 * floats.length + 4 * triangles.length);
floats.forEach((x, i) => bytes.writeFloatLE(x, 4 * i));
triangles.forEach((x, i) => bytes.writeUInt32LE(x, 4 * (floats.length + i)));
const view = (byteOffset, byteLength) => ({ buffer: 0, byteOffset, byteLength });
const camera = (name, z, rotation) => ({ name, camera: 0, translation: [0, 1, z], rotation });
console.log(JSON.stringify({
  asset: { version: '2.0' }, extensionsUsed: ['KHR_materials_unlit'], scene: 0, scenes: [{ nodes: [0, 1, 2] }],
  nodes: [{ mesh: 0 }, camera('front', 4, [0, 0, 0, 1]), camera('back', -4, [0, 1, 0, 0])],
  cameras: [{ type: 'perspective', perspective: { yfov: 0.6, znear: 0.1 } }],
  meshes: [{ primitives: [{ attributes: { POSITION: 0, COLOR_0: 1 }, indices: 2, material: 0 }] }],
  materials: [{ alphaMode: 'BLEND', doubleSided: true, extensions: { KHR_materials_unlit: {} } }],
  accessors: [
    { bufferView: 0, componentType: 5126, count: 8, type: 'VEC3', min: [-1, 0, -0.2], max: [1, 2, 0.2] },
    { bufferView: 1, componentType: 5126, count: 8, type: 'VEC4' }, { bufferView: 2, componentType: 5125, count: 12, type: 'SCALAR' }],
  bufferViews: [view(0, 96), view(96, 128), view(224, 48)],
  buffers: [{ byteLength: bytes.length, uri: `data:application/octet-stream;base64,${bytes.toString('base64')}` }],
}));
