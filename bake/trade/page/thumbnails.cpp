#include "bake/trade/page/thumbnails.h"

#include "formats/core/file.h"
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

// By way of a file beside it, since only files are encoded.
Result<std::string> data_uri(const ByteImage& image, const std::filesystem::path& beside) {
  const std::filesystem::path file = beside.string() + ".thumbnail.png";
  ORIEL_TRY_VOID(write_png(file, image));
  const auto bytes = read_file(file);
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  if (!bytes) return tl::unexpected<Error>(bytes.error());
  return "data:image/png;base64," + base64(*bytes);
}

}  // namespace

Result<Thumbnails> thumbnails(const std::filesystem::path& side_by_side, std::uint32_t widest) {
  ORIEL_TRY(const ByteImage all, read_png(side_by_side));
  if (all.width % 3 != 0 || all.width == 0)
    return invalid(side_by_side.string(), "is {} pixels wide, expected three pictures of one width", all.width);
  const std::uint32_t n = std::max(1u, (all.width / 3 + widest - 1) / widest);
  Thumbnails out;
  ORIEL_TRY(out.reference, data_uri(cut(all, 0, n, false), side_by_side));
  ORIEL_TRY(out.frame, data_uri(cut(all, 1, n, false), side_by_side));
  ORIEL_TRY(out.flip, data_uri(cut(all, 2, n, true), side_by_side));
  out.width = all.width / 3 / n;
  out.height = all.height / n;
  return out;
}

std::string base64(std::span<const std::byte> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

}  // namespace oriel::trade
