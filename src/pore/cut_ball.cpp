// A ball within a convex polytope is a sum of cones from the centre of the ball, one over each face, with the sign of
// the side of the face on which the centre lies. The foot of the perpendicular on the face divides a cone further, into
// wedges over the edges and those into right-angled ones, whose volumes are elementary: Strobl, Formella and Poeschel,
// J. Comput. Phys. 311, 158 (2016), have the same pieces.
#include "pore/solid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/math.hpp"

namespace jam::inside {
namespace {

// The angle of the direction (x, y), x >= 0, with the digits of the smaller component.
double angle_of(double x, double y) {
  const double length = std::sqrt(x * x + y * y);
  if (!(length > 0.0)) return 0.0;
  if (std::fabs(y) < x) return math::asin(y / length);
  return std::copysign(0.5 * math::pi - math::asin(x / length), y);
}
double leg(double hypotenuse, double other) {
  return std::sqrt(std::max(0.0, (hypotenuse - other) * (hypotenuse + other)));
}

// d = 2: the part of a disk over the first s of a line at distance h >= 0 from its centre.
double wedge_2d(double radius, double h, double s) {
  if (h >= radius) return 0.5 * radius * radius * angle_of(h, s);
  const double rim = leg(radius, h);
  if (s <= rim) return 0.5 * h * s;
  return 0.5 * (h * rim + radius * radius * (angle_of(h, s) - angle_of(h, rim)));
}

// d = 3: the part of a ball over a right-angled triangle in a plane at distance h: its corners are the foot of the
// perpendicular, a point e away from it, and one that is s away from that.
double wedge_3d(double radius, double h, double e, double s) {
  if (!(e > 0.0 && s > 0.0)) return 0.0;
  const double phi = angle_of(e, s), r2 = radius * radius;
  // Integral of cos(theta) over the angle about the foot, up to the direction (c, q); theta is the angle at the centre.
  const auto cosines = [&](double c, double q) {
    return angle_of(std::sqrt(e * e * (c * c + q * q) + h * h * c * c), h * q);
  };
  const double beyond = r2 * radius / 3.0;
  if (h >= radius) return beyond * (phi - cosines(e, s));
  const double rim = leg(radius, h), disk = 0.5 * h * rim * rim / 3.0 + r2 * h / 3.0;  // for each angle beyond the rim
  if (e >= rim) return phi * disk - beyond * cosines(e, s);
  const double to_rim = leg(rim, e);
  if (s <= to_rim) return 0.5 * h * e * s / 3.0;
  return 0.5 * h * e * to_rim / 3.0 + (phi - angle_of(e, to_rim)) * disk -
         beyond * (cosines(e, s) - cosines(e, to_rim));
}

using Corner = std::array<double, 2>;

// Cuts a convex polygon: a x + b y <= c stays.
void clip_polygon(std::vector<Corner> &polygon, double a, double b, double c) {
  std::vector<Corner> left;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const Corner &u = polygon[k], &v = polygon[(k + 1) % polygon.size()];
    const double at_u = a * u[0] + b * u[1] - c, at_v = a * v[0] + b * v[1] - c;
    if (at_u <= 0.0) left.push_back(u);
    if ((at_u <= 0.0) == (at_v <= 0.0)) continue;
    const double t = at_u / (at_u - at_v);
    left.push_back({u[0] + t * (v[0] - u[0]), u[1] + t * (v[1] - u[1])});
  }
  polygon = std::move(left);
}

// The polytope: the half-spaces that cut the ball, and a cube about it.
class Polytope {
 public:
  Polytope(int dim, double radius, const std::vector<HalfSpace> &cuts) : dim_(dim), radius_(radius) {
    for (const HalfSpace &h : cuts) {
      empty_ = empty_ || h.offset <= -radius;
      if (h.offset < radius) face_.push_back(h);
    }
    if (face_.empty()) return;
    for (int c = 0; c < dim; ++c)
      for (const double side : {-1.0, 1.0}) {
        HalfSpace h{{}, 2.0 * radius};
        h.normal[static_cast<size_t>(c)] = side;
        face_.push_back(h);
      }
  }
  double volume() const {
    if (empty_) return 0.0;
    if (face_.empty())
      return dim_ == 2 ? math::pi * radius_ * radius_ : 4.0 / 3.0 * math::pi * radius_ * radius_ * radius_;
    double sum = 0.0;
    for (size_t f = 0; f < face_.size(); ++f)
      sum += std::copysign(dim_ == 2 ? cone_over_edge(f) : cone_over_face(f), face_[f].offset);
    return std::max(0.0, sum);
  }

 private:
  // Whether face g leaves nothing of a parallel face f; of two faces in one plane the first one stays.
  bool hides(size_t g, size_t f) const {
    const double a = face_[g].offset, b = dot(face_[g].normal, face_[f].normal) * face_[f].offset;
    return dot(face_[g].normal, face_[f].normal) > 0.0 ? a < b || (a == b && g < f) : a < b;
  }
  static bool parallel(const HalfSpace &f, const HalfSpace &g) {
    const Point across = cross(f.normal, g.normal);
    return dot(across, across) < CutTuning::parallel * CutTuning::parallel;
  }
  double cone_over_edge(size_t f) const {
    const HalfSpace &own = face_[f];
    const Point along{-own.normal[1], own.normal[0], 0.0};
    double from = -4.0 * radius_, to = 4.0 * radius_;
    for (size_t g = 0; g < face_.size(); ++g) {
      if (g == f) continue;
      if (parallel(own, face_[g])) {
        if (hides(g, f)) return 0.0;
        continue;
      }
      const double slope = dot(along, face_[g].normal);
      const double at = (face_[g].offset - own.offset * dot(own.normal, face_[g].normal)) / slope;
      (slope > 0.0 ? to : from) = slope > 0.0 ? std::min(to, at) : std::max(from, at);
    }
    if (!(from < to)) return 0.0;
    const auto part = [&](double s) {
      return std::copysign(wedge_2d(radius_, std::fabs(own.offset), std::fabs(s)), s);
    };
    return part(to) - part(from);
  }
  double cone_over_face(size_t f) const {
    const HalfSpace &own = face_[f];
    const size_t least = std::fabs(own.normal[0]) < 0.5 ? 0 : 1;
    Point axis{};
    axis[least] = 1.0;
    Point u = cross(own.normal, axis);
    const double length = std::sqrt(dot(u, u));
    for (double &x : u) x /= length;
    const Point v = cross(own.normal, u);
    const double far = 4.0 * radius_;
    std::vector<Corner> polygon{{-far, -far}, {far, -far}, {far, far}, {-far, far}};
    for (size_t g = 0; g < face_.size() && !polygon.empty(); ++g) {
      if (g == f) continue;
      const HalfSpace &h = face_[g];
      if (!parallel(own, h))
        clip_polygon(polygon, dot(u, h.normal), dot(v, h.normal), h.offset - own.offset * dot(own.normal, h.normal));
      else if (hides(g, f))
        polygon.clear();
    }
    double sum = 0.0;
    for (size_t k = 0; k < polygon.size(); ++k)
      sum += cone_over_side(polygon[k], polygon[(k + 1) % polygon.size()], own);
    return sum;
  }
  // Over the triangle of the foot and one side of a face, negative where the side turns the other way round the foot.
  double cone_over_side(const Corner &a, const Corner &b, const HalfSpace &face) const {
    const Corner d{b[0] - a[0], b[1] - a[1]};
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1]);
    if (!(length > 0.0)) return 0.0;
    const double e = (a[0] * d[1] - a[1] * d[0]) / length;
    const double from = (a[0] * d[0] + a[1] * d[1]) / length;
    const auto part = [&](double s) {
      return std::copysign(wedge_3d(radius_, std::fabs(face.offset), std::fabs(e), std::fabs(s)), s);
    };
    return std::copysign(part(from + length) - part(from), e);
  }

  int dim_;
  double radius_;
  bool empty_ = false;
  std::vector<HalfSpace> face_;
};

// Gauss and Kronrod, 7 and 15 points (Piessens et al., QUADPACK (1983)), halved until the two agree.
template <class F>
double adaptive(double from, double to, double error, int depth, const F &f) {
  static constexpr double node[] = {0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                                    0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                                    0.586087235467691130294144838258730, 0.405845151377397166906606412076961,
                                    0.207784955007898467600689403773245, 0.0};
  static constexpr double kronrod[] = {0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
                                       0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
                                       0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
                                       0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
  static constexpr double gauss[] = {
      0.0, 0.129484966168869693270611432679082, 0.0, 0.279705391489276667901467771423780,
      0.0, 0.381830050505118944950369775488975, 0.0, 0.417959183673469387755102040816327};
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double fine = 0.0, coarse = 0.0;
  for (size_t k = 0; k < 8; ++k) {
    const double value = k < 7 ? f(middle - half * node[k]) + f(middle + half * node[k]) : f(middle);
    fine += kronrod[k] * value, coarse += gauss[k] * value;
  }
  if (depth == 0 || std::fabs(fine - coarse) * half <= error) return fine * half;
  return adaptive(from, middle, 0.5 * error, depth - 1, f) + adaptive(middle, to, 0.5 * error, depth - 1, f);
}

// The half-spaces in the plane at height z, for a disk; false where one leaves nothing.
bool cuts_at(const std::vector<HalfSpace> &cuts, double z, std::vector<HalfSpace> &out) {
  out.clear();
  for (const HalfSpace &h : cuts) {
    const double across = std::sqrt(h.normal[0] * h.normal[0] + h.normal[1] * h.normal[1]);
    const double rest = h.offset - h.normal[2] * z;
    if (across > CutTuning::parallel)
      out.push_back({{h.normal[0] / across, h.normal[1] / across, 0.0}, rest / across});
    else if (rest < 0.0)
      return false;
  }
  return true;
}

}  // namespace

HalfSpace seen_from(const Point &origin, const HalfSpace &h) { return {h.normal, h.offset - dot(h.normal, origin)}; }

HalfSpace nearer_by_power(double own, const Point &centre, double radius, bool first) {
  const double apart = std::sqrt(dot(centre, centre));
  const double larger = (own - radius) * (own + radius);
  if (apart == 0.0) {
    constexpr double infinite = std::numeric_limits<double>::infinity();  // all of space, or nothing
    return {{1.0, 0.0, 0.0}, larger > 0.0 || (larger == 0.0 && first) ? infinite : -infinite};
  }
  return {{centre[0] / apart, centre[1] / apart, centre[2] / apart}, 0.5 * (apart + larger / apart)};
}

double cut_volume(int dim, double radius, const std::vector<HalfSpace> &cuts) {
  return Polytope(dim, radius, cuts).volume();
}

// What both balls share lies in the first one where the second has the smaller power, and in the second one elsewhere.
double cut_volume_in_ball(int dim, double radius, const std::vector<HalfSpace> &cuts, const Ball &other) {
  if (!(radius > 0.0 && other.r > 0.0)) return 0.0;
  const HalfSpace own = nearer_by_power(radius, other.x, other.r, true);
  std::vector<HalfSpace> here = cuts, there;
  for (const HalfSpace &h : cuts) there.push_back(seen_from(other.x, h));
  there.push_back(seen_from(other.x, own));
  here.push_back({{-own.normal[0], -own.normal[1], -own.normal[2]}, -own.offset});
  return cut_volume(dim, radius, here) + cut_volume(dim, other.r, there);
}

double cut_volume_in_cylinder(double radius, const std::vector<HalfSpace> &cuts, const Ball &axis) {
  std::vector<HalfSpace> flat;
  const Ball circle{{axis.x[0], axis.x[1], 0.0}, axis.r};
  // Heights z = radius sin(t): the section grows smoothly from both poles.
  const auto slice = [&](double t) {
    const double z = radius * math::sin(t), width = radius * math::cos(t);
    return cuts_at(cuts, z, flat) ? cut_volume_in_ball(2, width, flat, circle) * width : 0.0;
  };
  const double error = CutTuning::error * radius * radius * radius;
  return adaptive(-0.5 * math::pi, 0.5 * math::pi, error, CutTuning::halvings, slice);
}

}  // namespace jam::inside
