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

void BesideView::replace(std::unique_ptr<Other> other) {
  other_ = std::move(other);
  watch_ = {};
  shows_flip_ = false;
}

Status BesideView::draw(Renderer& first, std::uint64_t image_bytes, const Other::Seen& seen, Session& session,
                        double now_s) {
  session.comparison.elsewhere = is_elsewhere(seen.camera, other_->camera(seen.origin));
  if (session.comparison.beside == Beside::kDifference)
    return draw_difference(first, image_bytes, seen, session, now_s);
  session.comparison.flip.reset();
  shows_flip_ = false;
  if (session.comparison.beside == Beside::kFirst) return {};
  return other_->draw(seen);
}

Status BesideView::draw_difference(Renderer& first, std::uint64_t image_bytes, const Other::Seen& seen,
                                   Session& session, double now_s) {
  const IVec2 size(seen.width, seen.height);
  const float ev100 = session.shown_ev100;
  const bool other_view =
      watch_.look({seen.camera, size, seen.options, ev100, session.curve, {image_bytes, other_->image_bytes()}}, now_s);
  if (other_view || (!watch_.busy() && other_->has_live_news())) {
    ORIEL_TRY_VOID(other_->draw(seen));
    ByteImage left{UVec2(size).x, UVec2(size).y, 3, {}}, right = left;
    ORIEL_TRY(left.pixels, first.read_display(ev100, session.curve));
    ORIEL_TRY(right.pixels, other_->read_display(ev100, session.curve));
    watch_.start(std::move(left), std::move(right));
  }
  const FlipFrame* found = watch_.found();
  session.comparison.flip.reset();
  if (found == nullptr) {
    shows_flip_ = false;
    return {};
  }
  session.comparison.flip = Vec2(found->mean, found->largest);
  if (!shows_flip_) ORIEL_TRY_VOID(other_->show(found->colors));
  shows_flip_ = true;
  return {};
}

void BesideView::display(const Renderer& first, const Session& session) const {
  const ComparisonView& c = session.comparison;
  const bool alone = c.beside == Beside::kSecond || (c.beside == Beside::kDifference && shows_flip_);
  if (alone) return other_->display(session.shown_ev100, session.curve);
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
  const bool whole = c.beside == Beside::kFirst || (c.beside == Beside::kDifference && !shows_flip_);
  if (whole) return write_picture(first, path, notes, n);
  return other_->write_beside(first, c.beside == Beside::kSplit ? c.divider : 0.0f, path, notes, n);
}

}  // namespace oriel
