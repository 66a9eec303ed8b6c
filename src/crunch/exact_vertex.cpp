#include "crunch/exact_vertex.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/pair_rule.hpp"
#include "crunch/gap_rows.hpp"
#include "lp/small_lp.hpp"
#include "network/contact_network.hpp"

namespace jam {
namespace {

// Undecided at first: at least this many more than must be open. Later so many of those that pull join at a time.
constexpr size_t least_choice = 16, batch = 64;
constexpr int max_rounds = 30;

// Translations are fixed by one sphere, rattlers by themselves: neither costs accuracy.
std::vector<double> pins(const ContactNetwork &net, int dim) {
  std::vector<double> diagonal(net.coordination.size() * dim, 0.0);
  bool grounded = false;
  for (size_t i = 0; i < net.coordination.size(); ++i) {
    if (net.coordination[i] > 0 && grounded) continue;
    grounded = grounded || net.coordination[i] > 0;
    std::fill_n(&diagonal[i * dim], dim, 1.0);
  }
  return diagonal;
}

// The gaps of the undecided rows u change by o >= -h; all other gaps stay. A motion does both when (0, o) lies in the
// range of all rows. With P the projector on that range, this is (1 - G) o = 0 with G = P_uu. The rank of 1 - G is the
// number of redundant states: states of self-stress without pressure. The gain is gamma . o.
class SmallLp {
 public:
  SmallLp(const Packing &p, const ContactNetwork &all, NewtonSystem &system, const Tuning &tuning, Monitor *monitor)
      : all_(all),
        t_(tuning),
        dim_(p.dim),
        monitor_(monitor),
        a_(relative_rows(p, all)),
        pins_(pins(all, p.dim)),
        rows_(all.pairs, p.dim, a_, pins_, system),
        redundant_(static_cast<size_t>(excess_contacts(all, p.dim))),
        sigma_(all.size()),
        undecided_(all.size(), 0),
        wanted_(all.size()) {
    const double unit = diameter_mean(p);
    for (size_t k = 0; k < all.size(); ++k) sigma_[k] = contact_distance(p, all.pairs.i[k], all.pairs.j[k]) / unit;
  }

  bool solve(Vertex &out) {
    if (!rows_.factorise()) return false;
    balanced_.resize(all_.size());
    for (size_t k = 0; k < all_.size(); ++k) balanced_[k] = all_.force[k] * sigma_[k];
    rows_.balance(balanced_);
    y_ = balanced_;
    if (redundant_ == 0) return none_pulls() && finish(out);  // what was missing is there now
    for (int round = 0; round < max_rounds; ++round) {
      if (round > 0 && none_pulls()) return finish(out);
      if (!admit() || !vertex()) return false;
      forces();
    }
    return false;
  }

 private:
  bool none_pulls() const {
    return std::all_of(y_.begin(), y_.end(), [](double y) { return y >= 0.0; });  // nor is it no number
  }

  // At first all weak ones, at least so many that there is a choice; later the strongest that pull in the last answer:
  // with them settled most others push again.
  bool admit() {
    if (!std::all_of(y_.begin(), y_.end(), [](double y) { return std::isfinite(y); }))
      return false;  // the network is no frame
    const bool first = u_.empty();
    std::vector<double> sorted;
    for (size_t k = 0; k < y_.size(); ++k)
      if (!undecided_[k] && (first || y_[k] < 0.0)) sorted.push_back(y_[k]);
    if (sorted.empty()) return redundant_ <= u_.size();
    const auto last = sorted.begin() + static_cast<std::ptrdiff_t>(
                                           std::min(first ? redundant_ + least_choice : batch, sorted.size()) - 1);
    std::nth_element(sorted.begin(), last, sorted.end());
    const double limit = first ? std::max(t_.weak_force, *last) : *last;
    for (size_t k = 0; k < y_.size(); ++k)
      if (!undecided_[k] && y_[k] <= limit && !take(k)) return false;
    return redundant_ <= u_.size();
  }

  // Its column: what opening it alone by one does to the rows that are undecided, and to the diameters.
  bool take(size_t k) {
    if (u_.size() == t_.max_undecided || (monitor_ && monitor_->interrupted())) return false;
    undecided_[k] = 1;
    u_.push_back(k);
    std::fill(wanted_.begin(), wanted_.end(), 0.0);
    wanted_[k] = 1.0;
    gamma_.push_back(rows_.towards(wanted_, got_).g);
    const Eigen::Index n = static_cast<Eigen::Index>(u_.size());
    rest_.conservativeResize(n, n);
    for (Eigen::Index q = 0; q < n; ++q) rest_(q, n - 1) = rest_(n - 1, q) = (q == n - 1) - got_[u_[q]];
    return std::isfinite(gamma_.back());
  }

  // In x = (o + h) / t_.near_gap >= 0 and the eigenvectors of 1 - G that are not of eigenvalue 0.
  bool vertex() {
    const size_t n = u_.size();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(rest_);
    const Eigen::MatrixXd v = eigen.eigenvectors().rightCols(redundant_);
    Eigen::VectorXd h(n);
    std::vector<double> cost(n), rows(redundant_ * n);
    const double largest = std::abs(
        *std::max_element(gamma_.begin(), gamma_.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
    for (size_t q = 0; q < n; ++q) h[q] = all_.gap[u_[q]] / t_.near_gap, cost[q] = -gamma_[q] / largest;
    for (size_t r = 0; r < redundant_; ++r)
      for (size_t q = 0; q < n; ++q) rows[r * n + q] = v(q, r);
    const Eigen::VectorXd rhs = v.transpose() * h;
    x_ = solve_small_lp(cost, rows, std::vector<double>(rhs.data(), rhs.data() + rhs.size()));
    if (monitor_) {
      const auto pull = std::count_if(y_.begin(), y_.end(), [](double y) { return y < 0.0; });
      const double zero = n > redundant_ ? eigen.eigenvalues()[n - redundant_ - 1] : 0.0,
                   least = eigen.eigenvalues()[n - redundant_];
      monitor_->log(JAM_LOG_DEBUG, "exact vertex: %td pull, %zu undecided, %zu redundant, eigenvalues %.1e | %.1e, %s",
                    pull, n, redundant_, zero, least, x_.empty() ? "no vertex" : "vertex");
    }
    // With flexes the excess of contacts is not the number of redundant states: no vertex then.
    const bool rank = eigen.eigenvalues()[n - redundant_] > 1e-9;
    return rank && !x_.empty();
  }

  // The state of self-stress with nothing on the open ones: balanced_ plus states without pressure, (1 - P) of forces c
  // on the open ones.
  void forces() {
    std::vector<size_t> open;
    for (size_t q = 0; q < u_.size(); ++q)
      if (x_[q] > 0.0) open.push_back(q);
    const Eigen::Index n = static_cast<Eigen::Index>(open.size());
    Eigen::MatrixXd m(n, n);
    Eigen::VectorXd b(n);
    for (Eigen::Index r = 0; r < n; ++r) {
      b[r] = -balanced_[u_[open[r]]];
      for (Eigen::Index q = 0; q < n; ++q) m(r, q) = rest_(open[r], open[q]);
    }
    const Eigen::VectorXd c = m.ldlt().solve(b);
    std::fill(wanted_.begin(), wanted_.end(), 0.0);
    for (Eigen::Index q = 0; q < n; ++q) wanted_[u_[open[q]]] = c[q];
    rows_.towards(wanted_, got_);
    for (size_t k = 0; k < y_.size(); ++k) y_[k] = balanced_[k] + wanted_[k] - got_[k];
    for (const size_t k : u_)
      y_[k] = std::max(y_[k], 0.0);  // the small LP's own are exact zeros or more, but for rounding
  }

  // What of it stays: rows at zero, of spheres that they hold.
  bool finish(Vertex &out) {
    std::vector<char> on(all_.size(), 1);
    std::fill(wanted_.begin(), wanted_.end(), 0.0);
    for (size_t q = 0; q < u_.size(); ++q) {
      wanted_[u_[q]] = x_[q] * t_.near_gap - all_.gap[u_[q]];
      on[u_[q]] = !(x_[q] > 0.0);
    }
    out.step = rows_.towards(wanted_, got_);
    double sum = 0.0, mean = 0.0;
    out.open = 0.0;
    for (size_t k = 0; k < y_.size(); ++k) sum += y_[k], out.open += y_[k] * all_.gap[k];
    out.open /= sum;
    out.net = all_;
    for (size_t k = 0; k < y_.size(); ++k) out.net.force[k] = y_[k] / sigma_[k];
    drop_loose(all_.pairs, on, all_.coordination.size(), dim_);
    out.net = subset(out.net, on, dim_);
    for (const double f : out.net.force) mean += f / static_cast<double>(out.net.size());
    for (double &f : out.net.force) f /= mean;
    out.net.force_scale *= mean;
    return true;
  }

  const ContactNetwork &all_;
  const Tuning &t_;
  const int dim_;
  Monitor *monitor_;
  const std::vector<double> a_, pins_;
  GapRows rows_;
  const size_t redundant_;
  std::vector<double> sigma_;  // mean of the two diameters, in mean diameters
  std::vector<char> undecided_;
  std::vector<size_t> u_;  // the undecided, in the order of their coming
  std::vector<double> gamma_, x_, y_, balanced_, wanted_, got_;
  Eigen::MatrixXd rest_;  // 1 - G
};

}  // namespace

bool find_vertex(const Packing &p, const ContactNetwork &net, NewtonSystem &system, int threads, const Tuning &tuning,
                 Monitor *monitor, Vertex &out) {
  const ContactNetwork all = with_near_pairs(p, net, tuning.near_gap);
  const int64_t redundant = excess_contacts(all, p.dim);
  const bool undecided = redundant > 0 || (redundant == 0 && net.size() < all.size());
  if (all.size() == 0 || !undecided || redundant > static_cast<int64_t>(tuning.max_undecided)) return false;
  system.set_graph(p.dim, static_cast<int32_t>(p.n()), all.pairs, threads);
  return SmallLp(p, all, system, tuning, monitor).solve(out);
}

}  // namespace jam
