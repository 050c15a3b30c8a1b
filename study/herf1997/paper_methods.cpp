#include <algorithm>

#include "study/herf1997/count_methods.h"

namespace oriel::study {
namespace {

int clamp_texel(int x, int width) {
  return std::min(std::max(x, 0), width);
}

// Calls visit(row, from, to) for each span of texels that a face covers.
template <class Visit>
void visit_spans(const FaceEdges& face, int width, const Visit& visit) {
  int first = face[0].first, last = face[0].last;
  for (const FixedEdge& e : face)
    if (e.first < e.last) first = first < last ? std::min(first, e.first) : e.first, last = std::max(last, e.last);
  for (int row = first; row < last; ++row) {
    int from = width, to = 0;
    for (const FixedEdge& e : face) {
      if (row < e.first || row >= e.last) continue;
      const int x = clamp_texel(e.at(row), width);
      from = std::min(from, x), to = std::max(to, x);
    }
    if (from < to) visit(row, from, to);
  }
}

template <class Visit>
void visit_faces(const SampleBatch& batch, int lane, const Visit& visit) {
  const auto& edges = batch.projected.edges;
  for (std::size_t f = 0; f < batch.view.faces.size(); ++f) {
    const auto& e = batch.view.faces[f].edges;
    if (batch.projected.sides[f][lane] != 0)
      visit(FaceEdges{edges[e[0]].of(lane), edges[e[1]].of(lane), edges[e[2]].of(lane)});
  }
  for (const FaceEdges& face : batch.beside_light[lane]) visit(face);
}

void set_span(BlockedRows& rows, int sample, int row, const std::array<int, 2>& span) {
  for (int w = span[0] / 32; w <= (span[1] - 1) / 32; ++w)
    rows.word(sample, w, row) |= bits_from(span[0] - 32 * w) ^ bits_from(span[1] - 32 * w);
}

// An event where the count of faces between texel and sample changes, in the list of its texel.
struct Flag {
  std::int16_t direction = 0;  // faces that begin, less those that end: 2 where two faces of an edge lie on one side
  std::int16_t lane = 0;
  std::uint32_t next = 0;  // 0: the last
};

// Herf 1997, section 4.3.2: all lists of a buffer from one block of memory, freed by setting one number and clearing
// the heads.
class FlagBuffer {
 public:
  FlagBuffer(int width, int height)
      : width_(width), heads_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)), flags_(1) {}

  void add(const FixedEdge& edge, int lane, int direction) {
    for (int row = edge.first; row < edge.last; ++row) {
      const int x = std::max(edge.at(row), 0);  // what begins left of the receiver begins at its first texel
      if (x >= width_) continue;
      std::uint32_t& head = heads_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + x];
      flags_.push_back({static_cast<std::int16_t>(direction), static_cast<std::int16_t>(lane), head});
      head = static_cast<std::uint32_t>(flags_.size() - 1);
    }
  }

  // Runs along the rows with a count of faces a sample (Appel's quantitative invisibility).
  void run(const SampleBatch& batch, BlockedRows& rows) const {
    for (int row = 0; row < rows.height(); ++row) {
      std::array<int, kLanes> faces{}, since{};
      for (int x = 0; x < width_; ++x) {
        std::uint32_t f = heads_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + x];
        if (f == 0) continue;
        const std::array<int, kLanes> before = faces;
        for (; f != 0; f = flags_[f].next) faces[flags_[f].lane] += flags_[f].direction;
        for (int i = 0; i < batch.count; ++i) {
          if (before[i] != 0 && faces[i] == 0) set_span(rows, batch.first + i, row, {since[i], x});
          if (before[i] == 0) since[i] = x;
        }
      }
      for (int i = 0; i < batch.count; ++i)
        if (faces[i] != 0) set_span(rows, batch.first + i, row, {since[i], width_});
    }
  }

 private:
  int width_;
  std::vector<std::uint32_t> heads_;
  std::vector<Flag> flags_;  // the first is none
};

// What the count of faces changes by where a row crosses the edge from left to right: of a face that is seen
// counter-clockwise an edge that goes up is the right one. Nothing at edges between two faces that lie beside each
// other: only silhouettes have events (Herf 1997, section 4.3.3).
int direction_of(const SampleBatch& batch, const ViewEdge& edge, int lane) {
  const ProjectedEdges& p = batch.projected;
  const bool up = p.y[edge.a][lane] <= p.y[edge.b][lane];
  int sum = 0;
  for (const std::uint32_t f : edge.faces) {
    if (f == kNoFace) continue;
    const auto& corners = batch.view.faces[f].points;
    const bool along = (corners[0] == edge.a && corners[1] == edge.b) ||
                       (corners[1] == edge.a && corners[2] == edge.b) || (corners[2] == edge.a && corners[0] == edge.b);
    sum += p.sides[f][lane] * (along == up ? -1 : 1);
  }
  return sum;
}

// The same for a triangle that shares no edge: which side its other corner is on tells.
void add_alone(const FaceEdges& face, int lane, FlagBuffer& flags, int width) {
  visit_spans(face, width, [&](int row, int from, int to) {
    const auto at = [row](int x) {
      return FixedEdge{.x = static_cast<std::uint64_t>(x) << 32, .step = 0, .first = row, .last = row + 1};
    };
    flags.add(at(from), lane, 1), flags.add(at(to), lane, -1);
  });
}

}  // namespace

void fill_images(const SampleBatch& batch, BlockedRows& rows) {
  const auto width = static_cast<std::size_t>(rows.width());
  std::vector<std::uint8_t> image(width * static_cast<std::size_t>(rows.height()));
  for (int i = 0; i < batch.count; ++i) {
    std::ranges::fill(image, 0);
    visit_faces(batch, i, [&](const FaceEdges& face) {
      visit_spans(face, rows.width(), [&](int row, int from, int to) {
        std::fill(image.begin() + row * rows.width() + from, image.begin() + row * rows.width() + to, 1);
      });
    });
    for (int row = 0; row < rows.height(); ++row)
      for (int x = 0; x < rows.width(); ++x)
        rows.word(batch.first + i, x / 32, row) |= std::uint32_t{image[row * width + x]} << (x % 32);
  }
}

void fill_span_buffers(const SampleBatch& batch, BlockedRows& rows) {
  std::vector<std::vector<std::array<int, 2>>> buffer(static_cast<std::size_t>(rows.height()));
  for (int i = 0; i < batch.count; ++i) {
    visit_faces(batch, i, [&](const FaceEdges& face) {
      visit_spans(face, rows.width(), [&](int row, int from, int to) {
        auto& spans = buffer[row];
        auto it = std::ranges::lower_bound(spans, from, {}, [](const auto& s) { return s[1]; });  // ends not before
        const auto first = it;
        for (; it != spans.end() && (*it)[0] <= to; ++it) from = std::min(from, (*it)[0]), to = std::max(to, (*it)[1]);
        spans.insert(spans.erase(first, it), {from, to});
      });
    });
    for (int row = 0; row < rows.height(); ++row) {
      for (const auto& span : buffer[row]) set_span(rows, batch.first + i, row, span);
      buffer[row].clear();
    }
  }
}

void fill_edge_flags(const SampleBatch& batch, BlockedRows& rows) {
  FlagBuffer flags(rows.width(), rows.height());
  for (std::size_t e = 0; e < batch.view.edges.size(); ++e)
    for (int i = 0; i < batch.count; ++i)
      if (const int direction = direction_of(batch, batch.view.edges[e], i); direction != 0)
        flags.add(batch.projected.edges[e].of(i), i, direction);
  for (int i = 0; i < batch.count; ++i)
    for (const FaceEdges& face : batch.beside_light[i]) add_alone(face, i, flags, rows.width());
  flags.run(batch, rows);
}

}  // namespace oriel::study
