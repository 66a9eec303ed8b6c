// VTK PolyData (.vtp) with its arrays appended in binary behind the XML: what ParaView reads fastest.
#pragma once
#include <cstdint>
#include <type_traits>
#include <vector>

#include "core/byte_order.hpp"
#include "io/output_file.hpp"

namespace jam::inside {

class VtpFile {
 public:
  // points: (count, 3). Each cell has cell_size points, one after the other: 1 for vertices, 2 for lines.
  VtpFile(std::vector<double> points, int cell_size);
  // values: of doubles or of whole numbers of 64 bits.
  template <class T>
  void add_point_data(const char *name, std::vector<T> values) {
    point_data_.push_back(array(name, values, 1));
  }
  template <class T>
  void add_cell_data(const char *name, std::vector<T> values) {
    cell_data_.push_back(array(name, values, 1));
  }
  // Of the whole file.
  void add_field_text(const char *name, const std::string &text);
  void add_field_data(const char *name, const std::vector<double> &values);
  void write(OutputFile &file) const;

 private:
  struct Array {
    std::string name;
    bool whole;
    int components;
    std::string bytes;
  };
  template <class T>
  static Array array(const char *name, const std::vector<T> &values, int components) {
    Array made{name, std::is_integral<T>::value, components, std::string(values.size() * sizeof(T), '\0')};
    const char *memory = reinterpret_cast<const char *>(values.data());
    for (size_t k = 0; k < made.bytes.size(); ++k) made.bytes[k] = memory[byte_in_memory<T>(k)];
    return made;
  }
  size_t points_, cell_size_;
  Array place_, connectivity_, offsets_;
  std::vector<Array> point_data_, cell_data_;
  std::string fields_;  // as XML
};

}  // namespace jam::inside
