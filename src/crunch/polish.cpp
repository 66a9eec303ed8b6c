// The last digits: contacts closed and forces balanced to rounding.
#include <algorithm>
#include <cmath>

#include "crunch/crossover.hpp"
#include "crunch/crunch.hpp"
#include "crunch/gap_rows.hpp"
#include "network/contact_network.hpp"

namespace jam {
namespace {

// A tiny diagonal fixes the translations (and the rattlers, which no row holds); what it costs in accuracy the
// repeated steps win back.
std::vector<double> small_diagonal(const Packing &p, const ContactNetwork &net) {
  std::vector<double> diagonal(p.position.size(), 1e-12);
  for (size_t i = 0; i < p.n(); ++i)
    for (int c = 0; c < p.dim && net.coordination[i] == 0; ++c) diagonal[i * p.dim + c] = 1.0;
  return diagonal;
}

// A pair that stays wider than this, relative, when all contacts are closed together is none.
constexpr double closed = 1e-8;
// Gaps above this are more than what rounding leaves of closed contacts.
constexpr double rounding = 3e-14;
// Vertices tried before a network is given up.
constexpr int most_vertices = 4;

double largest(const std::vector<double> &x) {
  double m = 0.0;
  for (double v : x) m = std::max(m, std::fabs(v));
  return m;
}

double norm(const std::vector<double> &x) {
  double sum = 0.0;
  for (double v : x) sum += v * v;
  return std::sqrt(sum);
}

// One Gauss-Newton step of all gaps to zero over positions and the common factor of the diameters. On a network with a
// single state of self-stress the system is square and the step is Newton's; with more contacts it is least squares.
void close_contacts(Packing &p, ContactNetwork &net, NewtonSystem &system, const std::vector<double> &diagonal) {
  const std::vector<double> a = relative_rows(p, net);
  GapRows rows(net.pairs, p.dim, a, diagonal, system);
  if (!rows.factorise()) return;
  std::vector<double> wanted(net.gap), got;
  for (double &h : wanted) h = -h;
  move(p, net.pairs, rows.towards(wanted, got));
  measure_contacts(p, net);
}

// The nearest forces that balance on every sphere, in units of their mean.
void balance_forces(const Packing &p, ContactNetwork &net, NewtonSystem &system, const std::vector<double> &diagonal) {
  GapRows rows(net.pairs, p.dim, net.vector, diagonal, system);
  if (!rows.factorise()) return;
  rows.balance(net.force);
  double mean = 0.0;
  for (double f : net.force) mean += std::fabs(f) / static_cast<double>(net.size());  // a sign that is wrong must show
  for (double &f : net.force) f /= mean;
  net.force_scale *= mean;
}

bool pushes_only(const ContactNetwork &net) {
  return std::all_of(net.force.begin(), net.force.end(), [](double f) { return f > 0.0; });
}

// More contacts than one state of self-stress needs: the forces are not unique. Those of least norm at the same mean
// are the projection of equal forces; false, and nothing changed, if one of them pulls (the LP's forces then have to
// do).
bool least_forces(const Packing &p, ContactNetwork &net, NewtonSystem &system, const std::vector<double> &diagonal) {
  if (excess_contacts(net, p.dim) <= 0) return false;
  ContactNetwork least = net;
  std::fill(least.force.begin(), least.force.end(), 1.0);
  balance_forces(p, least, system, diagonal);
  if (!pushes_only(least)) return false;
  least.force_scale = net.force_scale;
  net = std::move(least);
  return true;
}

// False where a sphere would be left with too few contacts.
bool drop(ContactNetwork &net, size_t k, int dim) {
  int32_t &zi = net.coordination[net.pairs.i[k]], &zj = net.coordination[net.pairs.j[k]];
  if (zi <= dim + 1 || zj <= dim + 1) return false;
  --zi, --zj;
  const auto erase = [k](auto &v, size_t width) { v.erase(v.begin() + k * width, v.begin() + (k + 1) * width); };
  erase(net.pairs.i, 1), erase(net.pairs.j, 1), erase(net.pairs.offset, dim);
  erase(net.vector, dim), erase(net.gap, 1), erase(net.force, 1);
  return true;
}

// What least squares leave of the gaps is orthogonal to every change of the packing: itself a state of self-stress g,
// without pressure. Of the forces f - t g the first to vanish, as t grows, is of the contact that opens when the others
// close: a pivot of the dual simplex. False where all are closed, and where that contact's spheres have none to spare.
bool drop_open_contact(ContactNetwork &net, int dim) {
  if (excess_contacts(net, dim) <= 0 || !(largest(net.gap) > rounding)) return false;
  size_t first = net.size();
  for (size_t k = 0; k < net.size(); ++k)
    if (net.gap[k] > 0.0 && (first == net.size() || net.force[k] * net.gap[first] < net.force[first] * net.gap[k]))
      first = k;
  return first < net.size() && drop(net, first, dim);
}

// Closes all contacts as far as they go: on a network with one state of self-stress to rounding, else in least squares.
// False when interrupted.
bool close_all(Packing &p, ContactNetwork &net, NewtonSystem &system, int threads, Monitor *monitor) {
  system.set_graph(p.dim, static_cast<int32_t>(p.n()), net.pairs, threads);
  const std::vector<double> diagonal = small_diagonal(p, net);
  const auto open = [&] { return excess_contacts(net, p.dim) > 0 ? norm(net.gap) : largest(net.gap); };
  double worst = open();
  for (int round = 0; round < 4 && worst > 1e-16; ++round) {
    if (monitor) monitor->log(JAM_LOG_DEBUG, "polish %d largest gap %.2e", round, largest(net.gap));
    if (monitor && monitor->interrupted()) return false;
    Packing p_old = p;
    ContactNetwork old = net;
    close_contacts(p, net, system, diagonal);
    const double now = open();
    if (!(now < 0.5 * worst)) {  // no gain: rounding rules, or the contacts cannot all close
      if (!(now < worst)) p = std::move(p_old), net = std::move(old);
      break;
    }
    worst = now;
  }
  return !(monitor && monitor->interrupted());
}

PolishEnd close_and_balance(Packing &p, ContactNetwork &net, NewtonSystem &system, int threads, double allowed,
                            Monitor *monitor) {
  do {
    if (!close_all(p, net, system, threads, monitor)) return PolishEnd::interrupted;
    if (!(largest(net.gap) < closed)) return PolishEnd::open_contact;
  } while (drop_open_contact(net, p.dim));
  if (excess_contacts(net, p.dim) < 0) return PolishEnd::too_few;
  const std::vector<double> diagonal = small_diagonal(p, net);
  if (!least_forces(p, net, system, diagonal)) balance_forces(p, net, system, diagonal);
  if (monitor && !pushes_only(net))
    monitor->log(JAM_LOG_DEBUG, "polish: %td of %zu contacts pull, the strongest with %.1e",
                 std::count_if(net.force.begin(), net.force.end(), [](double f) { return !(f > 0.0); }), net.size(),
                 -*std::min_element(net.force.begin(), net.force.end()));
  if (!pushes_only(net)) return PolishEnd::negative_force;
  return closest_pair(p).gap < allowed ? PolishEnd::overlap : PolishEnd::done;
}

// From closed contacts of which some pull, or one is missing, to a vertex. Closing that may make others pull again,
// where vertices lie so near each other that a step between them changes the weakest forces: what no double can tell
// apart ends as it is, with its weakest contacts open, if their weighted gap is below rounding.
PolishEnd at_vertex(Packing &p, ContactNetwork &net, NewtonSystem &system, int threads, double allowed,
                    Monitor *monitor, PolishEnd end) {
  for (int k = 0; k < most_vertices; ++k) {
    Vertex vertex;
    if (!find_vertex(p, net, system, threads, monitor, vertex))
      return monitor && monitor->interrupted() ? PolishEnd::interrupted : end;
    Packing moved = p;
    ContactNetwork others = vertex.net;
    move(moved, others.pairs, vertex.step);
    measure_contacts(moved, others);
    end = close_and_balance(moved, others, system, threads, allowed, monitor);
    const bool exact = end == PolishEnd::done,
               enough = vertex.open < rounding && pushes_only(vertex.net) && closest_pair(p).gap >= allowed;
    if (monitor)
      monitor->log(JAM_LOG_DEBUG, "vertex: %zu contacts, weighted gap %.1e, step %.1e, %s", vertex.net.size(),
                   vertex.open, largest(vertex.step.s), exact ? "closed" : "open");
    if (end == PolishEnd::interrupted) return end;
    if (!exact && enough) {
      net = std::move(vertex.net);
      system.set_graph(p.dim, static_cast<int32_t>(p.n()), net.pairs, threads);
      balance_forces(p, net, system, small_diagonal(p, net));
      return pushes_only(net) ? PolishEnd::done : PolishEnd::negative_force;
    }
    p = std::move(moved), net = std::move(others);
    if (exact) return end;
  }
  return end;
}

}  // namespace

bool drop_idle_contact(ContactNetwork &net, int dim) {
  constexpr double idle = 1e-5;
  if (net.size() == 0 || excess_contacts(net, dim) <= 0) return false;
  const size_t k = std::min_element(net.force.begin(), net.force.end()) - net.force.begin();
  return net.force[k] <= idle && drop(net, k, dim);
}

PolishEnd polish(Packing &p, ContactNetwork &net, NewtonSystem &system, int threads, Monitor *monitor) {
  if (net.size() == 0) return PolishEnd::no_contacts;
  const double allowed = std::min(-1e-14, closest_pair(p).gap);
  Packing q = p;
  ContactNetwork better = net;
  PolishEnd end = close_and_balance(q, better, system, threads, allowed, monitor);
  if (end == PolishEnd::too_few || end == PolishEnd::negative_force || end == PolishEnd::overlap) {
    better = net;  // the LP's forces: where a contact is wrong so are all forces
    end = at_vertex(q, better, system, threads, allowed, monitor, end);
  }
  if (end != PolishEnd::done) return end;
  if (monitor && largest(better.gap) > rounding)
    monitor->log(JAM_LOG_WARNING, "polish: %zu contacts cannot all close, gaps of %.1e stay", better.size(),
                 largest(better.gap));
  p = std::move(q);
  net = std::move(better);
  return PolishEnd::done;
}

}  // namespace jam
