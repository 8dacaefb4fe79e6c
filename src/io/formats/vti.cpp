#include <gale/io/formats.hpp>
#include <gale/io/formats/volume.hpp>
#include <gale/io/formats/xml_pieces.hpp>

namespace gale::io::detail {

Content read_vti(const InputFile& input, const ReadOptions&) {
  const XmlFile file = read_xml(input, "ImageData");
  const XmlElement& element = file.root.require("ImageData");
  const Extent whole = extent_of(element, "WholeExtent");
  const auto origin = numbers_in<double>(element, "Origin", {0, 0, 0}, 3);
  const auto spacing = numbers_in<double>(element, "Spacing", {1, 1, 1}, 3);
  const auto direction = numbers_in<double>(element, "Direction", {1, 0, 0, 0, 1, 0, 0, 0, 1}, 9);
  Image image = oriented_image(whole.low, whole.high, origin, spacing, direction);
  const std::vector<GridPiece> pieces = grid_pieces_of(element, whole);
  XmlArrays arrays = join_pieces(pieces, whole, [&](const XmlElement& piece, std::uint64_t points) {
    return read_point_data(file, piece, points);
  });
  if (arrays.arrays.empty() && arrays.notices.empty() && !names_of_cell_data(*pieces[0].element).empty())
    throw Error("the image has values in its cells, none at its points");
  image.arrays = std::move(arrays.arrays);
  image.notices = std::move(arrays.notices);
  return image;
}

}  // namespace gale::io::detail
