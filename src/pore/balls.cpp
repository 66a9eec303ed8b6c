#include "pore/balls.hpp"

#include <cmath>

#include "core/error.hpp"

namespace jam::inside {

void check_has_pores(const Packing &p) {
  if (p.dim > 3) fail(JAM_E_UNSUPPORTED, "the pore space is computed in d = 2 and 3, this packing has d = %d", p.dim);
  if (p.model != JAM_MODEL_EUCLID)
    fail(JAM_E_UNSUPPORTED, "spheres of the Mari-Kurchan model have no pore space: each pair has its own distance");
}

std::array<double, 3> image_centre(const Packing &p, int32_t sphere, const std::array<int, 3> &cells) {
  std::array<double, 3> x{};
  const auto at = static_cast<size_t>(sphere) * static_cast<size_t>(p.dim);
  for (int c = 0; c < p.dim; ++c) {
    x[c] = p.position[at + static_cast<size_t>(c)];
    for (int k = c; k < p.dim; ++k) x[c] += cells[k] * p.cell.row(k)[c];
  }
  return x;
}

std::array<int, 3> cells_of(const Cell &cell, const double *offset) {
  std::array<double, JAM_MAX_DIM> s{};
  std::array<int, 3> cells{};
  cell.fraction(offset, s.data());
  for (int c = 0; c < cell.dim(); ++c) cells[c] = static_cast<int>(std::nearbyint(s[c]));
  return cells;
}

namespace {

// Components above c are chosen: the triangle of cell vectors leaves each of them as it is.
void descend(const Packing &p, int c, double reach, SphereImage &image, std::vector<SphereImage> &out) {
  if (c < 0) {
    image.centre = image_centre(p, image.sphere, image.cells);
    out.push_back(image);
    return;
  }
  image.cells[c] = 0;
  const double x = image_centre(p, image.sphere, image.cells)[c], edge = p.cell.edge(c);
  const int first = p.cell.repeats(c) ? static_cast<int>(std::ceil((-reach - x) / edge)) : 0;
  const int last = p.cell.repeats(c) ? static_cast<int>(std::floor((edge + reach - x) / edge)) : 0;
  for (int m = first; m <= last; ++m) {
    for (int k = 0; k < c; ++k) image.cells[k] = 0;
    image.cells[c] = m;
    descend(p, c - 1, reach, image, out);
  }
  image.cells[c] = 0;
}

}  // namespace

std::vector<SphereImage> images_near_brick(const Packing &p, const std::vector<double> &reach) {
  std::vector<SphereImage> out;
  for (size_t i = 0; i < p.n(); ++i) {
    SphereImage image{static_cast<int32_t>(i), {}, {}};
    descend(p, p.dim - 1, reach[i], image, out);
  }
  return out;
}

}  // namespace jam::inside
