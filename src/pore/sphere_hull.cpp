#include "pore/sphere_hull.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.hpp"

namespace jam::inside {
namespace {

// Where an edge meets the plane, to the bit the same from both ends.
Point crossing(const Point &u, const Point &v, size_t c, double t) {
  if (u[c] == t) return u;
  if (v[c] == t) return v;
  const Point &a = u < v ? u : v, &b = u < v ? v : u;
  const double s = (t - a[c]) / (b[c] - a[c]);
  Point x;
  for (size_t k = 0; k < 3; ++k) x[k] = k == c ? t : a[k] + s * (b[k] - a[k]);
  return x;
}

Point unit(const Point &x) {
  const double r = std::sqrt(dot(x, x));
  return {x[0] / r, x[1] / r, x[2] / r};
}

SphereGrid icosahedron() {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  SphereGrid grid;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-g, g}) {
      grid.point.push_back(unit({0.0, a, b}));
      grid.point.push_back(unit({a, b, 0.0}));
      grid.point.push_back(unit({b, 0.0, a}));
    }
  grid.triangle = sphere_hull(grid.point);
  return grid;
}

// Each face in n^2 triangles; edges are shared.
SphereGrid divided(const SphereGrid &base, int n) {
  SphereGrid grid;
  std::map<std::array<int32_t, 6>, int32_t> known;  // corners with their weights, sorted, to the new point
  const auto at = [&](const Triangle &t, int i, int j) {
    const int weight[] = {n - i - j, i, j};
    std::array<std::pair<int32_t, int>, 3> corner;
    for (size_t k = 0; k < 3; ++k) corner[k] = weight[k] ? std::make_pair(t[k], weight[k]) : std::make_pair(-1, 0);
    std::sort(corner.begin(), corner.end());
    std::array<int32_t, 6> key{};
    Point x{};
    for (size_t k = 0; k < 3; ++k) {
      key[2 * k] = corner[k].first, key[2 * k + 1] = corner[k].second;
      for (size_t c = 0; c < 3 && corner[k].second; ++c)
        x[c] += corner[k].second * base.point[static_cast<size_t>(corner[k].first)][c];
    }
    const auto found = known.emplace(key, static_cast<int32_t>(grid.point.size()));
    if (found.second) grid.point.push_back(unit(x));
    return found.first->second;
  };
  for (const Triangle &t : base.triangle)
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        grid.triangle.push_back({at(t, i, j), at(t, i + 1, j), at(t, i, j + 1)});
        if (i + j + 1 < n) grid.triangle.push_back({at(t, i + 1, j), at(t, i + 1, j + 1), at(t, i, j + 1)});
      }
  return grid;
}

double longest_edge(const SphereGrid &grid) {
  double longest2 = 0.0;
  for (const Triangle &t : grid.triangle)
    for (size_t k = 0; k < 3; ++k) {
      const Point d = minus(grid.point[static_cast<size_t>(t[k])], grid.point[static_cast<size_t>(t[(k + 1) % 3])]);
      longest2 = std::max(longest2, dot(d, d));
    }
  return std::sqrt(longest2);
}

// The incremental hull, with the neighbour of each edge. All points are corners, as they lie on a sphere.
class Hull {
 public:
  explicit Hull(const std::vector<Point> &point) {
    for (const Point &x : point) {
      Whole p;
      for (size_t c = 0; c < 3; ++c) p[c] = static_cast<int64_t>(std::nearbyint(std::ldexp(x[c], 19)));
      at_.push_back(p);
    }
    begin();
    for (size_t k = 0; k < at_.size(); ++k)
      if (!used_[k]) add(static_cast<int32_t>(k));
  }
  std::vector<Triangle> triangles() const {
    std::vector<Triangle> out;
    for (const Facet &f : facet_)
      if (f.alive) out.push_back(f.corner);
    return out;
  }

 private:
  using Whole = std::array<int64_t, 3>;
  struct Facet {
    Triangle corner;
    std::array<int32_t, 3> beside;  // beyond the edge from corner k to the next
    bool alive;
  };
  static Whole less(const Whole &a, const Whole &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  // Below 2^63: differences are at most 2^20.
  static int64_t volume(const Whole &a, const Whole &b, const Whole &c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  const Whole &point(int32_t k) const { return at_[static_cast<size_t>(k)]; }
  Facet &facet(int32_t k) { return facet_[static_cast<size_t>(k)]; }
  bool sees(int32_t p, const Facet &f) const {
    const Whole &a = point(f.corner[0]);
    return volume(less(point(f.corner[1]), a), less(point(f.corner[2]), a), less(point(p), a)) > 0;
  }

  // Four points near the corners of a tetrahedron, which is turned so that no symmetry of a grid leaves them in a
  // plane.
  void begin() {
    constexpr int64_t corner[4][3] = {{36, 60, 77}, {77, -60, -36}, {-36, 60, -77}, {-77, -60, 36}};
    used_.assign(at_.size(), false);
    std::array<int32_t, 4> first{};
    for (size_t k = 0; k < 4; ++k) {
      int64_t best = INT64_MIN;
      for (size_t q = 0; q < at_.size(); ++q) {
        const int64_t along = at_[q][0] * corner[k][0] + at_[q][1] * corner[k][1] + at_[q][2] * corner[k][2];
        if (along > best) best = along, first[k] = static_cast<int32_t>(q);
      }
    }
    for (const int32_t k : first) used_[static_cast<size_t>(k)] = true;
    const Whole &a = point(first[0]);
    const int64_t v = volume(less(point(first[1]), a), less(point(first[2]), a), less(point(first[3]), a));
    if (v > 0) std::swap(first[1], first[2]);
    if (v == 0) fail(JAM_E_INTERNAL, "the points of a sphere do not enclose its centre");
    const int side[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
    const int32_t beside[4][3] = {{1, 2, 3}, {3, 2, 0}, {1, 3, 0}, {2, 1, 0}};
    for (int f = 0; f < 4; ++f)
      facet_.push_back({{first[static_cast<size_t>(side[f][0])], first[static_cast<size_t>(side[f][1])],
                         first[static_cast<size_t>(side[f][2])]},
                        {beside[f][0], beside[f][1], beside[f][2]},
                        true});
    last_ = 0;
  }

  // A facet that the point sees: the walk goes over each edge that the point lies beyond.
  int32_t find(int32_t p) {
    int32_t at = last_;
    for (size_t steps = 0; steps < facet_.size(); ++steps) {
      const Facet &f = facet(at);
      int32_t next = -1;
      for (size_t k = 0; k < 3 && next < 0; ++k)
        if (volume(point(f.corner[k]), point(f.corner[(k + 1) % 3]), point(p)) < 0) next = f.beside[k];
      if (next < 0) break;
      at = next;
    }
    if (sees(p, facet(at))) return at;
    for (size_t k = 0; k < facet_.size(); ++k)
      if (facet_[k].alive && sees(p, facet_[k])) return static_cast<int32_t>(k);
    return -1;
  }

  void add(int32_t p) {
    const int32_t first = find(p);
    if (first < 0) return;  // inside by rounding: the caller's points are too near each other
    seen_.assign(1, first);
    facet(first).alive = false;
    struct Edge {
      int32_t from, to, beyond;
    };
    std::vector<Edge> horizon;
    for (size_t k = 0; k < seen_.size(); ++k) {
      const Facet f = facet(seen_[k]);
      for (size_t e = 0; e < 3; ++e) {
        Facet &n = facet(f.beside[e]);
        if (!n.alive) continue;
        if (sees(p, n)) n.alive = false, seen_.push_back(f.beside[e]);
      }
    }
    for (const int32_t s : seen_) {
      const Facet &f = facet(s);
      for (size_t e = 0; e < 3; ++e)
        if (facet(f.beside[e]).alive) horizon.push_back({f.corner[e], f.corner[(e + 1) % 3], f.beside[e]});
    }
    std::map<int32_t, int32_t> from;  // the new facet whose edge at the horizon begins at this corner
    const auto base = static_cast<int32_t>(facet_.size());
    for (size_t k = 0; k < horizon.size(); ++k) from[horizon[k].from] = base + static_cast<int32_t>(k);
    for (size_t k = 0; k < horizon.size(); ++k) {
      const Edge &h = horizon[k];
      facet_.push_back({{h.from, h.to, p}, {h.beyond, from[h.to], -1}, true});
      Facet &n = facet(h.beyond);
      for (size_t e = 0; e < 3; ++e)
        if (n.corner[e] == h.to && n.corner[(e + 1) % 3] == h.from) n.beside[e] = base + static_cast<int32_t>(k);
    }
    for (size_t k = 0; k < horizon.size(); ++k) facet(from[horizon[k].to]).beside[2] = base + static_cast<int32_t>(k);
    last_ = base;
  }

  std::vector<Whole> at_;
  std::vector<char> used_;
  std::vector<Facet> facet_;
  std::vector<int32_t> seen_;
  int32_t last_ = 0;
};

}  // namespace

SphereGrid divided_icosahedron(double edge) {
  const SphereGrid base = icosahedron();
  for (int n = std::max(1, static_cast<int>(longest_edge(base) / edge));; ++n) {
    const SphereGrid grid = divided(base, n);
    if (longest_edge(grid) <= edge) return grid;
  }
}

std::vector<Triangle> sphere_hull(const std::vector<Point> &point) { return Hull(point).triangles(); }

void clip(std::vector<Face> &piece, int axis, double t, bool above) {
  const auto c = static_cast<size_t>(axis);
  const auto inside = [&](const Point &x) { return above ? x[c] <= t : x[c] >= t; };
  std::vector<Face> left;
  std::vector<std::pair<Point, Point>> edge;  // of the cut, against the way round the face that it ends
  for (const Face &face : piece) {
    Face kept{{}, face.surface};
    Point out{}, in{};
    bool cut = false;
    const size_t n = face.corner.size();
    for (size_t k = 0; k < n; ++k) {
      const Point &u = face.corner[k], &v = face.corner[(k + 1) % n];
      const bool u_in = inside(u), v_in = inside(v);
      if (u_in) kept.corner.push_back(u);
      if (u_in == v_in) continue;
      const Point x = crossing(u, v, c, t);
      kept.corner.push_back(x);
      (u_in ? out : in) = x;
      cut = true;
    }
    if (cut && out != in) edge.emplace_back(in, out);
    if (kept.corner.size() > 2) left.push_back(std::move(kept));
  }
  Face cap{{}, true};
  if (!edge.empty()) {
    Point at = edge.front().first;
    for (size_t steps = 0; steps < edge.size(); ++steps)
      for (const auto &e : edge)
        if (e.first == at) {
          cap.corner.push_back(at);
          at = e.second;
          break;
        }
  }
  if (cap.corner.size() > 2) left.push_back(std::move(cap));
  piece = std::move(left);
}

}  // namespace jam::inside
