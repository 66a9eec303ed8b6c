// Times and errors of the analysis. usage: analysis [PACKING]   (a packing to crunch; default: the shared N = 1024
// file) JSON on stdout. Wall times are medians of `runs`; cpu is the process time of the same run, which other work on
// the machine does not stretch.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <numeric>
#include <vector>

#include "analysis/floppy.hpp"
#include "analysis/modes.hpp"
#include "analysis/spectrum.hpp"
#include "analysis/structure.hpp"
#include "capi/system.hpp"
#include "network/contacts_from_geometry.hpp"

using namespace jam::inside;

namespace {

struct Time {
  double wall, cpu;
};
double cpu_now() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
Time timed(int runs, const std::function<void()> &f) {
  std::vector<std::pair<double, double>> t;
  for (int k = 0; k < runs; ++k) {
    const double w = now_seconds(), c = cpu_now();
    f();
    t.push_back({now_seconds() - w, cpu_now() - c});
  }
  std::sort(t.begin(), t.end());
  return {t[t.size() / 2].first, t[t.size() / 2].second};
}
void show(const char *name, Time t, const char *tail = ",") {
  std::printf("  \"%s\": {\"wall\": %.4g, \"cpu\": %.4g}%s\n", name, t.wall, t.cpu, tail);
}
double peak_mb() {
  rusage u{};
  getrusage(RUSAGE_SELF, &u);
  return static_cast<double>(u.ru_maxrss) / 1024.0;
}

Modes modes_of(const RigidityMatrix &g, int32_t which, int64_t count, double tolerance) {
  jam_modes_options o = default_modes_options();
  o.which = which;
  o.count = count;
  o.tolerance = tolerance;
  Monitor monitor;
  Modes out;
  find_modes(g, contact_weights(g, 1.0, default_hessian_options()), o, monitor, out);
  return out;
}

// 2 x ... x 2 x 4 copies side by side: a larger network with the same contacts. Its box is no cube, so it is good for
// what runs on contacts alone.
void tile(const Packing &p, const ContactNetwork &net, Packing &q, ContactNetwork &out) {
  const int d = p.dim;
  q = p;
  q.position.clear();
  q.diameter.clear();
  std::vector<int> copies(d, 2);
  copies[d - 1] = 4;
  const int total = 2 << d;
  auto cell = [&](int c, int k) { return k == d - 1 ? c >> (d - 1) : (c >> k) & 1; };
  for (int c = 0; c < total; ++c)
    for (size_t i = 0; i < p.n(); ++i) {
      for (int k = 0; k < d; ++k) q.position.push_back(p.position[i * d + k] + cell(c, k) * p.cell.side());
      q.diameter.push_back(p.diameter[i]);
    }
  for (int c = 0; c < total; ++c)
    for (size_t e = 0; e < net.size(); ++e) {
      // r = x_i - x_j + offset: j stands offset / box cells before i's cell
      int to = 0;
      for (int k = 0; k < d; ++k) {
        const int m = cell(c, k) - static_cast<int>(std::lround(net.pairs.offset[e * d + k] / p.cell.side()));
        const int wrapped = (m % copies[k] + copies[k]) % copies[k];
        out.pairs.offset.push_back((wrapped - m) * p.cell.side());
        to += wrapped << k;
      }
      out.pairs.i.push_back(static_cast<int32_t>(c * p.n() + net.pairs.i[e]));
      out.pairs.j.push_back(static_cast<int32_t>(to * p.n() + net.pairs.j[e]));
      out.force.push_back(net.force[e]);
    }
}

// Largest difference between the cumulative spectra of the exact modes and of the kernel polynomial method.
double cumulative_error(const std::vector<double> &lambda, size_t translations, const DensityOfStates &dos) {
  double worst = 0.0;
  for (size_t k = 0; k < dos.omega.size(); ++k) {
    const double edge = dos.omega[k] + 0.5 * dos.step;
    const auto below = std::upper_bound(lambda.begin(), lambda.end(), edge * edge) - lambda.begin();
    worst =
        std::max(worst, std::fabs(dos.cumulative[k] - (static_cast<double>(below) - static_cast<double>(translations)) /
                                                          static_cast<double>(lambda.size() - translations)));
  }
  return worst;
}

double force_error(const std::vector<double> &f, const std::vector<double> &exact) {
  double mean = 0.0, worst = 0.0;
  for (double v : f) mean += v / static_cast<double>(f.size());
  for (size_t k = 0; k < f.size(); ++k) worst = std::max(worst, std::fabs(f[k] / mean - exact[k]));
  return worst;
}

// The multipliers of the last LP, not polished.
struct RawCrunch {
  std::vector<double> force;
  double seconds = 0.0;
};
RawCrunch crunch_without_polish(const char *file) {
  RawCrunch out;
  jam_system *sys = nullptr;
  jam_crunch_options o;
  jam_crunch_options_init(&o, sizeof o);
  o.polish = 0;
  if (jam_read(file, nullptr, nullptr, nullptr, &sys) != JAM_OK) return out;
  out.seconds = timed(1, [&] { jam_crunch(sys, &o, nullptr); }).cpu;
  out.force = sys->contacts.force;
  jam_destroy(sys);
  return out;
}

// Fields of 256 contacts in blocks of 64 and one by one, and the largest change of a contact length that should not be,
// over the largest displacement: S dr = e_l + gamma sigma.
void floppy_blocks(const Packing &p, const ContactNetwork &net, const RigidityMatrix &g) {
  const FloppySolver solver(p, net, g);
  const size_t m = std::min<size_t>(256, g.contacts()), n = g.unknowns();
  std::vector<double> dr, s(g.contacts());
  const Time one = timed(1, [&] {
    for (size_t l = 0; l < m; ++l) solver.fields(l, 1, dr);
  });
  const Time block = timed(3, [&] {
    for (size_t l = 0; l < m; l += 64) solver.fields(l, static_cast<int>(std::min<size_t>(64, m - l)), dr);
  });
  double worst = 0.0;
  for (size_t l = 0; l < m; ++l) {
    solver.fields(l, 1, dr);
    apply_compatibility(g, dr.data(), s.data());
    double size = 0.0;
    for (size_t q = 0; q < n; ++q) size = std::max(size, std::fabs(dr[q]));
    for (size_t k = 0; k < s.size(); ++k)
      worst = std::max(worst, std::fabs(s[k] - solver.inflation(l) * g.sigma[k] - (k == l)) / size);
  }
  std::printf(
      "  \"floppy_blocks\": {\"fields\": %zu, \"cpu\": %.4g, \"one_by_one\": %.4g, \"ratio\": %.3g, \"residual\": "
      "%.3g},\n",
      m, block.cpu, one.cpu, one.cpu / block.cpu, worst);
}

}  // namespace

int main(int argc, char **argv) {
  jam_system *sys = nullptr;
  const char *file = argc > 1 ? argv[1] : JAM_TEST_SHARED "/ls-n1024-d3.dat";
  if (jam_read(file, nullptr, nullptr, nullptr, &sys) != JAM_OK) {
    std::fprintf(stderr, "%s\n", jam_last_error());
    return 1;
  }
  jam_crunch_report report{};
  report.struct_size = sizeof report;
  const Time crunch = timed(1, [&] { jam_crunch(sys, nullptr, &report); });
  const std::unique_ptr<jam_system, void (*)(jam_system *)> owner(sys, jam_destroy);
  const Packing &p = sys->packing;
  const ContactNetwork &net = sys->contacts;
  const RigidityMatrix g = make_rigidity_matrix(p, net);
  std::printf("{\n  \"n\": %zu, \"dim\": %d, \"contacts\": %zu, \"excess\": %lld,\n", p.n(), p.dim, net.size(),
              static_cast<long long>(report.excess_contacts));
  show("crunch", crunch);
  auto geometry = [&] { contacts_from_geometry(p, default_geometry_options()); };
  auto gaps = [&] { find_gaps(p, &net, 1.0, true); };
  auto classes = [&] { classify_contacts(p, net); };
  auto structure = [&] {
    sphere_structure(p, net, false), sphere_structure(p, net, true), contact_dots(p, net, false);
  };
  show("contacts_and_forces", timed(7, geometry));
  show("gaps", timed(7, gaps));
  show("classes", timed(7, classes));
  show("structure", timed(7, structure));
  show("contacts_forces_gaps_classes_structure", timed(7, [&] { geometry(), gaps(), classes(), structure(); }));
  show("lowest_100", timed(3, [&] { modes_of(g, JAM_MODES_LOWEST, 100, 1e-10); }));
  show("floppy_all", timed(3, [&] {
         std::vector<size_t> every(g.contacts());
         std::iota(every.begin(), every.end(), size_t{0});
         floppy_modes(p, net, g, every, nullptr);
       }));
  floppy_blocks(p, net, g);
  Modes all;
  const Time dense = timed(1, [&] { all = modes_of(g, JAM_MODES_ALL, 1, 1e-10); });
  show("full_spectrum_with_vectors", dense);

  // ---- spectrum: error against time
  // Reference: another Krylov space, Rayleigh quotients summed over contacts (relative accuracy).
  const size_t t = static_cast<size_t>(g.dim), low = 20;
  const Modes exact = modes_of(g, JAM_MODES_LOWEST, 137, 1e-14);
  auto relative = [&](const std::vector<double> &l, size_t from) {
    double worst = 0.0;
    for (size_t k = 0; k < low && k + from < l.size(); ++k)
      worst = std::max(worst, std::fabs(l[k + from] / exact.lambda[k] - 1.0));
    return worst;
  };
  std::printf("  \"spectrum\": [\n    {\"method\": \"dense\", \"seconds\": %.4g, \"error\": %.3g}", dense.cpu,
              relative(all.lambda, t));
  for (int count :
       {20, 50, 100, 200, 400}) {  // a looser tolerance saves nothing: the first restart converges to rounding
    Modes m;
    const Time s = timed(3, [&] { m = modes_of(g, JAM_MODES_LOWEST, count, 1e-10); });
    std::printf(",\n    {\"method\": \"lanczos\", \"count\": %d, \"seconds\": %.4g, \"error\": %.3g}", count, s.cpu,
                relative(m.lambda, 0));
  }
  const ContactWeights weights = contact_weights(g, 1.0, default_hessian_options());
  const std::pair<int, int> kernels[] = {{64, 4},   {64, 16},  {64, 64},   {256, 4},  {256, 16},
                                         {256, 64}, {1024, 4}, {1024, 16}, {1024, 64}};
  for (const auto &[moments, vectors] : kernels) {
    jam_dos_options o = default_dos_options();
    o.moments = moments;
    o.vectors = vectors;
    o.points = 1024;
    DensityOfStates dos;
    const Time s = timed(1, [&] { dos = density_of_states(g, weights, o); });
    std::printf(
        ",\n    {\"method\": \"kernel polynomial\", \"moments\": %d, \"vectors\": %d, \"seconds\": %.4g, "
        "\"cumulative_error\": %.3g}",
        moments, vectors, s.cpu, cumulative_error(all.lambda, t, dos));
  }

  // ---- forces: error against time, relative to the mean force
  std::vector<double> reference(net.size());  // from a random vector: another path to the same line
  for (size_t k = 0; k < reference.size(); ++k) reference[k] = 1.0 + std::sin(1.0 + static_cast<double>(k * k));
  const NullSpace space(g);
  space.project(reference, 12);
  double mean = 0.0;
  for (double v : reference) mean += v / static_cast<double>(reference.size());
  for (double &v : reference) v /= mean;
  std::printf(
      "\n  ],\n  \"forces\": [\n    {\"method\": \"multipliers\", \"seconds\": %.4g, \"error\": %.3g, \"residual\": "
      "%.3g}",
      crunch.cpu, force_error(net.force, reference), balance_residual(g, net.force.data()));
  const RawCrunch raw = crunch_without_polish(file);
  if (raw.force.size() == reference.size())
    std::printf(
        ",\n    {\"method\": \"multipliers, no polish\", \"seconds\": %.4g, \"error\": %.3g, \"residual\": %.3g}",
        raw.seconds, force_error(raw.force, reference), balance_residual(g, raw.force.data()));
  for (int refinements : {0, 1, 2}) {
    std::vector<double> f;
    const Time s = timed(3, [&] {
      const NullSpace again(g);
      f.assign(net.size(), 1.0);
      again.project(f, refinements);
    });
    std::printf(
        ",\n    {\"method\": \"null vector\", \"refinements\": %d, \"seconds\": %.4g, \"error\": %.3g, \"residual\": "
        "%.3g}",
        refinements, s.cpu, force_error(f, reference), balance_residual(g, f.data()));
  }
  std::printf("\n  ],\n");

  // ---- a larger network: copies of this one (its spectrum is the folded one; cost and memory are those of any
  // network)
  Packing big;
  ContactNetwork many;
  tile(p, net, big, many);
  const RigidityMatrix wide = make_rigidity_matrix(big, many);
  std::printf("  \"tiled_n\": %zu,\n", big.n());
  show("tiled_lowest_100", timed(1, [&] { modes_of(wide, JAM_MODES_LOWEST, 100, 1e-10); }));
  show("tiled_forces", timed(1, [&] {
         const NullSpace s(wide);
         std::vector<double> f(wide.contacts(), 1.0);
         s.project(f);
       }));
  std::printf("  \"peak_mb\": %.0f\n}\n", peak_mb());
  return 0;
}
