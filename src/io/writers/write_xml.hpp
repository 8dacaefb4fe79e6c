#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gale/io/atomic_file.hpp>
#include <gale/io/writers/written_array.hpp>

namespace gale::io::detail {

/// What stands in one of VTK's XML files.
struct XmlContent {
  struct Section {
    std::string name;  ///< e.g. "PointData"
    std::vector<WrittenArray> arrays;
    std::string global_ids;  ///< the one of the arrays that has global ids, where there is one
  };

  std::string type;                                          ///< e.g. "UnstructuredGrid"
  std::vector<std::pair<std::string, std::uint64_t>> sizes;  ///< e.g. "NumberOfPoints"
  std::vector<Section> sections;
};

/// How a section, of pieces or of what they have in common, says which array has global ids; nothing for no name.
std::string global_ids_attribute(const std::string& name);

/// Writes it to the temporary file of `to`, its arrays in the encoding that this says, compressed where there is a
/// zlib: block by block, so that it takes little memory, and on as many threads as loops take. Throws gale::Error
/// without the path.
void write_xml(const AtomicFile& to, const XmlContent& content);

}  // namespace gale::io::detail
