// Finished work of a sweep, by files: what was measured once is not run again.
#pragma once

#include <filesystem>
#include <optional>

#include "trade/measures.h"

namespace oriel::trade {

class Store {
 public:
  // Files lie in `folder`, which must be there. `inputs`: hash_of() what every result depends on.
  Store(std::filesystem::path folder, std::string inputs) : folder_(std::move(folder)), inputs_(std::move(inputs)) {}

  // The name of a unit of work: a hash of the inputs and of what tells it from others.
  std::string key(const std::vector<std::string>& what) const;
  // A file of a unit, "KEY.oriel" and the like.
  std::filesystem::path file(const std::string& key, const std::string& ending) const;
  // What the unit measured, if it is finished.
  std::optional<Measures> find(const std::string& key) const;
  // Finishes it. Error kIo.
  Status keep(const std::string& key, const Measures& measures) const;

 private:
  std::filesystem::path folder_;
  std::string inputs_;
};

// Of the contents of the scene and of what a .gltf names beside itself, of files that options name (FILE or NODE=FILE),
// of the programs, and of the options. Error kIo where the scene or a program cannot be read.
Result<std::string> hash_of(const std::filesystem::path& scene, const std::vector<std::string>& options,
                            const std::vector<std::filesystem::path>& programs);

}  // namespace oriel::trade
