// States of a crunch that the page shows behind its slider: few enough, and in floats, so that the file stays small.
#pragma once
#include <cstdint>
#include <vector>

#include "core/packing.hpp"

namespace jam {

struct KeptStep {
  int64_t step;                 // rows of the history before this state: 0 is the start
  double diameter;              // of the first sphere; all grow by one factor
  double fraction;              // packing fraction
  Cell cell;                    // a free cell changes from step to step
  std::vector<float> position;  // (n, dim)
};

class KeptSteps {
 public:
  // most: states to keep, the start with them; 0: none. Large packings keep fewer.
  void begin(const Packing &start, int64_t most);
  // After each step. Where there is no more room every other state goes.
  void add(const Packing &now, int64_t step);
  std::vector<KeptStep> all() && { return std::move(kept_); }

 private:
  int64_t most_ = 0, every_ = 1;
  std::vector<KeptStep> kept_;
};

}  // namespace jam
