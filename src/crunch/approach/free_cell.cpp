#include "crunch/approach/free_cell.hpp"

#include "crunch/control.hpp"

namespace jam::inside {

bool frees_cell(const CrunchState &s) {
  return s.o.strain != JAM_STRAIN_NONE && s.next.strain.count() == 0 && s.out.report.stop_reason == JAM_STOP_NONE;
}

Phase free_cell(CrunchState &s) {
  const bool edges = (s.o.strain & JAM_STRAIN_EDGES) != 0, tilts = (s.o.strain & JAM_STRAIN_TILTS) != 0;
  s.next.strain = strain_basis(s.out.packing.dim, edges, tilts);
  s.monitor.log(JAM_LOG_INFO, "fixed cell: phi %.12f; %d strains join", packing_fraction(s.out.packing),
                s.next.strain.count());
  restart_lps(s, s.tuning.first_bound);
  s.history.stage.path_taken = false;
  s.history.stage.cell_free = true;
  return Phase::approach;
}

}  // namespace jam::inside
