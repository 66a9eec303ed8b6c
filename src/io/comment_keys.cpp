#include "io/comment_keys.hpp"

#include <algorithm>

namespace jam::inside {

std::string plain_list(std::string_view value) {
  std::string plain(value);
  if (plain.compare(0, 5, "_JSON") == 0) plain.erase(0, 5);
  std::replace_if(
      plain.begin(), plain.end(), [](char c) { return c == '[' || c == ']' || c == ','; }, ' ');
  return plain;
}

bool is_true(std::string_view word) {
  const std::string w = lower(word);
  return w == "t" || w == "true" || w == "1";
}

size_t read_container(const LineReader &in, CommentKeys &keys, Enclosure &enclosure) {
  std::string_view value;
  const bool named = keys.find("container", value);
  if (named) enclosure.container = container_of_word(std::string(value).c_str());
  if (enclosure.container < 0)
    in.fail(JAM_E_FORMAT, "container is '%s', known are %s", shown(value).c_str(), container_words().c_str());
  if (!keys.find("walls", value)) {  // walls alone are those of a brick
    if (!named) return 0;
    in.fail(JAM_E_FORMAT, "container= without walls=, a word T or F for each axis");
  }
  const std::string plain = plain_list(value);
  std::vector<std::string_view> words;
  split(plain, words);
  if (words.empty() || words.size() > JAM_MAX_DIM)
    in.fail(JAM_E_FORMAT, "walls has %zu words, it must have one for each axis, at most %d", words.size(), JAM_MAX_DIM);
  for (size_t c = 0; c < words.size(); ++c) {
    if (is_true(words[c]))
      enclosure.walls |= 1 << c;
    else if (const std::string w = lower(words[c]); w != "f" && w != "false" && w != "0")
      in.fail(JAM_E_FORMAT, "walls='%s': a word for each axis must be T or F", shown(value).c_str());
  }
  return words.size();
}

}  // namespace jam::inside
