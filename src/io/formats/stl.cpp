#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gale/base/bits.hpp>
#include <gale/base/stop.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/io/bytes/values.hpp>
#include <gale/io/cells/surface_cells.hpp>
#include <gale/io/formats.hpp>

// STL: facets, each with a normal, which nobody reads, and three corners of three floats. Binary files have 80 bytes,
// the number of facets, and 50 bytes of each.
namespace gale::io::detail {
namespace {

using Corner = std::array<std::uint32_t, 3>;  ///< the bits of three floats

/// Points, each once, in the order in which they occur first.
class MergedPoints {
 public:
  MergedPoints() : slots_(1 << 10, none) {}

  /// The number of the point.
  std::int32_t add(std::array<float, 3> place) {
    Corner bits;
    for (float& coordinate : place) coordinate += 0.0F;  // 0 and -0 are one
    std::memcpy(&bits, &place, sizeof bits);
    if (2 * points_.size() >= slots_.size()) grow();
    std::int32_t& slot = slots_[slot_of(bits)];
    if (slot == none) {
      if (points_.size() == static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
        throw Error("it has more points than 32-bit ids can number");
      slot = static_cast<std::int32_t>(points_.size());
      points_.push_back(bits);
    }
    return slot;
  }

  std::vector<float> take() const {
    std::vector<float> coordinates(3 * points_.size());
    if (!points_.empty()) std::memcpy(coordinates.data(), points_.data(), points_.size() * sizeof(Corner));
    return coordinates;
  }

 private:
  static constexpr std::int32_t none = -1;

  /// Where the point is, or is to be.
  std::size_t slot_of(const Corner& bits) const {
    const std::size_t mask = slots_.size() - 1;
    const std::uint64_t first = std::uint64_t(bits[0]) << 32 | bits[1];
    std::size_t slot = static_cast<std::size_t>(spread(spread(first) ^ bits[2])) & mask;
    while (slots_[slot] != none && points_[static_cast<std::size_t>(slots_[slot])] != bits) slot = (slot + 1) & mask;
    return slot;
  }

  void grow() {
    std::vector<std::int32_t> old(2 * slots_.size(), none);
    old.swap(slots_);
    for (std::size_t p = 0; p < points_.size(); ++p) slots_[slot_of(points_[p])] = static_cast<std::int32_t>(p);
  }

  std::vector<Corner> points_;
  std::vector<std::int32_t> slots_;  ///< at most half of them are taken
};

/// The facets that were read.
struct Facets {
  MergedPoints points;
  PolygonList polygons;

  void add(const std::array<std::array<float, 3>, 3>& corners) {
    gale::detail::stop_if_asked_at(static_cast<std::int64_t>(polygons.size()));
    for (const auto& corner : corners) polygons.add(points.add(corner));
    polygons.end();
  }
};

constexpr std::uint64_t header_bytes = 84, facet_bytes = 50;

/// The number of facets that a binary file says; nothing if the file is too short to say one.
std::optional<std::uint32_t> facets_of_binary(const InputFile& input) {
  if (input.size() < header_bytes) return std::nullopt;
  std::uint32_t count = 0;
  input.read(header_bytes - sizeof count, reinterpret_cast<char*>(&count), sizeof count);
  to_machine_order(&count, 1, ByteOrder::little);
  return count;
}

/// Whether it begins as a text does. Binary files may, too.
bool begins_as_text(const InputFile& input) {
  const std::uint64_t at = begin_of_text(input);
  std::string begin(std::min<std::uint64_t>(5, input.size() - at), ' ');
  input.read(at, begin.data(), begin.size());
  return lower_case(begin) == "solid";
}

void read_binary(const InputFile& input, std::uint64_t count, Facets& facets) {
  constexpr std::uint64_t at_once = 4096;
  std::vector<char> buffer(at_once * facet_bytes);
  for (std::uint64_t begin = 0; begin < count; begin += at_once) {
    const std::uint64_t some = std::min(at_once, count - begin);
    input.read(header_bytes + begin * facet_bytes, buffer.data(), static_cast<std::size_t>(some * facet_bytes));
    for (std::uint64_t k = 0; k < some; ++k) {
      std::array<std::array<float, 3>, 3> corners;
      std::memcpy(&corners, buffer.data() + k * facet_bytes + 12, sizeof corners);  // behind the normal
      to_machine_order(corners[0].data(), 9, ByteOrder::little);
      facets.add(corners);
    }
  }
}

/// A text of solids: words, whose keywords count in either case.
class Solids {
 public:
  explicit Solids(const InputFile& input) : bytes_(input, begin_of_text(input)), text_(bytes_) {}

  void read(Facets& facets) {
    std::string name;
    while (true) {
      const std::string word = next();
      if (word.empty()) return;
      if (word == "solid" || word == "endsolid") {
        text_.line(name);
      } else if (word == "facet") {
        facets.add(facet(facets.polygons.size()));
      } else {
        damaged("facet ", facets.polygons.size(), " begins with '", word, "'");
      }
    }
  }

 private:
  std::string next() { return lower_case(std::string(text_.word().substr(0, 40))); }

  void require(const char* keyword, std::size_t number) {
    const std::string word = next();
    if (word != keyword) damaged("facet ", number, " has '", word, "' where '", keyword, "' is to be");
  }

  std::array<std::array<float, 3>, 3> facet(std::size_t number) {
    require("normal", number);
    for (int d = 0; d < 3; ++d) next();
    require("outer", number);
    require("loop", number);
    std::array<std::array<float, 3>, 3> corners;
    for (auto& corner : corners) {
      require("vertex", number);
      for (float& coordinate : corner) {
        const std::string_view word = text_.word();
        if (!parse(word, coordinate))
          damaged("a coordinate of facet ", number, " is '", std::string(word.substr(0, 40)), "'");
      }
    }
    require("endloop", number);
    require("endfacet", number);
    return corners;
  }

  FileBytes bytes_;
  TextReader text_;
};

}  // namespace

Content read_stl(const InputFile& input, const ReadOptions& options) {
  MeshParts parts;
  Facets facets;
  const std::optional<std::uint32_t> count = facets_of_binary(input);
  const std::uint64_t behind = input.size() < header_bytes ? 0 : input.size() - header_bytes;
  const bool is_binary = count && behind == *count * facet_bytes;
  if (!is_binary && begins_as_text(input)) {
    Solids(input).read(facets);
  } else {
    if (!count) damaged("it has ", input.size(), " bytes, and a binary STL file has ", header_bytes, " at least");
    if (behind / facet_bytes < *count) damaged("it says ", *count, " facets, and has ", behind / facet_bytes);
    read_binary(input, *count, facets);
    if (!is_binary)
      parts.notices.push_back(text_of("left out ", behind - *count * facet_bytes, " bytes behind its facets"));
  }
  parts.points = facets.points.take();
  parts.cells = facets.polygons.take();
  return to_mesh(parts, options);
}

}  // namespace gale::io::detail
