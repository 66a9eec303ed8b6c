// The proof file: exact numbers that a checker of its own can read (bindings/proof/jamproof.py).
#include <cmath>

#include "io/files.hpp"
#include "io/output_file.hpp"
#include "proof/scene.hpp"

namespace jam::inside {
namespace {

// x = m 2^e with whole m, as "m p e" without blanks: exact, and the same in every locale.
void put(std::string &out, double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  (out += std::to_string(static_cast<long long>(std::ldexp(mantissa, 53)))) += 'p';
  out += std::to_string(exponent - 53);
}

// A sum of two doubles: both, with a comma.
void put(std::string &out, double high, double low) {
  put(out, high);
  if (low == 0.0) return;
  out += ',';
  put(out, low);
}

void put_list(std::string &out, const std::vector<int32_t> &list) {
  for (const int32_t x : list) (out += ' ') += std::to_string(x);
  out += '\n';
}

}  // namespace

void write_proof(const ProofScene &s, const char *path) {
  OutputFile file(path);
  std::string &out = file.text();
  const size_t d = static_cast<size_t>(s.dim);
  out += s.strict ? "jamproof 1\nstrict\ndim " : "jamproof 1\ndim ";
  out += std::to_string(s.dim) + "\nunit ";
  put(out, s.unit);
  out += "\ncell";
  for (size_t r = 0; r < d; ++r)
    for (size_t c = 0; c <= r; ++c) put(out += ' ', s.cell.row(static_cast<int>(r))[c], s.cell_low[r * d + c]);
  put(out += "\nnon_additivity ", s.non_additivity);
  put(out += s.rooted() ? "\ngrowth " : "\ngamma ", s.growth, s.growth_low);
  out += '\n';
  if (s.container.flat()) out += "walls";
  for (int c = 0; c < s.dim; ++c)
    if (s.container.flat() >> c & 1) out += ' ' + std::to_string(c);
  if (s.container.flat()) out += '\n';
  if (s.rooted()) out += "round " + std::to_string(s.container.round_axes()) + '\n';
  for (size_t k = 0; k < s.pin.size(); ++k)
    if (s.pin[k]) out += "pin " + std::to_string(k / d) + ' ' + std::to_string(k % d) + '\n';
  for (size_t i = 0; i < s.ratio.size(); ++i) {
    out += s.node[i] >= 0 ? "sphere 1 " : "sphere 0 ";
    put(out, s.ratio[i]);
    for (size_t c = 0; c < d; ++c) put(out += ' ', s.high[i * d + c], s.low[i * d + c]);
    out += '\n';
    file.flush_if_full();
  }
  std::vector<bool> implied(s.contacts(), false);
  for (const ImpliedContact &c : s.implied) implied[c.contact] = true;
  size_t row = 0;  // of the contacts that are not implied
  for (size_t k = 0; k < s.contacts(); ++k) {
    const std::string from = std::to_string(s.sphere[s.a[k]]) + ' ';
    if (s.wall(k)) {
      const Surface &plane = s.container[wall_partner(s.b[k])];
      out += "wall " + from + std::to_string(plane.axis()) + ' ' + std::to_string(plane.side());
    } else {
      out += "contact " + from + std::to_string(s.partner(k));
      for (size_t c = 0; c < d; ++c) out += ' ' + std::to_string(s.image[k * d + c]);
    }
    put(out += ' ', s.force[k]);
    if (!s.row.empty()) put(out += ' ', implied[k] ? 0.0 : s.row[row++]);
    out += '\n';
    file.flush_if_full();
  }
  if (!s.row.empty())
    for (const ImpliedContact &c : s.implied) {
      for (const std::vector<int32_t> &tile : c.tiles) put_list(out += "tile", tile);
      put_list(out += "implied " + std::to_string(c.contact), c.path);
    }
  file.commit();
}

}  // namespace jam::inside
