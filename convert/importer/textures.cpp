#include "convert/importer/textures.h"

#include <assimp/GltfMaterial.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>

#include "formats/core/file.h"
#include "formats/image/png.h"

namespace oriel {
namespace {

constexpr std::uint32_t kLargest = 16384;  // texels a side, as the baker takes them

bool begins(const Bytes& bytes, std::string_view magic, std::size_t at = 0) {
  return bytes.size() >= at + magic.size() && std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
}

// Of what glTF shows as it is; nullptr of other pictures.
const char* media_type(const Bytes& bytes) {
  if (begins(bytes, "\x89PNG")) return "image/png";
  if (begins(bytes, "\xFF\xD8\xFF")) return "image/jpeg";
  return begins(bytes, "RIFF") && begins(bytes, "WEBP", 8) ? "image/webp" : nullptr;
}

// By OpenImageIO, as RGBA: TGA, BMP, TIFF, GIF, PSD, DDS and what else it knows. Few of its readers read from memory:
// files are read as such.
Result<ByteImage> decode(const std::filesystem::path& path, const std::string& name, const Bytes& bytes) {
  OIIO::Filesystem::IOMemReader memory(const_cast<std::byte*>(bytes.data()), bytes.size());
  OIIO::Filesystem::IOProxy* proxy = &memory;
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  if (path.empty()) config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const auto input = OIIO::ImageInput::open(path.empty() ? name : path.string(), &config);
  if (!input) return invalid(name, "cannot be read: {}", OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  const auto width = static_cast<std::uint32_t>(spec.width), height = static_cast<std::uint32_t>(spec.height);
  const int channels = std::min(spec.nchannels, 4);
  if (width < 1 || height < 1 || width > kLargest || height > kLargest || channels < 1)
    return invalid(name, "found {} x {} texels, expected 1 to {} a side", width, height, kLargest);
  std::vector<std::uint8_t> in(std::size_t{width} * height * static_cast<std::size_t>(channels));
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, in.data()))
    return invalid(name, "cannot be read: {}", input->geterror());
  ByteImage out{width, height, 4, std::vector<std::uint8_t>(std::size_t{width} * height * 4, 255)};
  for (std::size_t i = 0; i < std::size_t{width} * height; ++i)
    for (std::size_t c = 0; c < 4; ++c) {
      const auto n = static_cast<std::size_t>(channels);
      if (c < 3) out.pixels[4 * i + c] = in[n * i + (n < 3 ? 0 : c)];
      if (c == 3 && (n == 2 || n == 4)) out.pixels[4 * i + 3] = in[n * i + n - 1];
    }
  return out;
}

std::string path_of(const aiMaterial& material, aiTextureType type) {
  aiString path;
  return material.GetTexture(type, 0, &path) == AI_SUCCESS ? path.C_Str() : "";
}

int gltf_wrap(const aiMaterial& material, aiTextureType type, bool u) {
  int mode = aiTextureMapMode_Wrap;
  if (u)
    material.Get(AI_MATKEY_MAPPINGMODE_U(type, 0), mode);
  else
    material.Get(AI_MATKEY_MAPPINGMODE_V(type, 0), mode);
  return mode == aiTextureMapMode_Mirror ? 33648 : mode == aiTextureMapMode_Clamp ? 33071 : 10497;  // glTF 2.0, 5.26
}

}  // namespace

Textures::Picture* Textures::picture(const aiMaterial& material, aiTextureType type) {
  const std::string path = path_of(material, type);
  if (path.empty()) return nullptr;
  const auto [at, added] = pictures_.try_emplace(path);
  std::optional<Picture>& found = at->second;
  if (!added) return found ? &*found : nullptr;
  const auto read = [&]() -> Status {
    if (const aiTexture* embedded = source_.scene.GetEmbeddedTexture(path.c_str()); embedded && embedded->mWidth > 0) {
      const auto* data = reinterpret_cast<const std::byte*>(embedded->pcData);
      const std::string hint = fmt::format(".{}", embedded->achFormatHint);  // by which its reader is found
      found = Picture{path.ends_with(hint) ? path : path + hint, {}, {}, {}};
      if (embedded->mHeight == 0) {
        found->bytes.assign(data, data + embedded->mWidth);
        return {};
      }
      found->pixels = {embedded->mWidth, embedded->mHeight, 4, {}};
      for (std::size_t i = 0; i < std::size_t{embedded->mWidth} * embedded->mHeight; ++i) {
        const aiTexel& t = embedded->pcData[i];
        found->pixels.pixels.insert(found->pixels.pixels.end(), {t.r, t.g, t.b, t.a});
      }
      return {};
    }
    const std::filesystem::path file = source_.files.find(path);
    if (file.empty())
      return fail(ErrorCode::kIo, path, "is neither where the file says nor beside it or in folders there");
    source_.files.note_read(file);
    ORIEL_TRY(Bytes bytes, read_file(file, std::uint64_t{1} << 30));  // bytes: more is no texture
    found = Picture{file.filename().string(), file, std::move(bytes), {}};
    return {};
  };
  Status done = read();
  if (done && found->pixels.pixels.empty() && !media_type(found->bytes) && !pixels(*found)) found.reset();
  if (!done) {
    source_.warn(fmt::format("texture {}: its surfaces have their colour alone", done.error().text()));
    found.reset();
  }
  return found ? &*found : nullptr;
}

const ByteImage* Textures::pixels(Picture& picture) {
  if (!picture.pixels.pixels.empty()) return &picture.pixels;
  auto decoded = decode(picture.path, picture.name, picture.bytes);
  if (!decoded) {
    source_.warn(fmt::format("texture {}: it is left out", decoded.error().text()));
    return nullptr;
  }
  picture.pixels = std::move(*decoded);
  return &picture.pixels;
}

Json Textures::add(const std::string& key, Picture& picture, const aiMaterial& material, aiTextureType type) {
  if (!images_.contains(key)) {
    const char* media = picture.bytes.empty() ? nullptr : media_type(picture.bytes);
    if (media) {
      images_[key] = glb_.add_image(picture.name, picture.bytes, media);
    } else {
      const auto png = encode_png(picture.pixels);
      if (!png) return {};
      images_[key] = glb_.add_image(picture.name, *png);
    }
  }
  const std::size_t sampler =
      glb_.add("samplers", {{"wrapS", gltf_wrap(material, type, true)}, {"wrapT", gltf_wrap(material, type, false)}});
  int channel = 0;
  material.Get(AI_MATKEY_UVWSRC(type, 0), channel);
  return {{"index", glb_.add("textures", {{"source", images_[key]}, {"sampler", sampler}})},
          {"texCoord", channel == 1 ? 1 : 0}};
}

Json Textures::reference(const aiMaterial& material, aiTextureType type) {
  Picture* found = picture(material, type);
  return found ? add(path_of(material, type), *found, material, type) : Json();
}

Json Textures::with_alpha(const aiMaterial& material, aiTextureType color, aiTextureType alpha, bool& cut_out) {
  Picture* cover = picture(material, alpha);
  const ByteImage* mask = cover ? pixels(*cover) : nullptr;
  if (!mask) return reference(material, color);
  Picture* base = picture(material, color);
  const ByteImage* below = base ? pixels(*base) : nullptr;
  const ByteImage& size = below && below->pixels.size() > mask->pixels.size() ? *below : *mask;
  const auto texel = [&](const ByteImage& of, std::uint32_t x, std::uint32_t y) {
    return &of.pixels[4 * (std::size_t{y * std::uint64_t{of.height} / size.height} * of.width +
                           x * std::uint64_t{of.width} / size.width)];
  };
  bool by_alpha = false;
  for (std::size_t i = 3; i < mask->pixels.size(); i += 4) by_alpha |= mask->pixels[i] != 255;
  Picture joint{base ? base->name : cover->name, {}, {}, {size.width, size.height, 4, {}}};
  joint.pixels.pixels.reserve(size.pixels.size());
  std::size_t clear = 0;  // texels that are on or off, within a tenth
  for (std::uint32_t y = 0; y < size.height; ++y)
    for (std::uint32_t x = 0; x < size.width; ++x) {
      const std::uint8_t* m = texel(*mask, x, y);
      const std::uint8_t a = by_alpha ? m[3] : m[1];
      for (std::size_t c = 0; c < 3; ++c) joint.pixels.pixels.push_back(below ? texel(*below, x, y)[c] : 255);
      joint.pixels.pixels.push_back(a);
      clear += a < 26 || a > 229;
    }
  cut_out = clear * 10 > 9 * std::size_t{size.width} * size.height;
  return add(path_of(material, color) + "\n" + path_of(material, alpha), joint, material, base ? color : alpha);
}

bool Textures::is_normal_map(const aiMaterial& material, aiTextureType type) {
  Picture* found = picture(material, type);
  const ByteImage* image = found ? pixels(*found) : nullptr;
  if (!image) return false;
  std::size_t blue = 0;
  for (std::size_t i = 0; i < image->pixels.size(); i += 4)
    blue += image->pixels[i + 2] > 127 && image->pixels[i + 2] > image->pixels[i] &&
            image->pixels[i + 2] > image->pixels[i + 1];
  return blue * 2 > image->pixels.size() / 4;
}

}  // namespace oriel
