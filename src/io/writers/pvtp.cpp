#include <gale/io/bytes/byte_order.hpp>
#include <gale/io/bytes/output_file.hpp>
#include <gale/io/writers/writers.hpp>
#include <gale/io/writers/written_array.hpp>
#include <gale/io/writers/xml_text.hpp>

namespace gale::io::detail {

namespace {

std::string entry(const WrittenArray& array) {
  return "      <PDataArray" + xml_attribute("type", xml_name_of(array.type)) + xml_attribute("Name", array.name) +
         xml_attribute("NumberOfComponents", std::to_string(array.components)) + "/>\n";
}

}  // namespace

void write_pvtp(const std::string& path, const std::vector<std::string>& pieces, const PointSet& like) {
  OutputFile file(path);
  const std::string order = byte_order_of_machine() == ByteOrder::little ? "LittleEndian" : "BigEndian";
  file.write("<VTKFile" + xml_attribute("type", "PPolyData") + xml_attribute("version", "1.0") +
             xml_attribute("byte_order", order) + ">\n  <PPolyData" + xml_attribute("GhostLevel", "0") +
             ">\n    <PPointData>\n");
  for (const WrittenArray& array : written({&like.arrays})) file.write(entry(array));
  file.write("    </PPointData>\n    <PPoints>\n" + entry(written(like.points)) + "    </PPoints>\n");
  for (const std::string& piece : pieces) file.write("    <Piece" + xml_attribute("Source", piece) + "/>\n");
  file.write("  </PPolyData>\n</VTKFile>\n");
  file.flush();
}

}  // namespace gale::io::detail
