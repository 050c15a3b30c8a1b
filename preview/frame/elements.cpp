#include "preview/frame/elements.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "bake/jobs/parallel.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::size_t kPlaces = 32;         // of an element, that rays go to
constexpr double kUnseen = 0.1;             // of all importance, that is shared by light as if nothing were between
constexpr double kAnyway = 0.01;            // by power
constexpr double kHidden = 0.05;            // of its light unshadowed, that counts of a landing that is not seen
constexpr std::size_t kLandingsATask = 64;  // landings of a task
constexpr float kNear =
    0.03f;  // of the scene's radius: light of what is nearer to the eye's points counts as from there

// Of six, the axis that the normal is nearest to.
std::uint32_t axis_of(const Vec3& n) {
  const Vec3 a = glm::abs(n);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return 2 * static_cast<std::uint32_t>(axis) + (n[axis] < 0 ? 1 : 0);
}

float near2(const Scene& scene) {
  const float near = kNear * scene.radius();
  return std::max(near * near, 1e-30f);
}

// What each landing shines on the eye's points: two of them, at random, tell whether it is seen.
Result<std::vector<double>> importance_of(std::span<const Landing> landings, std::span<const EyePoint> eye,
                                          const Accel& accel, Context& context) {
  std::vector<double> importance(landings.size());
  const float soft = near2(accel.scene());
  const std::size_t tasks = (landings.size() + kLandingsATask - 1) / kLandingsATask;
  ORIEL_TRY_VOID(parallel_for(context, "", tasks, [&](std::size_t task) {
    for (std::size_t i = task * kLandingsATask; i < std::min(landings.size(), (task + 1) * kLandingsATask); ++i) {
      const Landing& l = landings[i];
      const LampPoint lamp = lamp_at({offset_origin(l.place, l.normal, l.magnitude), l.normal, l.power}, soft);
      double sum = 0, seen = 0;
      int asked = 0;
      for (std::size_t k = 0; k < eye.size(); ++k) {
        const auto shone = shine(lamp, eye[(i + k) % eye.size()], accel.scene());
        if (!shone) continue;
        sum += double{luminance(shone->light)};
        if (asked == 2) continue;
        ++asked;
        seen += double{luminance(accel.transmittance(shone->ray))};
      }
      importance[i] = sum * (seen / std::max(asked, 1) + kHidden);
    }
  }));
  double all = 0, power = 0;
  for (std::size_t i = 0; i < landings.size(); ++i) all += importance[i], power += double{luminance(landings[i].power)};
  const double anyway = all > 0 ? kAnyway * all / power : 1;
  for (std::size_t i = 0; i < landings.size(); ++i) importance[i] += anyway * double{luminance(landings[i].power)};
  return importance;
}

// Landings that are one element: some of an order of them.
struct Cluster {
  std::size_t first = 0, count = 0;
  double importance = 0;
  DVec3 mean{0}, variance{0};  // of their places, by importance
  float least_m2 = 0;          // what it covers at least: a quarter of what it was split from

  double worth() const { return importance * (variance.x + variance.y + variance.z); }  // of splitting it
  bool operator<(const Cluster& other) const { return worth() < other.worth(); }
};

class Clusters {
 public:
  Clusters(std::span<const Landing> landings, std::span<const double> importance)
      : landings_(landings), importance_(importance), order_(landings.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
  }

  std::vector<BounceElement> split(std::uint32_t count) {
    std::priority_queue<Cluster> queue;
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t i, std::uint32_t j) { return axis(i) < axis(j); });
    for (std::size_t first = 0, last = 0; first < order_.size(); first = last) {
      while (last < order_.size() && axis(order_[last]) == axis(order_[first])) ++last;
      queue.push(cluster(first, last - first, 0));
    }
    while (queue.size() < count && !queue.empty() && queue.top().worth() > 0) {
      const Cluster whole = queue.top();
      const std::size_t middle = part(whole);
      if (middle == 0 || middle == whole.count) break;  // rounding alone tells them apart
      queue.pop();
      const float least_m2 = std::max(whole.least_m2, area_of(whole)) / 4;
      queue.push(cluster(whole.first, middle, least_m2));
      queue.push(cluster(whole.first + middle, whole.count - middle, least_m2));
    }
    std::vector<BounceElement> elements;
    for (; !queue.empty(); queue.pop()) elements.push_back(element(queue.top()));
    return elements;
  }

 private:
  std::uint32_t axis(std::uint32_t landing) const { return axis_of(landings_[landing].normal); }

  Cluster cluster(std::size_t first, std::size_t count, float least_m2) const {
    Cluster out{first, count, 0, DVec3(0), DVec3(0), least_m2};
    for (std::size_t i = first; i < first + count; ++i) {
      const double weight = importance_[order_[i]] + 1e-300;
      out.importance += weight;
      out.mean += weight * DVec3(landings_[order_[i]].place);
    }
    out.mean /= out.importance;
    for (std::size_t i = first; i < first + count; ++i) {
      const DVec3 off = DVec3(landings_[order_[i]].place) - out.mean;
      out.variance += (importance_[order_[i]] + 1e-300) / out.importance * off * off;
    }
    return out;
  }

  // Where its landings are farthest apart, at their mean; how many are before it.
  std::size_t part(const Cluster& c) {
    const DVec3& v = c.variance;
    const int along = v.x >= v.y && v.x >= v.z ? 0 : v.y >= v.z ? 1 : 2;
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(c.first);
    const auto middle =
        std::stable_partition(begin, begin + static_cast<std::ptrdiff_t>(c.count),
                              [&](std::uint32_t i) { return double{landings_[i].place[along]} < c.mean[along]; });
    return static_cast<std::size_t>(middle - begin);
  }

  // Of an even disk: mean square distance from its middle is half its radius' square.
  static float area_of(const Cluster& c) {
    return static_cast<float>(2 * kPiD * (c.variance.x + c.variance.y + c.variance.z));
  }

  // Its places half by importance and half by power, each with as much more light as it is taken less often.
  BounceElement element(const Cluster& c) const {
    BounceElement out{std::max(c.least_m2, area_of(c)), Vec3(0), {}, c.importance};
    double run = 0, power = 0;
    const auto power_of = [&](std::size_t i) { return luminance(DVec3(landings_[order_[i]].power)); };
    for (std::size_t i = c.first; i < c.first + c.count; ++i) power += power_of(i);
    const auto places = static_cast<double>(std::min(c.count, kPlaces));
    for (std::size_t i = c.first; i < c.first + c.count; ++i) {
      const Landing& l = landings_[order_[i]];
      const double share = 0.5 * (importance_[order_[i]] + 1e-300) / c.importance + 0.5 * power_of(i) / power;
      const double from = std::round(places * run), to = std::round(places * (run += share));
      for (double k = from; k < to; ++k)
        out.places.push_back(
            {offset_origin(l.place, l.normal, l.magnitude), l.normal, l.power / static_cast<float>(share)});
    }
    for (const BounceElement::Place& p : out.places) out.power += p.power / static_cast<float>(out.places.size());
    return out;
  }

  std::span<const Landing> landings_;
  std::span<const double> importance_;
  std::vector<std::uint32_t> order_;
};

}  // namespace

LampPoint lamp_at(const BounceElement::Place& place, float soft) {
  LampPoint lamp;
  lamp.place = Vec4(place.place, 1), lamp.normal = place.normal, lamp.power = place.power;
  lamp.soft = soft;
  return lamp;
}

Result<std::vector<BounceElement>> bounce_elements(std::span<const Landing> landings, std::span<const EyePoint> eye,
                                                   std::uint32_t count, const Accel& accel, Context& context) {
  if (count == 0 || landings.empty()) return std::vector<BounceElement>();
  ORIEL_TRY(const std::vector<double> importance, importance_of(landings, eye, accel, context));
  return Clusters(landings, importance).split(count);
}

Status find_importance(std::vector<BounceElement>& elements, std::span<const EyePoint> eye, const Accel& accel,
                       Context& context) {
  std::vector<double> unseen(elements.size());  // their light, were nothing between
  ORIEL_TRY_VOID(parallel_for(context, "", elements.size(), [&](std::size_t i) {
    BounceElement& e = elements[i];
    std::vector<Ray> rays;
    std::vector<double> light;
    for (std::size_t k = 0; k < eye.size(); ++k) {
      const LampPoint lamp = lamp_at(e.places[(i + k) % e.places.size()], e.area / kPi + near2(accel.scene()));
      const auto shone = shine(lamp, eye[k], accel.scene());
      if (!shone) continue;
      rays.push_back(shone->ray);
      light.push_back(double{luminance(shone->light)});
    }
    std::vector<Vec3> passed(rays.size());
    accel.transmittance(rays, passed);
    e.importance = 0;
    for (std::size_t k = 0; k < rays.size(); ++k)
      e.importance += light[k] * double{luminance(passed[k])}, unseen[i] += light[k];
  }));
  double power = 0, seen = 0, all = 0;
  for (std::size_t i = 0; i < elements.size(); ++i)
    seen += elements[i].importance, all += unseen[i], power += double{luminance(elements[i].power)};
  for (std::size_t i = 0; i < elements.size(); ++i) {
    double anyway = double{luminance(elements[i].power)} / power;
    if (seen > 0) anyway = seen * (kAnyway * anyway + (all > 0 ? kUnseen * unseen[i] / all : 0));
    elements[i].importance += anyway;
  }
  return {};
}

std::vector<BounceElement> some_of(std::span<const BounceElement> elements, std::size_t count, float u) {
  std::vector<BounceElement> some;
  double total = 0, run = 0;
  for (const BounceElement& e : elements) total += e.importance;
  const double step = total / static_cast<double>(count);
  const float usual = static_cast<float>(elements.size()) / static_cast<float>(count);
  for (const BounceElement& e : elements) {
    const double from = run / step - double{u}, to = (run += e.importance) / step - double{u};
    const double times = std::ceil(to) - std::ceil(from);  // whole steps within it
    if (times <= 0 || some.size() == count) continue;
    some.push_back(e);
    const auto factor = static_cast<float>(times * step / e.importance);
    BounceElement& taken = some.back();
    taken.power *= factor;
    taken.area *= std::max(factor / usual, 1.0f);  // where it stands for more than others it is as large
    for (BounceElement::Place& p : taken.places) p.power *= factor;
  }
  return some;
}

}  // namespace oriel
