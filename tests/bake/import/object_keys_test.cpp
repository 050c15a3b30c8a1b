#include "bake/import/object_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bake/import/gltf_maker.h"

namespace oriel {
namespace {

using test::Gltf;
using test::import;
using test::Imported;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Imported import_with(const Json& extras, const std::string& rule = "") {
  Gltf g = test::triangle();
  g.doc["nodes"][0]["name"] = "crate";
  g.doc["nodes"][0]["extras"] = extras;
  g.add_triangle()["name"] = "shelf";
  ImportOptions options;
  if (!rule.empty()) options.objects = parse_object_rules(rule).value();
  return import(g, options);
}

TEST(ObjectKeys, AreTakenAsBlenderMaxAndMayaWriteThem) {
  for (const Json& extras : {Json{{"oriel", {{"mover", true}}}}, Json{{"oriel", {{"mover", 1}}}},
                             Json{{"oriel.mover", 1}}, Json{{"oriel_mover", "true"}}})
    EXPECT_EQ(import_with(extras).scene().movers.size(), 1u) << extras.dump();
  EXPECT_TRUE(import_with(Json{{"oriel", {{"mover", 0}}}}).scene().movers.empty());
}

TEST(ObjectKeys, EachDoesWhatItSays) {
  EXPECT_EQ(import_with({{"oriel", {{"exclude", true}}}}).scene().surfaces.size(), 1u);
  EXPECT_FLOAT_EQ(import_with({{"oriel_texel", "2cm"}}).scene().surfaces[0].texel_m, 0.02f);
  EXPECT_FLOAT_EQ(import_with({{"oriel_texel", 0.5}}).scene().surfaces[0].texel_m, 0.5f);
  EXPECT_FLOAT_EQ(import_with({{"oriel_density", 40}}).scene().surfaces[0].texel_m, 0.025f);
  EXPECT_EQ(import_with({{"oriel_light_group", "desk"}}).scene().surfaces[0].group_mark, "desk");
  const Imported r = import_with({{"oriel", {{"two_sided", true}, {"reflections", "off"}, {"metal", "gold"}}}});
  const SceneMaterial& own = r.scene().materials[r.scene().surfaces[0].material];
  EXPECT_TRUE(own.double_sided);
  EXPECT_FALSE(own.reflections);
  EXPECT_EQ(own.metal, Metal::kGold);
  const SceneMaterial& other = r.scene().materials[r.scene().surfaces[1].material];
  EXPECT_TRUE(other.reflections && !other.double_sided);
}

TEST(ObjectKeys, UnknownOnesAndValuesAreSaid) {
  EXPECT_TRUE(import_with({{"oriel", {{"movr", true}}}}).warned("movr: is no key; the nearest are \"mover\""));
  EXPECT_TRUE(import_with({{"oriel_mover", "perhaps"}}).warned("found perhaps, expected true or false"));
  EXPECT_TRUE(import_with({{"oriel_texel", "2 feet"}}).warned("expected"));
  EXPECT_TRUE(import_with({{"oriel_density", -3}}).warned("found -3, expected texels a metre"));
  EXPECT_FALSE(import_with({{"oriel", {{"angular_diameter_deg", 1}}}}).warned("no key"));
  EXPECT_TRUE(import_with({{"oriel", {{std::string("a\0b", 3), 1}}}}).warned("is no key"));
  EXPECT_TRUE(import_with({{"oriel_light_group", Json::array({1, 2})}}).warned("found no number, text, true or false"));
  EXPECT_TRUE(import_with({{"oriel", "anybody's"}}).ok());
  Gltf g = test::triangle();
  g.material()["extras"] = {{"oriel", {{"texel", "2cm"}}}};
  EXPECT_TRUE(import(g).warned("are a node's"));
}

TEST(ObjectKeys, RulesGoOverTheFileAndDownTheTree) {
  EXPECT_EQ(import_with({{"oriel", {{"mover", true}}}}, "cr?te:mover=false,texel=1cm").scene().movers.size(), 0u);
  Gltf g = test::triangle();
  g.doc["nodes"][0]["name"] = "group";
  g.add_triangle()["name"] = "below";
  g.doc["nodes"][0]["children"] = {1};
  g.doc["scenes"][0]["nodes"] = {0};
  ImportOptions options;
  options.objects = parse_object_rules("group:texel=3cm").value();
  EXPECT_FLOAT_EQ(import(g, options).scene().surfaces[1].texel_m, 0.03f);
  options.objects = parse_object_rules("group/below:exclude").value();
  EXPECT_EQ(import(g, options).scene().surfaces.size(), 1u);
  options.objects = parse_object_rules("group:exclude,two_sided").value();
  EXPECT_FALSE(import(g, options).ok()) << "nothing is left";
  const auto more = parse_object_rules("below:exclude=false").value();
  options.objects.insert(options.objects.end(), more.begin(), more.end());
  const Imported kept = import(g, options);
  ASSERT_EQ(kept.scene().surfaces.size(), 1u);
  EXPECT_TRUE(kept.scene().material_of(0).double_sided);
}

TEST(ObjectKeys, RulesAreReadAndWritten) {
  const auto rules = parse_object_rules("a:b:mover,texel=2cm").value();
  ASSERT_EQ(rules.size(), 1u);
  EXPECT_EQ(rules[0].nodes, "a:b");
  EXPECT_THAT(rules[0].keys, ElementsAre(std::pair("mover", ""), std::pair("texel", "2cm")));
  EXPECT_EQ(text_of(rules[0]), "a:b:mover,texel=2cm");
  for (const char* wrong : {"crate", ":mover", "crate:", "crate:movr", "crate:texel", "crate:texel=0", "crate:mover=2"})
    EXPECT_FALSE(parse_object_rules(wrong)) << wrong;
  EXPECT_EQ(parse_object_rules("crate:light_group=a:b").value()[0].keys[0].second, "a:b");
  const test::TempFolder folder;
  const auto file = [&](const std::string& json) { return folder.write("keys.json", json).string(); };
  const auto read =
      parse_object_rules(file(R"({"a*": {"texel": 0.5, "mover": true}, "b": {"metal": "gold"}})")).value();
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(text_of(read[0]), "a*:texel=0.5,mover=true");
  for (const char* wrong : {R"({"a": true})", R"({"a": {"movr": 1}})", "[]", "{"}) {
    const auto refused = parse_object_rules(file(wrong));
    ASSERT_FALSE(refused) << wrong;
    EXPECT_THAT(refused.error().text(), HasSubstr("keys.json"));
  }
  const auto none = import_with({}, "crat:mover").result;
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().text(), HasSubstr("found the node \"crat\", expected one of the scene's"));
}

}  // namespace
}  // namespace oriel
