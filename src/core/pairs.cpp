#include "core/pairs.hpp"

#include <utility>

namespace jam::inside {

PairList replace_pairs(const PairList &list, const std::vector<char> &some, const PairList &theirs) {
  PairList out;
  size_t at = 0;
  const auto key = [](const PairList &pairs, size_t k) { return std::make_pair(pairs.i[k], pairs.j[k]); };
  for (size_t k = 0; k < list.size(); ++k) {
    if (some[list.i[k]] || (!list.wall(k) && some[list.j[k]])) continue;
    for (; at < theirs.size() && key(theirs, at) < key(list, k); ++at) out.append(theirs, at);
    out.append(list, k);
  }
  for (; at < theirs.size(); ++at) out.append(theirs, at);
  return out;
}

std::vector<double> carry_over(const PairList &from, const std::vector<double> &values, const PairList &to) {
  std::vector<double> out(to.size(), 0.0);
  size_t at = 0;
  for (size_t k = 0; k < to.size(); ++k) {
    const auto key = std::make_pair(to.i[k], to.j[k]);
    while (at < from.size() && std::make_pair(from.i[at], from.j[at]) < key) ++at;
    if (at < from.size() && std::make_pair(from.i[at], from.j[at]) == key) out[k] = values[at++];
  }
  return out;
}

void wrap_positions(Packing &p, PairList &pairs) {
  const size_t d = p.dim;
  std::vector<double> shift(p.position.size());
  for (size_t i = 0; i < p.n(); ++i) p.cell.wrap(&p.position[i * d], &shift[i * d]);
  for (size_t k = 0; k < pairs.size(); ++k)
    for (size_t c = 0; c < d && !pairs.wall(k); ++c)
      pairs.offset[k * d + c] += shift[pairs.i[k] * d + c] - shift[pairs.j[k] * d + c];
}

}  // namespace jam::inside
