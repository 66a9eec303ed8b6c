#include "pore/clipped.hpp"

#include <utility>

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

}  // namespace

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
