#include <algorithm>

#include <gale/io/bytes/output_file.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/writers/writers.hpp>

namespace gale::io::detail {
namespace {

/// The name as one word.
std::string as_word(const std::string& name) {
  static const char digits[] = "0123456789ABCDEF";
  std::string word;
  for (const char c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (code < '!' || code > '~' || c == '"' || c == '%') {
      word += {'%', digits[code / 16], digits[code % 16]};
    } else {
      word += c;
    }
  }
  return word;
}

/// The values, the most significant byte first.
void write_values(OutputFile& file, const WrittenArray& array) {
  constexpr std::uint64_t block = 1 << 15;
  with_type(array.type, [&](auto value) {
    std::vector<decltype(value)> values(std::min(block, array.count));
    for (std::uint64_t begin = 0; begin < array.count; begin += block) {
      const std::uint64_t count = std::min(block, array.count - begin);
      array.copy(begin, begin + count, reinterpret_cast<char*>(values.data()));
      to_machine_order(values.data(), count, ByteOrder::big);
      file.write(values.data(), count * sizeof(value));
    }
  });
  file.write("\n");
}

/// Writes the arrays of so many points or cells.
void write_data(OutputFile& file, const std::string& keyword, const std::string& rows, const WrittenArrays& arrays) {
  if (arrays.empty()) return;
  file.write(keyword + rows + "\nFIELD FieldData " + std::to_string(arrays.size()) + "\n");
  for (const WrittenArray& array : arrays) {
    const std::string name = as_word(array.name);
    constexpr std::size_t longest = 255;  // of the words that VTK reads
    if (name.size() > longest)
      refuse("the array '", printable(array.name), "' has a name that takes ", name.size(),
             " bytes, and legacy VTK has ", longest, " at most");
    file.write(text_of(name, " ", array.components, " ", rows, " ", name_in(legacy_types, array.type), "\n"));
    write_values(file, array);
  }
}

}  // namespace

void write_legacy_vtk(const AtomicFile& to, const Dataset& mesh, const std::vector<PointArray>& more) {
  const WrittenArray points = written(mesh.points);
  const WrittenCells simplices(mesh);
  const std::uint64_t count = simplices.count, size = simplices.corners * count;
  const std::string vertices = std::to_string(points.count / 3), cells = std::to_string(count);
  OutputFile file(to.temporary());
  file.write("# vtk DataFile Version 5.1\nwritten by gale\nBINARY\nDATASET UNSTRUCTURED_GRID\n");
  file.write(text_of("POINTS ", vertices, " ", name_in(legacy_types, points.type), "\n"));
  write_values(file, points);
  file.write("CELLS " + std::to_string(count + 1) + " " + std::to_string(size) + "\nOFFSETS vtktypeint64\n");
  write_values(
      file, made<std::int64_t>("", count + 1, [corners = simplices.corners](std::uint64_t k) { return corners * k; }));
  file.write("CONNECTIVITY vtktypeint64\n");
  write_values(file, simplices.connectivity<std::int64_t>(""));
  file.write("CELL_TYPES " + cells + "\n");
  write_values(file, made<std::int32_t>("", count, [type = simplices.type](std::uint64_t) { return type; }));
  write_data(file, "CELL_DATA ", cells, written(mesh.cell_arrays));
  write_data(file, "POINT_DATA ", vertices, written(mesh.arrays, more));
  file.flush();
}

}  // namespace gale::io::detail
