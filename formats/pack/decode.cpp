#include "formats/pack/decode.h"

#include <map>

namespace oriel {
namespace {

// Makes room for sections of one element each.
class Resizer {
 public:
  explicit Resizer(const PackIndex& index) {
    for (const auto& section : index.sections) ++numbers_[section.kind];
  }
  void text(std::uint32_t, std::string&) {}
  template <class T>
  void one(std::uint32_t, T&, bool) {}
  template <class T>
  void list(std::uint32_t, std::vector<T>&) {}
  template <class T>
  void each(std::uint32_t kind, std::vector<T>& elements) {
    elements.resize(numbers_[kind]);
  }

 private:
  std::map<std::uint32_t, std::size_t> numbers_;
};

// Reads the one section that it is made for.
class SectionReader {
 public:
  SectionReader(std::span<const std::byte> raw, const SectionInfo& section) : raw_(raw), section_(section) {}

  void text(std::uint32_t kind, std::string& text) {
    if (kind != section_.kind || !expect_one()) return;
    text.assign(reinterpret_cast<const char*>(raw_.data()), raw_.size());
  }
  template <class T>
  void one(std::uint32_t kind, T& element, bool) {
    if (kind != section_.kind || !expect_one()) return;
    ByteReader in(raw_);
    const Status decoded = decode(in, element);
    status_ = !decoded && in.ok() ? invalid(section_.label, "{}", decoded.error().message) : check_end(in, section_);
  }
  template <class T>
  void list(std::uint32_t kind, std::vector<T>& elements) {
    if (kind != section_.kind) return;
    ByteReader in(raw_);
    for (std::uint64_t i = 0; i < section_.count && in.ok(); ++i) {
      T element;
      if (auto decoded = decode(in, element); !decoded && in.ok()) {
        status_ = invalid(section_.label, "element {}: {}", i, decoded.error().message);
        return;
      }
      if (in.ok()) elements.push_back(std::move(element));
    }
    status_ = check_end(in, section_);
  }
  template <class T>
  void each(std::uint32_t kind, std::vector<T>& elements) {
    if (kind == section_.kind) status_ = decode_element(raw_, section_, elements[section_.nth]);
  }
  Status take() { return std::move(status_); }

 private:
  bool expect_one() {
    status_ = {};
    if (section_.count != 1) status_ = invalid(section_.label, "found {} elements, expected 1", section_.count);
    return section_.count == 1;
  }

  std::span<const std::byte> raw_;
  const SectionInfo& section_;
  Status status_;
};

}  // namespace

Pack pack_of(const PackIndex& index) {
  Pack pack;
  Resizer resizer(index);
  visit_sections(pack, resizer);
  return pack;
}

Status decode_section(std::span<const std::byte> raw, const SectionInfo& section, Pack& pack) {
  SectionReader reader(raw, section);
  visit_sections(pack, reader);
  return reader.take();
}

Status check_end(const ByteReader& in, const SectionInfo& section) {
  if (!in.ok())
    return invalid(section.label, "its counts need more than the {} bytes that it holds", section.raw_bytes);
  if (in.remaining() > 0)
    return invalid(section.label, "holds {} bytes more than its {} elements need", in.remaining(), section.count);
  return {};
}

}  // namespace oriel
