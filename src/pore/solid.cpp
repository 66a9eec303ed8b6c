#include "pore/solid.hpp"

#include <cmath>

#include "core/error.hpp"

namespace jam::inside {
namespace {

double radius_of(const Packing &p, int32_t i) { return 0.5 * p.diameter[static_cast<size_t>(i)]; }

// The vector of pair k from its first sphere to its second.
Point vector_of(const Packing &p, const PairList &pairs, size_t k) {
  double r[JAM_MAX_DIM];
  pair_vector(p, pairs, k, r);
  Point d{};
  for (int c = 0; c < p.dim; ++c) d[static_cast<size_t>(c)] = -r[c];
  return d;
}

// Spheres that another one with the same centre covers, of equal ones all but the first. Their cells are empty, so they
// cut no other cell: of two equal planes each would be taken off.
std::vector<char> covered_by_concentric(const Packing &p, const PairList &pairs) {
  std::vector<char> covered(p.n(), 0);
  for (size_t k = 0; k < pairs.size(); ++k) {
    const Point d = vector_of(p, pairs, k);
    if (dot(d, d) > 0.0) continue;
    const bool smaller = radius_of(p, pairs.i[k]) < radius_of(p, pairs.j[k]);
    covered[static_cast<size_t>(smaller ? pairs.i[k] : pairs.j[k])] = 1;
  }
  return covered;
}

}  // namespace

PairList overlapping_pairs(const Packing &p) {
  if (!p.overlap_allowed && p.non_additivity >= 0.0) return {};  // hard spheres: no search
  Packing additive = p;
  additive.non_additivity = 0.0;
  const PairList near = find_pairs(additive, 0.0, 1.0);
  PairList out;
  for (size_t k = 0; k < near.size(); ++k) {
    if (near.wall(k)) continue;
    const Point d = vector_of(p, near, k);
    if (relative_overlap(radius_of(p, near.i[k]), radius_of(p, near.j[k]), std::sqrt(dot(d, d))) > SolidTuning::overlap)
      out.append(near, k);
  }
  return out;
}

Solid::Solid(const Packing &p) : p_(p) {
  const PairList pairs = overlapping_pairs(p);
  if (pairs.size() > 0) cuts_.resize(p.n()), passes_.resize(p.n());
  const auto add = [&](int32_t i, int32_t j, const Point &d, bool first) {
    const HalfSpace h = nearer_by_power(radius_of(p, i), d, radius_of(p, j), first);
    if (h.offset < radius_of(p, i)) cuts_[static_cast<size_t>(i)].push_back(h);
  };
  const std::vector<char> covered = covered_by_concentric(p, pairs);
  for (size_t k = 0; k < pairs.size(); ++k) {
    const Point d = vector_of(p, pairs, k);
    if (!covered[static_cast<size_t>(pairs.j[k])]) add(pairs.i[k], pairs.j[k], d, true);
    if (!covered[static_cast<size_t>(pairs.i[k])]) add(pairs.j[k], pairs.i[k], {-d[0], -d[1], -d[2]}, false);
  }
  cut_by_walls();
}

void Solid::cut_by_walls() {
  if (!p_.overlap_allowed) return;
  for (size_t i = 0; i < p_.n(); ++i)
    for (int w = 0; w < p_.container.count(); ++w) {
      const double *x = &p_.position[i * static_cast<size_t>(p_.dim)], radius = 0.5 * p_.diameter[i];
      const double distance = p_.container[w].distance(x);
      if (!(radius - distance > SolidTuning::overlap * radius)) continue;
      if (cuts_.empty()) cuts_.resize(p_.n()), passes_.resize(p_.n());
      if (p_.container[w].curved()) {
        passes_[i] = 1;
        continue;
      }
      Point n{};
      p_.container[w].normal(x, n.data());
      cuts_[i].push_back({{-n[0], -n[1], -n[2]}, distance});
    }
}

bool Solid::any_passes_round_wall() const {
  return std::any_of(passes_.begin(), passes_.end(), [](char passes) { return passes != 0; });
}

double Solid::in_round(size_t i, double radius, const std::vector<HalfSpace> &cuts) const {
  const double middle = 0.5 * p_.cell.edge(0), own = 0.5 * p_.diameter[i];
  Ball round{{}, radius};
  for (int c = 0; c < p_.container.round_axes(); ++c)
    round.x[static_cast<size_t>(c)] = middle - p_.position[i * static_cast<size_t>(p_.dim) + static_cast<size_t>(c)];
  return p_.container.round_axes() == p_.dim ? cut_volume_in_ball(p_.dim, own, cuts, round)
                                             : cut_volume_in_cylinder(own, cuts, round);
}

double Solid::volume(size_t i, const HalfSpace &more) const {
  std::vector<HalfSpace> cut = cuts(i);
  cut.push_back(more);
  return passes_round_wall(i) ? in_round(i, 0.5 * p_.cell.edge(0), cut) : cut_volume(p_.dim, 0.5 * p_.diameter[i], cut);
}

double Solid::volume_within(size_t i, double radius) const { return in_round(i, radius, cuts(i)); }

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
