// VTK PolyData (.vtp) with its arrays appended in binary behind the XML: what ParaView reads fastest.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "io/output_file.hpp"

namespace jam::inside {

class VtpFile {
 public:
  // points: (count, 3). Each cell has cell_size points, one after the other: 1 for vertices, 2 for lines.
  VtpFile(std::vector<double> points, int cell_size);
  void add_point_data(const char *name, std::vector<double> values);
  void add_point_data(const char *name, std::vector<int64_t> values);
  void add_cell_data(const char *name, std::vector<double> values);
  void add_cell_data(const char *name, std::vector<int64_t> values);
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
  static Array array(const char *name, const std::vector<T> &values, int components);
  size_t points_, cell_size_;
  Array place_, connectivity_, offsets_;
  std::vector<Array> point_data_, cell_data_;
  std::string fields_;  // as XML
};

}  // namespace jam::inside
