#include "core/container.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "core/cell_reduction.hpp"
#include "core/error.hpp"
#include "core/math.hpp"
#include "core/packing.hpp"

namespace jam::inside {
namespace {

char letter(int c, int dim) { return dim <= 3 ? "xyz"[c] : static_cast<char>('0' + c); }

// An axis with walls is at a right angle to all others.
void check_axis(const Cell &cell, int c) {
  for (int k = 0; k < cell.dim(); ++k)
    for (int q = 0; q < k; ++q)
      if ((k == c || q == c) && cell.row(k)[q] != 0.0)
        fail(JAM_E_ARGUMENT, "walls on axis %c: cell vector %d has the component %g along axis %c, it must be 0",
             letter(c, cell.dim()), k, cell.row(k)[q], letter(q, cell.dim()));
}

}  // namespace

Container::Container(int32_t kind, int32_t walls, const Cell &cell) : kind_(kind), flat_(walls), dim_(cell.dim()) {
  if (kind < JAM_CONTAINER_BRICK || kind > JAM_CONTAINER_BALL)
    fail(JAM_E_ARGUMENT, "container is %d, it must be a value of jam_container", kind);
  if (walls < 0 || walls >= 1 << dim_)
    fail(JAM_E_ARGUMENT, "walls is %d, it must be a sum of 2^c over axes c below dim %d", walls, dim_);
  if (kind == JAM_CONTAINER_CYLINDER && dim_ != 3) fail(JAM_E_DIMENSION, "a cylinder needs dim 3, dim is %d", dim_);
  if (kind == JAM_CONTAINER_BALL && dim_ > 3) fail(JAM_E_DIMENSION, "a ball needs dim 2 or 3, dim is %d", dim_);
  if (kind == JAM_CONTAINER_CYLINDER && (walls & 3))
    fail(JAM_E_ARGUMENT, "walls is %d: a cylinder may have flat walls on axis z alone (4)", walls);
  if (kind == JAM_CONTAINER_BALL && walls) fail(JAM_E_ARGUMENT, "walls is %d: a ball has no flat walls", walls);
  round_axes_ = kind == JAM_CONTAINER_CYLINDER ? 2 : kind == JAM_CONTAINER_BALL ? dim_ : 0;
  closed_ = static_cast<uint32_t>(walls);
  for (int c = 0; c < dim_; ++c) {
    edge_[c] = cell.edge(c);
    if (c < round_axes_) closed_ |= 1u << c;
    if (walls >> c & 1) axis_[flat_walls_ / 2] = c, flat_walls_ += 2;
    if (!(closed_ >> c & 1)) continue;
    check_axis(cell, c);
    widest_ = std::min(widest_, edge_[c]);
  }
  volume_ = cell.volume();
  if (round_axes_ == 0) return;
  for (int c = 1; c < round_axes_; ++c)
    if (edge_[c] != edge_[0])
      fail(JAM_E_ARGUMENT, "a round container needs equal edges of the cell: x has %.17g, %c has %.17g", edge_[0],
           letter(c, dim_), edge_[c]);
  radius_ = 0.5 * edge_[0];
  volume_ = unit_sphere_volume(round_axes_);
  for (int c = 0; c < dim_; ++c) volume_ *= edge_[c];
}

double Container::area(int w) const {
  return is_round(w) ? volume_ * round_axes_ / radius_ : volume_ / edge_[axis(w)];  // round: d V / d R_c
}

namespace {
constexpr const char *words[] = {"brick", "cylinder", "ball"};
}

const char *Container::word() const { return words[kind_]; }

int32_t container_of_word(const char *word) {
  for (int32_t k = 0; k < 3; ++k)
    if (std::strcmp(words[k], word) == 0) return k;
  return -1;
}

std::string Container::name(int w) const {
  if (is_round(w)) return "the round wall";
  char text[64];
  std::snprintf(text, sizeof text, "the wall %c = %g", letter(axis(w), dim_), side(w) ? edge_[axis(w)] : 0.0);
  return text;
}

void Container::rotation(int q, const double *x, double *v) const {
  for (int c = 0; c < dim_; ++c) v[c] = 0.0;
  for (int a = 0; a < round_axes_; ++a)
    for (int b = a + 1; b < round_axes_; ++b)
      if (q-- == 0) v[a] = radius_ - x[b], v[b] = x[a] - radius_;
}

void Container::normal(int w, const double *x, double *n) const {
  for (int c = 0; c < dim_; ++c) n[c] = 0.0;
  if (!is_round(w)) {
    n[axis(w)] = side(w) ? -1.0 : 1.0;
    return;
  }
  const double r = radius_ - distance(w, x);
  if (!(r > 0.0))
    n[0] = 1.0;  // at the centre all directions are alike
  else
    for (int c = 0; c < round_axes_; ++c) n[c] = (radius_ - x[c]) / r;
}

double Container::displaced(int w, const double *x, const double *u, double *n) const {
  if (!is_round(w)) {
    normal(w, x, n);
    return side(w) ? -u[axis(w)] : u[axis(w)];
  }
  double r2 = 0.0, to2 = 0.0, change = 0.0, to[JAM_MAX_DIM];
  for (int c = 0; c < round_axes_; ++c) {
    const double r = x[c] - radius_;
    to[c] = r + u[c];
    r2 += r * r, to2 += to[c] * to[c], change += u[c] * (r + to[c]);
  }
  const double length = std::sqrt(to2), both = std::sqrt(r2) + length;
  for (int c = 0; c < dim_; ++c) n[c] = c < round_axes_ && length > 0.0 ? -to[c] / length : 0.0;
  if (!(length > 0.0)) n[0] = 1.0;
  return both > 0.0 ? -change / both : 0.0;
}

double Container::curvature(int w, const double *x) const {
  return is_round(w) ? 1.0 / (radius_ - distance(w, x)) : 0.0;
}

void Container::random_point(const Cell &cell, Rng &rng, double radius, double *x) const {
  for (int c = 0; c < dim_; ++c) {
    const bool shut = closed_ >> c & 1;
    const double room = shut ? edge_[c] - 2.0 * radius : edge_[c];
    x[c] = shut ? radius + room * rng.uniform() : wrap(cell.edge(c) * rng.uniform(), cell.edge(c));
  }
}

double scene_volume(const Packing &p) { return p.container ? p.container.volume() : p.cell.volume(); }

Cell walled_cell(int dim, const double *rows, const Enclosure &given) {
  const NormalCell normal = normal_cell(dim, rows);
  if (!normal.rotated)
    const Container named(given.container, given.walls, Cell::from_triangle(dim, rows));  // a tilted axis
  if (normal.rotated || !normal.same_vectors())
    fail(JAM_E_ARGUMENT, "with walls the cell is a brick, or its vectors are lower-triangular and %s",
         normal.same_vectors() ? "have a positive diagonal" : "lean less");
  return normal.cell;
}

void enclose(Packing &p, const Enclosure &given) {
  p.container = Container(given.container, given.walls, p.cell);
  if (!p.container) return;
  if (p.model == JAM_MODEL_MK)
    fail(JAM_E_UNSUPPORTED, "walls: Mari-Kurchan spheres have no distance to a wall, as shifts move their pairs");
  if (p.non_additivity > 0.0)
    fail(JAM_E_UNSUPPORTED, "walls: non_additivity is %g, with walls it must not be positive", p.non_additivity);
  p.cell.close(p.container.closed());
}

void refuse_too_wide(const Packing &p, jam_status code) {
  const auto largest = std::max_element(p.diameter.begin(), p.diameter.end());
  if (*largest > p.container.widest() * (1.0 + 1e-12))
    fail(code, "sphere %td of diameter %g does not fit between walls %g apart", largest - p.diameter.begin(), *largest,
         p.container.widest());
}

void refuse_outside(const Packing &p) {
  for (int w = 0; w < p.container.count(); ++w) {
    const ClosestWall now = closest_to_wall(p, w);
    if (now.gap < -1.0)
      fail(JAM_E_OVERLAP,
           "the centre of sphere %d lies outside %s: positions count from the corner of the cell; if yours count from "
           "its centre, add half of each edge",
           now.sphere, p.container.name(w).c_str());
  }
}

ClosestWall closest_to_wall(const Packing &p, int w) {
  ClosestWall closest{std::numeric_limits<double>::infinity(), -1, w};
  for (size_t i = 0; i < p.n(); ++i) {
    const double h = p.container.distance(w, &p.position[i * p.dim]) / (0.5 * p.diameter[i]) - 1.0;
    if (h < closest.gap) closest = {h, static_cast<int32_t>(i), w};
  }
  return closest;
}

ClosestWall closest_wall(const Packing &p) {
  ClosestWall closest{std::numeric_limits<double>::infinity(), -1, -1};
  for (int w = 0; w < p.container.count(); ++w) {
    const ClosestWall now = closest_to_wall(p, w);
    if (now.gap < closest.gap) closest = now;
  }
  return closest;
}

void refuse_walls(const Packing &p, const char *done) {
  if (p.container) fail(JAM_E_UNSUPPORTED, "a scene with walls cannot be %s yet", done);
}

void refuse_closed(const Packing &p, int needed, const char *call) {
  if (p.container && p.container.open_axes() < needed)
    fail(JAM_E_UNSUPPORTED, "%s needs at least %d axes without walls, this scene has %d", call, needed,
         p.container.open_axes());
}

}  // namespace jam::inside
