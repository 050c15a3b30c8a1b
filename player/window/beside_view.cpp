#include "player/window/beside_view.h"

#include "player/output/split.h"

namespace oriel {
namespace {

// The columns [first, end) of the window alone, while it lives.
class Columns {
 public:
  Columns(int first, int end, int height) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(first, 0, end - first, height);
  }
  ~Columns() { glDisable(GL_SCISSOR_TEST); }
  Columns(const Columns&) = delete;
  Columns& operator=(const Columns&) = delete;
};

bool is_elsewhere(const Camera& camera, const std::optional<Camera>& taken) {
  constexpr float kSamePlace_m = 0.01f, kSameDirection = 1e-3f;
  return taken && (glm::distance(camera.eye, taken->eye) > kSamePlace_m ||
                   glm::distance(camera.forward, taken->forward) > kSameDirection);
}

}  // namespace

Status BesideView::draw(const Other::Seen& seen, Session& session) {
  session.comparison.elsewhere = is_elsewhere(seen.camera, other_->camera(seen.origin));
  if (session.comparison.beside == Beside::kFirst) return {};
  return other_->draw(seen);
}

void BesideView::display(const Renderer& first, const Session& session) const {
  const ComparisonView& c = session.comparison;
  if (c.beside == Beside::kSecond) return other_->display(session.shown_ev100, session.curve);
  if (c.beside != Beside::kSplit) return first.display(session.shown_ev100, session.curve);
  const IVec2 size = first.frame_size();
  const int column = split_column(c.divider, size.x);
  {
    const Columns left(0, column, size.y);
    first.display(session.shown_ev100, session.curve);
  }
  const Columns right(column, size.x, size.y);
  other_->display(session.shown_ev100, session.curve);
}

Status BesideView::write(Renderer& first, const Session& session, const std::string& path, const PictureNotes& notes,
                         std::uint32_t n) {
  const ComparisonView& c = session.comparison;
  if (c.beside == Beside::kFirst) return write_picture(first, path, notes, n);
  return other_->write_beside(first, c.beside == Beside::kSplit ? c.divider : 0.0f, path, notes, n);
}

}  // namespace oriel
