// Our decoder of BC6H beside the device's, which knows nothing of it.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "formats/core/half.h"
#include "formats/image/encode.h"
#include "formats/image/modes.h"
#include "player/gpu/device.h"
#include "player/gpu/headless.h"

namespace oriel {
namespace {

TEST(Bc6hOnTheDevice, BlocksOfAllKindsShowTheSame) {
  const auto context = gpu::HeadlessContext::create();
  ASSERT_TRUE(context) << context.error().text();
  if (!epoxy_has_gl_extension("GL_ARB_texture_compression_bptc")) GTEST_SKIP() << "the device has no BC6H";
  constexpr std::uint32_t kWide = 32, kHigh = 56;  // blocks: 128 of each mode
  Bytes blocks(std::size_t{kWide} * kHigh * 16);
  std::mt19937 random(11);
  for (std::byte& b : blocks) b = static_cast<std::byte>(random());
  for (std::size_t i = 0; i < std::size_t{kWide} * kHigh; ++i) {
    const bc6h::Mode& mode = bc6h::modes()[i % bc6h::modes().size()];
    const std::uint32_t mask = (1u << mode.code_bits) - 1;
    blocks[16 * i] = static_cast<std::byte>((std::to_integer<std::uint32_t>(blocks[16 * i]) & ~mask) | mode.code);
  }
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glCompressedTexImage2D(GL_TEXTURE_2D, 0, GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT, 4 * kWide, 4 * kHigh, 0,
                         static_cast<GLsizei>(blocks.size()), blocks.data());
  std::vector<Vec3> device(std::size_t{16} * kWide * kHigh);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGB, GL_FLOAT, device.data());
  glDeleteTextures(1, &texture);
  ASSERT_TRUE(gpu::check_gl("reading BC6H"));
  const std::vector<Vec3> ours = rgb_from_bc6h(blocks, 4 * kWide, 4 * kHigh);
  int wrong = 0;
  for (std::size_t i = 0; i < ours.size(); ++i)
    if (ours[i] != device[i] && ++wrong < 5) {
      const std::size_t block = i / (16 * kWide) * kWide + i % (4 * kWide) / 4;
      ADD_FAILURE() << "mode " << block % bc6h::modes().size() + 1 << " texel " << i << ": " << ours[i].r << " "
                    << ours[i].g << " " << ours[i].b << ", the device " << device[i].r << " " << device[i].g << " "
                    << device[i].b;
    }
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace oriel
