#include "formats/image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfTestFile.h>

#include <cstring>
#include <set>

#include "formats/core/file.h"

namespace oriel {
namespace {

constexpr std::uint32_t kMaxSide = 65536;
constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 28;

class MemoryOut : public Imf::OStream {
 public:
  MemoryOut() : OStream("memory") {}
  void write(const char c[], int n) override {
    if (bytes.size() < at_ + static_cast<std::size_t>(n)) bytes.resize(at_ + static_cast<std::size_t>(n));
    std::memcpy(bytes.data() + at_, c, static_cast<std::size_t>(n));
    at_ += static_cast<std::size_t>(n);
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = at; }

  Bytes bytes;

 private:
  std::size_t at_ = 0;
};

class MemoryIn : public Imf::IStream {
 public:
  explicit MemoryIn(const Bytes& bytes) : IStream("memory"), bytes_(bytes) {}
  bool read(char c[], int n) override {
    if (n < 0 || at_ > bytes_.size() || static_cast<std::size_t>(n) > bytes_.size() - at_)
      throw std::runtime_error("the file ends early");
    std::memcpy(c, bytes_.data() + at_, static_cast<std::size_t>(n));
    at_ += static_cast<std::size_t>(n);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override { at_ = at; }

 private:
  const Bytes& bytes_;
  std::size_t at_ = 0;
};

// "R", or "specular.R" of a named layer.
std::string channel_name(const std::string& layer, std::uint32_t channels, std::uint32_t c) {
  static constexpr const char* kRgba[] = {"R", "G", "B", "A"};
  const std::string name = channels == 1 ? "Y" : kRgba[c];
  return layer.empty() ? name : layer + "." + name;
}

// left, top: of the data window. OpenEXR addresses pixels by their place in it, and its corner need not be (0, 0).
void add_slices(Imf::FrameBuffer& buffer, const std::string& layer, FloatImage& image, int left, int top) {
  const std::size_t pixel = image.channels * sizeof(float), row = pixel * image.width;
  const auto corner = static_cast<std::ptrdiff_t>(left) * static_cast<std::ptrdiff_t>(pixel) +
                      static_cast<std::ptrdiff_t>(top) * static_cast<std::ptrdiff_t>(row);
  for (std::uint32_t c = 0; c < image.channels; ++c)
    buffer.insert(channel_name(layer, image.channels, c),
                  Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(image.pixels.data() + c) - corner, pixel, row));
}

Status check_shape(const std::string& where, const FloatImage& image) {
  if (image.channels != 1 && image.channels != 3 && image.channels != 4)
    return invalid(where, "found {} channels, expected 1, 3 or 4", image.channels);
  const std::uint64_t pixels = std::uint64_t{image.width} * image.height;
  if (image.width == 0 || image.height == 0 || image.width > kMaxSide || image.height > kMaxSide || pixels > kMaxPixels)
    return invalid(where, "found {} x {} pixels, expected 1 to {} a side and at most {} in all", image.width,
                   image.height, kMaxSide, kMaxPixels);
  if (image.pixels.size() != pixels * image.channels)
    return invalid(where, "found {} values, expected {} ({} x {} x {})", image.pixels.size(), pixels * image.channels,
                   image.width, image.height, image.channels);
  return {};
}

// An empty image of the channels that a layer has, in the window's size; 0 channels where it has none of them.
Result<FloatImage> shape_of(const std::string& where, const Imf::ChannelList& channels, const std::string& layer) {
  const auto has = [&](std::uint32_t count, std::uint32_t c) {
    return channels.findChannel(channel_name(layer, count, c)) != nullptr;
  };
  FloatImage image;
  if (has(3, 0) && has(3, 1) && has(3, 2))
    image.channels = has(4, 3) ? 4 : 3;
  else if (has(1, 0))
    image.channels = 1;
  for (std::uint32_t c = 0; c < image.channels; ++c) {
    const std::string name = channel_name(layer, image.channels, c);
    const auto* channel = channels.findChannel(name);
    if (channel->xSampling != 1 || channel->ySampling != 1)
      return invalid(where, "channel {} is subsampled, expected full resolution", name);
  }
  return image;
}

Result<LayeredImage> decode(const std::string& where, const Bytes& bytes) {
  MemoryIn in(bytes);
  bool tiled = false, deep = false, multi_part = false;
  if (!Imf::isOpenExrFile(in, tiled, deep, multi_part)) return invalid(where, "is not an OpenEXR file");
  if (deep) return invalid(where, "found a deep image, expected a flat one");
  if (multi_part) return invalid(where, "found a multi-part file, expected a single part");
  Imf::InputFile file(in, 1);
  const auto& window = file.header().dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide ||
      static_cast<std::uint64_t>(width * height) > kMaxPixels)
    return invalid(where, "found {} x {} pixels, expected 1 to {} a side and at most {} in all", width, height,
                   kMaxSide, kMaxPixels);
  std::set<std::string> names;
  file.header().channels().layers(names);
  names.insert("");
  LayeredImage out;
  Imf::FrameBuffer buffer;
  for (const std::string& name : names) {
    ORIEL_TRY(FloatImage image, shape_of(where, file.header().channels(), name));
    if (image.channels == 0) continue;
    image.width = static_cast<std::uint32_t>(width);
    image.height = static_cast<std::uint32_t>(height);
    image.pixels.resize(std::size_t{image.width} * image.height * image.channels);
    add_slices(buffer, name, out.layers[name] = std::move(image), window.min.x, window.min.y);
  }
  if (!out.layers.contains("")) return invalid(where, "has neither channels R, G, B nor Y");
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  for (auto it = file.header().begin(); it != file.header().end(); ++it)
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute()))
      out.attributes[it.name()] = text->value();
  return out;
}

using Layers = std::map<std::string, const FloatImage*>;

Status write(const std::filesystem::path& path, const Layers& layers,
             const std::map<std::string, std::string>& attributes) {
  const FloatImage& first = *layers.begin()->second;
  for (const auto& [name, image] : layers) {
    ORIEL_TRY_VOID(check_shape(path.string(), *image));
    if (image->width != first.width || image->height != first.height)
      return invalid(path.string(), "layer \"{}\" has {} x {} pixels, expected {} x {} as the others", name,
                     image->width, image->height, first.width, first.height);
  }
  MemoryOut out;
  try {
    Imf::Header header(static_cast<int>(first.width), static_cast<int>(first.height), 1, {0, 0}, 1, Imf::INCREASING_Y,
                       Imf::ZIP_COMPRESSION);
    Imf::FrameBuffer buffer;
    for (const auto& [name, image] : layers) {
      for (std::uint32_t c = 0; c < image->channels; ++c)
        header.channels().insert(channel_name(name, image->channels, c), Imf::Channel(Imf::FLOAT));
      // OpenEXR's slices are for reading and writing alike; writing leaves the pixels alone.
      add_slices(buffer, name, const_cast<FloatImage&>(*image), 0, 0);
    }
    for (const auto& [name, value] : attributes) header.insert(name, Imf::StringAttribute(value));
    Imf::OutputFile file(out, header, 1);
    file.setFrameBuffer(buffer);
    file.writePixels(static_cast<int>(first.height));
  } catch (const std::exception& e) {
    return invalid(path.string(), "cannot be written as OpenEXR: {}", e.what());
  }
  return write_file_atomically(path, out.bytes);
}

}  // namespace

Status write_exr(const std::filesystem::path& path, const FloatImage& image,
                 const std::map<std::string, std::string>& attributes) {
  return write(path, {{"", &image}}, attributes);
}

Status write_exr(const std::filesystem::path& path, const LayeredImage& image) {
  Layers layers;
  for (const auto& [name, layer] : image.layers) layers[name] = &layer;
  if (!layers.contains("")) return invalid(path.string(), "found no layer without a name, expected one");
  return write(path, layers, image.attributes);
}

// Our code throws nothing, but OpenEXR does.
Result<LayeredImage> read_layered_exr(const std::filesystem::path& path) {
  ORIEL_TRY(const Bytes bytes, read_file(path));
  try {
    return decode(path.string(), bytes);
  } catch (const std::exception& e) {
    return invalid(path.string(), "is a broken OpenEXR file: {}", e.what());
  }
}

}  // namespace oriel
