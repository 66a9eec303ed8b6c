#include "io/comment_keys.hpp"

namespace jam {

bool is_true(std::string_view word) {
  const std::string w = lower(word);
  return w == "t" || w == "true" || w == "1";
}

void read_container(const LineReader &in, CommentKeys &keys, FileContent &content) {
  std::string_view value;
  if (!keys.find("container", value)) return;
  content.enclosure.container = container_of_word(std::string(value).c_str());
  if (content.enclosure.container < 0)
    in.fail(JAM_E_FORMAT, "container is '%s', known are brick, cylinder and ball", shown(value).c_str());
  if (!keys.find("walls", value)) in.fail(JAM_E_FORMAT, "container= without walls=, a word T or F for each axis");
  std::vector<std::string_view> words;
  split(value, words);
  if (words.size() != static_cast<size_t>(content.dim))
    in.fail(JAM_E_FORMAT, "walls has %zu words, %d are needed", words.size(), content.dim);
  for (size_t c = 0; c < words.size(); ++c) {
    if (is_true(words[c]))
      content.enclosure.walls |= 1 << c;
    else if (const std::string w = lower(words[c]); w != "f" && w != "false" && w != "0")
      in.fail(JAM_E_FORMAT, "walls='%s': a word for each axis must be T or F", shown(value).c_str());
  }
}

}  // namespace jam
