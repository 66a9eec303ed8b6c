#include <algorithm>
#include <cmath>

#include "core/limits.hpp"
#include "pore/profile.hpp"
#include "pore/solid_mesh.hpp"

namespace jam::inside {

Joints::Joints(const Packing &p, const ContactNetwork *network, const jam_mesh_options &o)
    : p_(p), o_(o), factor_(o.contacts == JAM_MESH_SHRUNK ? o.factor : 1.0), ends_(p.n()) {
  take_overlaps();
  if (o.contacts == JAM_MESH_BRIDGED && o.bridge_gap > 0.0)
    take_pairs(find_pairs(p, 0.0, 1.0 + o.bridge_gap), nullptr);
  else if (network && o.contacts != JAM_MESH_SHRUNK)
    take_pairs(network->pairs, network);
  check_ends();
  if (o.contacts == JAM_MESH_BRIDGED) check_cylinders();
}

void Joints::take_overlaps() {
  Packing shrunk = p_;
  for (double &sigma : shrunk.diameter) sigma *= factor_;
  const PairList pairs = overlapping_pairs(shrunk);
  for (size_t k = 0; k < pairs.size(); ++k) add(shrunk, pairs, k, true);
}

void Joints::take_pairs(const PairList &pairs, const ContactNetwork *network) {
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (pairs.wall(k)) continue;  // nothing joins a wall
    double r[3];
    const double length = std::sqrt(pair_vector(p_, pairs, k, r)), reach = radius(pairs.i[k]) + radius(pairs.j[k]);
    const bool may_overlap = p_.overlap_allowed || p_.non_additivity < 0.0;
    if (may_overlap && relative_overlap(radius(pairs.i[k]), radius(pairs.j[k]), length) > SolidTuning::overlap)
      continue;
    // In a mixture whose unlike spheres touch at a distance there is no common point.
    if (network && o_.contacts == JAM_MESH_KEPT && p_.non_additivity > 0.0 &&
        length > reach * (1.0 + std::fabs(network->gap[k]) + SolidTuning::overlap))
      continue;
    add(p_, pairs, k, false);
  }
}

void Joints::add(const Packing &p, const PairList &pairs, size_t k, bool overlaps) {
  Joint t{};
  t.i = pairs.i[k], t.j = pairs.j[k];
  t.cells = cells_of(p.cell, &pairs.offset[3 * k]);
  t.overlaps = overlaps;
  double r[3];
  t.length = std::sqrt(pair_vector(p, pairs, k, r));
  const double a = radius(t.i), b = radius(t.j), least = std::min(a, b);
  if (overlaps && t.length <= std::fabs(a - b) + SolidTuning::overlap * least)
    fail(JAM_E_UNSUPPORTED,
         "a mesh of sphere %d inside sphere %d would cut itself: jam_write_voxels makes an image of this solid",
         a < b ? t.i : t.j, a < b ? t.j : t.i);
  t.towards = {-r[0] / t.length, -r[1] / t.length, -r[2] / t.length};
  t.split = overlaps ? 0.5 * (t.length + (a - b) * (a + b) / t.length) : t.length * a / (a + b);
  const double circle2 = overlaps ? (a - t.split) * (a + t.split) : 0.0,
               circle = circle2 > 0.0 ? std::sqrt(circle2) : 0.0;
  if (circle > MeshTuning::widest_circle * least)
    fail(JAM_E_UNSUPPORTED,
         "spheres %d and %d overlap so far that one has less than half of itself left, and a mesh would cut itself: "
         "jam_write_voxels makes an image of this solid",
         t.i, t.j);
  const bool bridged = o_.contacts == JAM_MESH_BRIDGED && circle < o_.bridge * least;
  t.kind = bridged                                                   ? JointKind::cylinder
           : circle > MeshTuning::narrowest_circle * o_.edge * least ? JointKind::circle
                                                                     : JointKind::point;
  t.radius = t.kind == JointKind::cylinder ? o_.bridge * least : t.kind == JointKind::circle ? circle : 0.0;
  t.rim = t.kind == JointKind::circle
              ? std::max(8, static_cast<int32_t>(std::ceil(2.0 * math::pi * circle / (least * o_.edge))))
              : points_of_rim(o_);
  const size_t c = std::fabs(t.towards[0]) < 0.5 ? 0 : 1;  // an axis well away from it
  Point axis{};
  axis[c] = 1.0;
  t.u = cross(t.towards, axis);
  const double across = std::sqrt(dot(t.u, t.u));
  for (double &x : t.u) x /= across;
  t.v = cross(t.towards, t.u);
  ends_[static_cast<size_t>(t.i)].push_back({joint_.size(), false});
  ends_[static_cast<size_t>(t.j)].push_back({joint_.size(), true});
  joint_.push_back(t);
}

double Joints::cap_angle(const Joint &t, int32_t sphere) const { return math::asin(t.radius / radius(sphere)); }

Point Joints::direction(const End &e) const {
  const Point &d = joint_[e.joint].towards;
  return e.second ? Point{-d[0], -d[1], -d[2]} : d;
}

// A closed mesh alone is no valid one: its parts must not cut each other. Points of contact may be near each other.
void Joints::check_ends() const {
  for (size_t s = 0; s < ends_.size(); ++s)
    for (size_t a = 0; a < ends_[s].size(); ++a)
      for (size_t b = 0; b < a; ++b) {
        const auto sphere = static_cast<int32_t>(s);
        const Joint &t = of(ends_[s][a]), &q = of(ends_[s][b]);
        if (t.kind == JointKind::point && q.kind == JointKind::point) continue;
        const double angle =
            math::acos(std::min(1.0, std::max(-1.0, dot(direction(ends_[s][a]), direction(ends_[s][b])))));
        if (angle >= cap_angle(t, sphere) + cap_angle(q, sphere) + MeshTuning::between_rims) continue;
        if (t.kind == JointKind::cylinder || q.kind == JointKind::cylinder)
          fail(JAM_E_ARGUMENT, "bridge is %g: two cylinders at sphere %d would meet (contacts %zu and %zu)", o_.bridge,
               sphere, ends_[s][a].joint, ends_[s][b].joint);
        const int32_t first = q.i == sphere ? q.j : q.i, second = t.i == sphere ? t.j : t.i;
        fail(JAM_E_UNSUPPORTED,
             "spheres %d, %d and %d overlap at one place, where a mesh would cut itself: jam_write_voxels makes an "
             "image of this solid, or smaller diameters by JAM_MESH_SHRUNK part the spheres",
             sphere, first, second);
      }
}

void Joints::refuse_third_sphere(const Joint &t, const Point &x, double r, int32_t sphere) const {
  const double along = dot(x, t.towards);
  const double low = radius(t.i) * math::cos(cap_angle(t, t.i));
  const double high = t.length - radius(t.j) * math::cos(cap_angle(t, t.j));
  const double nearest = std::min(std::max(along, low), high);
  const double off2 = std::max(0.0, dot(x, x) - along * along);
  const double need = r + t.radius;
  if (off2 + (along - nearest) * (along - nearest) < need * need)
    fail(JAM_E_ARGUMENT, "bridge is %g: the cylinder between spheres %d and %d would meet sphere %d", o_.bridge, t.i,
         t.j, sphere);
}

void Joints::check_cylinders() const {
  const PairList pairs = find_pairs(p_, 0.0, 1.0 + o_.bridge + 2.0 * o_.bridge_gap);
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (pairs.wall(k)) continue;
    double r[3];
    pair_vector(p_, pairs, k, r);
    for (const bool second : {false, true}) {  // whether the joint is at the second sphere of the pair
      const int32_t own = second ? pairs.j[k] : pairs.i[k], other = second ? pairs.i[k] : pairs.j[k];
      for (const End &e : ends(own)) {
        const Joint &t = of(e);
        if (t.kind != JointKind::cylinder) continue;
        Point x, off;  // the other from the first sphere of the joint; from the partner
        for (size_t c = 0; c < 3; ++c) {
          x[c] = (second ? r[c] : -r[c]) + (e.second ? t.length * t.towards[c] : 0.0);
          off[c] = x[c] - (e.second ? 0.0 : t.length * t.towards[c]);
        }
        const double same = MeshTuning::same_centre * t.length;
        if (dot(off, off) > same * same) refuse_third_sphere(t, x, radius(other), other);
      }
    }
  }
}

// No three spheres share volume: check_ends refuses them. A cylinder replaces two caps, and with them what the spheres
// share.
double Joints::volume() const {
  double sum = 0.0;
  for (size_t i = 0; i < p_.n(); ++i) {
    const double r = radius(static_cast<int32_t>(i));
    sum += volume_below(3, r, r);
  }
  for (const Joint &t : joint_) {
    if (t.kind != JointKind::cylinder) {
      if (t.overlaps) sum -= shared_volume(3, radius(t.i), radius(t.j), t.length);
      continue;
    }
    double length = t.length, caps = 0.0;
    for (const int32_t s : {t.i, t.j}) {
      const double depth = radius(s) * math::cos(cap_angle(t, s));
      length -= depth;
      caps += volume_below(3, radius(s), -depth);
    }
    sum += math::pi * t.radius * t.radius * length - caps;
  }
  return sum;
}

}  // namespace jam::inside
