#include "io/lammps.hpp"

namespace jam::inside {

LammpsBox lammps_box(const Packing &p) {
  LammpsBox box;
  for (int c = 0; c < p.dim; ++c) box.high[c] = p.cell.edge(c);
  if (p.dim == 2) {
    box.low[2] = -0.5 * p.cell.side();
    box.high[2] = 0.5 * p.cell.side();
  }
  if (p.cell.cube()) return box;
  box.tilt[0] = p.cell.row(1)[0];
  if (p.dim == 3) {
    box.tilt[1] = p.cell.row(2)[0];
    box.tilt[2] = p.cell.row(2)[1];
  }
  for (const double t : box.tilt) box.tilted = box.tilted || t != 0.0;
  return box;
}

}  // namespace jam::inside
