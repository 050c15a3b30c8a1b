// Times of packs as files. docs/notes/format.md holds what it printed.
//   pack_bench grow PACK OUT BYTES     repeats PACK's lightmap pages and reflectors until OUT has BYTES or more
//   pack_bench load PACK               seconds to load PACK as the player does, bytes read, largest memory
//   pack_bench levels PACK             zstd levels by kind of section: ratio and MB/s
#include <fmt/format.h>
#include <sys/resource.h>
#include <zstd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <map>

#include "formats/core/file.h"
#include "formats/core/parallel.h"
#include "formats/pack/deferred.h"
#include "formats/pack/index.h"
#include "formats/pack/reader.h"
#include "formats/pack/writer.h"

namespace {

using namespace oriel;

template <class Do>
double seconds(const Do& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// One more of every lightmap page, and of every reflector with its maps, far away from the others.
void append_copy(Pack& pack, const Pack& of, float copies) {
  pack.lightmaps.insert(pack.lightmaps.end(), of.lightmaps.begin(), of.lightmaps.end());
  const auto first_reflector = static_cast<std::uint32_t>(pack.reflectors.size());
  const auto first_map = static_cast<std::uint32_t>(pack.radiance_maps.size());
  for (Reflector reflector : of.reflectors) {
    reflector.first_map += first_map;
    reflector.pack_from_reflector[3].x += 10000 * copies;
    pack.reflectors.push_back(std::move(reflector));
  }
  for (RadianceMap map : of.radiance_maps) {
    map.reflector += first_reflector;
    pack.radiance_maps.push_back(std::move(map));
  }
}

Status grow(const std::string& from, const std::string& to, std::uint64_t bytes) {
  ORIEL_TRY(const Pack one, read_pack(from));
  ORIEL_TRY(const Bytes file, read_file(from));
  Pack pack = one;
  float copies = 0;
  for (std::uint64_t size = file.size(); size < bytes; size += file.size()) append_copy(pack, one, ++copies);
  return write_pack(to, pack);
}

// From /proc/self/io: through read() and its like, whether from a disk or from the system's cache.
std::uint64_t bytes_read() {
  std::ifstream in("/proc/self/io");
  std::string name;
  std::uint64_t value = 0;
  in >> name >> value;
  return value;
}

using Work = std::vector<std::function<Status()>>;

// All of it, on all cores; seconds.
Result<double> done(const Work& work) {
  std::vector<Status> status(work.size());
  const double taken =
      seconds([&] { for_each_parallel(work.size(), core_count(), [&](std::size_t i) { status[i] = work[i](); }); });
  for (const Status& each : status) ORIEL_TRY_VOID(each);
  return taken;
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto of = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return of(usage.ru_utime) + of(usage.ru_stime);
}

// Three steps, as the player takes them: what a first frame needs; light and textures; the checksums of all else, which
// the player compares when nothing is left to do.
Status load(const std::string& path) {
  const std::uint64_t before = bytes_read();
  Result<DeferredPack> pack = tl::unexpected<Error>(Error{});
  double taken_s = seconds([&] { pack = open_pack(path); });
  if (!pack) return tl::unexpected<Error>(std::move(pack).error());
  const DeferredImages& images = *pack->images;
  const auto tell = [&](const char* step) {
    fmt::print("{}: {:.3f} s, {:.3f} s of CPU time, {:.3f} of the file's bytes\n", step, taken_s, cpu_seconds(),
               static_cast<double>(bytes_read() - before) / static_cast<double>(images.file_bytes()));
  };
  tell("open");
  const Pack& p = pack->pack;
  // What was decoded is let go, as by the player once it is on the device.
  const auto status_of = [](const auto& loaded) -> Status {
    if (!loaded) return tl::unexpected<Error>(loaded.error());
    return {};
  };
  Work shown, rest;
  for (std::size_t i = 0; i < p.lightmaps.size(); ++i) shown.push_back([&, i] { return status_of(images.light(i)); });
  for (std::size_t i = 0; i < p.textures.size(); ++i) shown.push_back([&, i] { return status_of(images.texture(i)); });
  for (std::size_t i = 0; i < p.normal_textures.size(); ++i)
    shown.push_back([&, i] { return status_of(images.normal_texture(i)); });
  for (std::size_t i = 0; i < images.sections(); ++i)
    rest.push_back([&, i] { return images.was_checked(i) ? Status() : images.check(i); });
  ORIEL_TRY(const double shown_s, done(shown));
  taken_s += shown_s;
  tell("light and textures");
  ORIEL_TRY(const double rest_s, done(rest));
  taken_s += rest_s;
  tell("all checksums");
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print("at most {} MB of memory, {} pages from the disk\n", usage.ru_maxrss / 1024, usage.ru_majflt);
  return {};
}

struct Kind {
  std::size_t raw = 0;
  std::map<int, std::pair<std::size_t, double>> by_level;  // stored bytes, seconds
  double decompression_s = 0;                              // of level 3
};

void measure(std::span<const std::byte> raw, Kind& kind) {
  kind.raw += raw.size();
  Bytes stored(ZSTD_compressBound(raw.size())), back(raw.size());
  for (const int level : {1, 3, 9, 19}) {
    std::size_t n = 0;
    auto& [bytes, time] = kind.by_level[level];
    time += seconds([&] { n = ZSTD_compress(stored.data(), stored.size(), raw.data(), raw.size(), level); });
    bytes += n;
    if (level == 3)
      kind.decompression_s += seconds([&] { ZSTD_decompress(back.data(), back.size(), stored.data(), n); });
  }
}

Status levels(const std::string& path) {
  ORIEL_TRY(const MappedFile file, MappedFile::open(path));
  ORIEL_TRY(const PackIndex index, read_index(file.bytes()));
  std::map<std::string, Kind> kinds;
  for (const auto& section : index.sections) {
    ORIEL_TRY(const RawBytes raw, section_bytes(file.bytes(), section));
    measure(raw.span(), kinds[kind_text(section.kind)]);
  }
  fmt::print("| kind | MB | level 1 | level 3 | level 9 | level 19 | back |\n|---|---|---|---|---|---|---|\n");
  for (const auto& [name, kind] : kinds) {
    const double megabytes = static_cast<double>(kind.raw) / 1e6;
    fmt::print("| {} | {:.2f} |", name, megabytes);
    for (const auto& [level, result] : kind.by_level)
      fmt::print(" {:.1f} %, {:.0f} MB/s |", 100 * static_cast<double>(result.first) / static_cast<double>(kind.raw),
                 megabytes / result.second);
    fmt::print(" {:.0f} MB/s |\n", megabytes / kind.decompression_s);
  }
  return {};
}

Status run(const std::vector<std::string>& words) {
  if (words.size() == 4 && words[0] == "grow") return grow(words[1], words[2], std::stoull(words[3]));
  if (words.size() == 2 && words[0] == "load") return load(words[1]);
  if (words.size() == 2 && words[0] == "levels") return levels(words[1]);
  return fail(ErrorCode::kUsage, "pack_bench", "expected grow PACK OUT BYTES, load PACK or levels PACK");
}

}  // namespace

int main(int argc, char** argv) {
  const Status status = run({argv + 1, argv + argc});
  if (status) return 0;
  fmt::print(stderr, "{}\n", status.error().text());
  return static_cast<int>(status.error().code);
}
