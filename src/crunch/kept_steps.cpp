#include "crunch/kept_steps.hpp"

#include <algorithm>

#include "core/limits.hpp"

namespace jam {

void KeptSteps::begin(const Packing &start, int64_t most) {
  const int64_t room = limits::kept_coordinates / static_cast<int64_t>(start.position.size());
  most_ = std::min(most, std::max<int64_t>(1, room));
  every_ = 1;
  kept_.clear();
  add(start, 0);
}

void KeptSteps::add(const Packing &now, int64_t step) {
  if (most_ == 0 || step % every_ != 0) return;
  kept_.push_back({step, now.diameter.front(), packing_fraction(now), now.cell,
                   std::vector<float>(now.position.begin(), now.position.end())});
  while (static_cast<int64_t>(kept_.size()) > most_) {
    every_ *= 2;
    kept_.erase(std::remove_if(kept_.begin(), kept_.end(), [&](const KeptStep &k) { return k.step % every_ != 0; }),
                kept_.end());
  }
}

}  // namespace jam
