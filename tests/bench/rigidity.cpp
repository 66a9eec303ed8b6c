// Cost and answer of the rigidity test against the number of spheres. usage: rigidity [PACKING ...]   FCC crystals by
// default; crunched packings from files. JSON on stdout; cpu is the median processor time of `runs`.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "core/create.hpp"
#include "io/files.hpp"
#include "verdict/verdict.hpp"

using namespace jam::inside;

namespace {

double cpu_now() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Packing fcc(int cells) {
  const double site[4][3] = {{0, 0, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}};
  Packing p;
  p.set_cube(p.dim, cells * std::sqrt(2.0));
  for (int x = 0; x < cells; ++x)
    for (int y = 0; y < cells; ++y)
      for (int z = 0; z < cells; ++z)
        for (const auto &s : site)
          p.position.insert(p.position.end(),
                            {(x + s[0]) * std::sqrt(2.0), (y + s[1]) * std::sqrt(2.0), (z + s[2]) * std::sqrt(2.0)});
  p.diameter.assign(p.position.size() / 3, 1.0);
  return p;
}

// Crystalline packings have many states of self-stress; the test takes another way there.
const char *family(const Packing &p, const RigidityResult &r) {
  return r.self_stresses > static_cast<int64_t>(p.n()) / 20 + 3 ? "crystalline" : "amorphous";
}

bool first = true;
void measure(const std::string &name, const Packing &p, Jamming kind) {
  const int runs = p.n() > 3000 ? 1 : 3;
  std::vector<double> t;
  PackingVerdict v;
  for (int k = 0; k < runs; ++k) {
    const double began = cpu_now();
    v = test_packing(p, nullptr, kind);
    t.push_back(cpu_now() - began);
  }
  std::sort(t.begin(), t.end());
  const char *verdict[] = {"no", "yes", "undecided"};
  const RigidityResult &r = v.result;
  std::printf(
      "%s{\"name\": \"%s\", \"family\": \"%s\", \"kind\": \"%s\", \"dim\": %d, \"n\": %zu, \"cpu\": %.4g, \"jammed\": "
      "\"%s\", "
      "\"contacts\": %lld, \"excess\": %lld, \"zero_force\": %lld, \"undecided\": %lld, \"flexes\": %lld, "
      "\"undercoordinated\": %lld, \"margin\": %.4g, \"residual\": %.2g, \"spheres\": %lld}",
      first ? "[" : ",\n ", name.c_str(), family(p, r), kind == Jamming::strict ? "strict" : "collective", p.dim, p.n(),
      t[t.size() / 2], verdict[static_cast<int>(v.jammed)], static_cast<long long>(r.contacts),
      static_cast<long long>(r.contacts - r.contacts_needed), static_cast<long long>(r.zero_force_contacts),
      static_cast<long long>(v.undecided_contacts), static_cast<long long>(r.flexes),
      static_cast<long long>(r.undercoordinated), r.margin, r.force_residual, static_cast<long long>(r.spheres));
  std::fflush(stdout);
  first = false;
}

}  // namespace

int main(int argc, char **argv) {
  for (int k = 1; k < argc; ++k) {
    const std::string path = argv[k];
    jam_create_options o = default_create_options();
    const FileContent file = read_file(argv[k]);
    o.dim = file.dim, o.n = static_cast<int64_t>(file.position.size()) / file.dim;
    if (file.box > 0.0) o.box = file.box;
    const Packing p =
        make_packing(o, file.position.data(), file.position.size(), file.diameter.data(), file.diameter.size());
    const size_t slash = path.rfind('/');
    for (const Jamming kind : {Jamming::collective, Jamming::strict})
      measure(slash == std::string::npos ? path : path.substr(slash + 1), p, kind);
  }
  for (const int cells : {3, 4, 6, 8, 11, 14}) {
    if (argc > 1) break;
    for (const Jamming kind : {Jamming::collective, Jamming::strict}) measure("fcc", fcc(cells), kind);
  }
  std::printf("]\n");
  return 0;
}
