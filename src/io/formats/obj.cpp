#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <gale/base/stop.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/cells/surface_cells.hpp>
#include <gale/io/formats.hpp>

// Wavefront OBJ: a line each for vertices (v x y z) and faces (f a b c ...). A corner is the number of a vertex,
// counted from 1, or back from -1 for the last one so far, and may have those of a texture's and a normal's behind
// slashes.
namespace gale::io::detail {
namespace {

/// The file's lines; those that end with a backslash go on in the next one.
bool next_line(TextReader& text, std::string& line) {
  if (!text.line(line)) return false;
  constexpr std::size_t longest = 1 << 24;
  for (std::string more; !line.empty() && line.back() == '\\' && text.line(more);) {
    line.back() = ' ';
    line += more;
    if (line.size() > longest) damaged("a line of more than ", longest, " bytes");
  }
  return true;
}

/// What is read, and the first keywords of what isn't.
struct Obj {
  std::vector<double> points;
  PolygonList faces;
  std::vector<std::string> others;
  bool are_all_named = true;

  void add_point(Words& words) {
    const std::size_t vertex = points.size() / 3;
    for (const char axis : {'x', 'y', 'z'}) {
      const std::string_view word = words.next();
      double coordinate = 0;
      if (!parse(word, coordinate))
        damaged(axis, " of vertex ", vertex + 1, " is '", std::string(word.substr(0, 40)), "'");
      points.push_back(coordinate);
    }
  }

  void add_face(Words& words) {
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      std::int64_t number = 0;
      if (!parse(word.substr(0, word.find('/')), number) || number == 0)
        damaged("a corner of face ", faces.size(), " is '", std::string(word.substr(0, 40)), "'");
      const auto count = static_cast<std::int64_t>(points.size() / 3);
      if (number < -count)
        damaged("a corner of face ", faces.size(), " is ", number, ", and there are ", count, " vertices before it");
      faces.add(number > 0 ? number - 1 : count + number);
    }
    faces.end();
  }

  void note(std::string_view keyword) {
    constexpr std::size_t most = 8, longest = 20;
    const std::string name(keyword.substr(0, longest));
    if (std::find(others.begin(), others.end(), name) != others.end()) return;
    if (others.size() < most) {
      others.push_back(name);
    } else {
      are_all_named = false;
    }
  }
};

}  // namespace

Content read_obj(const InputFile& input, const ReadOptions& options) {
  FileBytes bytes(input, begin_of_text(input));
  TextReader text(bytes);
  Obj obj;
  std::int64_t number = 0;
  for (std::string line; next_line(text, line);) {
    gale::detail::stop_if_asked_at(number++);
    Words words(line);
    const std::string_view keyword = words.next();
    if (keyword == "v") {
      obj.add_point(words);
    } else if (keyword == "f") {
      obj.add_face(words);
    } else if (!keyword.empty() && keyword.front() != '#') {
      obj.note(keyword);
    }
  }
  MeshParts parts;
  parts.points = std::move(obj.points);
  parts.cells = obj.faces.take();
  std::string names;
  for (const std::string& name : obj.others) names += (names.empty() ? "'" : ", '") + printable(name) + "'";
  if (!names.empty())
    parts.notices.push_back("left out lines that are neither v nor f: " + names + (obj.are_all_named ? "" : " ..."));
  return to_mesh(parts, options);
}

}  // namespace gale::io::detail
