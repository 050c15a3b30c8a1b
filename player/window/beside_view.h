// The window's frame beside another one.
#pragma once

#include "player/output/other.h"
#include "player/session/session.h"

namespace oriel {

class BesideView {
 public:
  explicit BesideView(std::unique_ptr<Other> other) : other_(std::move(other)) {}

  void replace(std::unique_ptr<Other> other) { other_ = std::move(other); }

  // What the session asks for of the other one.
  Status draw(const Other::Seen& seen, Session& session);
  // Into the bound framebuffer.
  void display(const Renderer& first, const Session& session) const;
  // What is seen, as a file, n x n pixels averaged to one.
  Status write(Renderer& first, const Session& session, const std::string& path, const PictureNotes& notes,
               std::uint32_t n);

 private:
  std::unique_ptr<Other> other_;
};

}  // namespace oriel
