#include "trade/thumbnails.h"

#include "formats/core/text.h"
#include "formats/image/png.h"

namespace oriel::trade {
namespace {

// The column of pictures `which` of three, over n × n pixels each, and of one channel where `grey`.
ByteImage cut(const ByteImage& all, std::uint32_t which, std::uint32_t n, bool grey) {
  const std::uint32_t width = all.width / 3, channels = grey ? 1u : all.channels;
  ByteImage out{width / n, all.height / n, channels, {}};
  for (std::uint32_t y = 0; y < out.height; ++y)
    for (std::uint32_t x = 0; x < out.width; ++x)
      for (std::uint32_t c = 0; c < channels; ++c) {
        std::uint32_t sum = 0;
        for (std::uint32_t j = 0; j < n; ++j)
          for (std::uint32_t i = 0; i < n; ++i)
            sum += all.pixels[((std::size_t{y} * n + j) * all.width + which * width + x * n + i) * all.channels + c];
        out.pixels.push_back(static_cast<std::uint8_t>((sum + n * n / 2) / (n * n)));
      }
  return out;
}

Result<std::string> data_uri(const ByteImage& image) {
  ORIEL_TRY(const Bytes bytes, encode_png(image));
  return "data:image/png;base64," + base64(bytes);
}

}  // namespace

Result<Thumbnails> thumbnails(const std::filesystem::path& side_by_side, std::uint32_t widest) {
  ORIEL_TRY(const ByteImage all, read_png(side_by_side));
  if (all.width % 3 != 0 || all.width == 0)
    return invalid(side_by_side.string(), "is {} pixels wide, expected three pictures of one width", all.width);
  const std::uint32_t n = std::max(1u, (all.width / 3 + widest - 1) / widest);
  Thumbnails out;
  ORIEL_TRY(out.reference, data_uri(cut(all, 0, n, false)));
  ORIEL_TRY(out.frame, data_uri(cut(all, 1, n, false)));
  ORIEL_TRY(out.flip, data_uri(cut(all, 2, n, true)));
  out.width = all.width / 3 / n;
  out.height = all.height / n;
  return out;
}

}  // namespace oriel::trade
