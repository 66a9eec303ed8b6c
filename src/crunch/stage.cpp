#include "crunch/stage.hpp"

#include <cmath>

#include "core/archive.hpp"

namespace jam {

static void archive(CrunchStage &s, Archive &a) {
  a(s.path.mu), a(s.path.first_mu), a(s.path_taken), a(s.cell_free);
  Archive::check(s.path.mu >= 0.0 && s.path.mu <= s.path.first_mu && std::isfinite(s.path.first_mu));
}

std::string CrunchStage::bytes() const {
  CrunchStage copy = *this;
  Archive a;
  archive(copy, a);
  return a.bytes();
}

CrunchStage CrunchStage::of(const std::string &bytes) {
  CrunchStage stage;
  Archive a(bytes);
  archive(stage, a);
  a.end();
  return stage;
}

}  // namespace jam
