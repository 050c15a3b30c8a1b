#include "formats/query/mover_pose.h"

#include <charconv>
#include <glm/gtc/quaternion.hpp>

#include "formats/core/text.h"

namespace oriel {
namespace {

glm::quat quaternion(const Vec4& r) {
  return glm::normalize(glm::quat(r.w, r.x, r.y, r.z));
}
Vec4 stored(const glm::quat& q) {
  return {q.x, q.y, q.z, q.w};
}

}  // namespace

MoverPose pose_at(const MoverPose& rest, std::span<const MoverKey> keys, double time_s) {
  if (keys.empty()) return rest;
  const double last = keys.back().time_s;
  double time = std::isfinite(time_s) ? time_s : 0;
  if (time > last) time = last > 0 ? std::fmod(time, last) : last;
  const auto above = std::upper_bound(keys.begin(), keys.end(), time,
                                      [](double t, const MoverKey& key) { return t < double{key.time_s}; });
  if (above == keys.begin()) return keys.front().pose;
  if (above == keys.end()) return keys.back().pose;
  const MoverKey &a = above[-1], &b = *above;
  const auto share = static_cast<float>((time - a.time_s) / (double{b.time_s} - a.time_s));
  return {glm::mix(a.pose.position, b.pose.position, share),
          stored(glm::slerp(quaternion(a.pose.rotation), quaternion(b.pose.rotation), share))};
}

DMat4 pack_from_object(const MoverPose& pose) {
  const Vec4& r = pose.rotation;
  DMat4 matrix = glm::mat4_cast(glm::normalize(glm::dquat(r.w, r.x, r.y, r.z)));
  matrix[3] = DVec4(DVec3(pose.position), 1);
  return matrix;
}

MoverPose motion_between(const MoverPose& from, const MoverPose& to) {
  const auto in_double = [](const Vec4& r) { return glm::normalize(glm::dquat(r.w, r.x, r.y, r.z)); };
  const glm::dquat turn = in_double(to.rotation) * glm::conjugate(in_double(from.rotation));
  const DVec3 by = DVec3(to.position) - DVec3(from.position), axis(turn.x, turn.y, turn.z);
  if (glm::dot(by, by) < 1e-12 && glm::dot(axis, axis) < 1e-12) return {};
  return {Vec3(DVec3(to.position) - turn * DVec3(from.position)), stored(glm::quat(turn))};
}

Result<MoverMove> parse_move(std::string_view text) {
  const std::size_t equals = text.rfind('=');
  MoverMove move;
  std::vector<double> numbers;
  bool read = equals != std::string_view::npos && equals > 0;
  if (read) {
    move.node = text.substr(0, equals);
    const char *at = text.data() + equals + 1, *end = text.data() + text.size();
    while (read) {
      double number = 0;
      const auto [after, error] = std::from_chars(at, end, number);
      read = error == std::errc() && std::isfinite(number) && std::abs(number) < 1e9 && (after == end || *after == ',');
      numbers.push_back(number);
      if (after == end) break;
      at = after + 1;
    }
  }
  if (!read || numbers.size() < 3 || numbers.size() > 4)
    return fail(ErrorCode::kUsage, "", "found '{}', expected NODE=x,y,z or NODE=x,y,z,yaw: metres, degrees, below 1e9",
                text);
  move.position = DVec3(numbers[0], numbers[1], numbers[2]);
  if (numbers.size() == 4) move.yaw_rad = numbers[3] * kPiD / 180;
  return move;
}

std::string text_of(const MoverMove& move) {
  return fmt::format("{}={:.3f},{:.3f},{:.3f},{:.1f}", move.node, move.position.x, move.position.y, move.position.z,
                     std::remainder(move.yaw_rad, 2 * kPiD) * 180 / kPiD);
}

MoverPose moved(const MoverPose& pose, const MoverMove& move, const DVec3& origin) {
  const glm::quat turn = glm::angleAxis(static_cast<float>(std::remainder(move.yaw_rad, 2 * kPiD)), Vec3(0, 1, 0));
  return {Vec3(move.position - origin), stored(turn * quaternion(pose.rotation))};
}

Status apply_moves(std::span<const MoverMove> moves, std::span<const std::string> names, const DVec3& origin,
                   std::span<MoverPose> poses) {
  for (const MoverMove& move : moves) {
    bool found = false;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] != move.node) continue;
      poses[i] = moved(poses[i], move, origin);
      found = true;
    }
    if (!found)
      return fail(ErrorCode::kUsage, "--move", "found the mover \"{}\", expected one that moves: {}", move.node,
                  names_like(move.node, std::vector<std::string>(names.begin(), names.end())));
  }
  return {};
}

}  // namespace oriel
