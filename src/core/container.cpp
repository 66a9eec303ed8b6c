#include "core/container.hpp"

#include <algorithm>
#include <cstring>

#include "core/cell_reduction.hpp"
#include "core/error.hpp"
#include "core/math.hpp"

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

// A shape: its curved wall goes round the first axes, and closes them; flat walls may close others.
struct Shape {
  const char *word;
  int least_dim, most_dim, round_axes;
  uint32_t flat, ends;  // axes that may have flat walls, and that must
  const char *dims, *flat_walls;
};
constexpr Shape shapes[] = {
    {"brick", 1, JAM_MAX_DIM, 0, ~0u, 0u, "", ""},
    {"cylinder", 3, 3, 2, 4u, 0u, "3", "may have flat walls on axis z alone (4)"},
    {"ball", 2, 3, 3, 0u, 0u, "2 or 3", "has no flat walls"},
    {"cone", 3, 3, 2, 4u, 4u, "3", "has flat walls on axis z, and on no other (4)"},
};
constexpr int32_t shape_count = sizeof shapes / sizeof *shapes;

const Shape &shape_of(int32_t kind, int32_t walls, int dim) {
  if (kind < 0 || kind >= shape_count)
    fail(JAM_E_ARGUMENT, "container is %d, it must be a value of jam_container", kind);
  if (walls < 0 || walls >= 1 << dim)
    fail(JAM_E_ARGUMENT, "walls is %d, it must be a sum of 2^c over axes c below dim %d", walls, dim);
  const Shape &shape = shapes[kind];
  if (dim < shape.least_dim || dim > shape.most_dim)
    fail(JAM_E_DIMENSION, "a %s needs dim %s, dim is %d", shape.word, shape.dims, dim);
  const auto given = static_cast<uint32_t>(walls);
  if (given & ~shape.flat || shape.ends & ~given)
    fail(JAM_E_ARGUMENT, "walls is %d: a %s %s", walls, shape.word, shape.flat_walls);
  return shape;
}

}  // namespace

Container::Container(int32_t kind, int32_t walls, const Cell &cell) : kind_(kind), flat_(walls), dim_(cell.dim()) {
  round_axes_ = std::min(dim_, shape_of(kind, walls, dim_).round_axes);
  closed_ = static_cast<uint32_t>(walls) | ((1u << round_axes_) - 1u);
  for (int c = 0; c < dim_; ++c) {
    edge_[c] = cell.edge(c);
    if (!(closed_ >> c & 1)) continue;
    check_axis(cell, c);
    widest_ = std::min(widest_, edge_[c]);
  }
  for (int c = 1; c < round_axes_; ++c)
    if (edge_[c] != edge_[0])
      fail(JAM_E_ARGUMENT, "a round container needs equal edges of the cell: x has %.17g, %c has %.17g", edge_[0],
           letter(c, dim_), edge_[c]);
  volume_ = round_axes_ > 0 ? unit_sphere_volume(round_axes_) : cell.volume();
  for (int c = 0; c < dim_ && round_axes_ > 0; ++c) volume_ *= edge_[c];
  for (int c = 0; c < dim_; ++c)
    for (int side = 0; side < 2 && (walls >> c & 1); ++side)
      walls_.push_back(Surface::plane(dim_, c, side, edge_[c], volume_ / edge_[c]));
  const double radius = 0.5 * edge_[0];
  if (kind == JAM_CONTAINER_CONE) {  // the widest sphere touches the flat wall at 0 and the cone, or both flat walls
    const double upper = 0.5 * radius, length = edge_[2], slant = std::sqrt(length * length + upper * upper);
    volume_ = math::pi * length * (radius * radius + radius * upper + upper * upper) / 3.0;
    widest_ = std::min(length, 2.0 * radius * length / (slant + upper));
    walls_ = {Surface::plane(3, 2, 0, length, math::pi * radius * radius),
              Surface::plane(3, 2, 1, length, math::pi * upper * upper),
              Surface::cone(radius, length, math::pi * (radius + upper) * slant)};
  } else if (round_axes_ > 0)  // area: d V / d R_c
    walls_.push_back(Surface::round(dim_, round_axes_, radius, volume_ * round_axes_ / radius));
}

const char *Container::word() const { return shapes[kind_].word; }

int32_t container_of_word(const char *word) {
  for (int32_t k = 0; k < shape_count; ++k)
    if (std::strcmp(shapes[k].word, word) == 0) return k;
  return -1;
}

std::string container_words() {
  std::string all;
  for (int32_t k = 0; k < shape_count; ++k)
    all += std::string(k == 0 ? "" : k + 1 < shape_count ? ", " : " and ") + shapes[k].word;
  return all;
}

bool Enclosure::closes(int c) const {
  return (walls >> c & 1) != 0 || (container > 0 && container < shape_count && c < shapes[container].round_axes);
}
int Enclosure::count(int dim) const {
  int all = container == JAM_CONTAINER_BRICK ? 0 : 1;
  for (int c = 0; c < dim; ++c) all += walls >> c & 1 ? 2 : 0;
  return all;
}
bool Enclosure::needs_space() const {
  return (walls & 4) != 0 || (container > 0 && container < shape_count && shapes[container].least_dim > 2);
}

void Container::know(const char *call) const {
  if (kind_ > JAM_CONTAINER_BALL) fail(JAM_E_UNSUPPORTED, "%s has no formulae for a %s yet", call, word());
}

std::vector<Container::Ring> Container::rings() const {
  const double half = 0.5 * edge_[0];
  if (round_axes_ == 0) return {};
  if (dim_ == 2) return {{{0, 1}, {half, half, 0.0}, half}};
  const double upper = kind_ == JAM_CONTAINER_CONE ? 0.5 * half : half;
  if (round_axes_ == 2) return {{{0, 1}, {half, half, 0.0}, half}, {{0, 1}, {half, half, edge_[2]}, upper}};
  const std::array<double, 3> middle{half, half, half};
  return {{{0, 1}, middle, half}, {{0, 2}, middle, half}, {{1, 2}, middle, half}};
}

void Container::rotation(int q, const double *x, double *v) const {
  for (int c = 0; c < dim_; ++c) v[c] = 0.0;
  for (int a = 0; a < round_axes_; ++a)
    for (int b = a + 1; b < round_axes_; ++b)
      if (q-- == 0) v[a] = 0.5 * edge_[0] - x[b], v[b] = x[a] - 0.5 * edge_[0];
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

void refuse_outside(const Packing &p, const char *why) {
  for (int w = 0; w < p.container.count(); ++w) {
    const ClosestWall now = closest_to_wall(p, w);
    if (now.gap < -1.0)
      fail(JAM_E_OVERLAP, "the centre of sphere %d lies outside %s: %s", now.sphere, p.container[w].name().c_str(),
           why);
  }
}

ClosestWall closest_to_wall(const Packing &p, int w) {
  ClosestWall closest{std::numeric_limits<double>::infinity(), -1, w};
  for (size_t i = 0; i < p.n(); ++i) {
    const double h = p.container[w].distance(&p.position[i * p.dim]) / (0.5 * p.diameter[i]) - 1.0;
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
    fail(JAM_E_UNSUPPORTED, "%s needs %s without walls, this scene has %d", call,
         needed == 1 ? "at least 1 axis" : "at least 2 axes", p.container.open_axes());
}

}  // namespace jam::inside
