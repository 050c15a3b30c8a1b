// Json beside nlohmann's own values: same text in, same text out.
#include "formats/core/json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

namespace oriel {
namespace {

using Theirs = nlohmann::ordered_json;

std::string dumped(const Theirs& json, int indent = -1) {
  return json.dump(indent, ' ', false, Theirs::error_handler_t::replace);
}

std::string repeated(const std::string& text, int count) {
  std::string out;
  for (int i = 0; i < count; ++i) out += text;
  return out;
}

std::string error_of(std::string_view text) {
  const auto read = Json::parse(text, "a.json");
  return read ? "" : read.error().text();
}

TEST(Json, WritesWhatItReadAsNlohmannDoes) {
  for (const char* text :
       {"null", "true", "\"\"", "[]", "{}", "[[],{}]", "-0", "-0.0", "1e2", "1E-7", "0.1",
        "123456789012345678901234567890", "-9223372036854775808", "18446744073709551615", "-9223372036854775809",
        R"({"b":1,"a":[1,2.50,"x"],"":null})", R"(["\u00e9\n\t\"\\\/\ud83d\ude00","é😀\u007f\u0000"])",
        " [ 1 , { \"a\" : false } ] \n", "\xEF\xBB\xBF[1]"})
    for (const int indent : {-1, 0, 1, 2}) {
      const auto read = Json::parse(text);
      ASSERT_TRUE(read) << text << ": " << read.error().text();
      EXPECT_EQ(read->dump(indent), dumped(Theirs::parse(text), indent));
      EXPECT_EQ(read->dump_ascii(), Theirs::parse(text).dump(-1, ' ', true));
      EXPECT_EQ(*Json::parse(read->dump(indent)), *read);
    }
}

TEST(Json, WritesNumbersAsNlohmannDoes) {
  std::mt19937_64 bits(1);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t b = bits();
    double d;
    float f;
    std::memcpy(&d, &b, sizeof d);
    std::memcpy(&f, &b, sizeof f);
    ASSERT_EQ(Json(d).dump(), Theirs(d).dump());
    ASSERT_EQ(Json(f).dump(), Theirs(f).dump());
    ASSERT_EQ(Json(b).dump(), std::to_string(b));
    ASSERT_EQ(Json(static_cast<std::int64_t>(b)).dump(), std::to_string(static_cast<std::int64_t>(b)));
  }
  for (const double d : {0.0, -0.0, 1.0, 0.1, 1e15, 1e16, 1e17, 1e-4, 1e-5, 5e-324, 1.7976931348623157e308})
    EXPECT_EQ(Json(d).dump(), Theirs(d).dump());
  EXPECT_EQ(Json(0.1f).dump(), "0.10000000149011612");
  EXPECT_EQ(Json(std::numeric_limits<double>::infinity()).dump(), "null");
  EXPECT_EQ(Json(std::nan("")).dump(), "null");
}

// A list as both understand it.
#define EXPECT_SAME(...)                   \
  do {                                     \
    const Json ours = __VA_ARGS__;         \
    const Theirs theirs = __VA_ARGS__;     \
    EXPECT_EQ(ours.dump(), theirs.dump()); \
  } while (false)

TEST(Json, ListsOfNamedPairsAreObjects) {
  EXPECT_SAME({{"a", 1}, {"b", 2.5f}});
  EXPECT_SAME({"a", 1});
  EXPECT_SAME({{"a", 1}});
  EXPECT_SAME({{"a", "b"}, {"c", "d"}});
  EXPECT_SAME({{"a", 1}, {2, 3}});
  EXPECT_SAME({{"a", {"b", "c"}}, {"d", {{"e", nullptr}}}, {"f", {1, 2u, true}}});
  EXPECT_SAME({{"a", {}}, {"b", std::vector<int>{}}, {"c", std::vector<std::string>{"x", "y"}}});
  EXPECT_SAME({{"a", 1}, {"a", 2}});
  EXPECT_SAME({1});
  EXPECT_SAME({{"a", std::array<double, 2>{1, 2}}, {"b", std::uint8_t{7}}, {"c", 'c'}, {"d", std::size_t{9}}});
  EXPECT_EQ(Json::array({{"a", 1}}).dump(), Theirs::array({{"a", 1}}).dump());
  EXPECT_EQ(Json::object({{"a", 1}}).dump(), "{\"a\":1}");
  EXPECT_THROW(Json::object({1}), JsonError);
}

TEST(Json, ReplacesWhatIsNoUtf8) {
  for (const char* bytes : {"\xff", "a\xc3", "\xe2\x82", "ok \xf0\x9f\x98 ok", "\xed\xa0\x80"}) {
    EXPECT_EQ(Json(bytes).dump(), dumped(bytes));
    EXPECT_NE(error_of(std::string("\"") + bytes + "\""), "") << "but a text must be UTF-8";
  }
}

TEST(Json, SaysWhatIsWrongAndWhere) {
  EXPECT_NE(error_of("{\"a\":}")
                .find("a.json: found invalid JSON at byte 6 of 6: parse error at line 1, column 6: syntax error"),
            std::string::npos)
      << error_of("{\"a\":}");
  EXPECT_NE(error_of("[1e999]").find("found invalid JSON: number overflow"), std::string::npos) << error_of("[1e999]");
  for (const char* bad : {"", " ", "[1,]", "[1] 2", "{1:2}", "{\"a\" 1}", "nul", "01", "[", "\"\n\"", "'a'", "// a\n1",
                          "[NaN]", "\"\\x\"", "\"\\ud800\"", "\xEF\xBB"})
    EXPECT_NE(error_of(bad), "") << bad;
  for (const char* bad : {"{\"a\":[1,2}", "[{\"a\":1,]"}) EXPECT_FALSE(nlohmann::json::accept(bad));
}

TEST(Json, DeepTextsAreAnError) {
  const int most = Json::kMaxDepth;
  EXPECT_EQ(error_of(repeated("[", most) + repeated("]", most)), "");
  EXPECT_EQ(error_of(repeated("{\"a\":", most) + "1" + repeated("}", most)), "");
  for (const int depth : {most + 1, 1000000}) {
    EXPECT_NE(error_of(repeated("[", depth)).find("nested deeper"), std::string::npos);
    EXPECT_NE(error_of(repeated("{\"a\":", depth)).find("nested deeper"), std::string::npos);
    EXPECT_NE(error_of(repeated("[", depth) + repeated("]", depth)).find("nested deeper"), std::string::npos);
  }
}

TEST(Json, OfMembersOfOneNameTheLastCounts) {
  const char* text = R"({"a":1,"b":[2],"a":{"c":3},"b":4})";
  EXPECT_EQ(Json::parse(text)->dump(), Theirs::parse(text).dump());
  std::string many = "{";
  for (int i = 0; i < 200000; ++i) many += fmt::format("\"{}\":{},", i % 100000, i);
  many.back() = '}';
  const auto read = Json::parse(many);
  ASSERT_EQ(read->size(), 100000u);
  EXPECT_EQ((*read)["7"], 100007);
}

TEST(Json, ReadsLongArrays) {
  const auto read = Json::parse("[" + repeated("[0.5,1],", 500000) + "0]");
  ASSERT_EQ(read->size(), 500001u);
  EXPECT_EQ((*read)[499999][0], 0.5);
}

TEST(Json, MembersAreMadeWhereTheyMayBe) {
  Json json;
  json["a"]["b"] = 1;
  json["list"][2] = "x";
  json["list"].push_back({{"c", nullptr}});
  EXPECT_EQ(json.dump(), R"({"a":{"b":1},"list":[null,null,"x",{"c":null}]})");
  const Json& same = json;
  EXPECT_TRUE(same["no"]["member"][3].is_null());
  EXPECT_TRUE(same["list"][9].is_null());
  EXPECT_EQ(same.find("no"), nullptr);
  EXPECT_EQ(same["a"]["b"].find("no"), nullptr);
  EXPECT_THROW(same.at("no"), JsonError);
  EXPECT_THROW(same["list"].at(4), JsonError);
  EXPECT_THROW(json["a"]["b"]["c"] = 1, JsonError);
  EXPECT_THROW(json["list"]["c"] = 1, JsonError);
  EXPECT_THROW(json["a"].push_back(1), JsonError);
  json.erase("a");
  json.update({{"list", 0}, {"z", 1}, {"b", 2}});
  EXPECT_EQ(json.dump(), R"({"list":0,"z":1,"b":2})");
  EXPECT_EQ(json.sorted().dump(), R"({"b":2,"list":0,"z":1})");
  EXPECT_EQ(Json({{"l", {{{"b", 1}, {"a", 2}}}}}).sorted().dump(), R"({"l":[{"a":2,"b":1}]})");
}

TEST(Json, GivesWhatItHolds) {
  const Json json = {{"whole", 3}, {"real", 2.5}, {"text", "x"}, {"yes", true}, {"texts", {"a", "b"}}, {"none", {}}};
  EXPECT_EQ(json["whole"].get<double>(), 3.0);
  EXPECT_EQ(json["real"].get<int>(), 2);
  EXPECT_EQ(json["texts"].get<std::vector<std::string>>(), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(json.value("text", ""), "x");
  EXPECT_EQ(json.value("no", "other"), "other");
  EXPECT_EQ(json.value("no", 7.0), 7.0);
  EXPECT_THROW(json.value("text", 7.0), JsonError);
  EXPECT_THROW(json["yes"].get<int>(), JsonError);
  EXPECT_THROW(json["whole"].get<bool>(), JsonError);
  EXPECT_THROW(json["real"].get<std::string>(), JsonError);
  EXPECT_THROW(json["texts"].get<std::vector<double>>(), JsonError);
  EXPECT_EQ(json.size(), 6u);
  EXPECT_EQ(json["whole"].size(), 1u);
  EXPECT_TRUE(json["none"].empty());
  EXPECT_EQ(json.begin(), json.end()) << "members are no elements";
  std::string names;
  for (const auto& [name, value] : json.items()) names += name + " ";
  EXPECT_EQ(names, "whole real text yes texts none ");
}

TEST(Json, EqualsByValue) {
  EXPECT_EQ(Json(1), Json(1u));
  EXPECT_EQ(Json(1), Json(1.0));
  EXPECT_NE(Json(-1), Json(std::numeric_limits<std::uint64_t>::max()));
  EXPECT_NE(Json(1), Json(true));
  EXPECT_NE(Json(1), Json("1"));
  EXPECT_NE(Json(), Json(0));
  EXPECT_EQ(Json({{"a", 1}, {"b", {1, 2}}}), Json({{"b", {1, 2}}, {"a", 1}}));
  EXPECT_NE(Json({{"a", 1}}), Json({{"a", 1}, {"b", 1}}));
  EXPECT_NE(Json({1, 2}), Json({2, 1}));
  std::ostringstream out;
  out << Json({1, "x"});
  EXPECT_EQ(out.str(), "[1,\"x\"]");
}

TEST(Json, APartMayReplaceTheWhole) {
  Json json = {{"a", {{"b", {1, 2}}}}};
  json = json["a"];
  EXPECT_EQ(json.dump(), R"({"b":[1,2]})");
  json = std::move(json["b"]);
  EXPECT_EQ(json.dump(), "[1,2]");
  json.push_back(json[0]);
  json.push_back(json);
  EXPECT_EQ(json.dump(), "[1,2,1,[1,2,1]]");
  Json& itself = json;
  json = itself;
  EXPECT_EQ(json.size(), 4u);
  const Json taken = std::move(json);
  EXPECT_EQ(taken.size(), 4u);
}

}  // namespace
}  // namespace oriel
