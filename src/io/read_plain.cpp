// Plain text: ours, and that of the code of Torquato and Jiao, which has cell vectors behind the diameter.
#include "io/read_helpers.hpp"

namespace jam::inside {
namespace {

// The third line: `<diameter>` or `diameters`, then perhaps `box <L>`. Returns whether each sphere has its own.
bool read_diameter_line(LineReader &in, FileContent &content) {
  std::string_view line;
  std::vector<std::string_view> words;
  if (!next_text(in, line, words)) in.fail(JAM_E_FORMAT, "the file ends before the diameter");
  if (words.size() != 1 && !(words.size() == 3 && words[1] == "box"))
    in.fail(JAM_E_FORMAT, "'%s' is neither '<diameter>' nor 'diameters', with 'box <side>' or without",
            shown(line).c_str());
  const bool each = words[0] == "diameters";
  if (!each) content.diameter.push_back(positive(in, words[0], "diameter"));
  if (words.size() == 3) content.box = take_box(in, words[2]);
  return each;
}

std::string joined(const std::vector<std::string_view> &words) {
  std::string all;
  for (const std::string_view word : words) all += (all.empty() ? "" : " ") + std::string(word);
  return all;
}

[[noreturn]] void refuse_more(const LineReader &in, int64_t line, int64_t n, const std::string &row) {
  inside::fail(JAM_E_FORMAT, "%s line %lld: there is more after the %lld spheres that the header announces: '%s'",
               in.path().c_str(), static_cast<long long>(line), static_cast<long long>(n), shown(row).c_str());
}

// The first d of n + d rows are cell vectors.
void take_vectors(const LineReader &in, FileContent &content) {
  const size_t d = static_cast<size_t>(content.dim);
  const auto behind = content.position.begin() + static_cast<std::ptrdiff_t>(d * d);
  std::vector<double> rows(content.position.begin(), behind);
  content.position.erase(content.position.begin(), behind);
  content.notes.say(
      "the file has %zu rows more than spheres: the first %zu were read as cell vectors, as the code of "
      "Torquato and Jiao writes them",
      d, d);
  take_cell(in, std::move(rows), content);
}

// n rows; where cell vectors may be before them, up to `more` others.
void read_rows(LineReader &in, int64_t n, bool each, int more, const ReadOptions &options, FileContent &content) {
  const size_t columns = static_cast<size_t>(content.dim) + (each ? 1 : 0);
  std::vector<std::string_view> words;
  Rows rows(in, true);
  int64_t found = 0, line_behind = 0, line_outside = 0;
  std::string behind;    // the first row that no sphere needs
  double outside = 0.0;  // the first coordinate that no box of side 1 has
  for (; found < n + more && rows.next(words); ++found) {
    if (found == n) behind = joined(words), line_behind = in.number();
    if (words.size() != columns && found >= n) refuse_more(in, line_behind, n, behind);
    if (words.size() != columns)
      in.fail(JAM_E_FORMAT, "%zu columns, %zu are needed (%s)", words.size(), columns,
              each ? "coordinates and diameter" : "coordinates");
    for (int c = 0; c < content.dim; ++c) {
      content.position.push_back(parse_number(in, words[c]));
      if (line_outside == 0 && !is_inside(content.position.back(), options))
        line_outside = in.number(), outside = content.position.back();
    }
    if (each) content.diameter.push_back(positive(in, words.back(), "diameter"));
  }
  if (found < n) ends_early(in, found, n);
  if (found > n && found < n + more) refuse_more(in, line_behind, n, behind);
  if (found > n) take_vectors(in, content);
  if (!content.has_box() && line_outside > 0) refuse_outside(in, line_outside, outside);
}

}  // namespace

FileContent read_plain(LineReader &in, const ReadOptions &options) {
  FileContent content;
  std::vector<std::string_view> words;
  std::string_view line;
  next_text(in, line, words);
  content.dim = take_dim(in, parse_count(in, words[0], "a dimension"));
  if (!next_text(in, line, words)) in.fail(JAM_E_FORMAT, "the file ends before the number of spheres");
  if (words.size() != 1) in.fail(JAM_E_FORMAT, "'%s' is not one number of spheres", shown(line).c_str());
  const int64_t n = take_count(in, parse_count(in, words[0], "a number of spheres"));
  const bool each = read_diameter_line(in, content);
  content.enclosure = options.enclosure;
  content.knows_walls = true;  // the format is one of periodic cubes: only the caller can name walls
  const bool may_have_vectors = !each && !content.has_box();
  read_rows(in, n, each, may_have_vectors ? content.dim : 0, options, content);
  check_end(in, n);
  return content;
}

}  // namespace jam::inside
