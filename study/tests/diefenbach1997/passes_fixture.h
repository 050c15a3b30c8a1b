// Small packs drawn with lamps in passes.
#pragma once

#include "study/diefenbach1997/multi_pass.h"
#include "study/rooms.h"
#include "tests/player/frame_fixture.h"

namespace oriel::study {

struct PassPicture : oriel::testing::Picture {
  MultiPassStats passes{};
};

class PassesTest : public oriel::testing::FrameTest {
 protected:
  void SetUp() override {
    gpu::add_shader_sources(shader_sources());
    FrameTest::SetUp();
  }
  PassPicture draw(const Pack& pack, const Camera& camera, int width, int height,
                   const MultiPassSettings& settings = {}, const FrameOptions& options = in_passes()) {
    auto scene = GpuScene::create(pack, device_);
    EXPECT_TRUE(scene) << (scene ? "" : scene.error().text());
    if (!scene) return {};
    MultiPass passes(device_.dialect, settings);
    const View view = make_view(camera, width, height, (*scene)->bounds());
    const auto stats = renderer_->render(**scene, view, options, &passes);
    EXPECT_TRUE(stats) << (stats ? "" : stats.error().text());
    if (!stats) return {};
    return {{width, height, renderer_->read_light(), *stats}, passes.stats()};
  }
  static FrameOptions in_passes() {
    FrameOptions options;
    options.reflections = Reflections::kGeometry;
    options.mover_lights = MoverLights::kHarmonics;
    return options;
  }
};

}  // namespace oriel::study
