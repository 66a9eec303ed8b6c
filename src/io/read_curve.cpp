// A curve of sizes: a table of two columns.
#include "io/read_helpers.hpp"

namespace jam::inside {

void read_curve(const char *path, std::vector<double> &curve) {
  LineReader in(path);
  std::vector<std::string_view> words;
  std::string_view line;
  bool first = true;
  while (in.next_filled(line, true)) {
    const std::string_view text = before_comment(line);
    split(text, words);
    if (words.empty()) continue;
    const bool heading = first && is_name(words[0]) && is_heading(text);
    first = false;
    if (heading) continue;
    if (text.find(';') != std::string_view::npos)
      in.fail(JAM_E_FORMAT, "'%s': part the two columns by a comma or blanks, with decimal points",
              shown(text).c_str());
    split_columns(in, text, words);
    if (words.size() != 2) in.fail(JAM_E_FORMAT, "a row of a curve has two numbers, this one %zu words", words.size());
    for (const std::string_view word : words) curve.push_back(parse_number(in, word));
    CallScope::need_memory(static_cast<double>(sizeof(double) * curve.capacity()), in.path().c_str());
  }
  if (curve.empty()) in.fail(JAM_E_FORMAT, "the file has no row of two numbers");
}

}  // namespace jam::inside
