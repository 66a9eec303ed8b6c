// Checkpoint: magic, header, arrays, checksum, all as they lie in memory. A machine with the other order of bytes
// refuses the file.
#include "io/files.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/byte_order.hpp"
#include "core/call_scope.hpp"
#include "core/cell_reduction.hpp"
#include "core/create.hpp"
#include "core/limits.hpp"
#include "core/rng.hpp"
#include "io/input_file.hpp"
#include "io/output_file.hpp"

namespace jam::inside {
namespace {

// Largest tilt of a cell vector, over the longer of its own edge and that along which it leans. Coordinates lose digits
// where the tilt is large: vectors whose orthogonality defect is larger are not kept, and a crunch adds strains of
// order one.
double tilt_max(int dim) { return 2.0 * defect_max(dim); }
// Lattice vectors that the search for the shortest one may examine. Of 1500 reduced cells in d = 8 none had more
// than 1.1e4.
constexpr double vectors_max = 1e7;

// The last character is the version of the format, which rises with every change of what is archived.
constexpr char magic[8] = {'j', 'a', 'm', 's', 't', 'a', 't', 'a'};

struct Header {
  char magic[8];
  int64_t n, seed, redrawn, beside;
  int32_t dim, model, flags, masses;
  double given_step;
  int64_t given_base;
  double mk_zeta, pressure, non_additivity;
  double cell[JAM_MAX_DIM * JAM_MAX_DIM];  // (dim, dim) cell vectors, the rest 0
};

// Flags; above them the container and its flat walls, both 0 without walls. The pressures on walls come last, if any.
constexpr int32_t flag_velocity = 1, flag_overlap_allowed = 2, flag_wall_pressure = 4;
constexpr int container_at = 8, walls_at = 16;

Enclosure enclosure_of(const Header &h) { return {h.flags >> container_at & 0xff, h.flags >> walls_at}; }
size_t walls_of(const Header &h) { return static_cast<size_t>(enclosure_of(h).count(h.dim)); }

// A lower triangle with positive edges, tilts in range, and few vectors as short as its shortest row.
bool has_searchable_cell(const Header &h) {
  const auto at = [&h](int r, int c) { return h.cell[r * h.dim + c]; };
  double least2 = std::numeric_limits<double>::infinity(), vectors = 1.0;
  for (int r = 0; r < h.dim; ++r) {
    double r2 = 0.0;
    if (!(at(r, r) > 0.0)) return false;
    for (int c = r + 1; c < h.dim; ++c)
      if (at(r, c) != 0.0) return false;
    for (int c = 0; c <= r; ++c) {
      if (c < r && !(std::fabs(at(r, c)) <= tilt_max(h.dim) * std::max(at(c, c), at(r, r)))) return false;
      r2 += at(r, c) * at(r, c);
    }
    least2 = std::min(least2, r2);
  }
  for (int c = 0; c < h.dim; ++c) vectors *= 2.0 * std::floor(std::sqrt(least2) / at(c, c) + 0.5) + 1.0;
  return vectors <= vectors_max;
}

uint64_t checksum(const char *data, size_t size) {
  uint64_t sum = 0x6a616d;
  for (size_t k = 0; k < size; k += 8) {
    uint64_t word = 0;
    std::memcpy(&word, data + k, size - k < 8 ? size - k : 8);
    sum = mix64(sum ^ word);
  }
  return sum;
}

template <class T>
void put(std::string &text, const std::vector<T> &v) {
  if (!v.empty()) text.append(reinterpret_cast<const char *>(v.data()), v.size() * sizeof(T));
}
template <class T>
void take(const char *&at, std::vector<T> &v, size_t count) {
  v.resize(count);
  if (count) std::memcpy(static_cast<void *>(v.data()), at, count * sizeof(T));
  at += count * sizeof(T);
}

// The whole file, unpacked. What does not begin as a checkpoint is read no further: it may be a device without an end.
std::string slurp(InputFile &file) {
  std::string all;
  std::vector<char> part(65536);
  for (size_t got; (got = file.read_unpacked(part.data(), part.size())) > 0;) {
    all.append(part.data(), got);
    if (all.size() < sizeof magic) continue;  // a pipe may give a byte at a time
    if (std::memcmp(all.data(), magic, sizeof magic) != 0) return all;
    // The string grows to twice its size, and the packing is a copy of it.
    CallScope::need_memory(3.0 * static_cast<double>(all.size()), ("the contents of " + file.path()).c_str());
  }
  return all;
}

}  // namespace

std::string bytes_of_state(const Packing &p, const std::string &beside) {
  Header h{};
  std::memcpy(h.magic, magic, sizeof magic);
  h.n = static_cast<int64_t>(p.n());
  h.seed = p.seed;
  h.redrawn = static_cast<int64_t>(p.mk_redrawn.size());
  h.beside = static_cast<int64_t>(beside.size());
  h.masses = p.masses;
  h.dim = p.dim;
  h.given_step = p.given.step, h.given_base = p.given.base;
  h.model = p.model;
  h.flags = (p.has_velocity ? flag_velocity : 0) | (p.overlap_allowed ? flag_overlap_allowed : 0) |
            (p.wall_pressure.empty() ? 0 : flag_wall_pressure) | p.container.kind() << container_at |
            p.container.flat() << walls_at;
  for (int k = 0; k < p.dim; ++k) std::copy(p.cell.row(k), p.cell.row(k) + p.dim, h.cell + k * p.dim);
  h.mk_zeta = p.mk_zeta;
  h.pressure = p.pressure;
  h.non_additivity = p.non_additivity;
  std::string text(reinterpret_cast<const char *>(&h), sizeof h);
  put(text, p.position);
  put(text, p.diameter);
  put(text, p.velocity);
  put(text, p.mk_redrawn);
  text += beside;
  put(text, p.wall_pressure);
  const uint64_t sum = checksum(text.data(), text.size());
  text.append(reinterpret_cast<const char *>(&sum), sizeof sum);
  return text;
}

void write_checkpoint(const Packing &p, const std::string &beside, const char *path) {
  OutputFile file(path);
  file.text() = bytes_of_state(p, beside);
  file.commit();
}

Packing read_checkpoint(const char *path, std::string &beside) {
  InputFile file(path);
  return packing_of_state(slurp(file), file.path().c_str(), beside);
}

Packing packing_of_state(const std::string &all, const char *name, std::string &beside) {
  Header h{};
  if (all.size() > sizeof magic && std::memcmp(all.data(), magic, sizeof magic - 1) == 0 &&
      all[sizeof magic - 1] != magic[sizeof magic - 1])
    fail(JAM_E_FORMAT, "%s is a checkpoint of another version of libjam", name);
  if (all.size() < sizeof h + 8 || std::memcmp(all.data(), magic, sizeof magic) != 0)
    fail(JAM_E_FORMAT, "%s is no checkpoint of libjam; jam_read reads files of packings", name);
  std::memcpy(&h, all.data(), sizeof h);
  const int32_t other_dim = with_bytes_reversed(h.dim);
  if (other_dim >= 2 && other_dim <= JAM_MAX_DIM)
    fail(JAM_E_FORMAT,
         "%s was written on a machine with the other order of bytes: write the packing as text there, which reads "
         "anywhere",
         name);
  uint64_t sum = 0;
  std::memcpy(&sum, all.data() + all.size() - 8, 8);
  if (sum != checksum(all.data(), all.size() - 8)) fail(JAM_E_FORMAT, "%s is damaged: its checksum does not fit", name);
  const size_t room = all.size() - sizeof h - 8;
  const size_t pressures =
      (h.flags & flag_wall_pressure) != 0 && h.dim >= 2 && h.dim <= JAM_MAX_DIM ? walls_of(h) * sizeof(double) : 0;
  if (h.dim < 2 || h.dim > JAM_MAX_DIM || h.n < 1 || h.n > INT32_MAX || h.redrawn < 0 ||
      static_cast<size_t>(h.redrawn) > room || h.beside < 0 || static_cast<size_t>(h.beside) > room ||
      static_cast<size_t>(h.n) > room || pressures > room ||
      room - static_cast<size_t>(h.beside) - pressures !=
          static_cast<size_t>(h.n) * (2 * static_cast<size_t>(h.dim) + 1) * sizeof(double) +
              static_cast<size_t>(h.redrawn) * sizeof(MkRedrawn))
    fail(JAM_E_FORMAT, "%s has the wrong size: %zu bytes for %lld spheres", name, all.size(),
         static_cast<long long>(h.n));
  Packing p;
  p.dim = h.dim;
  p.seed = h.seed;
  p.model = h.model;
  p.masses = h.masses;
  p.mk_zeta = h.mk_zeta;
  p.pressure = h.pressure;
  p.non_additivity = h.non_additivity;
  p.given.step = h.given_step, p.given.base = static_cast<int>(h.given_base);
  p.has_velocity = (h.flags & flag_velocity) != 0;
  p.overlap_allowed = (h.flags & flag_overlap_allowed) != 0;
  const char *at = all.data() + sizeof h;
  const size_t n = static_cast<size_t>(h.n), d = static_cast<size_t>(h.dim);
  take(at, p.position, n * d);
  take(at, p.diameter, n);
  take(at, p.velocity, n * d);
  take(at, p.mk_redrawn, static_cast<size_t>(h.redrawn));
  beside.assign(at, static_cast<size_t>(h.beside));
  at += h.beside;
  take(at, p.wall_pressure, pressures / sizeof(double));
  check_dim(h.dim);
  reduce_cell(h.dim, h.cell);  // for its checks
  if (!has_searchable_cell(h)) fail(JAM_E_FORMAT, "%s contains a cell that is far from reduced", name);
  p.cell = Cell::from_triangle(h.dim, h.cell);
  if (h.flags >> container_at) {
    enclose(p, enclosure_of(h));
    if (p.container.count() != static_cast<int>(walls_of(h))) fail(JAM_E_FORMAT, "%s has no such container", name);
    refuse_outside(p, wrong_origin);
  }
  check_packing(p, JAM_E_FORMAT);
  bool good = (h.model == JAM_MODEL_EUCLID || h.model == JAM_MODEL_MK) &&
              (h.masses == JAM_MASSES_EQUAL || h.masses == JAM_MASSES_VOLUME) &&
              (h.model == JAM_MODEL_EUCLID || is_mk_zeta(h.mk_zeta)) && h.given_step >= 0.0 &&
              std::isfinite(h.given_step) && (h.given_base == 0 || h.given_base == 2 || h.given_base == 10);
  const MkRedrawn *last = nullptr;
  for (const MkRedrawn &r : p.mk_redrawn) {
    good = good && r.i >= 0 && r.i < r.j && r.j < h.n && r.attempt > 0 &&
           (!last || last->i < r.i || (last->i == r.i && last->j < r.j));
    last = &r;
  }
  if (!good) fail(JAM_E_FORMAT, "%s contains values that no packing has", name);
  return p;
}

}  // namespace jam::inside
