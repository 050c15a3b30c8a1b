// A scene file that is followed as it is saved.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "preview/frame/preview_scene.h"

namespace oriel {

// What came of the file: a scene, or why there is none.
struct SceneNews {
  std::shared_ptr<const PreviewScene> scene;
  Error error;
};

// Loads on a thread of its own, again whenever the file, or one that it names, has changed and is left in peace.
class LiveScene {
 public:
  // Reading begins at once. threads: of rays; 0: all CPUs. told: is called from another thread when reading begins and
  // when there is news; may be empty.
  LiveScene(PreviewSceneOptions options, int threads, std::uint64_t seed, std::function<void()> told = {});
  ~LiveScene();
  LiveScene(const LiveScene&) = delete;
  LiveScene& operator=(const LiveScene&) = delete;

  // A file is being read: who can wait leaves the processors to it.
  bool reading() const { return reading_; }
  // The last news, once.
  std::optional<SceneNews> news();
  std::vector<std::string> warnings();  // of the last reading, once

 private:
  void work();
  bool sleep();  // false: it ends

  PreviewSceneOptions options_;
  Context context_;
  std::vector<std::filesystem::path> files_;  // that are watched
  std::shared_ptr<const PreviewScene> last_;  // that could be read
  std::function<void()> told_;
  std::atomic<bool> reading_{true};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<SceneNews> news_;
  std::vector<std::string> warnings_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace oriel
