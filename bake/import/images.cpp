#include "bake/import/images.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <array>
#include <fstream>

namespace oriel {
namespace {

bool starts_with(std::span<const std::byte> bytes, std::string_view magic, std::size_t at = 0) {
  return bytes.size() >= at + magic.size() && std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
}

std::uint32_t big_endian(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint32_t>(bytes[at + i]);
  return value;
}

// ISO 3309, as PNG's chunks carry it.
std::uint32_t crc32(std::span<const std::byte> bytes) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      t[i] = i;
      for (int k = 0; k < 8; ++k) t[i] = t[i] & 1 ? 0xEDB88320u ^ t[i] >> 1 : t[i] >> 1;
    }
    return t;
  }();
  std::uint32_t crc = ~0u;
  for (const std::byte b : bytes) crc = table[(crc ^ static_cast<std::uint32_t>(b)) & 0xFF] ^ crc >> 8;
  return ~crc;
}

// The PNG with the chunks that make its pixels and no others: glTF ignores colour profiles and gamma, and libpng would
// print what it thinks of them, and of damage, to stderr. Damage is found here.
Result<Bytes> essential_png(std::span<const std::byte> bytes, const std::string& name) {
  Bytes out(bytes.begin(), bytes.begin() + 8);
  for (std::size_t at = 8; at < bytes.size();) {
    if (bytes.size() - at < 12)
      return invalid(name, "found {} bytes at {} of a PNG, expected a chunk of at least 12", bytes.size() - at, at);
    const std::uint64_t size = big_endian(bytes, at);
    if (size > bytes.size() - at - 12)
      return invalid(name, "found a PNG chunk of {} bytes at {}, expected at most {}", size, at,
                     bytes.size() - at - 12);
    const auto chunk = bytes.subspan(at + 4, size + 4);
    if (crc32(chunk) != big_endian(bytes, at + 8 + size))
      return invalid(name, "found a damaged PNG chunk at byte {}, expected its checksum to hold", at);
    const bool header = starts_with(chunk, "IHDR"), end = starts_with(chunk, "IEND");
    if (header != (at == 8) || (header && size != 13))
      return invalid(name, "found a PNG that does not start with one IHDR chunk of 13 bytes, expected it to");
    if (header || end || starts_with(chunk, "PLTE") || starts_with(chunk, "tRNS") || starts_with(chunk, "IDAT"))
      out.insert(out.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                 bytes.begin() + static_cast<std::ptrdiff_t>(at + size + 12));
    if (end) return out;
    at += size + 12;
  }
  return invalid(name, "found a PNG without IEND, expected one");
}

bool is_png(std::span<const std::byte> bytes) {
  return starts_with(bytes, "\x89PNG\r\n\x1A\n");
}

bool is_webp(std::span<const std::byte> bytes) {
  return starts_with(bytes, "RIFF") && starts_with(bytes, "WEBP", 8);
}

std::uint32_t little_endian(std::span<const std::byte> bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value |= static_cast<std::uint32_t>(bytes[at + i]) << (8 * i);
  return value;
}

// As the first chunk has it (RFC 9649). libwebp decodes as it opens a file: what it will need is asked before.
Result<ImageSize> webp_size(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.size() >= 30 && starts_with(bytes, "VP8X", 12))
    return ImageSize{little_endian(bytes, 24, 3) + 1, little_endian(bytes, 27, 3) + 1};
  if (bytes.size() >= 30 && starts_with(bytes, "VP8L", 12) && bytes[20] == std::byte{0x2F}) {
    const std::uint32_t sides = little_endian(bytes, 21, 4);
    return ImageSize{(sides & 0x3FFF) + 1, (sides >> 14 & 0x3FFF) + 1};
  }
  if (bytes.size() >= 30 && starts_with(bytes, "VP8 ", 12) && starts_with(bytes, "\x9D\x01\x2A", 23))
    return ImageSize{little_endian(bytes, 26, 2) & 0x3FFF, little_endian(bytes, 28, 2) & 0x3FFF};
  return invalid(name, "found a corrupt WebP: {} bytes without the header of an image", bytes.size());
}

// What else artists put there.
const char* foreign_format(std::span<const std::byte> bytes) {
  if (starts_with(bytes, "\xABKTX 20\xBB")) return "KTX2";
  if (starts_with(bytes, "\xABKTX 11\xBB")) return "KTX";
  if (starts_with(bytes, "DDS ")) return "DDS";
  if (starts_with(bytes, "GIF8")) return "GIF";
  if (starts_with(bytes, "BM")) return "BMP";
  if (starts_with(bytes, "II*") || starts_with(bytes, "MM")) return "TIFF";
  return "an unknown format";
}

Result<ImageSize> checked_size(std::uint32_t width, std::uint32_t height, const std::string& name) {
  if (width < 1 || height < 1 || width > kMaxImageSize || height > kMaxImageSize)
    return invalid(name, "found {} x {} texels, expected 1 to {} a side", width, height, kMaxImageSize);
  return ImageSize{width, height};
}
Result<ImageSize> size_of(const OIIO::ImageSpec& spec, const std::string& name) {
  return checked_size(static_cast<std::uint32_t>(spec.width), static_cast<std::uint32_t>(spec.height), name);
}

// OpenImageIO multiplies WebP's alpha in. Texels without any have the colour of those beside them, so that edges of
// cut-outs do not darken between texels.
void divide_alpha(Image& image) {
  std::vector<std::uint8_t>& texels = image.texels;
  for (std::size_t i = 0; i < texels.size(); i += 4)
    for (std::size_t c = 0; c < 3 && texels[i + 3] > 0; ++c)
      texels[i + c] =
          static_cast<std::uint8_t>(std::min(255, (texels[i + c] * 255 + texels[i + 3] / 2) / texels[i + 3]));
  const auto at = [&](std::uint32_t x, std::uint32_t y) { return 4 * (std::size_t{y} * image.width + x); };
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x) {
      if (texels[at(x, y) + 3] > 0) continue;
      std::array<int, 3> sum{};
      int count = 0;
      for (std::uint32_t v = y - std::min(y, 1u); v <= std::min(y + 1, image.height - 1); ++v)
        for (std::uint32_t u = x - std::min(x, 1u); u <= std::min(x + 1, image.width - 1); ++u) {
          if (texels[at(u, v) + 3] == 0) continue;
          for (std::size_t c = 0; c < 3; ++c) sum[c] += texels[at(u, v) + c];
          ++count;
        }
      for (std::size_t c = 0; c < 3 && count > 0; ++c) texels[at(x, y) + c] = static_cast<std::uint8_t>(sum[c] / count);
    }
}

// An open reader and what it reads from.
struct Reader {
  explicit Reader(Bytes&& source) : bytes(std::move(source)), memory(bytes.data(), bytes.size()) {}
  Bytes bytes;
  OIIO::Filesystem::IOMemReader memory;
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
};

Result<std::unique_ptr<Reader>> open(std::span<const std::byte> bytes, const std::string& name) {
  const bool png = is_png(bytes), webp = is_webp(bytes);
  if (!png && !webp && !starts_with(bytes, "\xFF\xD8\xFF"))
    return invalid(name, "found {}, expected PNG, JPEG or WebP", bytes.empty() ? "no data" : foreign_format(bytes));
  const std::string format = png ? "PNG" : webp ? "WebP" : "JPEG", plugin = png ? "png" : webp ? "webp" : "jpeg";
  Bytes source;
  if (png) {
    ORIEL_TRY(source, essential_png(bytes, name));
  } else {
    source.assign(bytes.begin(), bytes.end());
  }
  auto reader = std::make_unique<Reader>(std::move(source));
  OIIO::ImageSpec config;
  OIIO::Filesystem::IOProxy* proxy = &reader->memory;
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  config.attribute("oiio:UnassociatedAlpha", 1);
  reader->input = OIIO::ImageInput::create(plugin);
  if (!reader->input) return fail(ErrorCode::kRuntime, name, "OpenImageIO has no reader for {}", format);
  const OIIO::ImageSpec& spec = reader->spec;
  if (!reader->input->open("memory." + plugin, reader->spec, config))
    return invalid(name, "found a corrupt {}: {}", format, reader->input->geterror());
  ORIEL_TRY_VOID(size_of(spec, name));
  if (spec.nchannels < 1 || spec.nchannels > 4)
    return invalid(name, "found {} channels, expected 1 to 4", spec.nchannels);
  return reader;
}

// Not every reader of OpenImageIO reads from memory: this one opens the file itself.
Result<std::unique_ptr<OIIO::ImageInput>> open_sky(const std::filesystem::path& path) {
  const std::string name = path.string();
  char magic[4] = {};
  std::ifstream(path, std::ios::binary).read(magic, sizeof(magic));
  const std::string_view start(magic, sizeof(magic));
  const bool exr = start == "\x76\x2f\x31\x01", hdr = start.starts_with("#?");
  if (!exr && !hdr) {
    if (!std::filesystem::is_regular_file(path)) return fail(ErrorCode::kIo, name, "cannot be read");
    return invalid(name, "found {}, expected Radiance (.hdr) or OpenEXR",
                   foreign_format(std::as_bytes(std::span(magic))));
  }
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(exr ? "openexr" : "hdr");
  if (!input) return fail(ErrorCode::kRuntime, name, "OpenImageIO has no reader for {}", exr ? "OpenEXR" : "Radiance");
  OIIO::ImageSpec spec;
  if (!input->open(name, spec))
    return invalid(name, "found a corrupt {} file: {}", exr ? "OpenEXR" : "Radiance", input->geterror());
  ORIEL_TRY_VOID(size_of(spec, name));
  return input;
}

// OpenImageIO and what it calls may throw.
template <class Work>
auto guarded(const std::string& name, const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kRuntime, name, "not enough memory to decode the image");
  } catch (const std::exception& e) {
    return invalid(name, "the image cannot be decoded: {}", e.what());
  }
}

}  // namespace

Result<ImageSize> image_size(std::span<const std::byte> bytes, const std::string& name) {
  if (is_webp(bytes)) return webp_size(bytes, name);
  if (is_png(bytes) && bytes.size() >= 24) return checked_size(big_endian(bytes, 16), big_endian(bytes, 20), name);
  return guarded(name, [&]() -> Result<ImageSize> {
    ORIEL_TRY(const std::unique_ptr<Reader> reader, open(bytes, name));
    return size_of(reader->spec, name);
  });
}

Result<Image> decode_image(std::span<const std::byte> bytes, const std::string& name) {
  return guarded(name, [&]() -> Result<Image> {
    ORIEL_TRY(const std::unique_ptr<Reader> reader, open(bytes, name));
    const int channels = reader->spec.nchannels;
    Image image{
        name, static_cast<std::uint32_t>(reader->spec.width), static_cast<std::uint32_t>(reader->spec.height), {}};
    image.texels.assign(std::size_t{4} * image.width * image.height, 255);
    if (!reader->input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, image.texels.data(), 4))
      return invalid(name, "found a corrupt image: {}", reader->input->geterror());
    for (std::size_t i = 0; i < image.texels.size() && channels < 3; i += 4) {  // grey, with alpha or without
      std::uint8_t* texel = &image.texels[i];
      if (channels == 2) texel[3] = texel[1];
      texel[1] = texel[2] = texel[0];
    }
    if (is_webp(bytes) && channels == 4) divide_alpha(image);
    return image;
  });
}

Result<ImageSize> sky_image_size(const std::filesystem::path& path) {
  return guarded(path.string(), [&]() -> Result<ImageSize> {
    ORIEL_TRY(const auto input, open_sky(path));
    return size_of(input->spec(), path.string());
  });
}

Result<SkyImage> read_sky_image(const std::filesystem::path& path) {
  return guarded(path.string(), [&]() -> Result<SkyImage> {
    ORIEL_TRY(const auto input, open_sky(path));
    const OIIO::ImageSpec& spec = input->spec();
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::array<int, 3> rgb = {spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
    if (channels == 1 || spec.channelindex("Y") == 0) rgb = {0, 0, 0};
    if (std::min({rgb[0], rgb[1], rgb[2]}) < 0)
      return invalid(path.string(), "found {} channels without R, G and B, expected them, or Y alone", channels);
    SkyImage image{static_cast<std::uint32_t>(spec.width), static_cast<std::uint32_t>(spec.height), {}, 0};
    std::vector<float> row(image.width * channels);
    image.texels.reserve(std::size_t{image.width} * image.height);
    for (int y = 0; y < spec.height; ++y) {
      if (!input->read_scanlines(0, 0, spec.y + y, spec.y + y + 1, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT,
                                 row.data()))
        return invalid(path.string(), "found a corrupt image at row {}: {}", y, input->geterror());
      for (std::size_t x = 0; x < image.width; ++x) {
        const float* in = row.data() + x * channels;
        image.texels.emplace_back(in[rgb[0]], in[rgb[1]], in[rgb[2]]);
      }
    }
    return image;
  });
}

}  // namespace oriel
