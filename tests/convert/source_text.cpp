#include "tests/convert/source_text.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>

namespace oriel::test {

std::string ifc_wall(const std::string& unit) {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('ViewDefinition [CoordinationView]'),'2;1');\n"
         "FILE_NAME('t.ifc','2020-01-01T00:00:00',('a'),('b'),'c','d','e');\nFILE_SCHEMA(('IFC2X3'));\nENDSEC;\nDATA;\n"
         "#1=IFCPERSON($,$,'a',$,$,$,$,$);\n#2=IFCORGANIZATION($,'o',$,$,$);\n#3=IFCPERSONANDORGANIZATION(#1,#2,$);\n"
         "#4=IFCAPPLICATION(#2,'1','app','app');\n#5=IFCOWNERHISTORY(#3,#4,$,.ADDED.,$,$,$,0);\n"
         "#6=IFCDIRECTION((1.,0.,0.));\n#7=IFCDIRECTION((0.,0.,1.));\n#8=IFCCARTESIANPOINT((0.,0.,0.));\n"
         "#9=IFCAXIS2PLACEMENT3D(#8,#7,#6);\n#10=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#9,$);\n#11=" +
         unit +
         ";\n#12=IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.);\n#13=IFCUNITASSIGNMENT((#11,#12));\n"
         "#14=IFCPROJECT('0YvctVUKr0kugbFTf53O9L',#5,'P',$,$,$,$,(#10),#13);\n#15=IFCLOCALPLACEMENT($,#9);\n"
         "#16=IFCBUILDING('1YvctVUKr0kugbFTf53O9L',#5,'B',$,$,#15,$,$,.ELEMENT.,$,$,$);\n"
         "#17=IFCBUILDINGSTOREY('2YvctVUKr0kugbFTf53O9L',#5,'S',$,$,#15,$,$,.ELEMENT.,0.);\n"
         "#18=IFCRELAGGREGATES('3YvctVUKr0kugbFTf53O9L',#5,$,$,#14,(#16));\n"
         "#19=IFCRELAGGREGATES('4YvctVUKr0kugbFTf53O9L',#5,$,$,#16,(#17));\n#20=IFCCARTESIANPOINT((1.,2.,0.));\n"
         "#21=IFCAXIS2PLACEMENT3D(#20,#7,#6);\n#22=IFCLOCALPLACEMENT(#15,#21);\n#23=IFCCARTESIANPOINT((2.,0.1));\n"
         "#24=IFCDIRECTION((1.,0.));\n#25=IFCAXIS2PLACEMENT2D(#23,#24);\n"
         "#26=IFCRECTANGLEPROFILEDEF(.AREA.,$,#25,4.,0.2);\n#27=IFCEXTRUDEDAREASOLID(#26,#9,#7,3.);\n"
         "#28=IFCSHAPEREPRESENTATION(#10,'Body','SweptSolid',(#27));\n#29=IFCPRODUCTDEFINITIONSHAPE($,$,(#28));\n"
         "#30=IFCWALLSTANDARDCASE('5YvctVUKr0kugbFTf53O9L',#5,'North',$,$,#22,#29,$);\n"
         "#31=IFCRELCONTAINEDINSPATIALSTRUCTURE('6YvctVUKr0kugbFTf53O9L',#5,$,$,(#30),#17);\n"
         "#40=IFCCOLOURRGB($,0.8,0.2,0.1);\n"
         "#41=IFCSURFACESTYLERENDERING(#40,0.,$,$,$,$,IFCNORMALISEDRATIOMEASURE(0.5),IFCSPECULAREXPONENT(64.),"
         ".NOTDEFINED.);\n#42=IFCSURFACESTYLE('Brick',.BOTH.,(#41));\n#43=IFCPRESENTATIONSTYLEASSIGNMENT((#42));\n"
         "#44=IFCSTYLEDITEM(#27,(#43),$);\nENDSEC;\nEND-ISO-10303-21;\n";
}

std::string ifc4_wall() {
  std::string text = ifc_wall("IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)");
  const auto put = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  };
  put("IFC2X3", "IFC4");
  put("',#5,", "',$,");
  put("#43=IFCPRESENTATIONSTYLEASSIGNMENT((#42));\n", "");
  put("(#43)", "(#42)");
  put("(#30)", "(#30,#57)");
  put("ENDSEC;\nEND-ISO",
      "#50=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(1.,0.,0.),(1.,0.6,0.),(0.,0.6,0.),(0.,0.,0.7),(1.,0.,0.7),(1.,0.6,0.7),"
      "(0.,0.6,0.7)));\n#51=IFCTRIANGULATEDFACESET(#50,$,.T.,((1,4,3),(1,3,2),(5,6,7),(5,7,8)),$);\n"
      "#52=IFCINDEXEDPOLYGONALFACE((1,2,6,5));\n#53=IFCINDEXEDPOLYGONALFACE((3,4,8,7));\n"
      "#54=IFCPOLYGONALFACESET(#50,.F.,(#52,#53),$);\n#55=IFCSHAPEREPRESENTATION(#10,'Body','Tessellation',(#51,#54));"
      "\n"
      "#56=IFCPRODUCTDEFINITIONSHAPE($,$,(#55));\n"
      "#57=IFCFURNITURE('7YvctVUKr0kugbFTf53O9L',$,'Table',$,$,#15,#56,$,.NOTDEFINED.);\n#58=IFCSTYLEDITEM(#51,(#42),$)"
      ";\n"
      "ENDSEC;\nEND-ISO");
  return text;
}

std::string collada(const std::string& asset, const std::string& effect, const std::string& images) {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>)" +
         asset + R"(</asset><library_images>)" + images + R"(</library_images>
<library_effects><effect id="e"><profile_COMMON>)" +
         (effect.empty() ? R"(<technique sid="t"><phong><diffuse><color>0.5 0.25 0.125 1</color></diffuse>
<specular><color>0.2 0.2 0.2 1</color></specular><shininess><float>30</float></shininess></phong></technique>)"
                         : effect) +
         R"(</profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="paint"><instance_effect url="#e"/></material></library_materials>
<library_lights><light id="l" name="l"><technique_common><point><color>2 1 1</color></point></technique_common></light>
<light id="s" name="s"><technique_common><spot><color>1 1 1</color><falloff_angle>60</falloff_angle></spot>
</technique_common></light></library_lights>
<library_cameras><camera id="c" name="c"><optics><technique_common><perspective><xfov>90</xfov><aspect_ratio>2</aspect_ratio>
<znear>0.1</znear><zfar>9</zfar></perspective></technique_common></optics></camera></library_cameras>
<library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 2 0 0 0 0 3</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<source id="u"><float_array id="ua" count="6">0 0 1 0 0 1</float_array><technique_common>
<accessor source="#ua" count="3" stride="2"><param name="S" type="float"/><param name="T" type="float"/></accessor>
</technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="k"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#u" offset="1" set="0"/><p>0 0 1 1 2 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="vs"><node id="house" name="house"><node id="wall" name="wall"><instance_geometry
 url="#g"><bind_material><technique_common><instance_material symbol="k" target="#m"><bind_vertex_input semantic="UVMap"
 input_semantic="TEXCOORD" input_set="0"/></instance_material></technique_common></bind_material></instance_geometry></node>
<node id="lamp" name="lamp"><translate>0 0 2</translate><instance_light url="#l"/></node>
<node id="beam" name="beam"><translate>1 0 2</translate><instance_light url="#s"/></node>
<node id="eye" name="eye"><translate>0 -4 1</translate><rotate>1 0 0 90</rotate><instance_camera url="#c"/></node></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#vs"/></scene></COLLADA>)";
}

std::string fbx(const std::string& settings, const std::string& objects, const std::string& connections) {
  return "; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7300\n}\n"
         "GlobalSettings:  {\n\tVersion: 1000\n\tProperties70:  {\n" +
         settings +
         "\t}\n}\nObjects:  {\n\tGeometry: 10, \"Geometry::g\", \"Mesh\" {\n\t\tVertices: *12 {\n"
         "\t\t\ta: 0,0,0,200,0,0,200,100,0,0,100,0\n\t\t}\n\t\tPolygonVertexIndex: *4 {\n\t\t\ta: 0,1,2,-4\n\t\t}\n"
         "\t\tGeometryVersion: 124\n\t}\n\tModel: 20, \"Model::wall\", \"Mesh\" {\n\t\tVersion: 232\n\t}\n" +
         objects + "}\nConnections:  {\n\tC: \"OO\",20,0\n\tC: \"OO\",10,20\n" + connections + "}\n";
}

namespace {

template <class T>
std::string bytes_of(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof(T)};
}
std::string chunk(std::uint16_t id, const std::string& content) {
  return bytes_of(id) + bytes_of(static_cast<std::uint32_t>(content.size() + 6)) + content;
}
std::string text0(const std::string& text) {
  return text + '\0';
}

}  // namespace

std::string three_ds() {
  std::string vertices = bytes_of<std::uint16_t>(3), faces = bytes_of<std::uint16_t>(1);
  for (const float x : {0.f, 0.f, 0.f, 10.f, 0.f, 0.f, 0.f, 0.f, 4.f}) vertices += bytes_of(x);
  for (const std::uint16_t i : {0, 1, 2, 7}) faces += bytes_of(i);
  const std::string blue = std::string("\x00\x00\xFF", 3);
  const std::string used = text0("blue") + bytes_of<std::uint16_t>(1) + bytes_of<std::uint16_t>(0);
  const std::string mesh = chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, faces + chunk(0x4130, used)));
  const std::string material = chunk(0xAFFF, chunk(0xA000, text0("blue")) + chunk(0xA020, chunk(0x0011, blue)));
  return chunk(0x4D4D, chunk(0x0002, bytes_of<std::uint32_t>(3)) +
                           chunk(0x3D3D, material + chunk(0x4000, text0("wall") + mesh)));
}

std::string binary_stl(const std::string& floats) {
  std::string out(80, ' ');
  const std::size_t triangle = 36;
  out += bytes_of(static_cast<std::uint32_t>(floats.size() / triangle));
  for (std::size_t at = 0; at + triangle <= floats.size(); at += triangle)
    out += std::string(12, '\0') + floats.substr(at, triangle) + std::string(2, '\0');
  return out;
}

std::string tga(unsigned char r, unsigned char g, unsigned char b) {
  std::string out("\0\0\x02\0\0\0\0\0\0\0\0\0\x02\0\x02\0\x18\x20", 18);
  for (int i = 0; i < 4; ++i) out += {static_cast<char>(b), static_cast<char>(g), static_cast<char>(r)};
  return out;
}

}  // namespace oriel::test
