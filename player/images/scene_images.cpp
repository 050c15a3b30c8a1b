#include "player/images/scene_images.h"

#include <algorithm>

#include "formats/core/parallel.h"

namespace oriel {
namespace {

constexpr std::size_t kSlice = 512 << 10;                   // bytes that are handed over between looks at the clock
constexpr std::size_t kMostInFlight = 32;                   // images
constexpr std::uint64_t kMostBytesInFlight = 256ull << 20;  // of memory beside the device's, roughly
constexpr float kUnknownLux = 100;                          // any: exposure follows it

bool is_map(ImageKind kind) {
  return kind == ImageKind::kMaps || kind == ImageKind::kSurround;
}

}  // namespace

SceneImages::SceneImages(ImageSource source, const std::vector<ImageUse>& uses, const LoadingOptions& options)
    : source_(std::move(source)),
      options_(options),
      account_(options.limit),
      uses_(uses),
      background_(options.background ? std::max<std::size_t>(core_count() - 1, 1) : core_count(), options.background) {
  const std::array<std::size_t, 5> counts = source_.counts();
  for (std::size_t kind = 0; kind < counts.size(); ++kind) {
    first_[kind] = items_.size();
    for (std::size_t i = 0; i < counts[kind]; ++i) {
      Item item;
      item.name = {static_cast<ImageKind>(kind), static_cast<std::uint32_t>(i)};
      item.wanted = !is_map(item.name.kind);
      for (int level = 0; level <= source_.coarsest(item.name); ++level)
        item.bytes.push_back(source_.bytes(item.name, level));
      items_.push_back(std::move(item));
    }
  }
  colors_.resize(counts[0]);
  normals_.resize(counts[1]);
  lights_.resize(counts[2]);
  maps_ = std::vector<ReflectorMaps>(counts[3]);
  surrounds_.resize(counts[4]);
  const std::array<std::uint8_t, 4> grey{188, 188, 188, 255}, flat{128, 128, 255, 255};
  grey_ = gpu::Texture2d(gpu::kSrgbAlpha8, 1, 1, grey.data());
  flat_ = gpu::Texture2d(gpu::kRgba8, 1, 1, flat.data());
  const Half4 one = halves_of(Vec3(1));
  some_light_.texture = gpu::Texture2d(gpu::kRgba16f, 1, 1, one.data());
  some_light_.scale = kUnknownLux;
}

std::vector<Error> SceneImages::finish(Clock::time_point until) {
  while (true) {
    const Clock::time_point now = Clock::now();
    std::vector<Error> errors = advance(now < until ? until - now : Clock::duration(0));
    if (!errors.empty() || (in_flight_ == 0 && uploads_.empty()) || Clock::now() >= until) return errors;
    background_.wait_below(in_flight_, until);
  }
}

void SceneImages::prioritise(const Vec3& eye, const Frustum& frustum, const std::vector<std::uint8_t>* seen) {
  std::vector<float> ranks(items_.size(), 1e9f);
  for (const ImageUse& use : uses_) {
    float& rank = ranks[index_of(use.image)];
    const bool may_be_seen = seen == nullptr || use.group >= seen->size() || (*seen)[use.group] != 0;
    rank = std::min(rank, rank_of(use.bounds, eye, may_be_visible(frustum, use.bounds), may_be_seen));
  }
  for (std::size_t i = 0; i < items_.size(); ++i) {
    plan_is_due_ = plan_is_due_ || items_[i].rank != ranks[i];
    items_[i].rank = ranks[i];
  }
}

void SceneImages::want(const ImageName& maps) {
  Item& item = items_[index_of(maps)];
  plan_is_due_ = plan_is_due_ || !item.wanted;
  item.wanted = item.asked_for = true;
}

void SceneImages::begin_wants() {
  if (account_.limit() == kNoLimit) return;  // what is there may stay
  for (Item& item : items_) {
    if (!is_map(item.name.kind)) continue;
    const bool still = options_.background && item.asked_for;
    plan_is_due_ = plan_is_due_ || item.wanted != still;
    item.wanted = still;
    item.asked_for = false;
  }
}

// Gives each item its target, and drops what has to leave.
void SceneImages::plan() {
  plan_is_due_ = false;
  std::vector<Wish> wishes;
  std::vector<std::size_t> whose;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const Item& item = items_[i];
    items_[i].target = -1;
    if (item.failed || !item.wanted) continue;
    wishes.push_back({item.bytes, item.rank});
    whose.push_back(i);
  }
  const std::vector<int> levels = plan_residency(wishes, account_.limit());
  for (std::size_t w = 0; w < wishes.size(); ++w)
    if (levels[w] < wishes[w].out()) items_[whose[w]].target = levels[w];
  if (account_.limit() == kNoLimit) return;
  for (Item& item : items_) {
    if (item.level < 0 || item.target >= 0) continue;
    drop(item);
    source_.forget(item.name);
  }
}

void SceneImages::drop(Item& item) {
  const std::uint64_t bytes = item.bytes[static_cast<std::size_t>(item.level)];
  account_.give_back(bytes);
  if (is_map(item.name.kind)) map_bytes_ -= bytes;
  item.level = -1;
  const std::uint32_t i = item.name.index;
  switch (item.name.kind) {
    case ImageKind::kColor:
      colors_[i] = {};
      break;
    case ImageKind::kNormal:
      normals_[i] = {};
      break;
    case ImageKind::kLight:
      lights_[i] = {};
      break;
    case ImageKind::kMaps:
      maps_[i] = {};
      break;
    case ImageKind::kSurround:
      surrounds_[i] = {};
      break;
  }
}

// In order of rank: what is not there before what is there otherwise than it should be.
void SceneImages::ask_for_more() {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < items_.size(); ++i)
    if (items_[i].target >= 0 && items_[i].coming < 0 &&
        (items_[i].target != items_[i].level || wants_light(items_[i])))
      order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const bool there_a = items_[a].level >= 0, there_b = items_[b].level >= 0;
    return there_a != there_b ? there_b : items_[a].rank < items_[b].rank;
  });
  for (const std::size_t i : order) {
    if (in_flight_ >= kMostInFlight || (in_flight_ > 0 && bytes_in_flight_ >= kMostBytesInFlight)) return;
    begin(i);
  }
}

// Whether maps that are there are to be made anew for lamps as they shine now.
bool SceneImages::wants_light(const Item& item) const {
  return is_map(item.name.kind) && item.level >= 0 && item.level == item.target && !is_lit(item.name) &&
         (options_.background || item.asked_for) && (item.name.kind != ImageKind::kMaps || source_.geometry() == 0);
}

// Unless there is no room for it yet.
void SceneImages::begin(std::size_t index) {
  Item& item = items_[index];
  const int level = item.target;
  const auto light_alone = [&] { return item.level == level && item.geometry == geometry_of(item.name); };
  const auto bytes_of = [&] {
    return light_alone() ? source_.light_bytes(item.name, level) : item.bytes[static_cast<std::size_t>(level)];
  };
  if (!account_.has_room(bytes_of()) && item.level >= 0) {  // there is no room for both
    if (item.level == level && in_flight_ > 0) return;      // others give theirs back first
    drop(item);
  }
  const bool again = item.level == level, alone = light_alone();
  const std::uint64_t bytes = bytes_of();
  if (!account_.take(bytes)) return;
  item.coming = level;
  ++in_flight_;
  bytes_in_flight_ += bytes;
  if (again) again_in_flight_ += bytes;
  background_.add([=, this, name = item.name] {
    made_.put(
        {index, level, again, alone, bytes, alone ? source_.prepare_light(name, level) : source_.prepare(name, level)});
  });
}

void SceneImages::receive(std::vector<Error>& errors) {
  for (Made& made : made_.take()) {
    Item& item = items_[made.item];
    if (made.image && item.target == made.level && (!made.light_alone || item.level == made.level)) {
      uploads_.push_back(
          {made.item, made.level, made.again, made.light_alone, made.bytes, std::move(*made.image), {}, 0});
      continue;  // in flight until it is there
    }
    --in_flight_;
    bytes_in_flight_ -= made.bytes;
    if (made.again) again_in_flight_ -= made.bytes;
    if (!made.image) {
      give_up(made, errors);
    } else {  // things have changed meanwhile
      account_.give_back(made.bytes);
      item.coming = -1;
      if (item.level < 0 && item.target < 0) source_.forget(item.name);
    }
  }
}

void SceneImages::give_up(const Made& made, std::vector<Error>& errors) {
  Item& item = items_[made.item];
  account_.give_back(made.bytes);
  item.coming = -1;
  errors.push_back(made.image.error());
  if (made.again && item.level >= 0) {  // it stays as it is until lamps change again
    item.lights = source_.lights();
    return;
  }
  item.failed = true;
  plan_is_due_ = true;
}

std::vector<Error> SceneImages::advance(Clock::duration budget) {
  const Clock::time_point now = Clock::now();
  const Clock::time_point end = budget < Clock::time_point::max() - now ? now + budget : Clock::time_point::max();
  std::vector<Error> errors = std::exchange(page_errors_, {});
  receive(errors);
  if (plan_is_due_) plan();
  while (!uploads_.empty() && step_upload(end)) {
  }
  ask_for_more();
  for (const Status& status : checks_.take()) {
    checking_ = false;
    if (!status) errors.push_back(status.error());
  }
  if (options_.background && in_flight_ == 0 && uploads_.empty()) check_more();
  return errors;
}

// One section at a time: images may be wanted meanwhile.
void SceneImages::check_more() {
  const DeferredImages* deferred = source_.deferred();
  if (deferred == nullptr || checking_) return;
  while (next_check_ < deferred->sections() && deferred->was_checked(next_check_)) ++next_check_;
  if (next_check_ == deferred->sections()) return;
  checking_ = true;
  background_.add([this, deferred, section = next_check_] { checks_.put(deferred->check(section)); });
}

// Some of the upload that matters most; false once the time is over.
bool SceneImages::step_upload(Clock::time_point end) {
  const auto first = std::min_element(uploads_.begin(), uploads_.end(), [&](const Upload& a, const Upload& b) {
    return std::pair(a.next == 0 && a.textures.empty(), items_[a.item].rank) <
           std::pair(b.next == 0 && b.textures.empty(), items_[b.item].rank);
  });
  Upload& upload = *first;
  while (upload.next < upload.image.textures.size()) {
    if (upload.textures.size() == upload.next)
      upload.textures.emplace_back(std::move(upload.image.textures[upload.next]));
    if (upload.textures.back().step(kSlice)) ++upload.next;
    if (Clock::now() >= end) return false;
  }
  --in_flight_;
  bytes_in_flight_ -= upload.bytes;
  settle(upload);
  uploads_.erase(first);
  return Clock::now() < end;
}

// What was uploaded takes its place.
void SceneImages::settle(Upload& upload) {
  Item& item = items_[upload.item];
  item.coming = -1;
  if (upload.again) {
    again_in_flight_ -= upload.bytes;
    light_came_ = options_.background;
  }
  if (upload.light_alone) {  // it takes the place of as many bytes
    account_.give_back(upload.bytes);
    if (item.level != upload.level) return;  // they have left meanwhile
  }
  item.lights = upload.image.lights;
  if (!upload.light_alone) item.geometry = item.name.kind == ImageKind::kMaps ? 0 : upload.image.geometry;
  if (upload.light_alone) return item.name.kind == ImageKind::kMaps ? settle_maps(upload) : settle_surround(upload);
  if (item.level >= 0) drop(item);
  item.level = upload.level;
  if (item.target < 0) plan_is_due_ = true;  // not wanted any more: its room is others'
  const std::uint32_t i = item.name.index;
  auto& textures = upload.textures;
  switch (item.name.kind) {
    case ImageKind::kColor:
    case ImageKind::kNormal: {
      gpu::Texture2d& texture = (item.name.kind == ImageKind::kColor ? colors_ : normals_)[i];
      texture = std::move(textures[0].texture);
      if (!upload.image.texture.texels.empty()) texels_.emplace_back(i, std::move(upload.image.texture));
      break;
    }
    case ImageKind::kLight:
      settle_light(i, upload.image, textures);
      break;
    case ImageKind::kMaps:
      settle_maps(upload);
      break;
    case ImageKind::kSurround:
      settle_surround(upload);
      break;
  }
  if (is_map(item.name.kind)) map_bytes_ += item.bytes[static_cast<std::size_t>(item.level)];
}

const gpu::Texture2d& SceneImages::color(std::uint32_t index) const {
  return colors_[index] ? colors_[index] : grey_;
}

const gpu::Texture2d& SceneImages::normal(std::uint32_t index) const {
  return normals_[index] ? normals_[index] : flat_;
}

const LoadedLightmap& SceneImages::light(std::uint32_t index) const {
  return lights_[index].texture ? lights_[index] : some_light_;
}

Result<const LightmapPage*> SceneImages::page(std::uint32_t index, const LightmapPage& in_pack) {
  if (source_.deferred() == nullptr && source_.lights() == 0) return &in_pack;
  const auto make = [this, index] {
    KnownPage made;
    made.page = source_.lit_page(index, made.lights);
    return made;
  };
  for (auto& [of, made] : made_pages_.take()) {
    if (!made.page) page_errors_.push_back(made.page.error());
    coming_pages_.erase(of);
    pages_[of] = std::move(made);
  }
  auto found = pages_.find(index);
  const bool known = found != pages_.end() && (found->second.lights == source_.lights() || !found->second.page);
  if (!known && options_.background) {
    if (coming_pages_.insert(index).second) background_.add([=, this] { made_pages_.put({index, make()}); });
    return nullptr;
  }
  if (!known) found = pages_.insert_or_assign(index, make()).first;
  const Result<LightmapPage>& page = found->second.page;
  if (!page && options_.background) return nullptr;  // advance() tells why
  if (!page) return tl::unexpected<Error>(page.error());
  return &*page;
}

LoadingState SceneImages::state() const {
  LoadingState out;
  out.busy = plan_is_due_;
  out.used = account_.used() - again_in_flight_;
  out.most_used = account_.most_used();
  out.limit = account_.limit();
  for (const Item& item : items_) {
    out.failed += item.failed ? 1 : 0;
    if (!item.wanted || item.failed) continue;
    const int target = item.target < 0 && plan_is_due_ ? 0 : item.target;  // as it may be
    out.left_out += target < 0 ? 1 : 0;
    out.coarser += target > 0 ? 1 : 0;
    if (target < 0) continue;
    const std::uint64_t bytes = item.bytes[static_cast<std::size_t>(target)];
    out.wanted += bytes;
    out.there += item.level == target ? bytes : 0;
    out.busy = out.busy || item.level != target;
    out.following = out.following || wants_light(item);
  }
  const DeferredImages* deferred = source_.deferred();
  out.checking = options_.background && deferred != nullptr && next_check_ < deferred->sections();
  return out;
}

}  // namespace oriel
