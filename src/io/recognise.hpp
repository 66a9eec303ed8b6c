// The one table of what begins a file: formats that are read, and others, each with its way out.
#pragma once
#include <string_view>
#include <vector>

#include "io/files.hpp"
#include "io/text.hpp"

namespace jam::inside {

// The beginning of a file, as text where it is text.
struct Head {
  std::string_view bytes;
  std::vector<std::string_view> lines;  // the first ones, without their ends
  std::string_view ending;              // of the file's name
  size_t first = 0;                     // the first line that is neither blank nor a comment
  explicit Head(std::string_view start, std::string_view name_ending);
  // The words of line k before its comment, none beyond the last line.
  std::vector<std::string_view> words(size_t k) const;
};

struct KnownFile {
  const char *name;  // of a row of formats.cpp, where the file is read
  bool (*is)(const Head &);
  const char *way_out;  // NULL: it is read
};

// The first row of the table that fits; NULL when none does.
const KnownFile *recognise(const Head &head);

}  // namespace jam::inside
