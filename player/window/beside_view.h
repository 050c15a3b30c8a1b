// The window's frame beside another one.
#pragma once

#include "player/output/flip_watch.h"
#include "player/output/other.h"
#include "player/session/session.h"

namespace oriel {

class BesideView {
 public:
  explicit BesideView(std::unique_ptr<Other> other) : other_(std::move(other)) {}

  const Other& other() const { return *other_; }
  void replace(std::unique_ptr<Other> other);

  // What the session asks for of the other one, once `first` has drawn its frame, with so many bytes of images on the
  // device. Tells the session what FLIP found.
  Status draw(Renderer& first, std::uint64_t image_bytes, const Other::Seen& seen, Session& session, double now_s);
  // Into the bound framebuffer.
  void display(const Renderer& first, const Session& session) const;
  // What is seen, as a file, n x n pixels averaged to one.
  Status write(Renderer& first, const Session& session, const std::string& path, const PictureNotes& notes,
               std::uint32_t n);

 private:
  Status draw_difference(Renderer& first, std::uint64_t image_bytes, const Other::Seen& seen, Session& session,
                         double now_s);

  std::unique_ptr<Other> other_;
  FlipWatch watch_;
  bool shows_flip_ = false;  // the other's frame is FLIP's
};

}  // namespace oriel
