#include <gale/io/bytes/byte_order.hpp>
#include <gale/io/bytes/output_file.hpp>
#include <gale/io/writers/write_xml.hpp>
#include <gale/io/writers/writers.hpp>
#include <gale/io/writers/xml_text.hpp>

namespace gale::io::detail {

namespace {

using Arrays = std::vector<WrittenArray>;

std::string entry(const WrittenArray& array) {
  return "      <PDataArray" + xml_attribute("type", xml_name_of(array.type)) + xml_attribute("Name", array.name) +
         xml_attribute("NumberOfComponents", std::to_string(array.components)) + "/>\n";
}

/// An element of this name with an entry for each array.
std::string section(const std::string& name, const Arrays& arrays, const std::string& global_ids = "") {
  std::string text = "    <" + name + global_ids_attribute(global_ids) + ">\n";
  for (const WrittenArray& array : arrays) text += entry(array);
  return text + "    </" + name + ">\n";
}

/// `sections` are what pieces have in common.
void write(const std::string& path, const std::string& type, const std::vector<std::string>& pieces,
           const std::string& sections) {
  OutputFile file(path);
  const std::string order = byte_order_of_machine() == ByteOrder::little ? "LittleEndian" : "BigEndian";
  file.write("<VTKFile" + xml_attribute("type", type) + xml_attribute("version", "1.0") +
             xml_attribute("byte_order", order) + ">\n  <" + type + xml_attribute("GhostLevel", "0") + ">\n");
  file.write(sections);
  for (const std::string& piece : pieces) file.write("    <Piece" + xml_attribute("Source", piece) + "/>\n");
  file.write("  </" + type + ">\n</VTKFile>\n");
  file.flush();
}

}  // namespace

void write_pvtp(const std::string& path, const std::vector<std::string>& pieces, const PointSet& like) {
  write(path, "PPolyData", pieces,
        section("PPointData", written({&like.arrays})) + section("PPoints", {written(like.points)}));
}

void write_pvtp(const std::string& path, const std::vector<std::string>& pieces, const Surface& like) {
  write(path, "PPolyData", pieces,
        section("PPointData", written({&like.point_arrays})) + section("PCellData", written({&like.cell_arrays})) +
            section("PPoints", {written(like.points)}));
}

void write_pvtu(const std::string& path, const std::vector<std::string>& pieces, const MeshPiece& like) {
  write(path, "PUnstructuredGrid", pieces,
        section("PPointData", written({&like.mesh.arrays}), global_point_ids) +
            section("PCellData", written({&like.cell_arrays}), global_cell_ids) +
            section("PPoints", {written(like.mesh.points)}));
}

}  // namespace gale::io::detail
