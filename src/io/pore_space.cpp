#include "io/pore_space.hpp"

#include <cmath>
#include <cstring>

#include "core/byte_order.hpp"
#include "core/error.hpp"
#include "io/formats.hpp"
#include "pore/balls.hpp"

namespace jam::inside {
namespace {

template <class T>
void put(std::string &out, T value) {
  char bytes[sizeof value], memory[sizeof value];
  std::memcpy(memory, &value, sizeof value);
  for (size_t k = 0; k < sizeof value; ++k) bytes[k] = memory[byte_in_memory<T>(k)];
  out.append(bytes, sizeof bytes);
}

std::string number(double x) {
  std::string text;
  append_number(text, x);
  return text;
}

std::string three(const std::array<double, 3> &x) { return number(x[0]) + " " + number(x[1]) + " " + number(x[2]); }
std::string three(const std::array<int64_t, 3> &x) {
  return std::to_string(x[0]) + " " + std::to_string(x[1]) + " " + std::to_string(x[2]);
}

// NEP 1: a Python literal behind its length, padded to 64 bytes. x is fastest: Fortran's order of image[x, y, z].
void put_npy_header(std::string &out, const VoxelGrid &grid, int dim, int lines) {
  std::string shape = std::to_string(grid.count[0]) + ", " + std::to_string(grid.count[1]);
  if (dim == 3) shape += ", " + std::to_string(grid.count[2]);
  std::string header = std::string("{'descr': '") + (lines > 0 ? "<f4" : "|u1") +
                       "', 'fortran_order': True, 'shape': (" + shape + "), }";
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  out.append("\x93NUMPY\x01\x00", 8);
  put(out, static_cast<uint16_t>(header.size()));
  out += header;
}

// MetaImage: text, then the values. Its offset is the centre of the first voxel.
void put_mha_header(std::string &out, const VoxelGrid &grid, int lines) {
  const std::array<double, 3> first{0.5 * grid.spacing[0], 0.5 * grid.spacing[1], 0.5 * grid.spacing[2]};
  out += "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = False\n";
  out += "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = " + three(first) + "\nElementSpacing = " + three(grid.spacing);
  out += "\nDimSize = " + three(grid.count) + "\nElementType = " + (lines > 0 ? "MET_FLOAT" : "MET_UCHAR");
  out += "\nElementDataFile = LOCAL\n";
}

void put_vti_header(std::string &out, const VoxelGrid &grid, int lines, int64_t bytes) {
  const std::string extent = "0 " + std::to_string(grid.count[0]) + " 0 " + std::to_string(grid.count[1]) + " 0 " +
                             std::to_string(grid.count[2]);
  out +=
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<ImageData WholeExtent=\"" +
      extent + "\" Origin=\"0 0 0\" Spacing=\"" + three(grid.spacing) + "\">\n<Piece Extent=\"" + extent +
      "\">\n<CellData Scalars=\"solid\">\n<DataArray type=\"" + (lines > 0 ? "Float32" : "UInt8") +
      "\" Name=\"solid\" format=\"appended\" offset=\"0\"/>\n</CellData>\n</Piece>\n</ImageData>\n"
      "<AppendedData encoding=\"raw\">\n_";
  put(out, static_cast<uint64_t>(bytes));
}

}  // namespace

int64_t bytes_of_image(const VoxelGrid &grid, int lines) { return grid.total() * (lines > 0 ? 4 : 1); }

void write_image(const VoxelImage &image, const VoxelGrid &grid, int dim, int lines, const char *path,
                 const std::function<void(const double *layer)> &f) {
  const std::string ending = format_to_write(Content::image, path, 0).word;
  OutputFile file(path);
  std::string &out = file.text();
  if (ending == "npy") put_npy_header(out, grid, dim, lines);
  if (ending == "mha") put_mha_header(out, grid, lines);
  if (ending == "vti") put_vti_header(out, grid, lines, bytes_of_image(grid, lines));
  std::vector<double> layer(grid.layer());
  for (int64_t z = 0; z < grid.count[2]; ++z) {
    image.fill_layer(z, layer.data());
    f(layer.data());
    for (const double value : layer)
      if (lines > 0)
        put(out, static_cast<float>(value));
      else
        out += static_cast<char>(value == voxel_outside ? 2 : value > 0.0);
    file.flush_if_full();
  }
  if (ending == "vti") out += "\n</AppendedData>\n</VTKFile>\n";
  file.commit();
}

int64_t stl_bytes(int64_t triangles) { return 84 + 50 * triangles; }

int64_t write_stl(const SolidMesh &mesh, const char *path) {
  if (mesh.triangle.size() > UINT32_MAX)
    fail(JAM_E_UNSUPPORTED, "%zu triangles, STL can count to 2^32: choose a longer edge", mesh.triangle.size());
  OutputFile file(path);
  std::string &out = file.text();
  out += "binary STL of libjam: the solid of a packing of spheres";
  out.resize(80, ' ');
  put(out, static_cast<uint32_t>(mesh.triangle.size()));
  for (const std::array<float, 9> &t : mesh.triangle) {
    Point u, v;
    for (size_t q = 0; q < 3; ++q) {
      u[q] = static_cast<double>(t[3 + q]) - static_cast<double>(t[q]);
      v[q] = static_cast<double>(t[6 + q]) - static_cast<double>(t[q]);
    }
    const Point n = cross(u, v);
    const double length = std::sqrt(dot(n, n));
    for (const double x : n) put(out, static_cast<float>(length > 0.0 ? x / length : 0.0));
    for (const float x : t) put(out, x);
    put(out, static_cast<uint16_t>(0));
    file.flush_if_full();
  }
  file.commit();
  return stl_bytes(static_cast<int64_t>(mesh.triangle.size()));
}

}  // namespace jam::inside
