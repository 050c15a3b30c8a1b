#include "preview/frame/live_scene.h"

#include <sys/stat.h>

#include <chrono>
#include <utility>

namespace oriel {
namespace {

constexpr std::chrono::milliseconds kLook{20};  // how often files are looked at

// What tells that a file is another: none where it is not there.
struct FileStamp {
  std::int64_t seconds = -1, nanoseconds = 0, bytes = 0;
  std::uint64_t node = 0;  // programs save by renaming
  bool operator==(const FileStamp&) const = default;
};

std::vector<FileStamp> stamps_of(const std::vector<std::filesystem::path>& files) {
  std::vector<FileStamp> stamps;
  for (const auto& file : files) {
    struct stat status {};
    stamps.emplace_back();
    if (::stat(file.c_str(), &status) == 0)
      stamps.back() = {status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_size, status.st_ino};
  }
  return stamps;
}

}  // namespace

LiveScene::LiveScene(PreviewSceneOptions options, int threads, std::uint64_t seed, std::function<void()> told)
    : options_(std::move(options)), told_(std::move(told)) {
  context_.threads = threads;
  context_.seed = seed;
  context_.warn = [this](const Warning& warning) {
    const std::scoped_lock lock(mutex_);
    warnings_.push_back(warning.text);
  };
  files_ = {options_.file};
  thread_ = std::thread([this] { work(); });
}

LiveScene::~LiveScene() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
    context_.stop = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::optional<SceneNews> LiveScene::news() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(news_, std::nullopt);
}

std::vector<std::string> LiveScene::warnings() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(warnings_, {});
}

bool LiveScene::sleep() {
  std::unique_lock lock(mutex_);
  return !changed_.wait_for(lock, kLook, [&] { return ends_; });
}

void LiveScene::work() {
  while (true) {
    reading_ = true;
    if (told_) told_();
    const std::vector<FileStamp> read = stamps_of(files_);
    auto loaded = load_preview_scene(options_, context_, last_.get());
    if (loaded) last_ = *loaded;
    {
      const std::scoped_lock lock(mutex_);
      if (ends_) return;
      news_ = loaded ? SceneNews{*loaded, {}} : SceneNews{nullptr, loaded.error()};
    }
    reading_ = false;
    if (told_) told_();
    bool followed = false;  // the files that the scene names
    if (loaded) {
      std::vector<std::filesystem::path> files{options_.file};
      for (const auto& [name, hash] : (*loaded)->imported.inputs) files.push_back(options_.file.parent_path() / name);
      followed = std::exchange(files_, files) != files;
    }
    // Until they differ from what was read, and stay as they are for a look.
    std::vector<FileStamp> last = followed ? stamps_of(files_) : read;
    last.front() = read.front();
    const std::vector<FileStamp> known = last;
    while (true) {
      if (!sleep()) return;
      std::vector<FileStamp> now = stamps_of(files_);
      const bool at_rest = now == std::exchange(last, now);
      if (now != known && at_rest) break;
    }
  }
}

}  // namespace oriel
