// Keys on a line of comment, as extended XYZ has them, and what they say of the container.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "io/read_helpers.hpp"

namespace jam::inside {

// The keys of a line; words without = are comments.
class CommentKeys {
 public:
  // key=value, the value in quotes, in brackets, in braces or bare; as for ASE there may be blanks around =, a
  // character after a \ does not close quotes, braces or brackets, and brackets may be nested. The \ stays in the
  // value.
  CommentKeys(const LineReader &in, std::string_view comment) : in_(in) {
    const auto skip_blanks = [&](size_t k) { return std::min(comment.find_first_not_of(" \t", k), comment.size()); };
    for (size_t k = 0; k < comment.size();) {
      const size_t start = k = skip_blanks(k);
      while (k < comment.size() && comment[k] != '=' && comment[k] != ' ' && comment[k] != '\t') ++k;
      const std::string_view name = comment.substr(start, k - start);
      const size_t equals = skip_blanks(k);
      if (equals >= comment.size() || comment[equals] != '=') continue;
      k = skip_blanks(equals + 1);
      const char opens = k < comment.size() ? comment[k] : ' ';
      const bool quoted = opens == '"' || opens == '\'' || opens == '{' || opens == '[';
      if (quoted) ++k;
      size_t stop = quoted ? closing(comment, k, opens) : comment.find_first_of(" \t", k);
      if (stop == std::string_view::npos) {
        if (quoted) in.fail(JAM_E_FORMAT, "the quote after '%s=' is not closed", shown(name).c_str());
        stop = comment.size();
      }
      const std::string_view next = comment.substr(skip_blanks(stop), 1);
      if (!quoted && k > equals + 1 && (next == "=" || comment.substr(k, stop - k).find('=') != comment.npos))
        stop = k = equals + 1;  // another key follows: this one has no value
      keys_.push_back({name, comment.substr(k, stop - k), false});
      k = stop + 1;
    }
  }
  // Once only. From then on the key counts as read.
  bool find(std::string_view name, std::string_view &value) {
    bool found = false;
    for (Key &key : keys_) {
      if (key.name != name) continue;
      if (found) in_.fail(JAM_E_FORMAT, "'%s=' is there twice", shown(name).c_str());
      found = key.read = true;
      value = key.value;
    }
    return found;
  }
  bool has(std::string_view name) const {
    return std::any_of(keys_.begin(), keys_.end(), [&](const Key &key) { return key.name == name; });
  }
  std::vector<std::string> unread() const {
    std::vector<std::string> names;
    for (const Key &key : keys_)
      if (!key.read) names.emplace_back(key.name);
    return names;
  }

 private:
  // Where what was opened before k is closed.
  static size_t closing(std::string_view line, size_t k, char opens) {
    const char closes = opens == '{' ? '}' : opens == '[' ? ']' : opens;
    for (int depth = 1; k < line.size(); ++k) {
      if (line[k] == '\\')
        ++k;
      else if (line[k] == closes && --depth == 0)
        return k;
      else if (line[k] == opens && opens == '[')
        ++depth;
    }
    return std::string_view::npos;
  }
  struct Key {
    std::string_view name, value;
    bool read;
  };
  const LineReader &in_;
  std::vector<Key> keys_;
};

// A list with blanks alone between its words: ASE writes _JSON [false, true], others [1, 0, 0] or 1,0,0.
std::string plain_list(std::string_view value);
// Whether the word of a truth value is T, True or 1.
bool is_true(std::string_view word);
// container=, and walls= with a word for each axis: what container_keys writes; walls= alone are those of a brick. The
// number of these words; 0 without walls=.
size_t read_container(const LineReader &in, CommentKeys &keys, Enclosure &enclosure);

}  // namespace jam::inside
