// A store that doubts another: some of its units are computed again and compared.
#pragma once

#include "bake/jobs/units.h"

namespace oriel {

class CheckingStore : public UnitStore {
 public:
  // `kept` must outlive it. share: of the units, [0, 1], that are computed although they are kept; which ones follows
  // from `seed`.
  CheckingStore(UnitStore& kept, double share, std::uint64_t seed) : kept_(kept), share_(share), seed_(seed) {}

  std::optional<KeptUnit> find(const Hash128& name) override;
  bool claim(const Hash128& name) override;
  void keep(const Hash128& name, const KeptUnit& unit) override;
  void leave(const Hash128& name) override;
  UnitShare share() const override { return kept_.share(); }
  std::optional<Bytes> peek(const Hash128& name) override { return kept_.peek(name); }

  std::uint64_t checked() const { return checked_; }
  std::uint64_t differing() const { return differing_; }

 private:
  bool is_doubted(const Hash128& name) const;

  UnitStore& kept_;
  double share_;
  std::uint64_t seed_;
  std::atomic<std::uint64_t> checked_{0}, differing_{0};
};

}  // namespace oriel
