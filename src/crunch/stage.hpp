// Where a crunch stands between two steps. With the packing it is all that another call needs to go on.
#pragma once
#include <string>

namespace jam {

// On the barrier path multipliers are mu over gap, so mu alone brings them back. mu = 0: not on the path.
struct PathPoint {
  double mu = 0.0, first_mu = 0.0;
};

struct CrunchStage {
  PathPoint path;
  bool path_taken = false, cell_free = false;

  std::string bytes() const;
  static CrunchStage of(const std::string &bytes);  // throws JAM_E_FORMAT
};

}  // namespace jam
