#include "formats/core/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <new>

namespace oriel {

std::uint64_t hash64(std::span<const std::byte> bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::string hash128_hex(std::span<const std::byte> bytes) {
  const XXH128_hash_t h = XXH3_128bits(bytes.data(), bytes.size());
  return to_hex({h.high64, h.low64});
}

std::string to_hex(const Hash128& hash) {
  return fmt::format("{:016x}{:016x}", hash.high, hash.low);
}

namespace {

using XxhState = std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)>;

XxhState make_xxh_state() {
  XxhState state(XXH3_createState(), &XXH3_freeState);
  if (!state) throw std::bad_alloc();
  return state;
}

}  // namespace

struct Hasher64::State {
  XxhState xxh = make_xxh_state();
};

Hasher64::Hasher64() : state_(std::make_unique<State>()) {
  reset();
}

Hasher64::~Hasher64() = default;

void Hasher64::reset() {
  XXH3_64bits_reset(state_->xxh.get());
}

void Hasher64::add(std::span<const std::byte> bytes) {
  XXH3_64bits_update(state_->xxh.get(), bytes.data(), bytes.size());
}

std::uint64_t Hasher64::result() const {
  return XXH3_64bits_digest(state_->xxh.get());
}

struct Hasher::State {
  XxhState xxh = make_xxh_state();
};

Hasher::Hasher() : state_(std::make_unique<State>()) {
  XXH3_128bits_reset(state_->xxh.get());
}

Hasher::~Hasher() = default;

void Hasher::add(std::span<const std::byte> bytes) {
  XXH3_128bits_update(state_->xxh.get(), bytes.data(), bytes.size());
}

Hash128 Hasher::result() const {
  const XXH128_hash_t h = XXH3_128bits_digest(state_->xxh.get());
  return {h.high64, h.low64};
}

}  // namespace oriel
