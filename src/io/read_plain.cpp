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
  const size_t columns = static_cast<size_t>(content.dim) + (each ? 1 : 0);
  const bool may_have_vectors = !each && !content.has_box();
  Rows rows(in, true);
  std::vector<int64_t> at;  // the line of each row
  std::string behind;       // the first row that no sphere needs
  for (; at.size() < static_cast<size_t>(n + (may_have_vectors ? content.dim : 0)) && rows.next(words);
       at.push_back(in.number())) {
    if (at.size() == static_cast<size_t>(n)) behind = joined(words);
    if (at.size() >= static_cast<size_t>(n) && words.size() != columns) refuse_more(in, in.number(), n, behind);
    if (words.size() != columns)
      in.fail(JAM_E_FORMAT, "%zu columns, %zu are needed (%s)", words.size(), columns,
              each ? "coordinates and diameter" : "coordinates");
    for (int c = 0; c < content.dim; ++c) content.position.push_back(parse_number(in, words[c]));
    if (each) content.diameter.push_back(positive(in, words.back(), "diameter"));
  }
  const int64_t found = static_cast<int64_t>(at.size());
  if (found < n) ends_early(in, found, n);
  if (found > n && found < n + content.dim) refuse_more(in, at[static_cast<size_t>(n)], n, behind);
  if (found > n) take_vectors(in, content);
  for (size_t k = 0; k < content.position.size() && !content.has_box(); ++k)
    check_inside(in, at[k / static_cast<size_t>(content.dim)], content.position[k], options);
  check_end(in, n);
  return content;
}

}  // namespace jam::inside
