// Scenes of other formats, written as text.
#pragma once

#include <string>

namespace oriel::test {

// An IFC of one wall of 4 × 0.2 × 3 units that stands on the ground at (1, 2), of red brick.
std::string ifc_wall(const std::string& unit);
// The same as IFC 4 writes it: no owner, styles without assignment; with a tessellated table of 1 × 0.6 × 0.7 at the
// origin.
std::string ifc4_wall();
// A Collada file of one triangle (0,0,0) (2,0,0) (0,0,3) in a node, with a point light, a spot and a camera.
std::string collada(const std::string& asset, const std::string& effect = "", const std::string& images = "");
// An ASCII FBX of a quadrilateral 200 × 100 in the first two axes, as its settings have it.
std::string fbx(const std::string& settings, const std::string& objects = "", const std::string& connections = "");
// A 3DS of one triangle, 10 units wide and 4 high, of a blue material.
std::string three_ds();
// A binary STL of these triangles, 9 floats each.
std::string binary_stl(const std::string& floats);
// A 2 × 2 picture of one colour: TGA, which glTF does not know.
std::string tga(unsigned char r, unsigned char g, unsigned char b);

}  // namespace oriel::test
