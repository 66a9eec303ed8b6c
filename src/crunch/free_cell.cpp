// A free cell: LPs with strain amplitudes go on from the packing that fits the fixed one. They end in a strictly jammed
// packing, with d (N' - 1) + d (d + 1) / 2 contacts when it is disordered (Torquato and Jiao, Phys. Rev. E 82, 061302
// (2010)). The barrier path has no strain: near its optimum a few LPs do.
#include "core/cell_reduction.hpp"
#include "crunch/state.hpp"

namespace jam {

bool frees_cell(const CrunchState &s) {
  return s.o.strain != JAM_STRAIN_NONE && s.strain.count() == 0 && s.out.report.stop_reason == JAM_STOP_NONE;
}

Phase free_cell(CrunchState &s) {
  const bool edges = (s.o.strain & JAM_STRAIN_EDGES) != 0, tilts = (s.o.strain & JAM_STRAIN_TILTS) != 0;
  s.strain = strain_basis(s.out.packing.dim, edges, tilts);
  s.monitor.log(JAM_LOG_INFO, "fixed cell: phi %.12f; %d strains join", packing_fraction(s.out.packing),
                s.strain.count());
  s.bound = s.tuning.strain_bound;
  s.last_gain = s.moved = 1.0;
  s.stalled = 0;
  s.exact = false;
  return Phase::approach;
}

void shorten_cell(Packing &p) {
  const ReducedCell reduced = [&] {
    std::vector<double> rows;
    for (int c = 0; c < p.dim; ++c) rows.insert(rows.end(), p.cell.row(c), p.cell.row(c) + p.dim);
    return reduce_cell(p.dim, rows.data());
  }();
  enter_cell(p, reduced);
}

}  // namespace jam
