#include "bake/jobs/checking_store.h"

namespace oriel {

bool CheckingStore::is_doubted(const Hash128& name) const {
  return static_cast<double>(hash_of(name, seed_).low >> 11) * 0x1p-53 < share_;
}

std::optional<KeptUnit> CheckingStore::find(const Hash128& name) {
  return is_doubted(name) ? std::nullopt : kept_.find(name);
}

bool CheckingStore::claim(const Hash128& name) {
  return is_doubted(name) || kept_.claim(name);
}

void CheckingStore::leave(const Hash128& name) {
  if (!is_doubted(name)) kept_.leave(name);
}

void CheckingStore::keep(const Hash128& name, const KeptUnit& unit) {
  if (is_doubted(name)) {
    if (const auto known = kept_.find(name)) {
      ++checked_;
      differing_ += known->results != unit.results;
      return;
    }
  }
  kept_.keep(name, unit);
}

}  // namespace oriel
