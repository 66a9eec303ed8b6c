// Local packing fractions: the volumes of radical Voronoi cells, cut by walls.
#include <algorithm>
#include <cmath>

#include "analysis/structure.hpp"
#include "analysis/tuning.hpp"
#include "core/call_scope.hpp"
#include "core/cell_reduction.hpp"
#include "core/math.hpp"
#ifdef JAM_HAVE_VORO
#include <voro++/voro++.hh>
#endif

namespace jam::inside {
#ifdef JAM_HAVE_VORO
namespace {

using Corner = std::array<double, 2>;

// Area that the circle of radius r about the origin shares with the triangle of the origin, a and b; its sign is that
// of a x b.
double shared_with_circle(const Corner &a, const Corner &b, double r) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], length2 = ux * ux + uy * uy;
  if (!(length2 > 0.0)) return 0.0;
  const auto sector = [r](double ax, double ay, double bx, double by) {
    const double dot = ax * bx + ay * by, length = std::sqrt((ax * ax + ay * ay) * (bx * bx + by * by));
    const double angle = length > 0.0 ? math::acos(std::min(1.0, std::max(-1.0, dot / length))) : 0.0;
    return std::copysign(0.5 * r * r * angle, ax * by - ay * bx);
  };
  // The side is in the circle from t = from to t = to.
  const double middle = -(a[0] * ux + a[1] * uy) / length2, cross = a[0] * b[1] - a[1] * b[0];
  const double half2 = (r * r - cross * cross / length2) / length2;
  const double half = half2 > 0.0 ? std::sqrt(half2) : 0.0;
  const double from = std::max(0.0, middle - half), to = std::min(1.0, middle + half);
  if (half2 <= 0.0 || from >= to) return sector(a[0], a[1], b[0], b[1]);
  const Corner p{a[0] + from * ux, a[1] + from * uy}, q{a[0] + to * ux, a[1] + to * uy};
  return sector(a[0], a[1], p[0], p[1]) + 0.5 * (p[0] * q[1] - p[1] * q[0]) + sector(q[0], q[1], b[0], b[1]);
}

// A convex cell of voro++ about the axis or the centre of a round wall of radius R.
class CutCell {
 public:
  CutCell(voro::voronoicell &cell, const std::array<double, 3> &centre, double radius, bool ball)
      : radius_(radius), ball_(ball) {
    std::vector<double> flat;
    cell.vertices(centre[0], centre[1], centre[2], flat);
    for (size_t k = 0; k + 2 < flat.size(); k += 3) corner_.push_back({flat[k], flat[k + 1], flat[k + 2]});
    for (int i = 0; i < cell.p; ++i)
      for (int k = 0; k < cell.nu[i]; ++k)
        if (cell.ed[i][k] > i) edge_.push_back({static_cast<size_t>(i), static_cast<size_t>(cell.ed[i][k])});
    cell.face_vertices(face_);
  }
  bool is_cut() const {
    return std::any_of(corner_.begin(), corner_.end(), [this](const auto &c) {
      return c[0] * c[0] + c[1] * c[1] + (ball_ ? c[2] * c[2] : 0.0) > radius_ * radius_;
    });
  }
  // The volume within the wall: slices along z between heights of corners, of ends of the ball, of points where an edge
  // meets the wall and of slices in which a side touches the wall. In between the area is smooth except for powers of
  // 3/2 at the ends.
  double volume() const {
    std::vector<double> height;
    for (const auto &c : corner_) height.push_back(c[2]);
    if (ball_) height.push_back(-radius_), height.push_back(radius_);
    for (const auto &e : edge_) meet_wall(corner_[e[0]], corner_[e[1]], height);
    for (size_t k = 0; k < face_.size(); k += static_cast<size_t>(face_[k]) + 1) touch_wall(k, height);
    const auto [low, high] =
        std::minmax_element(corner_.begin(), corner_.end(), [](const auto &a, const auto &b) { return a[2] < b[2]; });
    for (double &z : height) z = std::min((*high)[2], std::max((*low)[2], z));
    std::sort(height.begin(), height.end());
    double sum = 0.0;
    for (size_t k = 0; k + 1 < height.size(); ++k) {
      const double length = height[k + 1] - height[k];
      if (!(length > 0.0)) continue;
      constexpr int slices = CellsTuning::slices;
      for (int s = 0; s < slices; ++s) {  // Fejer's rule: nodes cos(theta), exact for polynomials below their number
        const double theta = math::pi * (s + 0.5) / slices;
        double weight = 1.0;
        for (int j = 1; 2 * j < slices; ++j) weight -= 2.0 * math::cos(2.0 * j * theta) / (4.0 * j * j - 1.0);
        sum += length * weight / slices * area(height[k] + 0.5 * length * (1.0 + math::cos(theta)));
      }
    }
    return sum;
  }

 private:
  void meet_wall(const std::array<double, 3> &a, const std::array<double, 3> &b, std::vector<double> &height) const {
    double uu = 0.0, au = 0.0, aa = -radius_ * radius_;
    for (size_t c = 0; c < (ball_ ? 3u : 2u); ++c) {
      const double u = b[c] - a[c];
      uu += u * u, au += a[c] * u, aa += a[c] * a[c];
    }
    const double disc = au * au - uu * aa;
    if (!(uu > 0.0 && disc > 0.0)) return;
    for (const double t : {(-au - std::sqrt(disc)) / uu, (-au + std::sqrt(disc)) / uu})
      if (t > 0.0 && t < 1.0) height.push_back(a[2] + t * (b[2] - a[2]));
  }
  // Heights at which the side that face k cuts out of a slice touches the wall. Its plane is n.x = d, by Newell's sum.
  void touch_wall(size_t k, std::vector<double> &height) const {
    const auto count = static_cast<size_t>(face_[k]);
    double n[3] = {0.0, 0.0, 0.0};
    const auto at = [&](size_t i) -> const std::array<double, 3> & {
      return corner_[static_cast<size_t>(face_[k + 1 + i % count])];
    };
    for (size_t i = 0; i < count; ++i)
      for (int c = 0; c < 3; ++c) {
        const int p = (c + 1) % 3, q = (c + 2) % 3;
        n[c] += (at(i)[p] - at(i + 1)[p]) * (at(i)[q] + at(i + 1)[q]);
      }
    const double d = n[0] * at(0)[0] + n[1] * at(0)[1] + n[2] * at(0)[2], flat2 = n[0] * n[0] + n[1] * n[1];
    // |d - n_z z| = |(n_x, n_y)| r with the radius r of the wall's slice
    const double a = n[2] * n[2] + (ball_ ? flat2 : 0.0), b = d * n[2], c = d * d - flat2 * radius_ * radius_;
    const double disc = b * b - a * c;
    if (!(a > 0.0 && disc >= 0.0)) return;
    height.push_back((b - std::sqrt(disc)) / a), height.push_back((b + std::sqrt(disc)) / a);
  }
  // Of the slice at height z.
  double area(double z) const {
    const double r2 = radius_ * radius_ - (ball_ ? z * z : 0.0);
    if (!(r2 > 0.0)) return 0.0;
    std::vector<Corner> polygon;
    Corner middle{0.0, 0.0};
    for (const auto &e : edge_) {
      const auto &a = corner_[e[0]], &b = corner_[e[1]];
      if ((a[2] < z) == (b[2] < z)) continue;
      const double t = (z - a[2]) / (b[2] - a[2]);
      polygon.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
      middle[0] += polygon.back()[0], middle[1] += polygon.back()[1];
    }
    if (polygon.size() < 3) return 0.0;
    const double n = static_cast<double>(polygon.size());
    // In the order of angles about the middle, by half planes and cross products.
    const auto less = [&](const Corner &p, const Corner &q) {
      const double px = p[0] - middle[0] / n, py = p[1] - middle[1] / n, qx = q[0] - middle[0] / n,
                   qy = q[1] - middle[1] / n;
      const bool lower = py < 0.0 || (py == 0.0 && px < 0.0), other = qy < 0.0 || (qy == 0.0 && qx < 0.0);
      return lower != other ? other : px * qy - py * qx > 0.0;
    };
    std::sort(polygon.begin(), polygon.end(), less);
    double sum = 0.0;
    for (size_t k = 0; k < polygon.size(); ++k)
      sum += shared_with_circle(polygon[k], polygon[(k + 1) % polygon.size()], std::sqrt(r2));
    return sum;
  }
  double radius_;
  bool ball_;
  std::vector<std::array<double, 3>> corner_;
  std::vector<std::array<size_t, 2>> edge_;
  std::vector<int> face_;  // corners of each face, their number first
};

// Volumes of the cells of `box`, in its unit, by sphere; 0 where none was found.
template <class Loop, class Box, class Volume>
std::vector<double> cell_volumes(size_t n, Box &box, const Volume &volume_of) {
  std::vector<double> volume(n, 0.0);
  Loop loop(box);
  voro::voronoicell cell;
  if (loop.start()) do {
      CallScope::look();
      if (box.compute_cell(cell, loop)) volume[static_cast<size_t>(loop.pid())] = volume_of(cell, loop);
    } while (loop.inc());
  return volume;
}

template <class Box>
void put_spheres(const Packing &p, Box &box) {
  const double side = p.cell.side();
  for (size_t i = 0; i < p.n(); ++i) {
    const double *x = &p.position[3 * i];
    box.put(static_cast<int>(i), x[0] / side, x[1] / side, x[2] / side, 0.5 * p.diameter[i] / side);
  }
}

// Flat walls are faces of the brick. A round wall cuts the cells that voro++ makes in the brick around it.
std::vector<double> volumes_within_walls(const Packing &p, int blocks) {
  const double side = p.cell.side();
  std::array<double, 3> edge, middle;
  for (int c = 0; c < 3; ++c) edge[c] = p.cell.edge(c) / side, middle[c] = 0.5 * edge[c];
  for (int k = 1; k < 3; ++k)
    for (int c = 0; c < k; ++c)
      if (p.cell.row(k)[c] != 0.0)
        fail(JAM_E_UNSUPPORTED,
             "Voronoi cells between walls need a brick, this cell is tilted: voro++ has no walls there");
  const auto repeats = [&](int c) { return p.cell.repeats(c); };
  voro::container_poly box(0.0, edge[0], 0.0, edge[1], 0.0, edge[2], blocks, blocks, blocks, repeats(0), repeats(1),
                           repeats(2), 8);
  put_spheres(p, box);
  const int round_axes = p.container.round_axes();
  if (round_axes == 2) middle[2] = 0.0;
  return cell_volumes<voro::c_loop_all>(p.n(), box, [&](voro::voronoicell &cell, voro::c_loop_all &loop) {
    if (round_axes == 0) return cell.volume();
    const CutCell cut(cell, {loop.x() - middle[0], loop.y() - middle[1], loop.z() - middle[2]}, 0.5 * edge[0],
                      round_axes == 3);
    return cut.is_cut() ? cut.volume() : cell.volume();
  });
}

std::vector<double> volumes_in_cell(const Packing &p, int blocks) {
  const double side = p.cell.side();
  const Cell cell = upright(p.cell);
  const double *b = cell.row(1), *c = cell.row(2);
  voro::container_periodic_poly box(cell.edge(0) / side, b[0] / side, b[1] / side, c[0] / side, c[1] / side,
                                    c[2] / side, blocks, blocks, blocks, 8);
  put_spheres(p, box);
  return cell_volumes<voro::c_loop_all_periodic>(
      p.n(), box, [](voro::voronoicell &cell, const voro::c_loop_all_periodic &) { return cell.volume(); });
}

}  // namespace
#endif

void check_local_fractions(const Packing &p) {
#ifndef JAM_HAVE_VORO
  fail(JAM_E_UNSUPPORTED, "this libjam was built without voro++");
#endif
  if (p.dim != 3)
    fail(JAM_E_UNSUPPORTED, "local packing fractions are there for d = 3 only, this system has d = %d", p.dim);
  if (p.model == JAM_MODEL_MK) fail(JAM_E_UNSUPPORTED, "Mari-Kurchan spheres have no cells of their own");
}

std::vector<double> local_fractions(const Packing &p) {
#ifdef JAM_HAVE_VORO
  // In a cell of volume 1: voro++ has absolute tolerances, and ends the process when it loses track of a cell.
  const int blocks =
      std::max(1, static_cast<int>(math::pow(static_cast<double>(p.n()) / CellsTuning::spheres_a_block, 1.0 / 3.0)));
  const std::vector<double> volume = p.container ? volumes_within_walls(p, blocks) : volumes_in_cell(p, blocks);
  std::vector<double> phi(p.n());
  for (size_t i = 0; i < p.n(); ++i) {
    phi[i] = volume[i] > 0.0 ? unit_sphere_volume(3) * math::pow(p.diameter[i] / p.cell.side(), 3) / volume[i] : 0.0;
    if (!(phi[i] > 0.0 && phi[i] <= 1.0 + 1e-9)) fail(JAM_E_SOLVER, "the Voronoi cell of sphere %zu was not found", i);
  }
  return phi;
#else
  check_local_fractions(p);
  return {};
#endif
}

}  // namespace jam::inside
