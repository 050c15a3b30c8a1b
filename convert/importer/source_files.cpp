#include "convert/importer/source_files.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>

#include "formats/core/text.h"

namespace oriel {
namespace {

namespace fs = std::filesystem;

// The name without folders, of any system; of a URI as well.
std::string bare_name(std::string name) {
  std::string plain;
  for (std::size_t i = 0; i < name.size(); ++i) {
    int byte = 0;
    if (name[i] == '%' && i + 2 < name.size() &&
        std::sscanf(name.c_str() + i + 1, "%2x", reinterpret_cast<unsigned*>(&byte)) == 1)
      plain += static_cast<char>(byte), i += 2;
    else
      plain += name[i];
  }
  const std::size_t slash = plain.find_last_of("/\\");
  return lower_case(slash == std::string::npos ? plain : plain.substr(slash + 1));
}

}  // namespace

SourceFiles::SourceFiles(fs::path scene, const std::string& extension) : scene_(std::move(scene)), alias_(scene_) {
  alias_.replace_extension(extension);
  constexpr int kDeepest = 3;         // folders below the scene's, as "textures/2k/wood"
  constexpr std::size_t kMost = 1e5;  // files to look at: the scene may lie in somebody's home
  std::vector<fs::path> folders = {scene_.has_parent_path() ? scene_.parent_path() : fs::path(".")};
  for (int depth = 0; depth <= kDeepest && around_.size() < kMost; ++depth) {
    std::vector<fs::path> below;
    for (const fs::path& folder : folders) {
      std::error_code ec;
      for (fs::directory_iterator at(folder, fs::directory_options::skip_permission_denied, ec), end;
           !ec && at != end && around_.size() < kMost; at.increment(ec)) {
        std::error_code unreadable;
        if (at->is_directory(unreadable) && !at->is_symlink(unreadable)) below.push_back(at->path());
        if (at->is_regular_file(unreadable)) around_.emplace(lower_case(at->path().filename().string()), at->path());
      }
    }
    std::ranges::sort(below);
    folders = std::move(below);
  }
}

fs::path SourceFiles::find(const std::string& name) const {
  if (name == alias_.string()) return scene_;
  std::error_code ec;
  fs::path direct = name;
  if (direct.is_relative()) direct = scene_.parent_path() / direct;
  if (fs::is_regular_file(direct, ec)) return direct;
  if (fs::is_regular_file(name, ec)) return name;  // readers put the scene's folder before it themselves
  const auto found = around_.find(bare_name(name));
  return found == around_.end() ? fs::path() : found->second;
}

Assimp::IOStream* SourceFiles::Open(const char* name, const char* mode) {
  if (!text_.empty() && name == alias_.string())
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(text_.data()), text_.size());
  const fs::path found = find(name);
  if (found.empty() || mode[0] != 'r') return nullptr;
  if (found != scene_) note_read(found);
  return DefaultIOSystem::Open(found.c_str(), mode);
}

}  // namespace oriel
