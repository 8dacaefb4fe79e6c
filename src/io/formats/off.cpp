#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <gale/base/stop.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/cells/surface_cells.hpp>
#include <gale/io/formats.hpp>

// OFF: how many vertices, faces and edges there are; a line for each vertex, x y z, and for each face: how many corners
// it has, and these, counted from 0. Colours, normals and textures may follow in the line.
namespace gale::io::detail {
namespace {

/// Lines without comments that aren't empty.
class OffLines {
 public:
  explicit OffLines(TextReader& text) : text_(text) {}

  /// The words of the next one, valid until the next call. Throws gale::Error, naming `what` it should be, at the end.
  Words next(const std::string& what) {
    while (text_.line(line_)) {
      gale::detail::stop_if_asked_at(number_++);
      line_.resize(std::min(line_.size(), line_.find('#')));
      if (!Words(line_).next().empty()) return Words(line_);
    }
    damaged("it ends before ", what);
  }

 private:
  TextReader& text_;
  std::string line_;
  std::int64_t number_ = 0;
};

/// Whether the keyword is that of three coordinates a vertex, and maybe more behind them.
bool is_off(std::string_view keyword) {
  static constexpr std::array<std::string_view, 8> known = {"OFF",   "COFF",   "NOFF",   "CNOFF",
                                                            "STOFF", "STCOFF", "STNOFF", "STCNOFF"};
  return std::find(known.begin(), known.end(), keyword) != known.end();
}

std::int64_t count_in(std::string_view word, const char* what, std::uint64_t most) {
  const auto count = number<std::int64_t>(word, what);
  if (count < 0) damaged(what, " is ", count);
  if (static_cast<std::uint64_t>(count) > most) damaged(what, " is ", count, ", for which it has no room");
  return count;
}

}  // namespace

Content read_off(const InputFile& input, const ReadOptions& options) {
  FileBytes bytes(input, begin_of_text(input));
  TextReader text(bytes);
  OffLines lines(text);
  Words header = lines.next("its first line");
  const std::string keyword(header.next().substr(0, 40));
  if (!is_off(keyword)) damaged("its first word is '", keyword, "', not OFF");
  std::string_view word = header.next();
  if (word == "BINARY") throw Error("it is binary, and OFF is read as text");
  if (word.empty()) {
    header = lines.next("its numbers of vertices and faces");
    word = header.next();
  }
  // Three coordinates and what ends them take six bytes at least, a corner two.
  const std::int64_t points = count_in(word, "the number of vertices", input.size() / 6),
                     faces = count_in(header.next(), "the number of faces", input.size() / 2);
  bool has_more = false;
  std::vector<double> coordinates;
  coordinates.reserve(3 * static_cast<std::size_t>(points));
  for (std::int64_t p = 0; p < points; ++p) {
    const std::string what = "vertex " + std::to_string(p) + " of " + std::to_string(points);
    Words words = lines.next(what);
    for (int d = 0; d < 3; ++d) coordinates.push_back(number<double>(words.next(), "a coordinate of " + what));
    has_more = has_more || !words.next().empty();
  }
  PolygonList polygons;
  for (std::int64_t f = 0; f < faces; ++f) {
    const std::string what = "face " + std::to_string(f) + " of " + std::to_string(faces);
    Words words = lines.next(what);
    const std::int64_t corners = count_in(words.next(), "the number of a face's corners", input.size() / 2);
    for (std::int64_t k = 0; k < corners; ++k) polygons.add(number<std::int64_t>(words.next(), "a corner of " + what));
    polygons.end();
    has_more = has_more || !words.next().empty();
  }
  MeshParts parts;
  parts.points = std::move(coordinates);
  parts.cells = polygons.take();
  if (has_more) parts.notices.push_back("left out what follows coordinates and corners, such as colours");
  return to_mesh(parts, options);
}

}  // namespace gale::io::detail
