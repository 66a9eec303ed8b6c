// Data files of MercuryDPM in three dimensions, one frame or several: "N time xmin ymin zmin xmax ymax zmax", then a
// row of 14 numbers for each particle, "x y z vx vy vz radius" and what is not read here (docs.mercurydpm.org, Output
// Files).
#include <array>

#include "io/read_helpers.hpp"

namespace jam::inside {
namespace {

constexpr size_t header_words = 8, row_words = 14, radius_at = 6;

// Frame k; false at the end of the file.
bool read_mercury_frame(LineReader &in, const Enclosure &given, FileContent &content) {
  std::string_view line;
  std::vector<std::string_view> words;
  if (!in.next_filled(line)) return false;
  split(line, words);
  if (words.size() != header_words)
    in.fail(JAM_E_FORMAT, "'%s' where a frame begins: N time xmin ymin zmin xmax ymax zmax are needed",
            shown(line).c_str());
  const int64_t n = take_count_of_frame(in, parse_count(in, words[0], "a number of particles"));
  std::array<double, 3> low{}, high{};
  for (size_t c = 0; c < 3; ++c) {
    low[c] = parse_number(in, words[2 + c]);
    high[c] = parse_number(in, words[5 + c]);
    if (n > 0 && !(high[c] > low[c])) in.fail(JAM_E_FORMAT, "the box has no extent along %c", "xyz"[c]);
  }
  content.dim = 3;
  content.knows_origin = true;
  content.enclosure = given;
  Rows rows(in, false);
  for (int64_t k = 0; k < n; ++k) {
    if (!rows.next(words)) ends_early(in, k, n);
    if (words.size() != row_words)
      in.fail(JAM_E_FORMAT, "%zu columns, data of MercuryDPM have %zu in d = 3", words.size(), row_words);
    for (size_t c = 0; c < 3; ++c) content.position.push_back(parse_number(in, words[c]));
    content.diameter.push_back(2.0 * positive(in, words[radius_at], "radius"));
  }
  if (n == 0) return true;
  measure_from_corner(low.data(), content);
  std::vector<double> edges(9, 0.0);
  for (size_t c = 0; c < 3; ++c) edges[4 * c] = high[c] - low[c];
  take_cell(in, std::move(edges), content);
  content.notes.say("velocities, rotations and the last column of the data were not read");
  return true;
}

}  // namespace

FileContent read_mercury(LineReader &in, const ReadOptions &options) {
  return choose_frame(in, options.frame, [&](FileContent &content, int64_t) {
    return read_mercury_frame(in, options.enclosure, content);
  });
}

}  // namespace jam::inside
