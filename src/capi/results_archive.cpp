// Results and unfinished work as bytes of a checkpoint. The bytes may come from a damaged or malicious file, so all
// that later calls rely on is checked: sizes, numbers of spheres, and that the contacts are those of the packing.
#include <cmath>

#include "capi/system.hpp"
#include "core/create.hpp"
#include "core/error.hpp"
#include "core/pair_rule.hpp"
#include "io/files.hpp"

namespace jam::inside {
namespace {

void check(bool good) {
  if (!good) fail(JAM_E_FORMAT, "the results kept in the checkpoint do not fit its packing");
}
bool all_finite(const std::vector<double> &x) {
  for (const double v : x)
    if (!std::isfinite(v)) return false;
  return true;
}

void archive(Archive &a, std::string &text) {
  std::vector<char> bytes(text.begin(), text.end());
  a(bytes);
  text.assign(bytes.begin(), bytes.end());
}

// Distances of two spheres that the stored contact and the packing give may differ by the rounding of coordinates.
double resolution(const Packing &p, double sigma) {
  constexpr double of_contact = 1e-9, of_coordinate = 1e-13;
  return of_contact * sigma + of_coordinate * p.cell.half_diagonal();
}

void check_network(const ContactNetwork &c, const Packing &p, bool by_distance) {
  const size_t m = c.pairs.i.size(), n = p.n(), d = static_cast<size_t>(p.dim);
  check(c.pairs.j.size() == m && c.pairs.offset.size() == m * d && c.vector.size() == m * d && c.gap.size() == m);
  check(c.force.size() == m && (c.stiffness.empty() || c.stiffness.size() == m));
  check(c.prestress.size() == c.stiffness.size());
  check(c.coordination.size() == n || (c.coordination.empty() && m == 0));
  for (const auto *x : {&c.pairs.offset, &c.vector, &c.gap, &c.stiffness, &c.prestress}) check(all_finite(*x));
  for (const double f : c.force) check(by_distance ? std::isnan(f) : std::isfinite(f));
  std::vector<int32_t> coordination(c.coordination.size(), 0);
  double r[JAM_MAX_DIM];
  for (size_t k = 0; k < m; ++k) {
    const int32_t i = c.pairs.i[k], j = c.pairs.j[k];
    check(i >= 0 && static_cast<size_t>(i) < n && static_cast<size_t>(std::max(j, 0)) < n);
    check(c.pairs.wall(k) ? wall_partner(j) < p.container.count() : i <= j);
    check(k == 0 || std::make_pair(c.pairs.i[k - 1], c.pairs.j[k - 1]) <= std::make_pair(i, j));
    for_spheres(i, j, [&](int32_t s) { ++coordination[s]; });
    pair_vector(p, c.pairs, k, r);
    const double sigma = contact_distance(p, i, j), length = sigma * (1.0 + c.gap[k]);
    for (size_t e = 0; e < d; ++e) check(std::fabs(r[e] - length * c.vector[k * d + e]) <= resolution(p, sigma));
  }
  check(coordination == c.coordination);
}

void archive(Archive &a, ContactNetwork &c) {
  a(c.pairs.i), a(c.pairs.j), a(c.pairs.offset);
  a(c.vector), a(c.gap), a(c.force), a(c.stiffness), a(c.prestress);
  a(c.force_scale), a(c.coordination);
}

void archive(Archive &a, KeptStep &s, const Packing &p, size_t rows) {
  a(s.step), a(s.diameter), a(s.fraction), a(s.position);
  std::vector<double> cell = s.cell.rows();
  a(cell);
  if (!a.reading()) return;
  const size_t d = static_cast<size_t>(p.dim);
  check(s.step >= 0 && static_cast<size_t>(s.step) <= rows && s.position.size() == p.position.size());
  check(s.diameter > 0.0 && std::isfinite(s.diameter) && std::isfinite(s.fraction));
  check(cell.size() == d * d && all_finite(cell));
  for (size_t k = 0; k < d; ++k) check(cell[k * d + k] > 0.0);
  for (const float x : s.position) check(std::isfinite(x));
  s.cell = Cell::from_triangle(p.dim, cell.data());
}

void check_history(const std::vector<HistoryRow> &history) {
  for (const HistoryRow &row : history) {
    const double phase = row[JAM_HISTORY_PHASE];
    check(phase == JAM_STEP_PATH || phase == JAM_STEP_LP || phase == JAM_STEP_POLISH);
  }
}

// The parts of a checkpoint that wait: bytes of their own, empty where there is nothing.
struct Waiting {
  std::string crunch, paused, runs, notes;
  int64_t sweeps = 0;
  uint8_t follows = 0;  // sum of the two below
  static constexpr uint8_t results = 1, start = 2;
  void archive(Archive &a) {
    jam::inside::archive(a, crunch), jam::inside::archive(a, paused), jam::inside::archive(a, runs),
        jam::inside::archive(a, notes);
    a(sweeps), a(follows);
    check(follows <= (results | start));
  }
};

bool same_configuration(const Packing &a, const Packing &b) {
  return a.position == b.position && a.diameter == b.diameter && a.cell.rows() == b.cell.rows() &&
         a.overlap_allowed == b.overlap_allowed;
}

// The packing that the runs began from, in the form of a checkpoint, whose checks it needs.
Packing read_start(Archive &a, const Packing &p) {
  std::string bytes, none;
  archive(a, bytes);
  Packing start = packing_of_state(bytes, "the start of the runs", none);
  check(start.dim == p.dim && start.n() == p.n() && start.seed == p.seed);
  apply_overlap_policy(start, start.overlap_allowed ? JAM_OVERLAP_ALLOW : JAM_OVERLAP_REFUSE);
  return start;
}

}  // namespace

void Results::archive(Archive &a, const Packing &p) {
  // A report may grow at its end. Another column of a history is another format: raise the version in
  // io/checkpoint.cpp.
  a(has_report), a.sized(report), jam::inside::archive(a, contacts);
  a(has_history), a(history), a(soft_history);
  uint64_t kept = kept_steps.size();
  a(kept);
  if (a.reading()) {
    check(!has_report || std::max<int64_t>(0, report.contacts) == static_cast<int64_t>(contacts.size()));
    check_history(history);
    check(kept <= history.size() + 1);
    kept_steps.resize(kept);
  }
  int64_t last = -1;
  for (KeptStep &s : kept_steps) {
    jam::inside::archive(a, s, p, history.size());
    check(s.step > last);
    last = s.step;
  }
  // Follows only where there is one, so that other checkpoints keep the format of 1.0.
  if (a.reading() ? a.more() : by_distance()) a(contact_gap);
  if (!a.reading()) return;
  check(!by_distance() || (!has_report && contact_gap > 0.0 && contact_gap <= 1.0));
  check_network(contacts, p, by_distance());
}

std::string archive_beside(const SystemState &s, const Moving &moving, const Packing &now) {
  Waiting w;
  const bool moves = moving.crunch || moving.dynamics;
  if (moving.crunch || (!moves && s.crunch_paused))
    w.crunch = (moving.crunch ? *moving.crunch : *s.crunch_paused).bytes();
  if (moving.dynamics || (!moves && s.paused))
    w.paused = write_dynamics(moving.dynamics ? *moving.dynamics : *s.paused);
  if (s.runs) w.runs = write_dynamics(*s.runs);
  w.sweeps = s.sweeps;
  w.notes = s.notes.text();
  if (!moves && (s.has_report || s.by_distance() || s.has_history || !s.soft_history.empty()))
    w.follows |= Waiting::results;
  if (s.runs && !same_configuration(s.runs->packing(), now)) w.follows |= Waiting::start;
  Archive a;
  w.archive(a);
  if (w.follows & Waiting::start) {
    std::string start = bytes_of_state(s.runs->packing(), "");
    archive(a, start);
  }
  if (w.follows & Waiting::results) {
    Results copy = s;
    copy.archive(a, s.packing);
  }
  return a.bytes();
}

void read_beside(SystemState &s, std::string bytes) {
  Archive a(std::move(bytes));
  Waiting w;
  w.archive(a);
  check(w.sweeps >= 0);
  const Packing start = w.follows & Waiting::start ? read_start(a, s.packing) : s.packing;
  if (w.follows & Waiting::results) s.results().archive(a, s.packing);
  a.end();
  s.sweeps = w.sweeps;
  s.notes = Notes(std::move(w.notes));
  if (!w.crunch.empty()) s.crunch_paused = CrunchStage::of(w.crunch);
  if (!w.paused.empty()) s.paused = read_dynamics(s.packing, std::move(w.paused));
  if (w.runs.empty()) return;
  std::unique_ptr<Dynamics> runs = read_dynamics(start, std::move(w.runs));
  check(runs->phase() == JAM_PHASE_ISOCONF && (!s.paused || s.paused->phase() != runs->phase()));
  s.runs.reset(static_cast<Isoconfigurational *>(runs.release()));
}

}  // namespace jam::inside
