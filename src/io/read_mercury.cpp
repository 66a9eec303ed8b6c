// Data files of MercuryDPM, one frame or several: "N time xmin ymin zmin xmax ymax zmax", then a row of 14 numbers for
// each particle, "x y z vx vy vz radius" and what is not read here; in d = 2 without z, with rows of 8 numbers
// (docs.mercurydpm.org, Output Files).
#include "io/read_helpers.hpp"

namespace jam::inside {
namespace {

// A frame; false at the end of the file. d is 0 before the first one.
bool read_mercury_frame(LineReader &in, const Enclosure &given, size_t &d, FileContent &content) {
  std::string_view line;
  std::vector<std::string_view> words;
  if (!in.next_filled(line)) return false;
  split(line, words);
  if (d == 0) d = words.size() / 2 - 1;
  if (words.size() != 2 + 2 * d)
    in.fail(JAM_E_FORMAT, "'%s' where a frame begins: N time %s are needed", shown(line).c_str(),
            d == 2 ? "xmin ymin xmax ymax" : "xmin ymin zmin xmax ymax zmax");
  const size_t row_words = d == 2 ? 8 : 14, radius_at = 2 * d;
  const int64_t n = take_count_of_frame(in, parse_count(in, words[0], "a number of particles"));
  std::array<double, 3> low{}, high{};
  for (size_t c = 0; c < d; ++c) {
    low[c] = parse_number(in, words[2 + c]);
    high[c] = parse_number(in, words[2 + d + c]);
    if (n > 0 && !(high[c] > low[c])) in.fail(JAM_E_FORMAT, "the box has no extent along %c", "xyz"[c]);
  }
  content.dim = static_cast<int>(d);
  content.knows_origin = true;
  content.enclosure = given;
  Rows rows(in, false);
  for (int64_t k = 0; k < n; ++k) {
    if (!rows.next(words)) ends_early(in, k, n);
    if (words.size() != row_words)
      in.fail(JAM_E_FORMAT, "%zu columns, data of MercuryDPM have %zu in d = %zu", words.size(), row_words, d);
    for (size_t c = 0; c < d; ++c) content.position.push_back(parse_number(in, words[c]));
    content.diameter.push_back(2.0 * positive(in, words[radius_at], "radius"));
  }
  if (n == 0) return true;
  measure_from_corner(low.data(), content);
  std::vector<double> edges(d * d, 0.0);
  for (size_t c = 0; c < d; ++c) edges[(d + 1) * c] = high[c] - low[c];
  take_cell(in, std::move(edges), content);
  content.notes.say("velocities, rotations and the last column of the data were not read");
  return true;
}

}  // namespace

FileContent read_mercury(LineReader &in, const ReadOptions &options) {
  size_t d = 0;
  return choose_frame(in, options.frame, [&](FileContent &content, int64_t) {
    return read_mercury_frame(in, options.enclosure, d, content);
  });
}

}  // namespace jam::inside
