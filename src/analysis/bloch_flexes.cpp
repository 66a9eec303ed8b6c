// Flexes of copies of a packing, at each of their wave vectors.
#include <algorithm>
#include <limits>

#include "analysis/modes.hpp"
#include "core/call_scope.hpp"
#include "linalg/block_cholesky.hpp"
#include "network/flex.hpp"

namespace jam::inside {
namespace {

// At one wave vector: flexes, and the least eigenvalue of S^T S above them; infinity without another motion.
struct Soft {
  int64_t flexes;
  double margin;
};

// Contacts that carry force in the copies: those that do in one cell, and spheres that touch their own images in
// another copy, whose force balances.
ContactNetwork carrying_contacts(const Packing &p, const PackingVerdict &verdict, const Copies &copies) {
  ContactNetwork net = verdict.carrying(p.dim);
  const ContactNetwork own = between_copies(p, unlisted_own_images(p, net, contact_gap_limit), copies);
  for (size_t k = 0; k < own.size(); ++k) add_contact(p, own.pairs, k, net);
  return net;
}

// The rows S at one wave vector as real ones: of x, or of x and y where they are complex and x + i y moves. The pattern
// of S^T S is that of all wave vectors.
class WaveRows {
 public:
  WaveRows(const RigidityMatrix &g, const CellsBack &back, bool real) : g_(g), back_(back), real_(real), factor_(h_) {
    h_.dim = g.dim, h_.nodes = (real ? 1 : 2) * g.nodes;
    std::vector<Edge> edges;
    for (size_t k = 0; k < g.contacts(); ++k)
      for (const Edge &e : edges_of(k)) edges.push_back(e);
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const Edge &e : edges) h_.ei.push_back(e.first), h_.ej.push_back(e.second);
    for (size_t k = 0; k < g.contacts(); ++k)
      for (const Edge &e : edges_of(k))
        place_.push_back(static_cast<size_t>(std::lower_bound(edges.begin(), edges.end(), e) - edges.begin()));
  }
  // symmetries: whether those of the network are no flexes. Empty where there are too many flexes to search for.
  std::optional<Soft> softest(const double *q, bool symmetries) {
    set(q);
    factor_.factorise_from(flex_eigenvalue);
    const size_t known = symmetries ? static_cast<size_t>(g_.symmetries()) : 0, columns = h_.rows();
    const SoftRows rows{(real_ ? 1 : 2) * g_.contacts(),
                        columns,
                        known,
                        [&](const double *x, double *y) { multiply(x, y); },
                        [&](double *x) {
                          if (symmetries) g_.remove_symmetries(x);
                        },
                        [&](double *x, int count) { factor_.solve_many(x, count); }};
    const SoftestModes modes = softest_modes(rows, flex_eigenvalue, columns / BlochTuning::unknowns_a_flex);
    if (!modes.complete) return {};
    const size_t found = modes.flexes.size();
    return Soft{static_cast<int64_t>(real_ ? found : (found + 1) / 2),
                found + known < columns ? modes.margin : std::numeric_limits<double>::infinity()};
  }

 private:
  using Edge = std::pair<int32_t, int32_t>;
  // Real: (x_a, x_b). Complex: (x_a, x_b), (y_a, y_b), (x_a, y_b), (x_b, y_a).
  std::vector<Edge> edges_of(size_t k) const {
    const int32_t a = g_.a[k], b = g_.b[k], low = std::min(a, b), high = std::max(a, b), m = g_.nodes;
    if (b < 0 || a == b) return {};
    if (real_) return {{low, high}};
    return {{low, high}, {low + m, high + m}, {a, b + m}, {b, a + m}};
  }
  void set(const double *q) {
    const size_t d = static_cast<size_t>(g_.dim), dd = d * d, m = static_cast<size_t>(g_.nodes);
    h_.diag.assign(static_cast<size_t>(h_.nodes) * dd, 0.0), h_.off.assign(h_.ei.size() * dd, 0.0);
    phase_.clear();
    size_t at = 0;
    for (size_t k = 0; k < g_.contacts(); ++k) {
      const double *n = &g_.normal[k * d];
      const WavePhase phase = phase_of(q, back_[k], g_.dim);
      phase_.push_back(phase);
      const auto add = [&](double *block, double factor) {
        for (size_t r = 0; r < d; ++r)
          for (size_t c = 0; c < d; ++c) block[r * d + c] += factor * n[r] * n[c];
      };
      const auto add_diagonal = [&](int32_t node, double factor) {
        add(&h_.diag[static_cast<size_t>(node) * dd], factor);
        if (!real_) add(&h_.diag[(static_cast<size_t>(node) + m) * dd], factor);
      };
      const int32_t a = g_.a[k], b = g_.b[k];
      if (a == b) {
        add_diagonal(a, (1.0 - phase.cosine) * (1.0 - phase.cosine) + phase.sine * phase.sine);
        continue;
      }
      add_diagonal(a, 1.0);
      if (b < 0) continue;
      add_diagonal(b, 1.0);
      const auto add_edge = [&](double factor) { add(&h_.off[place_[at++] * dd], factor); };
      add_edge(-phase.cosine);
      if (real_) continue;
      add_edge(-phase.cosine), add_edge(phase.sine), add_edge(-phase.sine);
    }
  }
  void multiply(const double *x, double *y) const {
    const size_t d = static_cast<size_t>(g_.dim), n = g_.unknowns(), rows = g_.contacts();
    const auto along = [&](size_t k, const double *u, int32_t node) {
      double sum = 0.0;
      for (size_t c = 0; c < d; ++c) sum += g_.normal[k * d + c] * u[static_cast<size_t>(node) * d + c];
      return sum;
    };
    for (size_t k = 0; k < rows; ++k) {
      const int32_t a = g_.a[k], b = g_.b[k];
      const WavePhase phase = phase_[k];
      const double xb = b < 0 ? 0.0 : along(k, x, b), yb = b < 0 || real_ ? 0.0 : along(k, x + n, b);
      y[k] = along(k, x, a) - phase.cosine * xb + phase.sine * yb;
      if (!real_) y[rows + k] = along(k, x + n, a) - phase.sine * xb - phase.cosine * yb;
    }
  }

  const RigidityMatrix &g_;
  const CellsBack &back_;
  const bool real_;
  BlockMatrix h_;
  ShiftedFactor factor_;
  std::vector<size_t> place_;  // of the edges of one contact after the other
  std::vector<WavePhase> phase_;
};

// By all eigenvalues of S^T S.
Soft softest_of_all(const RigidityMatrix &g, const CellsBack &back, const double *q, bool symmetries) {
  need_memory_for_bloch(g, back, q);
  const ContactWeights springs{std::vector<double>(g.contacts(), 1.0), {}};
  const std::vector<double> lambda = bloch_modes(g, springs, back, q, false).lambda;
  const size_t known = std::min(lambda.size(), symmetries ? static_cast<size_t>(g.symmetries()) : 0);
  const auto flexes = std::count_if(lambda.begin() + static_cast<std::ptrdiff_t>(known), lambda.end(),
                                    [](double x) { return x < flex_eigenvalue; });
  const size_t above = known + static_cast<size_t>(flexes);
  return {flexes, above < lambda.size() ? lambda[above] : std::numeric_limits<double>::infinity()};
}

// The wave vectors of copies: what a matrix of one cell has at each of them.
class WaveVectors {
 public:
  WaveVectors(const Copies &copies, int dim) : copies_(copies), dim_(dim) {
    for (int64_t row = 0; row < copies.number(); ++row) {
      const auto q = copies.place(row);
      for (int c = 0; c < dim; ++c) wave.push_back(static_cast<double>(q[c]) / copies.along(c));
    }
  }
  // From row `first` on, one of each pair q, -q. At q = 0 symmetries are no flexes. True: look no further.
  void each(const RigidityMatrix &g, const CellsBack &back, size_t first,
            const std::function<bool(size_t row, const Soft &)> &take) const {
    std::optional<WaveRows> rows[2];  // of complex and of real wave vectors
    const auto count = static_cast<size_t>(copies_.number());
    for (size_t row = first; row < count; ++row) {
      CallScope::report_share(static_cast<int64_t>(row), static_cast<double>(row) / static_cast<double>(count));
      if (opposite(row) < row) continue;
      const double *q = &wave[row * static_cast<size_t>(dim_)];
      const bool real = is_real(back, q, dim_), symmetries = row == 0;
      std::optional<Soft> soft;
      if ((real ? 1 : 2) * g.unknowns() > ModesTuning::always_dense) {
        if (!rows[real]) rows[real].emplace(g, back, real);
        soft = rows[real]->softest(q, symmetries);
      }
      if (take(row, soft ? *soft : softest_of_all(g, back, q, symmetries))) return;
    }
  }
  // The row of -q, whose matrix is the conjugate one.
  size_t opposite(size_t row) const {
    const auto q = copies_.place(static_cast<int64_t>(row));
    size_t out = 0;
    for (int c = dim_ - 1; c >= 0; --c)
      out = out * static_cast<size_t>(copies_.along(c)) +
            static_cast<size_t>((copies_.along(c) - q[c]) % copies_.along(c));
    return out;
  }
  std::vector<double> wave;  // (copies, dim)

 private:
  const Copies &copies_;
  const int dim_;
};

// Rows of further pairs of the spheres of g. A rattler stays where it is, as a wall does.
void add_rows(const Packing &p, const ContactNetwork &near, RigidityMatrix &g, CellsBack &back) {
  const RigidityMatrix rows = make_rigidity_matrix(p, near);
  const CellsBack steps = cells_back(p, near);
  const auto d = static_cast<std::ptrdiff_t>(p.dim);
  for (size_t k = 0; k < near.size(); ++k) {
    const int32_t a = g.node[near.pairs.i[k]], b = near.pairs.wall(k) ? -1 : g.node[near.pairs.j[k]];
    if (a < 0 && b < 0) continue;
    g.a.push_back(a < 0 ? b : a), g.b.push_back(a < 0 ? -1 : b);
    const auto n = rows.normal.begin() + static_cast<std::ptrdiff_t>(k) * d;
    g.normal.insert(g.normal.end(), n, n + d);
    back.push_back(steps[k]);
  }
}

// Whether the copies have a flex that keeps the pairs that block others. At q = 0 the test of one cell has looked.
bool is_clear(const Packing &p, const ContactNetwork &net, const WaveVectors &waves) {
  const ContactNetwork near = blocking_pairs(p, net, net, false, true);
  if (near.size() == 0) return true;
  RigidityMatrix g = make_rigidity_matrix(p, net);
  CellsBack back = cells_back(p, net);
  add_rows(p, near, g, back);
  bool found = false;
  waves.each(g, back, 1, [&](size_t, const Soft &soft) { return found = soft.flexes > 0; });
  return found;
}

}  // namespace

BlochFlexes bloch_flexes(const Packing &p, const PackingVerdict &verdict, const Copies &copies) {
  const auto count = static_cast<size_t>(copies.number());
  const ContactNetwork net = carrying_contacts(p, verdict, copies);
  const RigidityMatrix g = make_rigidity_matrix(p, net);
  const WaveVectors waves(copies, p.dim);
  BlochFlexes out;
  out.wave = waves.wave;
  out.flexes.assign(count, 0);
  out.margin.assign(count, std::numeric_limits<double>::quiet_NaN());
  if (net.size() > 0)
    waves.each(g, cells_back(p, net), 0, [&](size_t row, const Soft &soft) {
      out.flexes[row] = soft.flexes, out.margin[row] = soft.margin;
      return false;
    });
  for (size_t row = 0; row < count; ++row) {
    const size_t opposite = waves.opposite(row);
    if (opposite < row) out.flexes[row] = out.flexes[opposite], out.margin[row] = out.margin[opposite];
    out.total += out.flexes[row];
  }
  CopiesEvidence found;
  found.empty = net.size() == 0, found.flexes_of_one = out.flexes[0], found.flexes = out.total;
  found.clear = out.total > 0 && out.flexes[0] == 0 && is_clear(p, net, waves);
  found.closed = std::all_of(net.gap.begin(), net.gap.end(), [](double h) { return h < contact_gap_limit; });
  found.margin = *std::min_element(out.margin.begin(), out.margin.end());
  out.jammed = verdict_of_copies(verdict, found);
  return out;
}

}  // namespace jam::inside
