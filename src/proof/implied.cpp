#include "proof/newton.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "core/call_scope.hpp"
#include "proof/tuning.hpp"

namespace jam::inside {
namespace {

// An exact angle: multiples of 60 degrees and of unknown angles, each by its number.
struct Angle {
  int sixths = 0;
  std::map<int, int> unknown{};
  void add(const Angle &other, int sign) {
    sixths = ((sixths + sign * other.sixths) % 6 + 6) % 6;
    for (const auto &[name, times] : other.unknown)
      if ((unknown[name] += sign * times) == 0) unknown.erase(name);
  }
};

// Lengths of contacts by number, and the angles of triangles with such sides.
class Lengths {
 public:
  explicit Lengths(const ProofScene &s) {
    std::map<std::tuple<double, double, bool>, int> seen;
    for (size_t c = 0; c < s.contacts(); ++c) {
      const double p = s.ratio[s.sphere[s.a[c]]], q = s.wall(c) ? p : s.ratio[s.partner(c)];
      const DoubleDouble sum = two_sum(p, q);  // two equal sums have equal parts
      const auto key = std::make_tuple(sum.high, sum.low, s.non_additivity != 0.0 && p != q);
      of.push_back(seen.emplace(key, static_cast<int>(seen.size())).first->second);
    }
  }
  // Opposite to a side, between two others, where two of the three are equal. The angles at a base have one name.
  Angle between(int opposite, int left, int right) {
    if (left == right && opposite == left) return {1};
    if (left == right) return {3, {{name(left, opposite), -2}}};
    return {0, {{name(opposite, opposite == left ? right : left), 1}}};
  }
  std::vector<int> of;

 private:
  int name(int leg, int base) {
    return names_.emplace(std::make_pair(leg, base), static_cast<int>(names_.size())).first->second;
  }
  std::map<std::pair<int, int>, int> names_;
};

// A side of a tile: a contact walked from one of its spheres.
struct Side {
  int32_t contact, from, to;
  std::array<int32_t, 2> image;
  std::array<double, 2> r;  // from `from` to `to`
};

double cross(const Side &p, const Side &q) { return p.r[0] * q.r[1] - p.r[1] * q.r[0]; }

// A closed walk of three or four contacts. Of four: a parallelogram.
struct Tile {
  std::vector<Side> side;
};

class Tiles {
 public:
  Tiles(const ProofScene &s, const Lengths &lengths) : lengths_(lengths), around_(s.nodes()), of(s.contacts()) {
    for (size_t c = 0; c < s.contacts(); ++c) {
      if (s.wall(c)) continue;
      Side out{static_cast<int32_t>(c), s.b[c], s.a[c], {s.image[2 * c], s.image[2 * c + 1]}, {}};
      for (int k = 0; k < 2; ++k) out.r[k] = s.component(c, k).value();
      const Side back{out.contact, out.to, out.from, {-out.image[0], -out.image[1]}, {-out.r[0], -out.r[1]}};
      around_[out.from].push_back(out), around_[back.from].push_back(back);
    }
    for (size_t u = 0; u < around_.size(); ++u) collect(static_cast<int32_t>(u));
  }
  std::vector<Tile> all;

 private:
  // Walks u -> v -> w by the place where they end; two of them, or one and a contact, close a tile.
  void collect(int32_t u) {
    std::map<std::array<int32_t, 3>, std::vector<std::pair<Side, Side>>> walks;
    for (const Side &p : around_[u])
      for (const Side &q : around_[p.to])
        if (q.contact != p.contact) walks[{q.to, p.image[0] + q.image[0], p.image[1] + q.image[1]}].push_back({p, q});
    for (const auto &[end, list] : walks) {
      for (const Side &p : around_[u])
        if (p.to == end[0] && p.image[0] == end[1] && p.image[1] == end[2] && u < p.to)
          for (const auto &walk : list)
            if (u < walk.first.to && walk.first.to < p.to) keep({{walk.first, walk.second, reversed(p)}});
      if (u >= end[0]) continue;
      for (size_t k = 0; k < list.size(); ++k)
        for (size_t m = 0; m < k; ++m)
          keep({{list[m].first, list[m].second, reversed(list[k].second), reversed(list[k].first)}});
    }
  }
  static Side reversed(const Side &p) {
    return {p.contact, p.to, p.from, {-p.image[0], -p.image[1]}, {-p.r[0], -p.r[1]}};
  }
  void keep(const Tile &tile) {
    const auto &side = tile.side;
    const int turn = cross(side[0], side[1]) > 0.0 ? 1 : -1;
    for (size_t k = 0; k < side.size(); ++k) {
      const Side &p = side[k], &q = side[(k + 1) % side.size()];
      const double most = std::sqrt((p.r[0] * p.r[0] + p.r[1] * p.r[1]) * (q.r[0] * q.r[0] + q.r[1] * q.r[1]));
      if (!(turn * cross(p, q) > proof_tuning::far_above * most)) return;
    }
    const auto length = [&](size_t k) { return lengths_.of[side[k].contact]; };
    const bool scalene = length(0) != length(1) && length(1) != length(2) && length(2) != length(0);
    if (side.size() == 4 ? length(0) != length(2) || length(1) != length(3) : scalene) return;
    for (const Side &p : side) of[p.contact].push_back(static_cast<int32_t>(all.size()));
    all.push_back(tile);
  }
  const Lengths &lengths_;
  std::vector<std::vector<Side>> around_;

 public:
  std::vector<std::vector<int32_t>> of;  // contact -> tiles
};

// Directions of contacts that exact angles relate: a forest of contacts, each with its angle to its root.
class Directions {
 public:
  explicit Directions(size_t contacts) : node_(contacts) {}
  void clear() {
    for (const int32_t c : related_) node_[c] = Node();
    related_.clear();
  }
  // q = p + angle, both as they are walked.
  void relate(const Side &p, const Side &q, const ProofScene &s, Angle angle) {
    angle.sixths += 3 * (backwards(p, s) + backwards(q, s));  // now of the contacts from b to a
    const int32_t a = root(p.contact), b = root(q.contact);
    if (a == b) return;
    angle.add(node_[p.contact].angle, 1), angle.add(node_[q.contact].angle, -1);
    node_[b] = {a, angle};
  }
  // The direction of a side: root and angle to it.
  std::pair<int32_t, Angle> of(const Side &p, const ProofScene &s) {
    const int32_t at = root(p.contact);
    Angle angle = node_[p.contact].angle;
    angle.add({3 * backwards(p, s)}, 1);
    return {at, angle};
  }

 private:
  struct Node {
    int32_t up = -1;  // none: related to no other
    Angle angle;
  };
  static int backwards(const Side &p, const ProofScene &s) { return p.from == s.a[p.contact]; }
  int32_t root(int32_t c) {
    if (node_[c].up < 0) node_[c].up = c, related_.push_back(c);
    if (node_[c].up == c) return c;
    const int32_t up = node_[c].up, top = root(up);
    if (top != up) node_[c].angle.add(node_[up].angle, 1), node_[c].up = top;
    return top;
  }
  std::vector<Node> node_;
  std::vector<int32_t> related_;
};

class Search {
 public:
  explicit Search(const ProofScene &s)
      : s_(s),
        lengths_(s),
        tiles_(s, lengths_),
        dropped_(s.contacts(), false),
        directions_(s.contacts()),
        seen_(tiles_.all.size(), -1) {}

  std::vector<ImpliedContact> run(size_t excess) {
    std::vector<ImpliedContact> out;
    for (size_t c = 0; c < s_.contacts() && out.size() < excess; ++c) {
      CallScope::look();
      if (tiles_.of[c].empty()) continue;
      const auto contact = static_cast<int32_t>(c);
      relate_without(contact);
      std::vector<int32_t> path;
      for (const int32_t t : tiles_.of[c]) {
        path.clear();
        if (!follows(tiles_.all[t], contact, path)) continue;
        dropped_[c] = true;
        out.push_back({contact, path, walks()});
        break;
      }
    }
    if (out.size() < excess) out.clear();
    std::reverse(out.begin(), out.end());  // the last one dropped follows from kept contacts alone
    return out;
  }

 private:
  // What the kept tiles near a contact relate that do not have it: directions, and the tiles in their order.
  void relate_without(int32_t contact) {
    directions_.clear(), used_.clear();
    std::vector<int32_t> shell(tiles_.of[contact]), next;
    for (const int32_t t : shell) seen_[t] = contact;
    for (int step = 0; step <= proof_tuning::patch && !shell.empty(); ++step) {
      next.clear();
      for (const int32_t t : shell) {
        if (use(tiles_.all[t], contact)) used_.push_back(t);
        for (const Side &p : tiles_.all[t].side)
          for (const int32_t other : tiles_.of[p.contact])
            if (seen_[other] != contact) seen_[other] = contact, next.push_back(other);
      }
      shell.swap(next);
    }
  }
  std::vector<std::vector<int32_t>> walks() const {
    std::vector<std::vector<int32_t>> out;
    for (const int32_t t : used_) {
      out.emplace_back();
      for (const Side &p : tiles_.all[t].side) out.back().push_back(p.contact);
    }
    return out;
  }
  bool use(const Tile &tile, int32_t contact) {
    const auto &side = tile.side;
    for (const Side &p : side)
      if (p.contact == contact || dropped_[p.contact]) return false;
    if (side.size() == 4) {
      directions_.relate(side[0], side[2], s_, {3}), directions_.relate(side[1], side[3], s_, {3});
      return true;
    }
    // Walked round, a triangle turns by 180 degrees less its angle at each corner.
    const int turn = cross(side[0], side[1]) > 0.0 ? 1 : -1;
    for (int k = 0; k < 2; ++k) {
      const auto length = [&](int m) { return lengths_.of[side[(k + m) % 3].contact]; };
      Angle outer;
      outer.add({3}, turn), outer.add(lengths_.between(length(2), length(0), length(1)), -turn);
      directions_.relate(side[k], side[k + 1], s_, outer);
    }
    return true;
  }
  // Whether the other sides of the tile sum to one vector as long as the contact. In Z[e^(i pi / 3)] times roots,
  // unknown angles and lengths, sums that cancel are zero.
  bool follows(const Tile &tile, int32_t contact, std::vector<int32_t> &path) {
    static constexpr int unit[6][2] = {{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}};
    std::map<std::tuple<int32_t, std::map<int, int>, int>, std::array<int, 2>> sum;
    const size_t count = tile.side.size();
    size_t start = 0;
    while (tile.side[start].contact != contact) ++start;
    for (size_t k = 1; k < count; ++k) {
      const Side &p = tile.side[(start + k) % count];
      if (dropped_[p.contact]) return false;
      const auto [root, angle] = directions_.of(p, s_);
      auto &at = sum[{root, angle.unknown, lengths_.of[p.contact]}];
      for (int q = 0; q < 2; ++q) at[q] += unit[angle.sixths][q];
      path.push_back(p.contact);
    }
    int left = 0, length = -1;
    for (const auto &[key, value] : sum) {
      if (value == std::array<int, 2>{0, 0}) continue;
      ++left;
      for (const auto &u : unit)
        if (value[0] == u[0] && value[1] == u[1]) length = std::get<2>(key);
    }
    return left == 1 && length == lengths_.of[contact];
  }
  const ProofScene &s_;
  Lengths lengths_;
  Tiles tiles_;
  std::vector<bool> dropped_;
  Directions directions_;
  std::vector<int32_t> seen_, used_;  // tile -> the last contact that met it; tiles that gave the directions
};

}  // namespace

std::vector<ImpliedContact> find_implied(const ProofScene &s) {
  const size_t needed = s.nodes() > 0 ? static_cast<size_t>(s.needed()) : 0;
  if (s.dim != 2 || s.strict || s.own_images || s.contacts() <= needed) return {};
  return Search(s).run(s.contacts() - needed);
}

}  // namespace jam::inside
