// Maps after an edit: what stays, what is captured, and what is known of viewpoints.
#include "bake/radiance/kept_maps.h"

#include <gtest/gtest.h>

#include <map>
#include <mutex>

#include "bake/radiance/planned_views.h"
#include "tests/bake/radiance/mirror_room.h"

namespace oriel {
namespace {

using test::MirrorRoom;

class MemoryStore : public UnitStore {
 public:
  std::optional<KeptUnit> find(const Hash128& name) override { return found(units_, name); }
  bool claim(const Hash128&) override { return true; }
  void keep(const Hash128& name, const KeptUnit& unit) override {
    const std::lock_guard lock(mutex_);
    units_[name] = unit;
    ++computed;
  }
  void leave(const Hash128&) override {}
  UnitShare share() const override { return {}; }
  std::optional<Bytes> peek(const Hash128& name) override {
    const auto unit = found(units_, name);
    return unit ? std::optional(unit->results) : std::nullopt;
  }
  std::optional<Bytes> recall(const Hash128& name) override { return found(remembered_, name); }
  void remember(const Hash128& name, Bytes bytes) override { remembered_[name] = std::move(bytes); }
  void forget() { units_.clear(); }

  std::size_t computed = 0;

 private:
  template <class T>
  std::optional<T> found(const std::map<Hash128, T>& in, const Hash128& name) {
    const std::lock_guard lock(mutex_);
    const auto at = in.find(name);
    return at == in.end() ? std::nullopt : std::optional(at->second);
  }
  std::mutex mutex_;
  std::map<Hash128, KeptUnit> units_;
  std::map<Hash128, Bytes> remembered_;
};

constexpr float kBox = 0.05f;  // metres: a few pixels, which samples are likely to miss

// The mirror room with a small box of material 7 on its floor.
struct Furnished {
  MirrorRoom room;
  Vec3 box;

  explicit Furnished(const Vec3& at) : box(at) {
    test::SceneParts parts;
    parts.scene() = room.scene;
    parts.box("box", parts.diffuse(Vec3(0.5f)), at, at + kBox);
    room.scene = parts.finish();
  }
  ScenePart part() const { return {hash_of(box), box, box + kBox}; }
};

// Everything else shines as the room's materials do, times a factor.
OutgoingRadiance light(const Furnished& f, float factor = 1) {
  return [&f, factor](const SeenSurface& seen) { return factor * f.room.outgoing()(seen); };
}

class KeptMaps : public ::testing::Test {
 protected:
  // Captures one map of the mirror's, all of it or what is not kept of the bake before.
  struct Bake {
    std::vector<FoundReflector> reflectors;
    std::vector<RadianceMap> maps;
    MapReuse reuse;
    KnownReflections known;
  };
  Bake bake(const Furnished& f, const KnownReflections* before, double error, const OutgoingRadiance& outgoing,
            bool with_store = true) {
    const auto accel = Accel::build(f.room.scene);
    EXPECT_TRUE(accel);
    Bake out;
    out.reflectors = find_reflectors(*accel, f.room.materials(), f.room.reflector_options()).reflectors;
    EXPECT_EQ(out.reflectors.size(), 1u);
    const Reflector& r = out.reflectors[0].reflector;
    out.maps = {blank_map(0, {0, 0, -1}, {r.lower, r.upper}, 256)};
    Context context;
    context.units = with_store ? &store_ : nullptr;
    const StageInputs inputs(context, std::string("light"), f.box, ++bakes_);
    const ReflectedSurroundings surroundings(*accel, out.reflectors, {});
    const std::vector<ScenePart> parts = {f.part()};
    out.known = {parts, {}, {identity_of(f.room.scene, out.reflectors[0])}, context.inputs, {}};
    if (before) {
      const Edit edit{*before, edited_boxes(before->parts, parts), error};
      out.reuse = *capture_edited_maps({surroundings, outgoing}, edit, context, out.maps);
    } else {
      EXPECT_TRUE(capture_maps({surroundings, outgoing}, context, out.maps));
    }
    return out;
  }

  MemoryStore store_;
  int bakes_ = 0;
};

TEST_F(KeptMaps, BandsInWhichAnEditIsSeenAreCapturedAndTheOthersStay) {
  const Furnished a({1, 0, 3}), b({2.6f, 0, 3});
  const Bake before = bake(a, nullptr, 0, light(a));
  const Bake anew = bake(b, nullptr, 0, light(b), false);
  // All light is 1 % brighter: bands that stay have that error, the others do not.
  const std::size_t computed = store_.computed;
  const Bake edited = bake(b, &before.known, 0.02, light(b, 1.01f));
  const std::uint32_t bands = (edited.maps[0].height + 31) / 32;
  EXPECT_EQ(edited.reuse.bands, bands);
  EXPECT_GT(edited.reuse.kept, 0u);
  EXPECT_LT(edited.reuse.kept, bands);
  EXPECT_NEAR(edited.reuse.error, 0.01 / 1.01 * std::sqrt(1.0 * edited.reuse.kept / bands), 2e-3);
  EXPECT_EQ(store_.computed - computed, bands - edited.reuse.kept + 1) << "and one for the samples of all bands";
  std::size_t wrong = 0, fresh = 0;
  const RadianceMap &map = edited.maps[0], &truth = anew.maps[0];
  for (std::size_t i = 0; i < map.radiance.size(); ++i) {
    EXPECT_EQ(map.disparity[i], truth.disparity[i]);
    if (map.radiance[i] == truth.radiance[i] * 1.01f)
      ++fresh;
    else
      wrong += map.radiance[i] != truth.radiance[i];
  }
  EXPECT_EQ(wrong, 0u) << "the box is nowhere where it was";
  EXPECT_GT(fresh, 0u);
}

TEST_F(KeptMaps, LightThatChangesByMoreThanIsAllowedIsCaptured) {
  const Furnished f({1, 0, 3});
  const Bake before = bake(f, nullptr, 0, light(f));
  EXPECT_EQ(bake(f, &before.known, 0.02, light(f, 1.03f)).reuse.kept, 0u);
  const Bake same = bake(f, &before.known, 0.02, light(f));
  EXPECT_EQ(same.reuse.kept, same.reuse.bands);
  EXPECT_EQ(same.reuse.error, 0);
  EXPECT_EQ(same.maps[0].radiance, before.maps[0].radiance);
}

TEST_F(KeptMaps, NothingStaysOfAnotherReflectorOrOfALostCache) {
  const Furnished f({1, 0, 3});
  const Bake before = bake(f, nullptr, 0, light(f));
  KnownReflections other = before.known;
  other.captured[0].low ^= 1;
  EXPECT_EQ(bake(f, &other, 0.02, light(f)).reuse.kept, 0u);
  store_.forget();
  const Bake lost = bake(f, &before.known, 0.02, light(f));
  EXPECT_EQ(lost.reuse.kept, 0u);
  EXPECT_EQ(lost.maps[0].radiance, before.maps[0].radiance);
}

TEST_F(KeptMaps, WhatIsRememberedIsWholeOrNothing) {
  Context context;
  context.units = &store_;
  const Hash128 name = hash_of(1);
  EXPECT_FALSE(recall_reflections(context, name));
  KnownReflections known{{{hash_of(2), Vec3(1), Vec3(2)}}, {}, {hash_of(3)}, hash_of(4), hash_of(5)};
  remember_reflections(context, name, known);
  const auto found = recall_reflections(context, name);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->captured, known.captured);
  EXPECT_EQ(found->inputs, known.inputs);
  EXPECT_EQ(found->around, known.around);
  EXPECT_EQ(found->parts[0].upper, Vec3(2));
  Bytes bytes = *store_.recall(name);
  bytes.pop_back();
  store_.remember(name, bytes);
  EXPECT_FALSE(recall_reflections(context, name));
}

TEST(EditedBoxes, AreThoseOfWhatIsNewOrGone) {
  const ScenePart wall{hash_of(1), Vec3(-9), Vec3(9)}, chair{hash_of(2), Vec3(0), Vec3(1)};
  const ScenePart moved{hash_of(3), Vec3(2), Vec3(3)};
  const std::vector<ScenePart> before = {wall, chair}, now = {moved, wall};
  EXPECT_TRUE(edited_boxes(before, before).empty());
  const std::vector<Box> boxes = edited_boxes(before, now);
  ASSERT_EQ(boxes.size(), 2u);
  EXPECT_TRUE(meets(boxes, {0.5f, 0.5f, -5}, {0, 0, 1}, 5.001f));
  EXPECT_FALSE(meets(boxes, {0.5f, 0.5f, -5}, {0, 0, 1}, 4.9f)) << "something stands before it";
  EXPECT_FALSE(meets(boxes, {0.5f, 0.5f, -5}, {0, 0, -1}, 100)) << "behind it";
  EXPECT_TRUE(meets(boxes, {0.5f, 0.5f, 0.5f}, {1, 0, 0}, 0)) << "inside it";
  EXPECT_FALSE(meets(boxes, {1.5f, 1.5f, -5}, {0, 0, 1}, 100)) << "between both";
  std::vector<ScenePart> many;
  for (int i = 0; i < 65; ++i) many.push_back({hash_of(i), Vec3(i), Vec3(i + 1)});
  const std::vector<Box> one = edited_boxes({}, many);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_LE(one[0].lower.x, 0);
  EXPECT_GE(one[0].upper.x, 65);
}

// A screen put before the viewpoints' sight, or nothing; or eyes that go to its other side, while what was found for
// the first ones is still in the store.
TEST(KnownViews, StayWhileTheyShowAsMuch) {
  std::vector<Vec3> eyes;
  MemoryStore store;
  for (int i = 0; i < 200; ++i) eyes.push_back({0.4f + 0.016f * i, 1.6f, 1 + 0.015f * ((37 * i) % 200)});
  const auto plan = [&](const MirrorRoom& room, KnownPlans& known) {
    const auto accel = Accel::build(room.scene);
    EXPECT_TRUE(accel);
    auto reflectors = find_reflectors(*accel, room.materials(), room.reflector_options()).reflectors;
    const auto as_found = reflectors;
    Context context;
    context.units = &store;
    const StageInputs inputs(context, room.scene.positions);
    PlannedViewOptions options;
    options.eyes = eyes;
    auto made = plan_views_for_eyes(ReflectedSurroundings(*accel, as_found, {}), options, context, reflectors, known);
    EXPECT_TRUE(made);
    return made ? *made : ViewPlan();
  };
  const MirrorRoom room;
  KnownPlans known;
  const ViewPlan first = plan(room, known);
  EXPECT_EQ(first.kept, 0u);
  KnownPlans again{.before = known.now, .now = {}};
  const ViewPlan second = plan(room, again);
  EXPECT_EQ(second.kept, 1u);
  ASSERT_EQ(second.maps.size(), first.maps.size());
  for (std::size_t i = 0; i < first.maps.size(); ++i) EXPECT_EQ(frame_of(second.maps[i]), frame_of(first.maps[i]));
  EXPECT_EQ(hash_of(again.now), hash_of(known.now)) << "and the next bake may know them too";

  MirrorRoom screened;
  test::SceneParts parts;
  parts.scene() = screened.scene;
  // Upright between mirror and room, so that what lies beside it is seen past its edges.
  parts.box("screen", parts.diffuse(Vec3(0.5f)), {1.9f, 0, 0.5f}, {2.1f, 2.2f, 2});
  screened.scene = parts.finish();
  KnownPlans without{.before = known.now, .now = {}};
  EXPECT_EQ(plan(screened, without).kept, 0u);

  const std::vector<Vec3> everywhere = eyes;
  const auto keep_eyes = [&](bool left) {
    eyes = everywhere;
    std::erase_if(eyes, [&](const Vec3& eye) { return (eye.x < 1.9f) != left || eye.z > 2; });
  };
  keep_eyes(true);
  KnownPlans of_left;
  plan(screened, of_left);
  KnownPlans same{.before = of_left.now, .now = {}}, elsewhere = same;
  EXPECT_EQ(plan(screened, same).kept, 1u);
  keep_eyes(false);
  EXPECT_EQ(plan(screened, elsewhere).kept, 0u);
}

}  // namespace
}  // namespace oriel
