#include "io/vtp.hpp"

#include <numeric>

#include "io/text.hpp"

namespace jam::inside {

VtpFile::VtpFile(std::vector<double> points, int cell_size)
    : points_(points.size() / 3), cell_size_(static_cast<size_t>(cell_size)), place_(array("Points", points, 3)) {
  std::vector<int64_t> point(points_), end(points_ / cell_size_);
  std::iota(point.begin(), point.end(), 0);
  for (size_t k = 0; k < end.size(); ++k) end[k] = static_cast<int64_t>((k + 1) * cell_size_);
  connectivity_ = array("connectivity", point, 1);
  offsets_ = array("offsets", end, 1);
}

// VTK writes text as the numbers of its characters, with 0 at the end.
void VtpFile::add_field_text(const char *name, const std::string &text) {
  fields_ += std::string("<DataArray type=\"String\" Name=\"") + name + "\" NumberOfTuples=\"1\" format=\"ascii\">\n";
  for (const char c : text) fields_ += std::to_string(static_cast<int>(c)) + ' ';
  fields_ += "0\n</DataArray>\n";
}

void VtpFile::add_field_data(const char *name, const std::vector<double> &values) {
  fields_ += std::string("<DataArray type=\"Float64\" Name=\"") + name + "\" NumberOfTuples=\"" +
             std::to_string(values.size()) + "\" format=\"ascii\">\n";
  for (const double x : values) {
    append_number(fields_, x);
    fields_ += ' ';
  }
  fields_ += "\n</DataArray>\n";
}

void VtpFile::write(OutputFile &file) const {
  std::string &out = file.text();
  std::vector<const Array *> order;
  size_t offset = 0;
  const auto announce = [&](const Array &a) {
    out += "<DataArray type=\"" + std::string(a.whole ? "Int64" : "Float64") + "\" Name=\"" + a.name +
           "\" NumberOfComponents=\"" + std::to_string(a.components) + "\" format=\"appended\" offset=\"" +
           std::to_string(offset) + "\"/>\n";
    offset += sizeof(uint64_t) + a.bytes.size();
    order.push_back(&a);
  };
  const std::string cells = std::to_string(points_ / cell_size_), kind = cell_size_ == 1 ? "Verts" : "Lines";
  out +=
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n";
  if (!fields_.empty()) out += "<FieldData>\n" + fields_ + "</FieldData>\n";
  out += "<Piece NumberOfPoints=\"" + std::to_string(points_) + "\" NumberOfVerts=\"" +
         (cell_size_ == 1 ? cells : "0") + "\" NumberOfLines=\"" + (cell_size_ == 2 ? cells : "0") +
         "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n";
  announce(place_);
  out += "</Points>\n<" + kind + ">\n";
  announce(connectivity_);
  announce(offsets_);
  out += "</" + kind + ">\n<PointData>\n";
  for (const Array &a : point_data_) announce(a);
  out += "</PointData>\n<CellData>\n";
  for (const Array &a : cell_data_) announce(a);
  out += "</CellData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  for (const Array *a : order) {
    out += array("", std::vector<int64_t>{static_cast<int64_t>(a->bytes.size())}, 1).bytes;
    out += a->bytes;
    file.flush_if_full();
  }
  out += "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace jam::inside
